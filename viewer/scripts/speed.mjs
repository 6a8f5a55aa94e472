// Frame rate with large data: 2,000,000 points at 10 Hz, a map of 4000 x 4000 cells with partial updates, and
// a camera. The server is the reference server of the protocol, in Node.
//
//   npm run bench:frames [PICTURE.png]
//
// Besides frames per second it counts the GPU work per frame, which is the same on every machine: draw calls,
// points, and uploaded bytes.
import protocol from '@foxglove/ws-protocol';
import { WebSocketServer } from 'ws';
import { browser, open, servePage } from '../e2e/lib.mjs';

const POINTS = 2_000_000;
const CELLS = 4000;
const HEADER =
  '================\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n' +
  '================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n';
const CLOUD =
  'std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n' +
  'uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n' +
  '================\nMSG: sensor_msgs/PointField\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n' +
  HEADER;
const ORIGIN =
  '================\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n' +
  '================\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n' +
  '================\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n';
const IMAGE =
  'std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n' +
  HEADER;
const GRID =
  'std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n' +
  '================\nMSG: nav_msgs/MapMetaData\nbuiltin_interfaces/Time map_load_time\nfloat32 resolution\n' +
  'uint32 width\nuint32 height\ngeometry_msgs/Pose origin\n' +
  HEADER +
  ORIGIN;
const UPDATE =
  'std_msgs/Header header\nint32 x\nint32 y\nuint32 width\nuint32 height\nint8[] data\n' + HEADER;

/** Little endian CDR of the messages used here. */
class Cdr {
  parts = [Buffer.from([0, 1, 0, 0])];
  size = 0;
  put(buffer, align) {
    const gap = (align - (this.size % align)) % align;
    if (gap) this.parts.push(Buffer.alloc(gap));
    this.parts.push(buffer);
    this.size += gap + buffer.length;
    return this;
  }
  u8 = (v) => this.put(Buffer.from([v]), 1);
  u32 = (v) => this.put(Buffer.from(new Uint32Array([v]).buffer), 4);
  f32 = (v) => this.put(Buffer.from(new Float32Array([v]).buffer), 4);
  f64 = (v) => this.put(Buffer.from(new Float64Array([v]).buffer), 8);
  text = (v) => this.u32(v.length + 1).put(Buffer.from(`${v}\0`), 1);
  bytes = (v) => this.u32(v.length).put(v, 1);
  header = () => this.u32(0).u32(0).text('map');
  done = () => new Uint8Array(Buffer.concat(this.parts));
}

const points = new Float32Array(POINTS * 4);
for (let i = 0; i < POINTS; i++) {
  const [u, v] = [(i % 2000) / 100 - 10, Math.floor(i / 2000) / 50 - 10];
  points.set([u, v, Math.sin(u) * Math.cos(v) + 1, (u + v) * 10], i * 4);
}
const cloud = new Cdr().header().u32(1).u32(POINTS).u32(4);
['x', 'y', 'z', 'intensity'].forEach((name, i) =>
  cloud
    .text(name)
    .u32(i * 4)
    .u8(7)
    .u32(1),
);
cloud
  .u8(0)
  .u32(16)
  .u32(POINTS * 16)
  .bytes(Buffer.from(points.buffer))
  .u8(1);
const cloudBytes = cloud.done();

const cells = Buffer.alloc(CELLS * CELLS);
for (let i = 0; i < cells.length; i++) {
  cells[i] = (i % CELLS) % 200 < 4 || Math.floor(i / CELLS) % 200 < 4 ? 100 : 0;
}
const grid = new Cdr().header().u32(0).u32(0).f32(0.05).u32(CELLS).u32(CELLS);
for (const v of [-100, -100, 0, 0, 0, 0, 1]) grid.f64(v);
const gridBytes = grid.bytes(cells).done();

/** Counts GPU calls and uploads. Runs in the page. */
function count() {
  const counted = (window.counted = { draws: 0, vertices: 0, bytes: 0 });
  const { prototype: gl } = WebGL2RenderingContext;
  const watch = (name, note) => {
    const own = gl[name];
    gl[name] = function (...all) {
      note(...all);
      return own.apply(this, all);
    };
  };
  const drawn = (vertices) => {
    counted.draws++;
    counted.vertices += vertices;
  };
  watch('drawArrays', (_mode, _first, vertices) => drawn(vertices));
  watch('drawElements', (_mode, vertices) => drawn(vertices));
  watch('drawArraysInstanced', (_mode, _first, vertices, many) => drawn(vertices * many));
  watch('drawElementsInstanced', (_mode, vertices, _type, _at, many) => drawn(vertices * many));
  const sent = (data, length) => {
    if (ArrayBuffer.isView(data)) {
      counted.bytes += length ? length * data.BYTES_PER_ELEMENT : data.byteLength;
    }
  };
  watch('bufferData', (_target, data) => sent(data));
  watch('bufferSubData', (_target, _to, data, _from, length) => sent(data, length));
  const pixels = (...all) => sent(all.find((one) => ArrayBuffer.isView(one)));
  for (const name of ['texImage2D', 'texSubImage2D', 'texStorage2D']) watch(name, pixels);
}

const server = new protocol.FoxgloveServer({
  name: 'speed',
  capabilities: [],
  supportedEncodings: ['cdr'],
});
const sockets = new WebSocketServer({ port: 0, handleProtocols: (p) => server.handleProtocols(p) });
sockets.on('connection', (socket, request) => server.handleConnection(socket, request.url));
await new Promise((resolve) => sockets.once('listening', resolve));
const channel = (topic, schemaName, schema) =>
  server.addChannel({ topic, encoding: 'cdr', schemaName, schema, schemaEncoding: 'ros2msg' });
const ids = {
  cloud: channel('/points', 'sensor_msgs/msg/PointCloud2', CLOUD),
  map: channel('/map', 'nav_msgs/msg/OccupancyGrid', GRID),
  image: channel('/image', 'sensor_msgs/msg/Image', IMAGE),
  updates: channel('/map_updates', 'map_msgs/msg/OccupancyGridUpdate', UPDATE),
};
server.on('subscribe', (id) => {
  if (id === ids.map) server.sendMessage(id, 0n, gridBytes);
});

const pages = await servePage();
const chrome = await browser();
try {
  const { page, complaints } = await open(
    chrome,
    `${pages.url}?ws=ws://127.0.0.1:${sockets.address().port}/`,
  );
  await page.waitForFunction('periplus.topics.length >= 4');
  await page.evaluate(count);
  const measure = async (what, send, everyMs) => {
    const timer = setInterval(send, everyMs);
    await page.waitForTimeout(3000);
    const found = await page.evaluate(
      () =>
        new Promise((resolve) => {
          const { stage } = window.periplus;
          const from = performance.now();
          const before = { ...window.counted };
          let [frames, slowestMs, lastMs] = [0, 0, from];
          const step = () => {
            const now = performance.now();
            slowestMs = Math.max(slowestMs, now - lastMs);
            lastMs = now;
            frames++;
            stage.view.turn(2, 0);
            if (now - from < 4000) {
              requestAnimationFrame(step);
              return;
            }
            const each = (name) => (window.counted[name] - before[name]) / frames;
            resolve({
              fps: (frames * 1000) / (now - from),
              slowestMs,
              draws: each('draws'),
              vertices: each('vertices'),
              bytes: each('bytes'),
            });
          };
          requestAnimationFrame(step);
        }),
    );
    clearInterval(timer);
    const { fps, slowestMs, draws, vertices, bytes } = found;
    console.log(
      `${what}: ${fps.toFixed(1)} frames/s (slowest ${slowestMs.toFixed(0)} ms); a frame: ` +
        `${draws.toFixed(1)} draw calls, ${Math.round(vertices)} vertices, ${Math.round(bytes)} bytes sent`,
    );
  };
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    app.active.isAutomatic = false;
    app.setFixedFrame('map');
    app.setView({ distance: 30, pitch: 0.9 });
    app.active.add('rviz_default_plugins/Map', 'map', { Topic: '/map' });
  });
  let at = 0;
  await measure(
    'map of 4000 x 4000 cells, 200 x 200 of them new ten times a second',
    () => {
      at = (at + 200) % (CELLS - 200);
      const update = new Cdr().header().u32(at).u32(at).u32(200).u32(200);
      server.sendMessage(ids.updates, 0n, update.bytes(Buffer.alloc(40_000, 50)).done());
    },
    100,
  );
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    app.active.add('rviz_default_plugins/Image', 'image', { Topic: '/image' });
  });
  const pixels = Buffer.alloc(640 * 480 * 3, 99);
  const image = new Cdr()
    .header()
    .u32(480)
    .u32(640)
    .text('rgb8')
    .u8(0)
    .u32(1920)
    .bytes(pixels)
    .done();
  await measure(
    'a camera of 640 x 480 at 30 Hz',
    () => server.sendMessage(ids.image, 0n, image),
    33,
  );
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    const look = { Topic: '/points', Style: 'Points', 'Size (Pixels)': 2 };
    app.active.add('rviz_default_plugins/PointCloud2', 'points', look);
  });
  server.sendMessage(ids.cloud, 0n, cloudBytes);
  await measure('2,000,000 points that stand', () => {}, 1000);
  await measure(
    '2,000,000 points, new once a second',
    () => server.sendMessage(ids.cloud, 0n, cloudBytes),
    1000,
  );
  if (process.argv[2]) await page.screenshot({ path: process.argv[2] });
  console.log(complaints.join('\n'));
} finally {
  await chrome.close();
  pages.stop();
  sockets.close();
  process.exit();
}
