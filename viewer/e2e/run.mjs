// End-to-end tests of the page with a running Periplus, in Debian's Chromium without a window.
//
//   npm run e2e [NAME...]     PERIPLUS=path/to/periplus
import assert from 'node:assert/strict';
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { axe } from './axe.mjs';
import { building, foreignBuildings } from './building.mjs';
import { demo } from './demo.mjs';
import { dock } from './dock.mjs';
import { edit } from './edit.mjs';
import { keyboard } from './keyboard.mjs';
import { browser, next, open, periplus, servePage, until, port } from './lib.mjs';
import { meshes } from './meshes.mjs';
import { navigate } from './navigate.mjs';
import { panels } from './panels.mjs';
import { proof } from './proof.mjs';
import { replay } from './replay.mjs';
import { robots } from './robots.mjs';
import { tab } from './tab.mjs';
import { tutorials } from './tutorials.mjs';
import { use } from './use.mjs';

const PORT = port(8821);
const KBOT = 'robots/kbot/urdf/kbot.urdf.xacro';
const out = mkdtempSync(join(tmpdir(), 'periplus-e2e-'));

const where = (page) =>
  page.evaluate(() => {
    const found = window.periplus.tf.lookup('odom', 'base_footprint');
    return found.kind === 'found' ? found.pose.t : undefined;
  });

const tests = {
  /** Keys drive the robot, and the map grows. */
  async drive(page) {
    await until(page, "periplus.fixedFrame === 'map'", 'a map');
    await until(page, 'periplus.displays.some((d) => d.kind.title === "RobotModel")', 'a robot');
    await page.waitForTimeout(500);
    const before = await where(page);
    const known = () => next(page, '/map', 'message.data.reduce((n, c) => n + (c >= 0), 0)');
    const first = await known();
    await page.locator('canvas').first().focus();
    // The key is held until the robot has moved: a machine may be slow.
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

  /** Updates of a map are received as updates, and are drawn. */
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
    await until(page, 'periplus.isPaused', 'standing still');
    const before = await page.evaluate('periplus.clock.nowS');
    await page.getByRole('button', { name: 'Step' }).first().click();
    await until(page, `periplus.clock.nowS > ${before}`, 'a step');
    await page.getByRole('button', { name: 'Play', exact: true }).first().click();
    await until(page, '!periplus.isPaused', 'going on');
  },

  /** A model is inserted in front of the robot, measured by its scanner, and deleted. */
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

  /** Parameters of nodes, with the ranges that they declare. */
  async parameters(page) {
    await page.getByRole('tab', { name: 'Parameters' }).click();
    await until(page, 'Object.keys(periplus.parameters).length > 10', 'parameters');
    const panel = page.getByRole('tabpanel');
    await panel.getByLabel('Search parameters').fill('resolution');
    await panel.locator('.parameter').first().waitFor();
  },
};

const wanted = process.argv.slice(2);
const isWanted = (name) => wanted.length === 0 || wanted.some((one) => name.startsWith(one));
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
attempt.isWanted = (name) => wanted.length === 0 || wanted.some((one) => one.startsWith(name));
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
  await attempt('building', () => building(chrome, pages.url, out));
  await attempt('foreign buildings', () => foreignBuildings(chrome, pages.url, out));
  await attempt('keyboard', () => keyboard(chrome, pages.url));
  await meshes(chrome, pages.url, out, attempt);
  await dock(chrome, pages.url, out, attempt);
  await use(chrome, pages.url, attempt);
  await axe(chrome, pages.url, attempt);
  await navigate(chrome, pages.url, attempt);
  await panels(chrome, pages.url, attempt);
  await tutorials(chrome, pages.url, out, attempt);
  await replay(chrome, pages.url, out, attempt);
  await edit(chrome, pages.url, attempt);
  await proof(chrome, pages.url, out, attempt);
  await demo(chrome, pages.url, attempt);
  await robots(chrome, pages.url, attempt);
  await tab(chrome, pages.url, out, attempt);
} finally {
  await chrome.close();
  pages.stop();
  rmSync(out, { recursive: true });
}
process.exitCode = failed > 0 ? 1 : 0;
