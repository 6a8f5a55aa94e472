// Several robots on the page, messages published by hand, and reports, differences and files of recordings.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { PHONE, wrong } from './axe.mjs';
import { open, periplus, port, PROGRAM, ROOT, until } from './lib.mjs';
import { goal } from './navigate.mjs';

const PORT = port(8861);
const choice = (page) => page.getByRole('combobox', { name: 'Robot that the tools act on' });

/** Position of a robot in the simulated world [m]. */
const where = (page, robot) =>
  page.evaluate(
    (name) => window.periplus.tf.lookup('world', `${name}/base_footprint`).pose.t,
    robot,
  );
const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

async function ready(page) {
  await choice(page).waitFor({ timeout: 60_000 });
  assert.deepEqual(await choice(page).locator('option').allTextContents(), ['r1', 'r2']);
  const both = ['r1', 'r2'].map(
    (name) => `periplus.tf.lookup("world", "${name}/base_footprint").kind === "found"`,
  );
  await until(page, both.join(' && '), 'both robots in one frame', 60_000);
  assert.equal(await page.evaluate('periplus.fixedFrame'), 'world');
  const [a, b] = [await where(page, 'r1'), await where(page, 'r2')];
  assert.ok(Math.abs(b[1] - a[1] - 1) < 0.1, `r1 at ${a}, r2 at ${b}`);
  await until(
    page,
    `(() => {
      const models = periplus.displays.filter((d) => d.kind.title === 'RobotModel');
      return models.length === 2 && models.every((d) => d.level === 'ok' && d.values['TF Prefix']);
    })()`,
    'the models of both robots at their transforms',
  );
  // Data of both, each with the frames of its robot.
  await until(
    page,
    `periplus.displays.filter((d) => d.kind.title === 'LaserScan' && d.level === 'ok').length === 2`,
    'the scans of both robots',
  );
}

/** Chooses a robot by the list, drives it by a key: the other one stays. */
async function drive(page) {
  await choice(page).selectOption('r2');
  await until(page, 'periplus.robots.chosen.namespace === "/r2"', 'the choice');
  const before = [await where(page, 'r1'), await where(page, 'r2')];
  await page.locator('canvas').first().focus();
  await page.keyboard.down('i');
  await until(
    page,
    `Math.abs(periplus.tf.lookup("world", "r2/base_footprint").pose.t[0] - ${before[1][0]}) > 0.3`,
    'driving the second robot',
    40_000,
  );
  await page.keyboard.up('i');
  assert.ok(distance(await where(page, 'r1'), before[0]) < 0.05, 'the first robot moved, too');
}

/** A goal in the world frame reaches the second robot in its own frame. */
async function sendGoal(page) {
  await page.waitForTimeout(1000);
  const before = [await where(page, 'r1'), await where(page, 'r2')];
  await page.evaluate(() => {
    window.periplus.setView({ kind: 'TopDownOrtho', scale: 75, x: 0.5, y: 0.5 });
  });
  await page.waitForTimeout(300);
  await goal(page, [-0.5, 1], [-0.6, 1]);
  await page
    .getByTestId('navigation-state')
    .filter({ hasText: 'Goal reached' })
    .waitFor({ timeout: 90_000 });
  const now = [await where(page, 'r1'), await where(page, 'r2')];
  assert.ok(distance(now[1], [-0.5, 1]) < 0.5, `the second robot is at ${now[1]}`);
  assert.ok(distance(now[1], before[1]) > 0.3, 'the second robot stayed');
  assert.ok(distance(now[0], before[0]) < 0.05, 'the first robot moved, too');
}

/** A click on a robot chooses it, and a layout keeps the choice. */
async function click(page) {
  const [x, y] = await page.evaluate(() => {
    const { view, renderer } = window.periplus.stage;
    const [px, py, pz] = window.periplus.tf.lookup('world', 'r1/base_footprint').pose.t;
    const at = view.origin
      .clone()
      .set(px, py, pz + 0.1)
      .project(view.camera);
    const box = renderer.domElement.getBoundingClientRect();
    return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
  });
  await page.mouse.click(x, y);
  await until(page, 'periplus.robots.chosen.namespace === "/r1"', 'the choice by a click', 10_000);
  await until(
    page,
    'document.querySelector(".robot select").value === "/r1"',
    'its name in the bar',
  );
  // The first robot has no navigator.
  await page
    .getByText('No node offers the action', { exact: false })
    .or(page.getByText('navigate_to_pose'))
    .first()
    .waitFor();
  assert.equal(await page.evaluate('periplus.workbench.save().robot'), '/r1');
}

/** The panel that publishes: errors that teach, then a command that turns the first robot only. */
async function publish(page) {
  await page.evaluate(() => void window.periplus.workbench.open('publish'));
  const topic = page.getByRole('combobox', { name: 'Topic 1', exact: true });
  const type = page.getByRole('combobox', { name: 'Type of topic 1' });
  await topic.fill('/r1/cmd_vel');
  await topic.blur();
  await type.fill('geometry_msgs/msg/Twits');
  await page.getByRole('alert').filter({ hasText: 'is unknown here' }).waitFor();
  await type.fill('geometry_msgs/msg/Twist');
  await page.getByRole('button', { name: 'YAML' }).click();
  const text = page.getByRole('textbox', { name: 'Message of /r1/cmd_vel' });
  await text.fill('angular: {z: quick}\nlinaer: {x: 1}');
  await page.getByRole('button', { name: 'Publish once' }).click();
  await page
    .getByRole('alert')
    .filter({ hasText: 'angular.z: expected a value of the type float64' })
    .waitFor();
  await page
    .getByRole('alert')
    .filter({ hasText: 'linaer: geometry_msgs/Twist has no such field' })
    .waitFor();
  await text.fill('angular: {z: 1.0}');
  await page.getByRole('spinbutton', { name: 'Rate of /r1/cmd_vel' }).fill('10');
  const yaw = (robot) =>
    page.evaluate((name) => {
      const [, , z, w] = window.periplus.tf.lookup('world', `${name}/base_footprint`).pose.q;
      return 2 * Math.atan2(z, w);
    }, robot);
  const before = [await yaw('r1'), await yaw('r2')];
  await page.getByRole('button', { name: 'Repeat' }).click();
  await page.waitForTimeout(2500);
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await page
    .getByRole('status')
    .filter({ hasText: /\d+ published\. Subscribers: .*relay/ })
    .waitFor();
  const turned = await yaw('r1');
  assert.ok(Math.abs(turned - before[0]) > 0.3, `r1 turned from ${before[0]} to ${turned}`);
  assert.ok(Math.abs((await yaw('r2')) - before[1]) < 0.1, 'the second robot turned, too');
  const { rows } = await page.evaluate(() => {
    const panel = window.periplus.workbench.panels.find((one) => one.kind === 'publish');
    return panel.saved();
  });
  assert.deepEqual(
    rows.map((row) => [row.topic, row.type, row.rateHz, row.value]),
    [['/r1/cmd_vel', 'geometry_msgs/msg/Twist', 10, { angular: { z: 1 } }]],
  );
  assert.deepEqual(await wrong(page, 'publish'), []);
}

async function phone(chrome, address) {
  const { page } = await open(chrome, address, { ...PHONE, reducedMotion: 'reduce' });
  await choice(page).waitFor({ timeout: 60_000 });
  const wide = await page.evaluate('document.querySelector(".bar").scrollWidth');
  assert.ok(wide <= page.viewportSize().width, `the bar is ${wide} px wide`);
  const box = await choice(page).boundingBox();
  assert.ok(box.x >= 0 && box.x + box.width <= page.viewportSize().width, JSON.stringify(box));
  assert.deepEqual(await wrong(page, 'robots on a phone'), []);
  if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/phone.png` });
  await page.close();
}

async function several(chrome, url, attempt) {
  const words = ['launch', 'viewer/e2e/show/two_robots.launch.py', '--ros2', 'off', '--no-browser'];
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
  const { page, complaints } = await open(chrome, address, { reducedMotion: 'reduce' });
  const shot = (name) =>
    process.env.SHOTS && page.screenshot({ path: `${process.env.SHOTS}/${name}.png` });
  try {
    await attempt('robots: two robots in one view', () => ready(page));
    await shot('two');
    await attempt('robots: drive the second', () => drive(page));
    await attempt('robots: a goal for the second', () => sendGoal(page));
    await shot('goal');
    await attempt('robots: click on a robot', () => click(page));
    await attempt('robots: publish', () => publish(page));
    await shot('publish');
    await attempt('robots: no errors', async () => assert.deepEqual(complaints, []));
    await page.close();
    await attempt('robots: phone', () => phone(chrome, address));
  } finally {
    await run.stop();
  }
}

/** Text of a download that a click starts. */
async function downloaded(page, button) {
  const [file] = await Promise.all([
    page.waitForEvent('download', { timeout: 60_000 }),
    button.click(),
  ]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

async function reports(page, folder) {
  const panel = page.getByRole('article', { name: 'a', exact: true });
  await panel.waitFor({ timeout: 60_000 });
  await panel.getByText('Origin').click();
  await panel.getByText('periplus sim worlds/closed_room.world', { exact: false }).waitFor();
  const report = await downloaded(
    page,
    page.getByRole('button', { name: 'Report of a', exact: true }),
  );
  assert.equal(report.name, 'a.html');
  const html = report.bytes.toString();
  assert.match(html, /^<!DOCTYPE html>/i);
  assert.match(html, /--seed 1/);
  const file = await downloaded(
    page,
    page.getByRole('button', { name: 'Download a', exact: true }),
  );
  assert.equal(file.name, 'a.mcap');
  assert.ok(file.bytes.equals(readFileSync(join(folder, 'a.mcap'))), 'other bytes');
}

/** Two runs with another seed of the noise: the scans differ, the transforms do not. */
async function difference(page) {
  await page.getByRole('tab', { name: 'Comparison' }).click();
  await page.getByRole('button', { name: 'Compare all messages' }).click();
  await page
    .getByRole('status')
    .filter({ hasText: /topics with different messages/ })
    .waitFor({ timeout: 60_000 });
  const scan = page.locator('details').filter({ hasText: '/kbot/sensor_laser/scan' });
  await scan.locator('summary').click();
  await scan.getByRole('rowheader', { name: 'ranges[0]', exact: true }).waitFor();
  const both = await downloaded(page, page.getByRole('button', { name: 'Report of both…' }));
  assert.match(both.bytes.toString(), /Comparison of a\.mcap \(A\) and b\.mcap \(B\)/);
  assert.deepEqual(await wrong(page, 'comparison'), []);
}

/** The result of an estimator: kept by a download, discarded by a button. */
async function result(page) {
  await page.evaluate(() => {
    const { recordings } = window.periplus;
    recordings.run('slam', recordings.list.find((one) => one.name === 'a').id, {});
  });
  await page.getByRole('tab', { name: 'Recordings' }).click();
  const made = page.getByRole('article', { name: 'a (slam)', exact: true });
  await made
    .getByText('until it is closed or the program ends', { exact: false })
    .waitFor({ timeout: 60_000 });
  const file = await downloaded(page, made.getByRole('button', { name: 'Download a (slam)' }));
  assert.equal(file.name, 'a (slam).mcap');
  assert.equal(file.bytes.subarray(1, 5).toString(), 'MCAP');
  await made.getByRole('button', { name: 'Discard a (slam)' }).click();
  await made.waitFor({ state: 'detached' });
}

async function recorded(chrome, url, attempt) {
  const folder = mkdtempSync(join(tmpdir(), 'periplus-robots-'));
  const record = (name, seed) => {
    const words = [
      'sim',
      'worlds/closed_room.world',
      '--robot',
      'robots/kbot/urdf/kbot.urdf.xacro',
    ];
    const more = [
      '--duration',
      '3',
      '--seed',
      seed,
      '--quiet',
      '--record',
      join(folder, `${name}.mcap`),
    ];
    const done = spawnSync(PROGRAM, [...words, ...more], { cwd: ROOT });
    assert.equal(done.status, 0, String(done.stderr));
  };
  record('a', '1');
  record('b', '2');
  const files = ['a', 'b'].map((name) => join(folder, `${name}.mcap`));
  const run = await periplus(['view', ...files, '--no-browser', `--page=127.0.0.1:${PORT}`], PORT);
  const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
  const { page, complaints } = await open(chrome, address, { reducedMotion: 'reduce' });
  try {
    await page.getByRole('tab', { name: 'Recordings' }).click({ timeout: 60_000 });
    await attempt('robots: report and file of a recording', () => reports(page, folder));
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/recordings.png` });
    await attempt('robots: difference of two recordings', () => difference(page));
    if (process.env.SHOTS) await page.screenshot({ path: `${process.env.SHOTS}/difference.png` });
    await attempt('robots: result of an estimator', () => result(page));
    await attempt('robots: no errors in replay', async () => assert.deepEqual(complaints, []));
    await page.close();
  } finally {
    await run.stop();
    rmSync(folder, { recursive: true });
  }
}

export async function robots(chrome, url, attempt) {
  if (!attempt.isWanted('robots')) return;
  await several(chrome, url, attempt);
  await recorded(chrome, url, attempt);
}
