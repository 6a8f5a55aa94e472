// First steps of a new user: each test covers a fault that users once met.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { next, open, periplus, ROOT, sim, until, port } from './lib.mjs';

const PORT = port(8825);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';
const SAM_BOT_RVIZ = 'robots/sam_bot/rviz/sam_bot.rviz';
const CUBE = 'worlds/cube_and_sphere.sdf';
const pong = ['sim', 'worlds/pong.sdf', '--rtf', '1', '--ros2', 'off'];
const cube = (...more) => sim(CUBE, SAM_BOT, 'publish_odom_tf:=true', ...more);
const button = (page, name) => page.getByRole('button', { name, exact: true }).first();

/** Part of the pixels of the 3D view for which a test of r, g and b holds. */
async function share(page, test) {
  const png = await page.locator('canvas').first().screenshot();
  return page.evaluate(
    async ([bytes, text]) => {
      const image = await createImageBitmap(new Blob([new Uint8Array(bytes)]));
      const canvas = new OffscreenCanvas(image.width, image.height);
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, image.width, image.height);
      const holds = new Function('r', 'g', 'b', `return ${text}`);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) count += holds(data[i], data[i + 1], data[i + 2]);
      return (count * 4) / data.length;
    },
    [[...png], test],
  );
}

/** Drags on the floor of the 3D view with a tool chosen by its button. */
async function drag(page, tool) {
  await button(page, tool).click();
  const box = await page.locator('canvas').first().boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height * 0.6];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y, { steps: 4 });
  await page.mouse.up();
}

const notice = (page, text) => page.getByRole('log', { name: 'Messages' }).getByText(text);

/** Rays of a lidar whose robot publishes no transforms on /tf. */
async function lidarWithoutTf(page) {
  await until(page, 'periplus.fixedFrame === "world"', 'the world as the fixed frame');
  const frames = page.getByRole('combobox', { name: 'Fixed frame' });
  assert.deepEqual(await frames.locator('option').allTextContents(), ['world']);
  await page.getByRole('tab', { name: 'World' }).click();
  await page.getByRole('tabpanel').getByRole('button', { name: 'Visualize Lidar' }).click();
  const lidar = 'periplus.displays.find((d) => d.kind.title === "Visualize Lidar")';
  await until(page, `${lidar}?.statuses.Rays`, 'rays');
  await until(page, 'periplus.displays.every((d) => d.level !== "error")', 'no red display');
  // The beams start at the simulated pose of the lidar, and end at the simulated obstacles.
  const ends = await page.evaluate(`new Promise((resolve) => setTimeout(() => {
    const d = ${lidar}.display;
    const group = d.root.children[0];
    resolve(group.matrix.elements.slice(12, 14));
  }, 500))`);
  const robot = await page.evaluate('periplus.world().poseOf("pong-bot/chassis").t');
  const AHEAD_M = 0.9;
  assert.ok(
    Math.hypot(ends[0] - robot[0] - AHEAD_M, ends[1] - robot[1]) < 0.02,
    `the rays begin at ${ends}, the robot is at ${robot}`,
  );
  const blue = await share(page, 'b > 100 && b > r + 50 && b > g + 50');
  assert.ok(blue > 0.02, `${(blue * 100).toFixed(1)} % of the view is blue`);
}

/** A goal in a frame without transforms is not sent. */
async function goalWithoutFrames(page) {
  await drag(page, '2D Goal Pose');
  await notice(page, 'Not sent: no transform names the frame "world"').waitFor();
}

/** A goal and a pose estimate without a subscriber: a notice reports it, and both arrows are shown. */
async function goalIntoTheVoid(page) {
  await until(page, 'periplus.tf.has("odom")', 'frames');
  for (const [tool, topic, advice, rgb] of [
    ['2D Goal Pose', '/goal_pose', 'navigator', 'r > 180 && b > 120 && g < 130'],
    ['2D Pose Estimate', '/initialpose', 'localization', 'g > 130 && r < 90 && b < 140'],
  ]) {
    const before = await share(page, rgb);
    await drag(page, tool);
    await notice(page, `No node subscribes to ${topic}`).filter({ hasText: advice }).waitFor();
    await page.waitForTimeout(1500);
    const after = await share(page, rgb);
    assert.ok(after > before + 0.0002, `${tool}: its arrow is there (${before}, then ${after})`);
  }
}

/** Without a pose estimator the page shows no localization error. */
async function nothingEstimates(page) {
  await until(page, 'periplus.displays.some((d) => d.kind.title === "World")', 'the world');
  await until(page, 'periplus.tf.has("base_link")', 'the robot');
  await page.waitForTimeout(1500);
  assert.deepEqual(await page.evaluate('[...periplus.estimators]'), []);
  assert.equal(await page.getByText('localization error').count(), 0);
}

/** The list of displays to add shows all names in full. */
async function namesInAdd(page) {
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  const clipped = await page.evaluate(() => {
    const all = [...document.querySelectorAll('.adding .pick span:first-child')];
    const wrong = all.filter((span) => {
      const range = document.createRange();
      range.selectNodeContents(span);
      const text = range.getBoundingClientRect();
      const box = span.getBoundingClientRect();
      const list = span.closest('.adding').getBoundingClientRect();
      return text.width < 5 || text.width > box.width + 1 || text.right > list.right;
    });
    return { count: all.length, wrong: wrong.map((span) => span.textContent) };
  });
  assert.ok(clipped.count > 20, `${clipped.count} names`);
  assert.deepEqual(clipped.wrong, []);
  await page.getByRole('button', { name: 'Add', exact: true }).click();
}

/** Single steps advance the clock of the page. */
async function stepsShow(page) {
  await button(page, 'Pause').click();
  await until(page, 'periplus.isPaused', 'a pause');
  const time = page.locator('.time');
  await page.waitForTimeout(400);
  // Each step is visible: two decimals would show one in ten.
  for (let i = 0; i < 4; i++) {
    const before = await time.textContent();
    await button(page, 'Step').click();
    const isNew = (old) => document.querySelector('.time').textContent !== old;
    await page.waitForFunction(isNew, before, { timeout: 5000 });
  }
}

/** A page opened while the simulation is paused shows the last messages. */
async function openedWhilePaused(chrome, address) {
  const { page } = await open(chrome, address);
  await until(page, 'periplus.isPaused', 'a pause');
  await until(page, 'periplus.tf.has("odom") && periplus.tf.has("base_link")', 'frames');
  await until(page, 'periplus.fixedFrame === "odom"', 'the fixed frame');
  for (const [what, expression] of [
    ['the robot', 'd.kind.title === "RobotModel" && d.level === "ok" && d.statuses.Description'],
    ['the scan', 'd.kind.title === "LaserScan" && d.statuses.Points && d.level !== "error"'],
    ['the world', 'd.kind.title === "World" && d.statuses.Scene && d.level === "ok"'],
  ]) {
    await until(page, `periplus.displays.some((d) => ${expression})`, what);
  }
  const lit = `(() => {
    const canvas = periplus.displays.find((d) => d.isEnabled && d.canvas?.width > 300)?.canvas;
    if (!canvas) return false;
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.some((v, i) => i % 4 < 3 && v > 60);
  })()`;
  await until(page, lit, 'a picture that is not black');
  assert.ok(await page.evaluate('periplus.isPaused'), 'it is still paused');
  await page.close();
}

/** Play and Pause show the state of the simulation, also if a step takes seconds. */
async function slowMachine(page) {
  await until(page, 'periplus.clock.nowS > 0', 'time');
  await button(page, 'Pause').waitFor();
  // Longer than the window in which the clock would detect a pause.
  for (let i = 0; i < 12; i++) {
    await page.waitForTimeout(250);
    assert.equal(await page.evaluate('periplus.isPaused'), false, 'it runs, slowly');
  }
  // A reset does not pause the simulation.
  await button(page, 'Reset').click();
  await page.waitForTimeout(1500);
  assert.equal(await page.evaluate('periplus.isPaused'), false, 'it runs after a reset');
  await button(page, 'Pause').click();
  await button(page, 'Play').waitFor({ timeout: 10_000 });
  await button(page, 'Reset').click();
  await page.waitForTimeout(1500);
  assert.equal(await page.evaluate('periplus.isPaused'), true, 'a reset keeps the pause');
}

/** The world stays visible while a run with a pose filter is reset. */
async function reset(page) {
  await until(page, 'periplus.estimators.length > 0', 'a filter', 60_000);
  const aligned = 'periplus.world()?.root.visible && !!periplus.world().truth';
  await until(page, aligned, 'the world beside the estimate', 60_000);
  const red = 'r > 110 && r > 2 * g && r > 2 * b';
  const before = await share(page, red);
  assert.ok(before > 0.001, `the cube is red: ${before}`);
  await until(page, 'periplus.clock.nowS > 4', 'some time');
  await button(page, 'Reset').click();
  await until(page, 'periplus.clock.nowS < 3', 'the time before');
  for (let i = 0; i < 12; i++) {
    assert.ok(await page.evaluate('periplus.world().root.visible'), `hidden after ${i * 0.25} s`);
    await page.waitForTimeout(250);
  }
  const after = await share(page, red);
  assert.ok(after > before / 4, `the cube is seen: ${before}, then ${after}`);
}

/** The world stays visible while no node has published the pose yet: a paused run that is reset. */
async function resetWhilePaused(page) {
  await until(page, 'periplus.tf.has("odom") && periplus.clock.nowS > 1', 'odometry');
  const red = 'r > 110 && r > 2 * g && r > 2 * b';
  // Chosen by the user, so it stays while no node publishes it.
  await page.getByRole('combobox', { name: 'Fixed frame' }).selectOption('odom');
  await page.evaluate('periplus.setFixedFrame("odom")');
  await button(page, 'Pause').click();
  await until(page, 'periplus.isPaused', 'a pause');
  const before = await share(page, red);
  assert.ok(before > 0.001, `the cube is red: ${before}`);
  await button(page, 'Reset').click();
  await until(page, 'periplus.clock.nowS < 0.5', 'the start');
  await page.waitForTimeout(1000);
  assert.ok(await page.evaluate('periplus.world().root.visible'), 'the world is hidden');
  const after = await share(page, red);
  assert.ok(after > before / 4, `the cube is seen: ${before}, then ${after}`);
}

/** An `.rviz` file keeps the simulated world on the page. */
async function rvizKeepsWorld(page) {
  await until(page, 'periplus.displays.some((d) => d.kind.title === "World")', 'the world');
  const file = join(ROOT, 'robots/sam_bot/rviz/sam_bot.rviz');
  await page.getByTestId('rviz-file').setInputFiles(file);
  await until(page, 'periplus.active.fileName === "sam_bot.rviz"', 'the file');
  await until(
    page,
    'periplus.displays.some((d) => d.kind.title === "World" && d.statuses.Scene)',
    'the world beside the displays of the file',
  );
  const worlds = 'periplus.displays.filter((d) => d.kind.title === "World").length';
  assert.equal(await page.evaluate(worlds), 1);
  // A file with a world display replaces it.
  await page.evaluate(
    (text) => window.periplus.active.openRviz(text, 'again'),
    await page.evaluate('periplus.active.rvizText()'),
  );
  assert.equal(await page.evaluate(worlds), 1);
}

/** Names and classes of the displays in an `.rviz` file. */
function displaysOf(file) {
  const text = readFileSync(join(ROOT, file), 'utf8');
  return [
    ...text.matchAll(
      /^ {4}- Class: (?:rviz_default_plugins|rviz)\/(.+)\n(?: {6}.*\n)*? {6}Name: (.+)$/gm,
    ),
  ].map(([, kind, name]) => [kind, name]);
}

/** The `.rviz` file named by the command line or a launch file is opened automatically. */
async function opensRviz(page, file, { fixedFrame, works, hasWorld = false }) {
  await until(page, `periplus.active.fileName === ${JSON.stringify(basename(file))}`, 'the file');
  const wanted = displaysOf(file);
  assert.ok(wanted.length > 3, `${file}: ${wanted}`);
  const shown = await page.evaluate('periplus.displays.map((d) => [d.kind.title, d.name])');
  assert.deepEqual(
    shown.filter(([kind]) => kind !== 'World'),
    wanted,
  );
  if (hasWorld) {
    const worlds = 'periplus.displays.filter((d) => d.kind.title === "World" && d.statuses.Scene)';
    await until(page, `${worlds}.length === 1`, 'the simulated world beside the displays');
  }
  assert.equal(await page.evaluate('periplus.fixedFrame'), fixedFrame);
  for (const name of works) {
    const display = `periplus.displays.find((d) => d.name === ${JSON.stringify(name)})`;
    await until(
      page,
      `${display}.level === "ok" && Object.keys(${display}.statuses).length > 1`,
      `the display ${name}`,
    );
  }
}

/** `periplus rviz2 -d FILE` beside a simulation that another program runs. */
async function rviz2(chrome, url) {
  const domain = { ROS_DOMAIN_ID: '87' };
  const sim = await periplus(
    [
      ...cube().filter((word) => word !== '--ros2' && word !== 'off'),
      `--page=127.0.0.1:${PORT + 1}`,
    ],
    PORT + 1,
    domain,
  );
  try {
    for (const [words, fixedFrame] of [
      [['rviz2', '-d', SAM_BOT_RVIZ], 'odom'],
      [
        ['ros2', 'run', 'rviz2', 'rviz2', `--display-config=${SAM_BOT_RVIZ}`, '-f', 'base_link'],
        'base_link',
      ],
    ]) {
      const view = await periplus(
        [...words, '--no-browser', `--page=127.0.0.1:${PORT}`],
        PORT,
        domain,
      );
      const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
      try {
        await opensRviz(page, SAM_BOT_RVIZ, { fixedFrame, works: ['RobotModel', 'Scan', 'Image'] });
        const red = await share(page, 'r > 200 && g < 90 && b < 90');
        assert.ok(red > 0.001, `squares of the scan: ${red}`);
        assert.deepEqual(complaints, []);
      } finally {
        await page.close();
        await view.stop();
      }
    }
  } finally {
    await sim.stop();
  }
}

/** The token is removed from the address, and a reload still has it. */
async function tokenLeavesTheAddress(chrome, url) {
  const address = `${url}?ws=ws://127.0.0.1:${PORT}/&token=sixteen%20letters%20%26%20more`;
  const { page } = await open(chrome, address);
  await until(page, 'periplus.connection === "open"', 'a connection');
  assert.ok(!page.url().includes('token'), page.url());
  await page.reload();
  await until(page, 'periplus.connection === "open"', 'a connection after a reload');
  await page.close();
}

/** Runs a program, opens the page on it and runs tests. */
async function beside(chrome, url, words, look) {
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
  const { page, complaints } = await open(chrome, address);
  try {
    await until(page, 'periplus.connection === "open"', 'a connection', 60_000);
    await look(page, address);
    assert.deepEqual(complaints, []);
  } finally {
    await page.close();
    await run.stop();
  }
}

export async function use(chrome, url, attempt) {
  if (!attempt.isWanted('use')) return;
  const on = (name, words, look) => attempt(`use ${name}`, () => beside(chrome, url, words, look));
  await on('lidar without tf', pong, lidarWithoutTf);
  await on('goal without frames', pong, goalWithoutFrames);
  await on('goal into the void', cube(), goalIntoTheVoid);
  await on('nothing estimates', cube(), nothingEstimates);
  await on('names in add', cube(), namesInAdd);
  await on('steps show', cube(), stepsShow);
  await on('opened while paused', cube(), async (page, address) => {
    await until(page, 'periplus.clock.nowS > 2', 'some time');
    await page.evaluate('periplus.active.clear()');
    await button(page, 'Pause').click();
    await until(page, 'periplus.isPaused', 'a pause');
    await openedWhilePaused(chrome, address);
  });
  const slow = [...pong.slice(0, 2), '--rtf', '0.001', '--ros2', 'off'];
  await on('slow machine', slow, slowMachine);
  await on('reset', ['launch', 'sam_bot', 'display.launch.py', '--no-browser'], reset);
  await on('reset while paused', cube(), resetWhilePaused);
  await on('rviz keeps the world', cube(), rvizKeepsWorld);
  await attempt('use rviz2 opens its file', () => rviz2(chrome, url));
  for (const [launch, file, expected] of [
    [
      ['launch', 'sam_bot', 'display.launch.py'],
      SAM_BOT_RVIZ,
      { fixedFrame: 'odom', works: ['RobotModel', 'Scan'], hasWorld: true },
    ],
    [
      ['launch', 'robots/kbot/launch/kbot.launch', '--ros2', 'off'],
      'robots/kbot/rviz/kbot.rviz',
      { fixedFrame: 'odom', works: ['RobotModel'], hasWorld: true },
    ],
  ]) {
    await on(`launch opens ${basename(file)}`, [...launch, '--no-browser'], (page) =>
      opensRviz(page, file, expected),
    );
  }
  await attempt('use token leaves the address', async () => {
    const words = [...pong, '--token', 'sixteen letters & more', `--page=0.0.0.0:${PORT}`];
    const run = await periplus(words, PORT);
    await tokenLeavesTheAddress(chrome, url).finally(() => run.stop());
  });
}
