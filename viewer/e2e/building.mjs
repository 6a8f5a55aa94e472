// The Building Editor: a room is drawn, saved, checked, simulated and scanned; buildings of other programs are
// opened, changed and saved.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { readFileSync } from 'node:fs';
import { next, open, periplus, PROGRAM, ROOT, sim, until, port } from './lib.mjs';

const PORT = port(8822);
const KBOT = 'robots/kbot/urdf/kbot.urdf.xacro';
const CORPUS = join(ROOT, '../shared/corpus');

/** Report of `periplus check` for a file; it must have no finding. */
function checked(file) {
  const said = execFileSync(PROGRAM, ['check', file], { encoding: 'utf8' });
  assert.match(said, /no findings/, said);
}

async function saved(page, button, file) {
  const wrong = await page.evaluate(() =>
    [...document.querySelectorAll('.properties p.warn')].map((p) => p.textContent),
  );
  assert.deepEqual(wrong, []);
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('dialog').getByRole('button', { name: button, exact: true }).click(),
  ]);
  await download.saveAs(file);
}

/** Screen position of a point of the plan, whose center is at 3, 2. */
async function presser(page) {
  const box = await page.getByRole('application').boundingBox();
  return async (x, y) => {
    const zoom = await page.evaluate('building.zoom');
    const [px, py] = [box.width / 2 + (x - 3) * zoom, box.height / 2 - (y - 2) * zoom];
    await page.mouse.click(box.x + px, box.y + py);
  };
}

const lengths = (page) =>
  page.evaluate(
    'building.plan.walls.map((w) => +Math.hypot(w.to.x - w.from.x, w.to.y - w.from.y).toFixed(3))',
  );

/** `liveUrl`: the page that shows the simulation of the room, with a server. */
export async function building(chrome, url, out, liveUrl = url) {
  const { page } = await open(chrome, `${url}#building`, { bypassCSP: true });
  const press = await presser(page);
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
  // Labels of the plan are not crossed by the lines of the wall being drawn.
  for (const mode of ['select', 'wall', 'door', 'window', 'stairs', 'scale']) {
    await page.evaluate((name) => window.building.setMode(name), mode);
    await page.waitForFunction(
      (name) => document.querySelector('svg[role=application]').classList.contains(`mode-${name}`),
      mode,
    );
    const strokes = await page.evaluate(() =>
      [...document.querySelectorAll('svg[role=application] text')].map(
        (t) => getComputedStyle(t).stroke,
      ),
    );
    assert.deepEqual([...new Set(strokes)], ['none'], `letters while in mode ${mode}`);
  }
  await page.evaluate(() => window.building.setMode('window'));
  assert.equal(await page.evaluate('building.plan.openings.length'), 1);
  const world = join(out, 'room.world');
  await saved(page, 'World', world);
  checked(world);
  await page.getByTestId('building-file').setInputFiles(world);
  await page.waitForFunction(
    'building.plan.name === "building" && building.plan.walls.length === 4',
  );
  assert.deepEqual(await lengths(page), [6, 4, 6, 4]);
  await page.close();
  const run = await periplus(sim(world, KBOT, '--pose', '2,2,0', `--page=127.0.0.1:${PORT}`), PORT);
  try {
    const { page: live } = await open(chrome, `${liveUrl}?ws=ws://127.0.0.1:${PORT}/`);
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
    // Walls are 0.15 m thick, and drawn by their center lines.
    const drawn = { right: 3.925, left: -1.925, up: 1.925, down: -1.925 };
    for (const [side, m] of Object.entries(drawn)) {
      assert.ok(Math.abs(found[side] - m) < 0.02, `${side}: ${found[side]} m instead of ${m} m`);
    }
    await live.close();
  } finally {
    await run.stop();
  }
}

/** Files of Gazebo's editor, partly edited by hand: their numbers of walls, doors and windows. */
const FOREIGN = [
  { file: join(ROOT, 'worlds/models/closed_room/model.sdf'), walls: 6, doors: 1 },
  {
    file: join(
      CORPUS,
      'turtlebot3_simulations/turtlebot3_gazebo/models/turtlebot3_house/model.sdf',
    ),
    walls: 10,
  },
];

export async function foreignBuildings(chrome, url, out) {
  const { page } = await open(chrome, `${url}#building`);
  await page.getByRole('application').waitFor();
  for (const { file, walls, doors } of FOREIGN) {
    if (!existsSync(file)) {
      console.log(`SKIPPED: ${file} is not there`);
      continue;
    }
    const name = /<model name=['"]([^'"]+)/.exec(readFileSync(file, 'utf8'))[1];
    await page.getByTestId('building-file').setInputFiles(file);
    await page.waitForFunction((wanted) => window.building.plan.name === wanted, name);
    const had = await page.evaluate(() => ({
      walls: window.building.plan.walls.length,
      doors: window.building.plan.openings.filter((o) => o.kind === 'door').length,
    }));
    assert.ok(had.walls >= walls, `${name} has ${had.walls} walls`);
    if (doors !== undefined) assert.deepEqual(had, { walls, doors });
    // One more wall, drawn by keys: from a corner of the grid 1.5 m to the right.
    await page.keyboard.press('w');
    await page.getByRole('application').focus();
    await page.keyboard.press('Enter');
    for (const key of ['Shift+ArrowRight', '1', '.', '5', 'Enter', 'Escape']) {
      await page.keyboard.press(key);
    }
    assert.equal((await lengths(page)).at(-1), 1.5);
    assert.equal((await lengths(page)).length, had.walls + 1);
    const folder = join(out, name);
    mkdirSync(folder);
    const world = join(folder, `${name}.world`);
    await saved(page, 'World', world);
    checked(world);
    await page.getByTestId('building-file').setInputFiles(world);
    await page.waitForFunction(
      (count) => window.building.plan.walls.length === count,
      had.walls + 1,
    );
    await page.getByRole('button', { name: 'New' }).click();
  }
  // The model is a folder in a .zip file; the program reads its files.
  const press = await presser(page);
  for (const [x, y] of [
    [0, 0],
    [3, 0],
  ]) {
    await press(x, y);
  }
  await page.keyboard.press('Escape');
  const packed = join(out, 'model.zip');
  await saved(page, 'Model', packed);
  for (const [name, bytes] of stored(readFileSync(packed))) {
    mkdirSync(dirname(join(out, name)), { recursive: true });
    writeFileSync(join(out, name), bytes);
  }
  checked(join(out, 'building/model.sdf'));
  await page.close();
}

/** Files of a .zip file without compression. */
function* stored(zip) {
  for (let at = 0; zip.readUInt32LE(at) === 0x04034b50;) {
    const [size, name, extra] = [
      zip.readUInt32LE(at + 18),
      zip.readUInt16LE(at + 26),
      zip.readUInt16LE(at + 28),
    ];
    const from = at + 30 + name + extra;
    yield [zip.toString('utf8', at + 30, at + 30 + name), zip.subarray(from, from + size)];
    at = from + size;
  }
}
