// Library of the measurements of frames: large messages from the reference server of the protocol, in Node, and
// counts of the GPU work per frame, which is the same on every machine.
import { readdirSync, readFileSync } from 'node:fs';
import protocol from '@foxglove/ws-protocol';
import { WebSocketServer } from 'ws';

const HEADER =
  '================\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n' +
  '================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n';
export const CLOUD =
  'std_msgs/Header header\nuint32 height\nuint32 width\nPointField[] fields\nbool is_bigendian\n' +
  'uint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n' +
  '================\nMSG: sensor_msgs/PointField\nstring name\nuint32 offset\nuint8 datatype\nuint32 count\n' +
  HEADER;
const ORIGIN =
  '================\nMSG: geometry_msgs/Pose\ngeometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n' +
  '================\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n' +
  '================\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n';
export const IMAGE =
  'std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 step\nuint8[] data\n' +
  HEADER;
export const GRID =
  'std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n' +
  '================\nMSG: nav_msgs/MapMetaData\nbuiltin_interfaces/Time map_load_time\nfloat32 resolution\n' +
  'uint32 width\nuint32 height\ngeometry_msgs/Pose origin\n' +
  HEADER +
  ORIGIN;
export const UPDATE =
  'std_msgs/Header header\nint32 x\nint32 y\nuint32 width\nuint32 height\nint8[] data\n' + HEADER;

export const SCAN =
  'std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n' +
  'float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n' +
  'float32[] ranges\nfloat32[] intensities\n' +
  HEADER;

/** Little endian CDR of the messages used here. */
export class Cdr {
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

/** Counts GPU calls and uploads. Runs in the page. */
export function count() {
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

/** A server of the protocol on any free port. */
export async function serve() {
  const server = new protocol.FoxgloveServer({
    name: 'speed',
    capabilities: [],
    supportedEncodings: ['cdr'],
  });
  const sockets = new WebSocketServer({
    port: 0,
    handleProtocols: (p) => server.handleProtocols(p),
  });
  sockets.on('connection', (socket, request) => server.handleConnection(socket, request.url));
  await new Promise((resolve) => sockets.once('listening', resolve));
  const channel = (topic, schemaName, schema) =>
    server.addChannel({ topic, encoding: 'cdr', schemaName, schema, schemaEncoding: 'ros2msg' });
  return { server, sockets, channel, url: `ws://127.0.0.1:${sockets.address().port}/` };
}

/** CPU time of the browser's processes so far, by their role [s]; on Linux only. */
function cpuOfBrowser() {
  const found = { page: 0, gpu: 0, rest: 0 };
  const ours = new Set([process.pid]);
  const all = readdirSync('/proc')
    .filter((name) => /^\d+$/.test(name))
    .map(Number)
    .sort((a, b) => a - b);
  for (const id of all) {
    let stat, words;
    try {
      stat = readFileSync(`/proc/${id}/stat`, 'utf8');
      words = readFileSync(`/proc/${id}/cmdline`, 'utf8');
    } catch {
      continue;
    }
    const fields = stat.slice(stat.lastIndexOf(')') + 2).split(' ');
    if (!ours.has(Number(fields[1]))) continue;
    ours.add(id);
    const role = words.includes('--type=renderer')
      ? 'page'
      : words.includes('--type=gpu-process')
        ? 'gpu'
        : 'rest';
    // utime and stime, in hundredths of a second.
    found[role] += (Number(fields[11]) + Number(fields[12])) / 100;
  }
  return found;
}

/**
 * Sends messages while the view turns, and prints frames per second and the work per frame. `senders` is a list of
 * functions with their periods [ms].
 */
export async function measure(page, what, senders) {
  const timers = senders.map(([send, everyMs]) => setInterval(send, everyMs));
  await page.waitForTimeout(3000);
  const before = cpuOfBrowser();
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
            frames,
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
  timers.forEach(clearInterval);
  const after = cpuOfBrowser();
  const cpuMs = (role) => (((after[role] - before[role]) * 1000) / found.frames).toFixed(1);
  const { fps, slowestMs, draws, vertices, bytes } = found;
  console.log(
    `${what}: ${fps.toFixed(1)} frames/s (slowest ${slowestMs.toFixed(0)} ms); a frame: ` +
      `${draws.toFixed(1)} draw calls, ${Math.round(vertices)} vertices, ${Math.round(bytes)} bytes sent, CPU ` +
      `${cpuMs('page')} ms page, ${cpuMs('gpu')} ms drawing, ${cpuMs('rest')} ms rest`,
  );
}
