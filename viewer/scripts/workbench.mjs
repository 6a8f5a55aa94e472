// Frame rate of a whole workbench at 1280 x 720: a map of 2,000 x 2,000 cells, a scan, a global and a local costmap,
// a camera of 640 x 480 and a cloud of 50,000 points, all new at the rates of a robot, while the view turns.
//
//   npm run bench:workbench [PICTURE.png]
import { browser, open, servePage } from '../e2e/lib.mjs';
import { Cdr, CLOUD, count, GRID, IMAGE, measure, SCAN, serve, UPDATE } from './frames.mjs';

const CELLS = 2000;
const LOCAL_CELLS = 120;
const POINTS = 50_000;
const BEAMS = 720;

/** An occupancy grid with walls every ten metres; `shade` makes costs around them. */
function grid(cells, resolutionM, originM, shade) {
  const data = Buffer.alloc(cells * cells);
  for (let i = 0; i < data.length; i++) {
    const [x, y] = [(i % cells) % 200, Math.floor(i / cells) % 200];
    const wall = Math.min(x, y);
    data[i] = wall < 4 ? 100 : shade && wall < 20 ? 98 - 4 * wall : 0;
  }
  const message = new Cdr().header().u32(0).u32(0).f32(resolutionM).u32(cells).u32(cells);
  for (const v of [originM, originM, 0, 0, 0, 0, 1]) message.f64(v);
  return message.bytes(data).done();
}

const map = grid(CELLS, 0.05, -50, false);
const globalCostmap = grid(CELLS, 0.05, -50, true);
const localCostmap = grid(LOCAL_CELLS, 0.05, -3, true);
const update = (at) =>
  new Cdr().header().u32(at).u32(at).u32(100).u32(100).bytes(Buffer.alloc(10_000, 60)).done();

function scan(turnRad) {
  const message = new Cdr().header();
  for (const v of [-Math.PI, Math.PI, (2 * Math.PI) / BEAMS, 0, 0.1, 0.1, 12]) message.f32(v);
  message.u32(BEAMS);
  for (let i = 0; i < BEAMS; i++) message.f32(4 + Math.sin((i / BEAMS) * 20 + turnRad));
  return message.u32(0).done();
}

function cloud(turnRad) {
  const points = new Float32Array(POINTS * 4);
  for (let i = 0; i < POINTS; i++) {
    const [u, v] = [(i % 250) / 12.5 - 10, Math.floor(i / 250) / 10 - 10];
    points.set([u, v, Math.sin(u + turnRad) * Math.cos(v) + 2, (u + v) * 10], i * 4);
  }
  const message = new Cdr().header().u32(1).u32(POINTS).u32(4);
  ['x', 'y', 'z', 'intensity'].forEach((name, i) =>
    message
      .text(name)
      .u32(i * 4)
      .u8(7)
      .u32(1),
  );
  return message
    .u8(0)
    .u32(16)
    .u32(POINTS * 16)
    .bytes(Buffer.from(points.buffer))
    .u8(1)
    .done();
}

function image(shade) {
  const pixels = Buffer.alloc(640 * 480 * 3);
  for (let i = 0; i < pixels.length; i++) pixels[i] = (i / 3 + shade) & 255;
  const message = new Cdr().header().u32(480).u32(640).text('rgb8').u8(0).u32(1920);
  return message.bytes(pixels).done();
}

// Prepared before: what is measured is the page, not this program.
const scans = Array.from({ length: 10 }, (_, i) => scan(i * 0.2));
const clouds = Array.from({ length: 10 }, (_, i) => cloud(i * 0.2));
const images = Array.from({ length: 10 }, (_, i) => image(i * 20));

const { server, sockets, channel, url } = await serve();
const ids = {
  map: channel('/map', 'nav_msgs/msg/OccupancyGrid', GRID),
  global: channel('/global_costmap/costmap', 'nav_msgs/msg/OccupancyGrid', GRID),
  globalUpdates: channel(
    '/global_costmap/costmap_updates',
    'map_msgs/msg/OccupancyGridUpdate',
    UPDATE,
  ),
  local: channel('/local_costmap/costmap', 'nav_msgs/msg/OccupancyGrid', GRID),
  scan: channel('/scan', 'sensor_msgs/msg/LaserScan', SCAN),
  cloud: channel('/points', 'sensor_msgs/msg/PointCloud2', CLOUD),
  image: channel('/image', 'sensor_msgs/msg/Image', IMAGE),
};
server.on('subscribe', (id) => {
  if (id === ids.map) server.sendMessage(id, 0n, map);
  if (id === ids.global) server.sendMessage(id, 0n, globalCostmap);
});

const pages = await servePage();
const chrome = await browser();
try {
  const { page, complaints } = await open(chrome, `${pages.url}?ws=${url}`);
  await page.waitForFunction('periplus.topics.length >= 7');
  await page.evaluate(count);
  await page.evaluate(() => {
    const app = window.periplus;
    app.active.clear();
    app.active.isAutomatic = false;
    app.setFixedFrame('map');
    app.setView({ distance: 25, pitch: 0.8 });
    const add = (kind, topic, more = {}) =>
      app.active.add(`rviz_default_plugins/${kind}`, topic, { Topic: topic, ...more });
    add('Map', '/map');
    add('Map', '/global_costmap/costmap', { 'Color Scheme': 'costmap', Alpha: 0.5 });
    add('Map', '/local_costmap/costmap', { 'Color Scheme': 'costmap', Alpha: 0.7 });
    add('LaserScan', '/scan');
    add('PointCloud2', '/points', { Style: 'Points', 'Size (Pixels)': 2 });
    add('Image', '/image');
  });
  let tick = 0;
  const send = (id, bytes) => server.sendMessage(id, 0n, bytes);
  const every = [
    [() => send(ids.scan, scans[tick++ % 10]), 100],
    [() => send(ids.cloud, clouds[tick % 10]), 100],
    [() => send(ids.image, images[tick % 10]), 33],
    [() => send(ids.local, localCostmap), 200],
    [() => send(ids.globalUpdates, update((tick * 10) % (CELLS - 100))), 1000],
  ];
  const only = process.argv.includes('--parts');
  await measure(page, 'workbench, everything', every);
  if (only) {
    const names = [
      'scan 10 Hz',
      'cloud 10 Hz',
      'camera 30 Hz',
      'local costmap 5 Hz',
      'global 1 Hz',
    ];
    for (const [i, one] of every.entries()) await measure(page, `only ${names[i]} new`, [one]);
    await measure(page, 'nothing new', []);
    const displays = await page.evaluate(() => window.periplus.displays.map((d) => d.name));
    for (const name of [...displays, 'none of them']) {
      await page.evaluate((shown) => {
        const { active } = window.periplus;
        for (const entry of active.displays) active.setEnabled(entry, entry.name === shown);
      }, name);
      await page.waitForTimeout(300);
      const again = {
        '/map': [ids.map, map],
        '/points': [ids.cloud, clouds[0]],
        '/scan': [ids.scan, scans[0]],
      }[name];
      if (again) send(...again);
      await measure(page, `shown alone: ${name}`, []);
    }
  }
  const picture = process.argv.slice(2).find((word) => word.endsWith('.png'));
  if (picture) await page.screenshot({ path: picture });
  console.log(complaints.join('\n'));
} finally {
  await chrome.close();
  pages.stop();
  sockets.close();
  process.exit();
}
