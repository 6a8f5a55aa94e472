// Navigation on the page: goals and waypoints by mouse, the state of the goal, and the reason why the robot stands.
import assert from 'node:assert/strict';
import { PHONE, wrong } from './axe.mjs';
import { next, open, periplus, sim, until, port } from './lib.mjs';

const PORT = port(8828);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';
const button = (page, name) => page.getByRole('button', { name, exact: true }).first();
const state = (page) => page.getByTestId('navigation-state');
const reason = (page) => page.getByTestId('navigation-reason');
const row = (page, name) => page.locator(`dt:text-is("${name}") + dd`);

/** Pixel of a point of the floor. */
export const pixel = (page, x, y) =>
  page.evaluate(
    ([x, y]) => {
      const { view, renderer } = window.periplus.stage;
      const at = view.origin.clone().set(x, y, 0).project(view.camera);
      const box = renderer.domElement.getBoundingClientRect();
      return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
    },
    [x, y],
  );

/** Drags on the floor from a point to another. */
async function drag(page, from, to) {
  await page.mouse.move(...(await pixel(page, ...from)));
  await page.mouse.down();
  await page.mouse.move(...(await pixel(page, ...to)), { steps: 4 });
  await page.mouse.up();
}

export async function goal(page, from, to) {
  await button(page, '2D Goal Pose').click();
  await drag(page, from, to);
}

const shows = (page, text, timeout = 60_000) =>
  state(page).filter({ hasText: text }).waitFor({ timeout });

/** The page shows the navigator, and the map from above with the robot in the middle. */
export async function ready(page) {
  await shows(page, 'No goal');
  await until(page, 'periplus.tf.has("map") && periplus.tf.has("base_link")', 'a map', 60_000);
  await until(
    page,
    'periplus.displays.some((d) => d.name === "global_costmap/costmap" && Number(d.values.Width) > 10)',
    'the global costmap',
    60_000,
  );
  await page.evaluate(() => {
    const { displays } = window.periplus;
    // Rendering the camera takes most of the time of a computer without a GPU.
    for (const one of displays)
      if (one.kind.title === 'Image') window.periplus.active.setEnabled(one, false);
    window.periplus.setView({ kind: 'TopDownOrtho', scale: 75, x: 1, y: 0 });
  });
}

/** A goal by the tool: the panel shows how the robot drives there. */
async function reach(page) {
  await goal(page, [1.2, 0], [1.8, 0]);
  await shows(page, 'Driving');
  assert.match(await row(page, 'Goal').textContent(), /^1\.\d\d, -?0\.\d\d m, -?\d°$/);
  await page
    .getByRole('list', { name: 'Running nodes' })
    .getByText('FollowPath', { exact: true })
    .waitFor();
  await row(page, 'Distance remaining').filter({ hasText: / m$/ }).waitFor();
  await button(page, 'Pause').click();
  await reason(page).filter({ hasText: 'The simulation is paused.' }).waitFor();
  assert.equal(await state(page).textContent(), 'Standing');
  await button(page, 'Play').click();
  await shows(page, 'Goal reached');
  assert.equal(await reason(page).count(), 0);
  const driven = await page.evaluate(() => window.periplus.tf.lookup('map', 'base_link').pose.t[0]);
  assert.ok(Math.abs(driven - 1.2) < 0.4, `the robot is at x ${driven}`);
}

/** A goal in a wall fails, and the panel says which cell and layer are in the way. */
async function intoWall(page) {
  // With the default tolerance the planner takes a free cell beside the wall.
  await page.evaluate(() =>
    window.periplus.client.setParameter({
      name: '/planner_server.GridBased.tolerance',
      value: 0.05,
    }),
  );
  await goal(page, [1.6, 0.8], [1.6, 1.4]);
  // At once, while the navigator still tries its recoveries.
  await reason(page)
    .filter({ hasText: /blocked by cell.*layer/s })
    .waitFor({ timeout: 10_000 });
  assert.match(await state(page).textContent(), /Standing|Recovering/);
  await shows(page, 'Goal failed', 120_000);
  await reason(page)
    .filter({ hasText: /blocked by cell.*layer.*\(error code 208\)/s })
    .waitFor({ timeout: 10_000 });
}

/** Waypoints by mouse; the goal is canceled by the button. */
async function waypoints(page) {
  await button(page, 'Waypoints').click();
  for (const [x, y] of [
    [0.2, 0],
    [1.6, 0],
  ])
    await page.mouse.click(...(await pixel(page, x, y)));
  const list = page.getByRole('list', { name: 'Waypoints' }).getByRole('listitem');
  assert.equal(await list.count(), 2);
  // Without a drag a waypoint has the heading with which the robot arrives: back, and forth again.
  assert.match(await list.nth(0).textContent(), /0\.2\d?, .* -?(9|1\d)\d°/);
  assert.match(await list.nth(1).textContent(), /1\.6\d?, .* 0°/);
  assert.deepEqual(await wrong(page, 'waypoints'), []);
  await button(page, 'Go').click();
  await row(page, 'Waypoint').filter({ hasText: '1 of 2' }).waitFor();
  await button(page, 'Cancel the goal').click();
  await shows(page, 'Goal canceled');
  await button(page, 'Delete waypoint 1').click();
  assert.equal(await list.count(), 1);
  await button(page, 'Clear').click();
  assert.equal(await list.count(), 0);
}

/** The candidates of MPPI are published while the box is ticked. */
async function trajectories(page) {
  const box = page.getByRole('checkbox', { name: 'Show the trajectories of MPPI' });
  await box.check();
  await goal(page, [-0.5, 0], [-1.2, 0]);
  const count = await next(page, '/trajectories', 'message.markers.length');
  assert.ok(count > 10, `${count} trajectories`);
  await until(
    page,
    'periplus.displays.some((d) => d.name === "trajectories" && d.isEnabled && d.level === "ok")',
    'the trajectories',
  );
  await button(page, 'Cancel the goal').click();
  await shows(page, 'Goal canceled');
  await until(
    page,
    'periplus.displays.find((d) => d.name === "trajectories").display.entries.size === 0',
    'the end of the trajectories',
  );
}

/** On a phone the tools fit into the toolbar, and the panel into its part of the screen. */
async function phone(page) {
  const { width } = page.viewportSize();
  const wide = await page.evaluate('document.querySelector(".bar").scrollWidth');
  assert.ok(wide <= width, `the toolbar is ${wide} px wide`);
  const box = await button(page, 'Waypoints').boundingBox();
  assert.ok(box.x >= 0 && box.x + box.width <= width && box.width >= 24, JSON.stringify(box));
  const panels = page.getByRole('button', { name: 'Panels', exact: true });
  if ((await panels.getAttribute('aria-pressed')) === 'false') await panels.click();
  await state(page).waitFor();
  const body = await page.evaluate(() => {
    const { scrollWidth, clientWidth } = document.querySelector('[role=tabpanel]');
    return { scrollWidth, clientWidth };
  });
  assert.ok(body.scrollWidth <= body.clientWidth, JSON.stringify(body));
  assert.deepEqual(await wrong(page, 'phone'), []);
}

export async function navigate(chrome, url, attempt) {
  if (!attempt.isWanted('navigate')) return;
  const words = sim('worlds/house.sdf', SAM_BOT, '--pose', '0,0,0', '--navigation');
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  // Without transitions of colours, which axe would measure midway.
  const options = { reducedMotion: 'reduce' };
  const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
  const { page, complaints } = await open(chrome, address, options);
  try {
    await attempt('navigate: ready', () => ready(page));
    await attempt('navigate: reach a goal', () => reach(page));
    await attempt('navigate: a goal in a wall', () => intoWall(page));
    await attempt('navigate: waypoints', () => waypoints(page));
    await attempt('navigate: trajectories', () => trajectories(page));
    await attempt('navigate: axe', async () => assert.deepEqual(await wrong(page, 'goal'), []));
    await attempt('navigate: no errors', async () => assert.deepEqual(complaints, []));
    await page.close();
    await attempt('navigate: phone', async () => {
      const { page } = await open(chrome, address, { ...PHONE, ...options });
      await phone(page);
      if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT });
      await page.close();
    });
  } finally {
    await run.stop();
  }
}
