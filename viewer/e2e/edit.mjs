// Editing of the simulated world: every kind of edit, undo and redo of all of them, handles, saving with a diff.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { open, periplus, until, port } from './lib.mjs';

const PORT = port(8841);
const WORLD = 'worlds/cube_and_sphere.sdf';

const panel = (page) => page.getByRole('tabpanel');
const press = (page, name) => panel(page).getByRole('button', { name, exact: true }).click();
const option = (page, name) => page.getByRole('option', { name, exact: true });
const idle = (page) => page.waitForTimeout(250);

/** Elements of the models in the world's SDF, sorted by name: a model that came back is the last of its world. */
const models = (page) =>
  page.evaluate(async () => {
    const { message } = await periplus.client.call(`/world/${periplus.worldName}/save`, {});
    const world = new DOMParser().parseFromString(message, 'text/xml').querySelector('world');
    const found = [...world.children].filter((one) => one.localName === 'model');
    // Rounded: a pose is a product of rotations.
    const rounded = (text) =>
      text.replace(/-?\d+\.\d+(e-?\d+)?/g, (n) => `${+(+n).toFixed(9) + 0}`);
    return found.map((one) => rounded(one.outerHTML)).sort();
  });
const changes = (page) =>
  page.evaluate(async () => {
    const name = `/world/${periplus.worldName}/changes`;
    if (!periplus.client.services.has(name)) return undefined;
    return JSON.parse((await periplus.client.call(name, {})).message).changes;
  });
const pose = (page, name) => page.evaluate((n) => periplus.world().poseOf(n), name);

/** Position on the page of a point in the world frame, which is the fixed frame here. */
const pixel = (page, point) =>
  page.evaluate(([x, y, z]) => {
    const { view, renderer } = periplus.stage;
    const at = view.camera.position.clone().set(x, y, z).project(view.camera);
    const box = renderer.domElement.getBoundingClientRect();
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  }, point);

async function choose(page, ...names) {
  await page.evaluate(() => (periplus.selection = []));
  for (const [i, name] of names.entries()) {
    await option(page, name).click(i > 0 ? { modifiers: ['Shift'] } : {});
  }
}
async function type(page, field, value) {
  const input = page.getByRole('group', { name: 'Pose in the world' }).getByLabel(field);
  await input.fill(String(value));
  await input.press('Enter');
  await input.blur();
  await idle(page);
}
async function drag(page, from, to, keys = []) {
  await page.mouse.move(...from);
  await page.mouse.down();
  for (const key of keys) await page.keyboard.down(key);
  for (let i = 1; i <= 6; i++) {
    await page.mouse.move(
      from[0] + ((to[0] - from[0]) * i) / 6,
      from[1] + ((to[1] - from[1]) * i) / 6,
    );
    await page.waitForTimeout(40);
  }
  await page.mouse.up();
  for (const key of keys) await page.keyboard.up(key);
  await page.waitForTimeout(500);
}

/** All kinds of edits, one after the other. */
const EDITS = [
  async function insert(page) {
    await press(page, 'box');
    await page.mouse.click(...(await pixel(page, [1, -3, 0])));
    await option(page, 'box').waitFor();
  },
  async function moveByNumber(page) {
    await choose(page, 'box');
    await type(page, 'x', 1.23);
  },
  async function rotateByNumber(page) {
    await type(page, 'yaw', 30);
  },
  async function rename(page) {
    const input = panel(page).getByLabel('Name', { exact: true });
    await input.fill('crate');
    await input.press('Enter');
    await option(page, 'crate').waitFor();
  },
  async function duplicate(page) {
    await choose(page, 'crate');
    await page.locator('canvas').first().focus();
    await page.keyboard.press('Control+d');
    await option(page, 'crate_0').waitFor();
  },
  async function align(page) {
    await choose(page, 'crate', 'crate_0', 'cube');
    await press(page, 'Left');
  },
  async function distribute(page) {
    await press(page, 'Along y');
  },
  async function snap(page) {
    await press(page, 'Snap to the grid of 0.1 m');
  },
  async function nudge(page) {
    await choose(page, 'crate');
    await page.locator('canvas').first().focus();
    await page.keyboard.press('Control+ArrowRight');
    await page.keyboard.press('Control+Shift+ArrowLeft');
  },
  async function dragHandle(page) {
    await choose(page, 'sphere');
    const { t } = await pose(page, 'sphere');
    const [x, y] = await pixel(page, t);
    await drag(page, [x + 60, y], [x + 130, y]);
  },
  async function paste(page) {
    await choose(page, 'crate_0');
    await press(page, 'Copy');
    await press(page, 'Paste');
    await option(page, 'crate_1').waitFor();
  },
  async function remove(page) {
    await choose(page, 'cube', 'crate');
    await page.locator('canvas').first().focus();
    await page.keyboard.press('Delete');
    await option(page, 'cube').waitFor({ state: 'detached' });
  },
];

async function edits(page) {
  const states = [await models(page)];
  for (const edit of EDITS) {
    await edit(page);
    await idle(page);
    states.push(await models(page));
    const before = states[states.length - 2].join();
    assert.notEqual(states[states.length - 1].join(), before, `${edit.name} changed nothing`);
  }
  if (await changes(page)) assert.ok((await changes(page)).length > 0);
  // The nudge was two steps.
  const steps = EDITS.length + 1;
  const undo = panel(page).getByRole('button', { name: /^Undo/ });
  await undo.click();
  await option(page, 'cube').waitFor();
  assert.deepEqual(await models(page), states[states.length - 2], 'undo of the deletion');
  await page.locator('canvas').first().focus();
  for (let i = 1; i < steps; i++) await page.keyboard.press('Control+z');
  await until(page, '!periplus.models.some((name) => /box|crate/.test(name))', 'undo of all');
  await idle(page);
  assert.deepEqual(await models(page), states[0], 'all undone');
  assert.ok(await undo.isDisabled());
  // Physics may have moved models a little before the pause.
  const left = ((await changes(page)) ?? []).filter(({ kind }) => kind !== 'moved');
  assert.deepEqual(left, []);
  for (let i = 0; i < steps; i++) await page.keyboard.press('Control+Shift+Z');
  await until(page, '!periplus.models.includes("cube")', 'redo of all');
  await idle(page);
  assert.deepEqual(await models(page), states[states.length - 1], 'all redone');
}

/** The grabbed point stays under the pointer, in the top view and in perspective. */
async function grabbed(page, view) {
  await page.evaluate((state) => periplus.setView(state), view);
  await choose(page, 'sphere');
  await press(page, 'Move');
  const before = await pose(page, 'sphere');
  // The highest point of the sphere is what the pointer sees from above.
  const [x, y, z] = before.t;
  const from = await pixel(page, [x, y, z]);
  const under = await page.evaluate(([px, py]) => {
    const { view: camera, content } = periplus.stage;
    const caster = camera.ray(px, py);
    const found = caster.intersectObjects(content.children, true);
    return found.find((one) => one.object.isMesh).point.toArray();
  }, from);
  const to = [from[0] + 90, from[1] - 40];
  await drag(page, from, to, ['Control']);
  const after = await pose(page, 'sphere');
  const moved = after.t.map((v, i) => v - before.t[i]);
  assert.ok(Math.hypot(moved[0], moved[1]) > 0.2, `it moved by ${moved}`);
  assert.equal(+moved[2].toFixed(6), 0);
  const now = await pixel(
    page,
    under.map((v, i) => v + moved[i]),
  );
  const offPx = Math.hypot(now[0] - to[0], now[1] - to[1]);
  assert.ok(offPx < 1.5, `the grabbed point is ${offPx} px from the pointer`);
  await press(page, 'Move');
  await page.keyboard.press('Control+z');
  await page.waitForTimeout(400);
  const back = await pose(page, 'sphere');
  assert.ok(Math.hypot(...back.t.map((v, i) => v - before.t[i])) < 1e-6, 'undone');
}

/** A rectangle selects what is in it; escape puts back what is dragged. */
async function rectangle(page) {
  await page.evaluate(() =>
    periplus.setView({ kind: 'TopDownOrtho', scale: 50, x: 0, y: 0, angle: 0 }),
  );
  await page.evaluate(() => (periplus.selection = []));
  await page
    .getByRole('button', { name: /^Select/ })
    .first()
    .click();
  const at = (await pose(page, 'sphere')).t;
  const [x, y] = await pixel(page, at);
  await drag(page, [x - 60, y - 60], [x + 60, y + 60]);
  assert.deepEqual(await page.evaluate('periplus.selection'), ['sphere']);
  await page.mouse.move(x + 60, y);
  await page.mouse.down();
  await page.mouse.move(x + 120, y, { steps: 4 });
  await page.locator('canvas').first().focus();
  await page.keyboard.press('Escape');
  await page.mouse.up();
  await page.waitForTimeout(500);
  const back = (await pose(page, 'sphere')).t;
  assert.ok(Math.hypot(back[0] - at[0], back[1] - at[1]) < 1e-6, 'canceled');
}

/** Another client deletes a model: the steps with it leave the history, with a message. */
async function foreign(page) {
  await press(page, 'cylinder');
  await page.mouse.click(...(await pixel(page, [-2, -3, 0])));
  await option(page, 'cylinder').waitFor();
  await idle(page);
  await page.evaluate(() =>
    periplus.client.call(`/world/${periplus.worldName}/remove`, {
      entity: { name: 'cylinder', type: 2 },
    }),
  );
  await page.getByText(/Another client deleted cylinder/).waitFor();
  const undo = panel(page).getByRole('button', { name: /^Undo/ });
  assert.ok(!(await undo.innerText()).includes('cylinder'));
}

/** A reset takes back moves, which leave the history. */
async function reset(page) {
  const undo = panel(page).getByRole('button', { name: /^Undo/ });
  await choose(page, 'sphere');
  await type(page, 'x', 3.5);
  assert.match(await undo.innerText(), /move sphere/);
  await page.getByRole('button', { name: 'Step', exact: true }).first().click();
  await page.waitForTimeout(500);
  await page.getByRole('button', { name: 'Reset', exact: true }).first().click();
  await page.getByText(/The reset took back all moves/).waitFor();
  assert.doesNotMatch(await undo.innerText(), /move sphere/);
}

/** A map is opened as map_server wrote it: first its YAML file, then its image. */
async function underlay(page) {
  const input = page.getByTestId('underlay-file');
  const yaml = 'image: maps/plan.pgm\nresolution: 0.5\norigin: [-2.0, -1.0, 0.0]\n';
  await input.setInputFiles({ name: 'plan.yaml', mimeType: '', buffer: Buffer.from(yaml) });
  await page
    .getByText(/open plan.pgm as well/)
    .first()
    .waitFor();
  const image = Buffer.concat([Buffer.from('P5\n8 4\n255\n'), Buffer.alloc(32, 60)]);
  await input.setInputFiles({ name: 'plan.pgm', mimeType: '', buffer: image });
  const card = panel(page).getByRole('group', { name: 'Floor plan' });
  await card.waitFor();
  assert.equal(await card.getByLabel('Pixel size').inputValue(), '0.5');
  assert.equal(
    await card.getByRole('group', { name: 'Lower left corner' }).getByLabel('x').inputValue(),
    '-2',
  );
  await page.waitForTimeout(600);
  // Its corners are where the map file says.
  const corner = await page.evaluate(() => {
    const found = [];
    periplus.stage.scene.traverse((one) => {
      if (one.material?.map && one.geometry.type === 'PlaneGeometry') found.push(one);
    });
    const at = found[0].position.clone().set(-0.5, -0.5, 0).applyMatrix4(found[0].matrix);
    return [found.length, +at.x.toFixed(6), +at.y.toFixed(6)];
  });
  assert.deepEqual(corner, [1, -2, -1]);
  // A measured length sets the scale: two metres of the picture are four.
  await card.getByRole('button', { name: 'Measure a known length' }).click();
  await page.mouse.click(...(await pixel(page, [-2, -1, 0])));
  await page.mouse.click(...(await pixel(page, [0, -1, 0])));
  await card.getByLabel('True length').fill('4');
  await card.getByRole('button', { name: 'Set', exact: true }).click();
  const scale = Number(await card.getByLabel('Pixel size').inputValue());
  assert.ok(Math.abs(scale - 1) < 0.03, `${scale}`);
  // The Building Editor has the same picture.
  await page.getByRole('button', { name: 'Building Editor' }).click();
  await page.getByRole('application').waitFor();
  const plan = await page.evaluate('building.plan.picture');
  assert.equal(plan.widthPx, 8);
  assert.ok(Math.abs(plan.pixelsPerM - 1 / scale) < 1e-4);
  await page.getByRole('button', { name: 'Close the editor' }).click();
  await card.getByRole('button', { name: 'Remove the picture' }).click();
}

/** A building of three levels with stairs and a roof without walls is saved and read back. */
async function levels(page) {
  await page.getByRole('button', { name: 'Building Editor' }).click();
  await page.getByRole('application').waitFor();
  await page.evaluate(() => {
    const { building } = window;
    const corners = [
      [0, 0],
      [6, 0],
      [6, 4],
      [0, 4],
      [0, 0],
    ];
    for (const [x, y] of corners) {
      building.cursor = { at: { x, y }, to: 'grid' };
      building.press();
    }
    building.addStairs({ x: 3, y: 2 });
    building.setLevelHeight(3);
    building.note();
    building.addLevel();
    building.addStairs({ x: 3, y: 3 });
    building.addLevel();
    building.plan.walls = building.plan.walls.filter((wall) => wall.level < 2);
    building.note();
  });
  const shape = () =>
    page.evaluate(() => {
      const { levels: all, walls, stairs } = window.building.plan;
      const own = (list) => list.map((one) => [one.level, one.heightM ?? one.steps]).sort();
      return [all.map((level) => level.heightM), own(walls), own(stairs)];
    });
  const before = await shape();
  assert.deepEqual(before[0], [3, 2.5, 2.5]);
  assert.deepEqual(before[1].filter(([level]) => level === 0).length, 4);
  const download = page.waitForEvent('download');
  await page.getByRole('dialog').getByRole('button', { name: 'World', exact: true }).click();
  const file = await (await download).path();
  await page.getByRole('dialog').getByRole('button', { name: 'New', exact: true }).click();
  await page.getByTestId('building-file').setInputFiles(file);
  await until(page, 'building.plan.levels.length === 3', 'three levels');
  assert.deepEqual(await shape(), before);
  // The middle level is removed: the roof is on the walls of the first.
  await page.evaluate(() => ((building.level = 1), building.removeLevel()));
  assert.deepEqual((await shape())[0], [3, 2.5]);
  await page.keyboard.press('Control+z');
  assert.deepEqual(await shape(), before);
  await page.getByRole('button', { name: 'Close the editor' }).click();
}

async function save(page) {
  const download = page.waitForEvent('download');
  await press(page, 'Save world as SDF');
  const text = readFileSync(await (await download).path(), 'utf8');
  assert.ok(text.includes('<sdf') && text.includes('crate_1'), text.slice(0, 200));
  if (!(await changes(page))) return console.log('     the server offers no changes: no diff');
  const diff = panel(page).getByRole('region', { name: /^Changes in/ });
  await diff.waitFor();
  assert.ok((await diff.locator('ins').allInnerTexts()).some((line) => line.includes('crate_1')));
  assert.ok((await diff.locator('del').count()) > 0);
  await press(page, 'Hide changes');
}

/** The page in German, and back. */
async function german(page) {
  await page.evaluate(() => localStorage.setItem('language', 'de'));
  await page.reload();
  await until(page, 'periplus.models.length > 1', 'models');
  await page.getByRole('tab').nth(2).click();
  await panel(page).getByRole('button', { name: 'Welt als SDF speichern' }).waitFor();
  assert.equal(await page.evaluate('document.documentElement.lang'), 'de');
  await page.evaluate(() => localStorage.setItem('language', 'en'));
}

export async function edit(chrome, url, attempt) {
  if (!attempt.isWanted('edit')) return;
  const words = ['sim', WORLD, '--rtf', '1', '--ros2', 'off'];
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
  try {
    await until(page, 'periplus.models.includes("sphere")', 'the world');
    await page.getByRole('tab', { name: 'World' }).click();
    await page.getByRole('button', { name: 'Pause', exact: true }).first().click();
    await until(page, 'periplus.isPaused', 'a pause');
    const top = { kind: 'TopDownOrtho', scale: 50, x: 0, y: 0, angle: 0 };
    const orbit = { kind: 'Orbit', distance: 12, focal: [0, 0, 0], pitch: 0.7, yaw: -1.2 };
    await page.evaluate((state) => periplus.setView(state), top);
    await attempt('edit undo redo', () => edits(page));
    await attempt('edit drag from above', () => grabbed(page, top));
    await attempt('edit drag in perspective', () => grabbed(page, orbit));
    await attempt('edit rectangle', () => rectangle(page));
    await attempt('edit foreign changes', () => foreign(page));
    await attempt('edit reset', () => reset(page));
    await attempt('edit underlay', () => underlay(page));
    await attempt('edit levels', () => levels(page));
    await attempt('edit save', () => save(page));
    await attempt('edit german', () => german(page));
    await attempt('edit quiet', async () => assert.deepEqual(complaints, []));
  } finally {
    await page.close();
    await run.stop();
  }
}
