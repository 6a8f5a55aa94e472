// The page beside a running Periplus, in Debian's Chromium without a window.
//
//   npm run e2e [NAME...]     PERIPLUS=path/to/periplus
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { browser, open, periplus, PROGRAM, ROOT, servePage, sim } from './lib.mjs';

const CORPUS = join(ROOT, '../shared/corpus');
const PORT = 8821;
const KBOT = 'robots/kbot/urdf/kbot.urdf.xacro';
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';
const out = mkdtempSync(join(tmpdir(), 'periplus-e2e-'));

/** Waits until an expression in the page is true. */
const until = (page, expression, what, timeout = 20_000) =>
  page.waitForFunction(expression, undefined, { timeout }).catch(async () => {
    const now = await page.evaluate(() => ({
      displays: window.periplus.displays.map((d) => [
        d.name,
        ...Object.values(d.statuses).map((s) => s.text),
      ]),
      notices: window.periplus.notices.map((n) => n.text),
      frames: window.periplus.frames,
    }));
    throw new Error(`${what} did not happen; the page says ${JSON.stringify(now)}`);
  });

/** Numbers of a message of a topic, taken in the page. */
const next = (page, topic, pick) =>
  page.evaluate(
    ([name, text]) =>
      new Promise((resolve, reject) => {
        setTimeout(() => reject(new Error(`nothing came on ${name}`)), 8000);
        const leave = window.periplus.client.subscribe(name, (message) => {
          leave();
          resolve(new Function('message', `return ${text}`)(message));
        });
      }),
    [topic, pick],
  );

const where = (page) =>
  page.evaluate(() => {
    const found = window.periplus.tf.lookup('odom', 'base_footprint');
    return found.kind === 'found' ? found.pose.t : undefined;
  });

const tests = {
  /** The robot goes where keys send it, and the map grows. */
  async drive(page) {
    await until(page, "periplus.fixedFrame === 'map'", 'a map');
    await until(page, 'periplus.displays.some((d) => d.kind.title === "RobotModel")', 'a robot');
    await page.waitForTimeout(500);
    const before = await where(page);
    const known = () => next(page, '/map', 'message.data.reduce((n, c) => n + (c >= 0), 0)');
    const first = await known();
    await page.locator('canvas').first().focus();
    // The key is held until it has got somewhere: a machine may be slow.
    await page.keyboard.down('i');
    await until(
      page,
      `(() => {
        const found = periplus.tf.lookup('odom', 'base_footprint');
        return found.kind === 'found' && Math.hypot(found.pose.t[0] - ${before[0]}, found.pose.t[1] - ${before[1]}) > 0.5;
      })()`,
      'driving half a metre',
      40_000,
    );
    await page.keyboard.up('i');
    await page.waitForTimeout(1500);
    const there = await where(page);
    await page.waitForTimeout(1000);
    const still = await where(page);
    const rolled = Math.hypot(still[0] - there[0], still[1] - there[1]);
    assert.ok(rolled < 0.1, `without a key it went on by ${rolled} m`);
    await page.keyboard.down('j');
    await page.waitForTimeout(3000);
    await page.keyboard.up('j');
    let later = first;
    for (let i = 0; i < 20 && later <= first; i++) {
      await page.waitForTimeout(1000);
      later = await known();
    }
    assert.ok(later > first, `cells of the map: ${first}, then ${later}`);
  },

  /** A map's changes come as changes, and are drawn. */
  async map(page) {
    await until(
      page,
      'periplus.displays.some((d) => d.kind.title === "Map" && Number(d.values.Width) > 10)',
      'a map with its size in words',
    );
    const levels = await page.evaluate(() =>
      window.periplus.displays.filter((d) => d.kind.title === 'Map').map((d) => d.level),
    );
    assert.deepEqual(
      levels,
      levels.map(() => 'ok'),
    );
  },

  /** Pause and step by the buttons. */
  async pause(page) {
    await page.getByRole('button', { name: 'Pause' }).first().click();
    await until(page, 'periplus.isStill', 'standing still');
    const before = await page.evaluate('periplus.clock.nowS');
    await page.getByRole('button', { name: 'Step' }).first().click();
    await until(page, `periplus.clock.nowS > ${before}`, 'a step');
    await page.getByRole('button', { name: 'Play', exact: true }).first().click();
    await until(page, '!periplus.isStill', 'going on');
  },

  /** A thing is put in front of the robot, seen by its scanner, and taken away. */
  async insert(page) {
    const scan = '/kbot/sensor_laser/scan';
    const nearest = () => next(page, scan, 'Math.min(...message.ranges.filter((r) => r > 0.05))');
    const before = await nearest();
    const at = await page.evaluate(() => window.periplus.tf.lookup('odom', 'base_footprint').pose);
    assert.ok(at, 'a place');
    await page.getByRole('tab', { name: 'World' }).click();
    await page.evaluate(async () => {
      const sdf =
        '<sdf version="1.6"><model name="pin"><static>1</static><link name="l"><collision name="c"><geometry><cylinder><radius>0.6</radius><length>2</length></cylinder></geometry></collision></link></model></sdf>';
      const pose = { position: { x: 0, y: 0, z: 1 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
      const name = `/world/${window.periplus.worldName}/create`;
      const factory = { name: 'pin', sdf, pose, relative_to: 'world' };
      window.done = await window.periplus.call(name, { entity_factory: factory });
    });
    assert.ok(await page.evaluate('!!window.done'), 'it was put there');
    await page.waitForTimeout(600);
    const now = await nearest();
    assert.notEqual(now.toFixed(2), before.toFixed(2));
    assert.equal(
      await page.evaluate(async () => {
        const entity = { name: 'pin', type: 2 };
        const name = `/world/${window.periplus.worldName}/remove`;
        return !!(await window.periplus.call(name, { entity }));
      }),
      true,
    );
  },

  /** Parameters of nodes, with bounds that they told of. */
  async parameters(page) {
    await page.getByRole('tab', { name: 'Parameters' }).click();
    await until(page, 'Object.keys(periplus.parameters).length > 10', 'parameters');
    const panel = page.getByRole('tabpanel');
    await panel.getByLabel('Search parameters').fill('resolution');
    await panel.locator('.parameter').first().waitFor();
  },

  /** RViz's files give the displays they name. */
  async rviz(page) {
    const files = {
      'navigation2_tutorials@humble/sam_bot_description/rviz/urdf_config.rviz': [
        'Grid',
        'RobotModel',
        'TF',
        'Map',
      ],
      'andino/andino_navigation/rviz/nav2_default_view.rviz': [
        ...['Grid', 'RobotModel', 'TF', 'LaserScan', 'PointCloud2', 'Map', 'ParticleCloud'],
        ...['Map', 'Map', 'Path', 'PointCloud2', 'Polygon', 'Map', 'Path', 'MarkerArray'],
        ...['Polygon', 'PointCloud2', 'Image', 'PointCloud2', 'MarkerArray'],
      ],
    };
    for (const [name, kinds] of Object.entries(files)) {
      const file = join(CORPUS, name);
      if (!existsSync(file)) {
        console.log(`SKIPPED: ${name} is not there`);
        continue;
      }
      await page.getByTestId('rviz-file').setInputFiles(file);
      await until(page, `periplus.fileName === ${JSON.stringify(name.split('/').pop())}`, name);
      const shown = await page.evaluate('periplus.displays.map((d) => d.kind.title)');
      assert.deepEqual(shown, kinds);
      const text = await page.evaluate('periplus.rvizText()');
      assert.match(text, /Visualization Manager/);
    }
  },
};

/** A room is drawn, saved, checked, simulated, and seen by a scanner where it was drawn. */
async function building(chrome, url) {
  const { page } = await open(chrome, `${url}#building`);
  const plan = page.getByRole('application');
  const box = await plan.boundingBox();
  const press = async (x, y) => {
    const zoom = await page.evaluate('building.zoom');
    const [px, py] = [box.width / 2 + (x - 3) * zoom, box.height / 2 - (y - 2) * zoom];
    await page.mouse.click(box.x + px, box.y + py);
  };
  for (const [x, y] of [
    [0, 0],
    [6, 0],
    [6, 4],
    [0, 4],
    [0, 0],
  ]) {
    await press(x, y);
  }
  await page.keyboard.press('n');
  await press(3, 4);
  await page.keyboard.press('Control+z');
  await page.keyboard.press('Control+y');
  assert.equal(await page.evaluate('building.plan.openings.length'), 1);
  const dialog = page.getByRole('dialog');
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    dialog.getByRole('button', { name: 'World' }).click(),
  ]);
  const world = join(out, 'room.world');
  await download.saveAs(world);
  const said = execFileSync(PROGRAM, ['check', world], { encoding: 'utf8' });
  assert.match(said, /no findings/);
  await page.getByTestId('building-file').setInputFiles(world);
  await page.waitForFunction(
    'building.plan.name === "building" && building.plan.walls.length === 4',
  );
  const lengths = await page.evaluate(
    'building.plan.walls.map((w) => Math.hypot(w.to.x - w.from.x, w.to.y - w.from.y))',
  );
  assert.deepEqual(
    lengths.map((l) => +l.toFixed(3)),
    [6, 4, 6, 4],
  );
  await page.close();
  const run = await periplus(sim(world, KBOT, '--pose', '2,2,0', `--page=127.0.0.1:${PORT}`), PORT);
  try {
    const { page: live } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
    await until(live, 'periplus.tf.has("odom")', 'odometry');
    const found = await next(
      live,
      '/kbot/sensor_laser/scan',
      `(() => {
        const { pose } = periplus.tf.lookup('base_footprint', message.header.frame_id);
        const xs = [], ys = [];
        message.ranges.forEach((r, i) => {
          if (!(r < message.range_max)) return;
          const a = message.angle_min + i * message.angle_increment + 2 * Math.atan2(pose.q[2], pose.q[3]);
          xs.push(pose.t[0] + r * Math.cos(a)); ys.push(pose.t[1] + r * Math.sin(a));
        });
        const middle = (all, side) => { const near = all.filter(side).sort((a, b) => a - b); return near[near.length >> 1]; };
        return { right: middle(xs, (x) => x > 3.7), left: middle(xs, (x) => x < -1.8), up: middle(ys, (y) => y > 1.8), down: middle(ys, (y) => y < -1.8) };
      })()`,
    );
    // Walls are 0.15 m thick, and drawn by their middles.
    const drawn = { right: 3.925, left: -1.925, up: 1.925, down: -1.925 };
    for (const [side, m] of Object.entries(drawn)) {
      assert.ok(Math.abs(found[side] - m) < 0.02, `${side}: ${found[side]} m instead of ${m} m`);
    }
    await live.close();
  } finally {
    await run.stop();
  }
}

/** The camera of the robot shows what stands before it. */
async function image(chrome, url) {
  const run = await periplus(
    sim('worlds/cube_and_sphere.sdf', SAM_BOT, `--page=127.0.0.1:${PORT}`),
    PORT,
  );
  try {
    const { page } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
    await until(
      page,
      'periplus.displays.some((d) => d.canvas && d.canvas.width > 300)',
      'a picture',
      30_000,
    );
    await page.waitForTimeout(500);
    const share = await page.evaluate(() => {
      const { canvas } = window.periplus.displays.find((d) => d.canvas && d.canvas.width > 300);
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      const colors = new Map();
      for (let i = 0; i < data.length; i += 4) {
        const key = (data[i] >> 5) * 64 + (data[i + 1] >> 5) * 8 + (data[i + 2] >> 5);
        colors.set(key, (colors.get(key) ?? 0) + 1);
      }
      return [...colors.values()].sort((a, b) => b - a).map((n) => (n * 4) / data.length);
    });
    assert.ok(share.length >= 3, 'the picture has the cube, the ground and the sky');
    assert.ok(share[0] < 0.9, `one colour fills ${(share[0] * 100).toFixed(0)} % of the picture`);
    await page.close();
  } finally {
    await run.stop();
  }
}

const wanted = process.argv.slice(2);
const isWanted = (name) => wanted.length === 0 || wanted.includes(name);
const pages = await servePage();
const chrome = await browser();
let failed = 0;
async function attempt(name, test) {
  if (!isWanted(name)) return;
  const from = Date.now();
  try {
    await test();
    console.log(`ok   ${name} (${((Date.now() - from) / 1000).toFixed(1)} s)`);
  } catch (error) {
    failed++;
    console.log(`FAIL ${name}: ${error.stack ?? error}`);
  }
}
try {
  if (Object.keys(tests).some(isWanted)) {
    const run = await periplus(
      [
        'sim',
        'worlds/closed_room.world',
        '--robot',
        KBOT,
        '--slam',
        '--rtf',
        '1',
        '--ros2',
        'off',
        `--page=127.0.0.1:${PORT}`,
      ],
      PORT,
    );
    const { page, complaints } = await open(chrome, `${pages.url}?ws=ws://127.0.0.1:${PORT}/`);
    for (const [name, test] of Object.entries(tests)) await attempt(name, () => test(page));
    await attempt('quiet', async () => assert.deepEqual(complaints, []));
    await page.close();
    await run.stop();
  }
  await attempt('image', () => image(chrome, pages.url));
  await attempt('building', () => building(chrome, pages.url));
} finally {
  await chrome.close();
  pages.stop();
  rmSync(out, { recursive: true });
}
process.exitCode = failed > 0 ? 1 : 0;
