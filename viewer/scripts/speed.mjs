// Frame rate with large data: 2,000,000 points at 10 Hz, a map of 4000 x 4000 cells with partial updates, and
// a camera. The server is the reference server of the protocol, in Node.
//
//   npm run bench:frames [PICTURE.png]
//
// Besides frames per second it counts the GPU work per frame, which is the same on every machine: draw calls,
// points, and uploaded bytes.
import { browser, open, servePage } from '../e2e/lib.mjs';
import { Cdr, CLOUD, count, GRID, IMAGE, measure, serve, UPDATE } from './frames.mjs';

const POINTS = 2_000_000;
const CELLS = 4000;
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

const { server, sockets, channel, url } = await serve();
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
  const { page, complaints } = await open(chrome, `${pages.url}?ws=${url}`);
  await page.waitForFunction('periplus.topics.length >= 4');
  await page.evaluate(count);
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    app.active.isAutomatic = false;
    app.setFixedFrame('map');
    app.setView({ distance: 30, pitch: 0.9 });
    app.active.add('rviz_default_plugins/Map', 'map', { Topic: '/map' });
  });
  let at = 0;
  await measure(page, 'map of 4000 x 4000 cells, 200 x 200 of them new ten times a second', [
    [
      () => {
        at = (at + 200) % (CELLS - 200);
        const update = new Cdr().header().u32(at).u32(at).u32(200).u32(200);
        server.sendMessage(ids.updates, 0n, update.bytes(Buffer.alloc(40_000, 50)).done());
      },
      100,
    ],
  ]);
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
  await measure(page, 'a camera of 640 x 480 at 30 Hz', [
    [() => server.sendMessage(ids.image, 0n, image), 33],
  ]);
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    const look = { Topic: '/points', Style: 'Points', 'Size (Pixels)': 2 };
    app.active.add('rviz_default_plugins/PointCloud2', 'points', look);
  });
  server.sendMessage(ids.cloud, 0n, cloudBytes);
  await measure(page, '2,000,000 points that stand', []);
  await measure(page, '2,000,000 points, new once a second', [
    [() => server.sendMessage(ids.cloud, 0n, cloudBytes), 1000],
  ]);
  if (process.argv[2]) await page.screenshot({ path: process.argv[2] });
  console.log(complaints.join('\n'));
} finally {
  await chrome.close();
  pages.stop();
  sockets.close();
  process.exit();
}
