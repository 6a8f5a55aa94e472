// `periplus demo` for a new user: the page opens, keys drive the robot, and the map grows.
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { next, open, periplus, ROOT, until, port } from './lib.mjs';

const PORT = port(8823);
const CORPUS = join(ROOT, '../shared/corpus');

/** `.rviz` files, and the displays that they contain. */
const RVIZ = {
  'robots/sam_bot/rviz/sam_bot.rviz': ['Grid', 'RobotModel', 'TF', 'LaserScan'],
  [join(CORPUS, 'navigation2_tutorials@humble/sam_bot_description/rviz/urdf_config.rviz')]: [
    ...['Grid', 'RobotModel', 'TF', 'Map'],
  ],
  [join(CORPUS, 'andino/andino_navigation/rviz/nav2_default_view.rviz')]: [
    ...['Grid', 'RobotModel', 'TF', 'LaserScan', 'PointCloud2', 'Map', 'ParticleCloud'],
    ...['Map', 'Map', 'Path', 'PointCloud2', 'Polygon', 'Map', 'Path', 'MarkerArray'],
    ...['Polygon', 'PointCloud2', 'Image', 'PointCloud2', 'MarkerArray'],
  ],
};

const pose = `(() => {
  const found = periplus.tf.lookup('odom', 'base_link');
  const q = found.pose?.q;
  return found.kind === 'found' && { x: found.pose.t[0], y: found.pose.t[1], yaw: 2 * Math.atan2(q[2], q[3]) };
})()`;
const known = (page) => next(page, '/map', 'message.data.reduce((n, c) => n + (c >= 0), 0)');

export const STEPS = {
  async opens(page) {
    await until(page, 'periplus.connection === "open"', 'a connection', 60_000);
    const has = (expression) => `periplus.displays.some((d) => d.isEnabled && ${expression})`;
    for (const [what, expression] of [
      ['a robot', 'd.kind.title === "RobotModel" && d.statuses.Description?.level === "ok"'],
      ['a scan', 'd.kind.title === "LaserScan" && d.statuses.Points'],
      ['a picture', 'd.canvas?.width > 300'],
      ['a map', 'd.values.Topic === "/map" && Number(d.values.Width) > 10'],
      ['a costmap', 'd.values["Color Scheme"] === "costmap" && Number(d.values.Width) > 10'],
      ['a world', 'd.kind.title === "World" && d.statuses.Scene'],
    ]) {
      await until(page, has(expression), what, 60_000);
    }
    await until(page, 'periplus.fixedFrame === "map"', 'the frame of the map');
  },

  /** The cube is straight ahead, and red. */
  async 'sees the cube'(page) {
    const red = `(() => {
      const { canvas } = periplus.displays.find((d) => d.isEnabled && d.canvas?.width > 300);
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        count += data[i] > 110 && data[i] > 2 * data[i + 1] && data[i] > 2 * data[i + 2];
      }
      return (count * 4) / data.length;
    })()`;
    await until(page, `${red} > 0.03`, 'a red cube in the picture');
    assert.ok((await page.evaluate(red)) < 0.9, 'there is more than a cube');
  },

  async 'is driven by keys, and maps'(page) {
    const first = await known(page);
    const start = await page.evaluate(pose);
    await page.locator('canvas').first().focus();
    await page.keyboard.down('i');
    const far = `Math.hypot(${pose}.x - ${start.x}, ${pose}.y - ${start.y}) > 0.4`;
    await until(page, far, 'driving on by 0.4 m', 60_000);
    await page.keyboard.up('i');
    await page.keyboard.down('j');
    const turned = `Math.abs(Math.sin((${pose}.yaw - ${start.yaw}) / 2)) > 0.9`;
    await until(page, turned, 'turning around', 60_000);
    await page.keyboard.up('j');
    await page.keyboard.down('i');
    await page.waitForTimeout(1500);
    await page.keyboard.up('i');
    let now = first;
    for (let i = 0; i < 30 && now <= first; i++) now = await known(page);
    assert.ok(now > first, `cells that the map knows: ${first}, then ${now}`);
  },

  async 'tells how true the map is'(page) {
    const hasTruth = await page.evaluate(
      'periplus.topics.some((t) => t.name === `/world/${periplus.worldName}/truth` && t.type)',
    );
    assert.ok(hasTruth, 'the truth is a topic');
    await until(
      page,
      'periplus.maps.some((m) => m.topic === "/map")',
      'a map beside the truth',
      60_000,
    );
    const map = await page.evaluate('periplus.maps.find((m) => m.topic === "/map")');
    assert.ok(map.freeIou > 0.5 && map.freeIou <= 1, `free space agrees by ${map.freeIou}`);
    await page.getByText('free space IoU').waitFor();
  },

  async "opens RViz's files"(page) {
    for (const [name, kinds] of Object.entries(RVIZ)) {
      const file = name.startsWith('/') ? name : join(ROOT, name);
      if (!existsSync(file)) {
        console.log(`SKIPPED: ${name} is not there`);
        continue;
      }
      await page.getByTestId('rviz-file').setInputFiles(file);
      const base = name.split('/').pop();
      await until(page, `periplus.active.fileName === ${JSON.stringify(base)}`, name);
      const shown = await page.evaluate('periplus.displays.map((d) => d.kind.title)');
      assert.deepEqual(shown.slice(0, kinds.length), kinds);
      // The simulated world stays beside the displays of the file.
      if (name.startsWith('/')) assert.deepEqual(shown.slice(kinds.length), ['World']);
      // Displays with a topic in the demo show its messages.
      for (const title of ['RobotModel', 'Map', 'LaserScan']) {
        const one = `periplus.displays.find((d) => d.kind.title === "${title}" && d.isEnabled)`;
        const isHere = `(periplus.topics.some((t) => t.type && t.name === ${one}?.values.Topic))`;
        if (!(await page.evaluate(isHere))) continue;
        await until(page, `${one}.statuses.Topic?.level === "ok"`, `${title} of ${base}`);
      }
      // The saved file has the same displays.
      const text = await page.evaluate('periplus.active.rvizText()');
      await page.evaluate((written) => window.periplus.active.openRviz(written, 'again'), text);
      assert.deepEqual(await page.evaluate('periplus.displays.map((d) => d.kind.title)'), shown);
    }
  },
};

/** All steps on one run, each reported by name. */
export async function demo(chrome, url, attempt) {
  if (!attempt.isWanted('demo')) return;
  const run = await periplus(['demo', '--no-browser', `--page=127.0.0.1:${PORT}`], PORT);
  const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
  try {
    for (const [name, step] of Object.entries(STEPS)) {
      await attempt(`demo ${name}`, () => step(page));
    }
    await attempt('demo is quiet', async () => assert.deepEqual(complaints, []));
  } finally {
    await page.close();
    await run.stop();
  }
}
