// The page without a server: loading, driving, goals, recordings, results, the same bag as the program, failures.
//
// It needs the static page: `npm run build:tab`, after `cargo xtask wasm --page` or a build of the module.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { building } from './building.mjs';
import { STEPS } from './demo.mjs';
import { open, PROGRAM, ROOT, until } from './lib.mjs';
import { goal, ready } from './navigate.mjs';
import { serveFolder } from './static.mjs';

/** The static page; `PERIPLUS_TAB_PAGE` names another build of it. */
export const PAGE = process.env.PERIPLUS_TAB_PAGE ?? join(ROOT, 'target/tab/page');
const CORE = join(ROOT, 'crates/apps/tab/scripts/core.mjs');

/** Targets of the time to the first picture and from there to the first scan [s]; machines of tests may be slow. */
const PICTURE_S = 3;
const SCAN_S = 1;
const SLOW_FACTOR = 4;
/** Duration of the compared bags [s]. */
const BAG_S = 20;

export const moduleName = () =>
  readdirSync(join(PAGE, 'assets')).find((name) => /\.wasm$/.test(name));
/** Expressions of the tests are text, which the policy of the page forbids; `loads` tests the page with it. */
const FREE = { bypassCSP: true };
const card = (page) => page.getByRole('alert').filter({ has: page.getByRole('button') });
const running = (page) =>
  until(page, 'window.periplusTab?.phase.kind === "running"', 'a start', 60_000);

/** Times from the request of the page until the robot is drawn, and until a scan is [s]. */
export async function firstTimes(chrome, url, more = {}) {
  const from = performance.now();
  const { page, complaints } = await open(chrome, url, more);
  const seconds = () => (performance.now() - from) / 1000;
  await page.waitForFunction(
    () => {
      const robot = window.periplus?.displays.find((d) => d.kind.title === 'RobotModel');
      return robot?.display?.root.children.some((link) => link.visible);
    },
    undefined,
    { timeout: 60_000 },
  );
  await page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );
  const pictureS = seconds();
  await page.waitForFunction(
    () => window.periplus.displays.some((d) => d.kind.title === 'LaserScan' && d.statuses.Points),
    undefined,
    { timeout: 60_000 },
  );
  return { page, complaints, pictureS, scanS: seconds() };
}

async function loads(chrome, isIsolated) {
  const site = await serveFolder(PAGE, { isIsolated });
  try {
    const { page, complaints, pictureS, scanS } = await firstTimes(chrome, site.url);
    assert.equal(await page.evaluate(() => window.crossOriginIsolated), isIsolated);
    console.log(
      `     first picture after ${pictureS.toFixed(2)} s, first scan after ${scanS.toFixed(2)} s`,
    );
    assert.ok(pictureS < SLOW_FACTOR * PICTURE_S, `the first picture took ${pictureS} s`);
    assert.ok(scanS - pictureS < SLOW_FACTOR * SCAN_S, `the first scan took ${scanS} s`);
    assert.deepEqual(complaints, []);
    await page.close();
  } finally {
    site.stop();
  }
}

/** Real-time factor while the page shows everything [1], over some seconds. */
export const realTimeFactor = (page, seconds) =>
  page.evaluate(async (seconds) => {
    const state = () => [window.periplus.clock.nowS, performance.now() / 1000];
    const [timeS, wallS] = state();
    await new Promise((resolve) => setTimeout(resolve, seconds * 1000));
    const [laterS, laterWallS] = state();
    return (laterS - timeS) / (laterWallS - wallS);
  }, seconds);

async function keepsTime(page) {
  const factor = await realTimeFactor(page, 10);
  console.log(`     ${factor.toFixed(3)} x real time`);
  assert.ok(factor > 0.25 && factor < 1.1, `${factor} x real time`);
}

/** Speed and pause are those of the page, and a reset starts again at zero without making up for the time. */
async function isControlled(page) {
  const call = (name, request) =>
    page.evaluate(([name, request]) => window.periplus.call(name, request), [name, request]);
  const now = await call('/get_physics_properties', {});
  const setRate = (factor) =>
    call('/set_physics_properties', {
      time_step: now.time_step,
      max_update_rate: factor / now.time_step,
      gravity: now.gravity,
      ode_config: now.ode_config,
    });
  await setRate(0.1);
  const slow = await realTimeFactor(page, 3);
  assert.ok(slow > 0.05 && slow < 0.15, `at a tenth of real time it is ${slow}`);
  await setRate(1);
  await page.getByRole('button', { name: 'Pause' }).first().click();
  await until(page, 'periplus.isPaused', 'standing still');
  await page.getByRole('button', { name: 'Reset' }).first().click();
  await until(page, 'periplus.clock.nowS === 0', 'a reset');
  await page.getByRole('button', { name: 'Step' }).first().click();
  await until(page, 'periplus.clock.nowS > 0', 'a step');
  assert.ok((await page.evaluate('periplus.clock.nowS')) < 0.5);
  await page.getByRole('button', { name: 'Play', exact: true }).first().click();
  await until(page, '!periplus.isPaused', 'going on');
}

/** A goal by the tool: the robot drives there. */
async function reachesGoal(page) {
  await page.evaluate(() => window.periplus.workbench.open('navigate'));
  await ready(page);
  await page.evaluate(() =>
    window.periplus.setView({ kind: 'TopDownOrtho', scale: 75, x: 0.5, y: 0 }),
  );
  const start = await page.evaluate(() => window.periplus.tf.lookup('map', 'base_link').pose.t);
  const to = [start[0] + 0.6, start[1]];
  await goal(page, to, [to[0] + 0.5, to[1]]);
  const state = page.getByTestId('navigation-state');
  await state.filter({ hasText: 'Goal reached' }).waitFor({ timeout: 120_000 });
  const there = await page.evaluate(() => window.periplus.tf.lookup('map', 'base_link').pose.t);
  const missedM = Math.hypot(there[0] - to[0], there[1] - to[1]);
  assert.ok(missedM < 0.4, `the robot is ${missedM} m from the goal`);
}

async function downloadOf(page, act) {
  const [download] = await Promise.all([page.waitForEvent('download'), act()]);
  return download;
}

/** A recording is made in memory, is downloaded whole, and is played. */
async function records(page, out) {
  await page.evaluate(() => window.periplus.workbench.open('recordings'));
  const panel = page.getByRole('tabpanel').filter({ has: page.getByTestId('recording-file') });
  await panel.getByRole('button', { name: 'Record', exact: true }).click();
  await until(page, 'periplus.recordings.isRecording', 'a recording');
  await page.waitForTimeout(3000);
  await panel.getByRole('button', { name: 'Stop recording' }).click();
  await until(page, 'periplus.recordings.list.some((one) => one.state === "ready")', 'its end');
  const download = await downloadOf(page, () =>
    panel.getByRole('button', { name: /^Download/ }).click(),
  );
  const file = join(out, 'tab.mcap');
  await download.saveAs(file);
  const said = execFileSync(PROGRAM, ['bag', 'info', file], { encoding: 'utf8' });
  assert.match(said, /\/scan/, said);
  await panel.getByRole('button', { name: /^Play/ }).click();
  await until(page, 'periplus.replay && periplus.timeS > 0', 'its replay');
  await panel.getByRole('button', { name: 'Back to live' }).click();
  await until(page, '!periplus.replay', 'the running system');
  await panel.getByRole('button', { name: /^Close/ }).click();
}

/** The map is saved and downloaded; files are put into memory, listed and removed. */
async function keepsFiles(page, out) {
  await page.evaluate(() => window.periplus.workbench.open('tabFiles'));
  const panel = page.getByRole('tabpanel').filter({ has: page.getByTestId('tab-file') });
  const downloads = [];
  page.on('download', (one) => downloads.push(one));
  await panel.getByRole('button', { name: 'Save the map' }).click();
  for (let i = 0; i < 100 && downloads.length < 2; i++) await page.waitForTimeout(100);
  const names = downloads.map((one) => one.suggestedFilename()).sort();
  assert.deepEqual(names, ['map.pgm', 'map.yaml']);
  const folder = mkdtempSync(join(out, 'map-'));
  for (const one of downloads) await one.saveAs(join(folder, one.suggestedFilename()));
  assert.match(readFileSync(join(folder, 'map.yaml'), 'utf8'), /image: map\.pgm/);
  assert.equal(readFileSync(join(folder, 'map.pgm')).toString('latin1', 0, 2), 'P5');
  const own = join(out, 'note.txt');
  writeFileSync(own, 'kept');
  await page.getByTestId('tab-file').setInputFiles(own);
  await panel.getByText('/files/note.txt').waitFor();
  const text = await page.evaluate(async () =>
    new TextDecoder().decode(await window.periplusTab.read('/files/note.txt')),
  );
  assert.equal(text, 'kept');
  await panel.getByRole('button', { name: 'Remove /files/note.txt' }).click();
  await panel.getByText('/files/note.txt').waitFor({ state: 'detached' });
}

/** A file with an error is checked, and a log is mapped, as by `periplus check` and `periplus slam`. */
async function checksAndMaps(page, out) {
  const has = await page.evaluate(() =>
    window.periplusTab.call('messages').then(
      () => true,
      (error) => !error.message.includes('built without'),
    ),
  );
  if (!has) {
    console.log('SKIPPED: tab checks and maps: the module was built without these functions');
    return;
  }
  await page.evaluate(() => window.periplus.workbench.open('tabFiles'));
  const panel = page.getByRole('tabpanel').filter({ has: page.getByTestId('tab-file') });
  const wrong = join(out, 'wrong.urdf');
  writeFileSync(wrong, '<robot name="wrong"><link name="a"/><link name="b"/></robot>');
  await page.getByTestId('tab-file').setInputFiles(wrong);
  await panel.getByRole('button', { name: 'Check /files/wrong.urdf' }).click();
  await panel
    .getByRole('group', { name: 'Findings in /files/wrong.urdf' })
    .getByText('b')
    .waitFor();
  const log = join(out, 'short.log');
  writeFileSync(log, carmenLog(60));
  await page.getByTestId('tab-file').setInputFiles(log);
  await panel.getByRole('button', { name: 'Map /files/short.log' }).click();
  const card = panel.getByRole('group', { name: 'Map of /files/short.log' });
  await card.getByRole('img').waitFor({ timeout: 60_000 });
  await card.getByRole('progressbar').waitFor({ state: 'detached', timeout: 60_000 });
  await panel.getByText(/^\/results\/short\/.*\.pgm$/).waitFor();
}

/** A robot that drives along the middle of a corridor with walls 1 m beside it. */
function carmenLog(scans) {
  const lines = [];
  for (let i = 0; i < scans; i++) {
    const x = (i * 0.1).toFixed(3);
    const ranges = Array.from({ length: 180 }, (_, beam) => {
      const rad = ((beam - 89.5) * Math.PI) / 180;
      return Math.min(1 / Math.abs(Math.sin(rad)), 8).toFixed(3);
    });
    lines.push(`FLASER 180 ${ranges.join(' ')} ${x} 0 0 ${x} 0 0 ${i * 0.2} host ${i * 0.2}`);
  }
  return `${lines.join('\n')}\n`;
}

/** A ready session of the page, from a link. */
async function opensSessions(chrome, url) {
  const { sessions } = JSON.parse(readFileSync(join(PAGE, 'files/sessions.json'), 'utf8'));
  if (sessions.length === 0) console.log('SKIPPED: tab opens sessions: the page has none');
  for (const { name } of sessions) {
    const { page } = await open(chrome, `${url}?session=${name}`, FREE);
    await running(page);
    await until(page, 'periplus.topics.length > 3 && periplus.timeS > 0', `the session ${name}`);
    await page.close();
  }
}

const BAG_WORKER = `
import { Core } from './core.mjs';
onmessage = async ({ data: { module, seconds, seed } }) => {
  try {
    const core = await Core.start(await fetch(module));
    core.open({ demo: { headless: true, explore: true, duration_s: seconds, out: '/demo', seed } });
    const from = performance.now();
    core.stepUntil(BigInt(seconds * 1e9));
    const wallS = (performance.now() - from) / 1000;
    core.closeRecording();
    postMessage({ bag: core.readFile('/demo/demo.mcap'), wallS, memoryBytes: core.memoryBytes });
  } catch (error) {
    postMessage({ error: error.message });
  }
};
`;

/** The module in Chromium writes the bag of the native program, byte for byte. */
async function sameBag(chrome, out) {
  const seed = 7;
  const native = join(out, 'native');
  const words = ['demo', '--headless', '--bag-compression', 'none', '--seed', seed];
  execFileSync(PROGRAM, [...words, '--duration', BAG_S, '--out', native].map(String), {
    stdio: 'pipe',
  });
  const answer = (path, response) => {
    const scripts = { '/bag/worker.mjs': BAG_WORKER, '/bag/core.mjs': readFileSync(CORE) };
    if (!scripts[path]) return false;
    response.writeHead(200, { 'content-type': 'text/javascript' }).end(scripts[path]);
    return true;
  };
  const site = await serveFolder(PAGE, { answer });
  try {
    const page = await chrome.newPage();
    await page.goto(`${site.url}icon.svg`);
    const found = await page.evaluate(
      async ([module, seconds, seed]) => {
        const worker = new Worker('/bag/worker.mjs', { type: 'module' });
        worker.postMessage({ module, seconds, seed });
        const { data } = await new Promise((resolve) => (worker.onmessage = resolve));
        if (data.error) throw new Error(data.error);
        let text = '';
        for (let at = 0; at < data.bag.length; at += 32768)
          text += String.fromCharCode(...data.bag.subarray(at, at + 32768));
        return { ...data, bag: btoa(text) };
      },
      [`/assets/${moduleName()}`, BAG_S, seed],
    );
    await page.close();
    const bag = Buffer.from(found.bag, 'base64');
    const expected = readFileSync(join(native, 'demo.mcap'));
    const factor = (BAG_S / found.wallS).toFixed(1);
    console.log(
      `     ${BAG_S} s at ${factor} x real time, bag of ${bag.length} bytes, ${found.memoryBytes >> 20} MiB`,
    );
    const at = bag.findIndex((byte, i) => byte !== expected[i]);
    assert.ok(bag.equals(expected), `it differs at byte ${at} of ${expected.length}`);
  } finally {
    site.stop();
  }
}

/** A link with settings that the page does not know is refused, and the demo is offered. */
async function refusesLinks(chrome, url) {
  const { page } = await open(chrome, `${url}?sed=3`, FREE);
  await card(page).getByText('The setting "sed" is unknown').waitFor();
  await page.getByRole('button', { name: 'Start the demo' }).click();
  await running(page);
  assert.equal(new URL(page.url()).search, '');
  await page.close();
}

/** The seed of the link is that of the session. */
async function takesSettings(chrome, url) {
  const { page } = await open(chrome, `${url}?seed=3&explore`, FREE);
  await running(page);
  const explores = 'periplus.topics.some((one) => one.publishers.includes("/explorer"))';
  await until(page, explores, 'the node that explores');
  await page.close();
}

/** What a user sees where the module is missing, damaged, of another type, or cannot run. */
async function fails(chrome) {
  let mode = 'missing';
  const answer = (path, response) => {
    if (!path.endsWith('.wasm') || mode === 'whole') return false;
    if (mode === 'missing') response.writeHead(404).end();
    else response.writeHead(200, { 'content-type': 'application/wasm' }).end('not a module');
    return true;
  };
  const site = await serveFolder(PAGE, { answer, types: { '.wasm': 'text/plain' } });
  try {
    const { page } = await open(chrome, site.url, FREE);
    await card(page).getByText('404').waitFor();
    mode = 'damaged';
    await page.getByRole('button', { name: 'Start again' }).click();
    await card(page).getByText('WebAssembly').waitFor();
    // Another type is no obstacle.
    mode = 'whole';
    await page.getByRole('button', { name: 'Start again' }).click();
    await running(page);
    await page.close();
  } finally {
    site.stop();
  }
}

async function lacksWebAssembly() {
  const site = await serveFolder(PAGE);
  const old = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--js-flags=--jitless'],
  });
  try {
    const { page } = await open(old, site.url, FREE);
    await card(page).getByText('no WebAssembly').waitFor();
  } finally {
    await old.close();
    site.stop();
  }
}

export async function tab(chrome, serverUrl, out, attempt) {
  if (!attempt.isWanted('tab')) return;
  if (!existsSync(join(PAGE, 'index.html'))) {
    console.log('SKIPPED: tab: there is no static page; `cargo xtask wasm --page` builds it');
    return;
  }
  await attempt('tab loads', () => loads(chrome, false));
  await attempt('tab loads where it is isolated', () => loads(chrome, true));
  await attempt('tab has the bag of the program', () => sameBag(chrome, out));
  const site = await serveFolder(PAGE);
  try {
    const { page, complaints } = await open(chrome, site.url, FREE);
    // The code of the page is loaded after its file.
    await until(page, 'Boolean(window.periplus && window.periplusTab)', 'a page');
    const steps = {
      opens: () => STEPS.opens(page),
      'keeps time': () => keepsTime(page),
      'is driven by keys, and maps': () => STEPS['is driven by keys, and maps'](page),
      'is controlled': () => isControlled(page),
      'reaches a goal': () => reachesGoal(page),
      records: () => records(page, out),
      'keeps files': () => keepsFiles(page, out),
      'checks and maps': () => checksAndMaps(page, out),
      'is quiet': async () => assert.deepEqual(complaints, []),
    };
    for (const [name, step] of Object.entries(steps)) await attempt(`tab ${name}`, step);
    await page.close();
    await attempt('tab building', () =>
      building(chrome, site.url, mkdtempSync(join(out, 'tab-')), serverUrl),
    );
    await attempt('tab refuses links', () => refusesLinks(chrome, site.url));
    await attempt('tab takes settings', () => takesSettings(chrome, site.url));
    await attempt('tab opens sessions', () => opensSessions(chrome, site.url));
    await attempt('tab fails with words', () => fails(chrome));
    await attempt('tab lacks WebAssembly', () => lacksWebAssembly());
  } finally {
    site.stop();
  }
}
