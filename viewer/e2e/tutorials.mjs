// Executes the manual steps of the tutorials: the names of controls and the values are read from the texts
// in docs/tutorials, so that an outdated text fails.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { next, open, periplus, PROGRAM, ROOT, sim, until, port } from './lib.mjs';

const PORT = port(8827);

/**
 * Numbered steps of the list after a text, each with its bold names and code. A name may span two lines.
 */
function stepsOf(file, before) {
  const text = readFileSync(join(ROOT, 'docs/tutorials', file), 'utf8');
  const from = text.indexOf(before);
  assert.ok(from >= 0, `${file} has no "${before}"`);
  const list = /(?:^\d+\. .*\n(?:^ {3}.*\n)*)+/m.exec(text.slice(from));
  assert.ok(list, `${file}: no steps after "${before}"`);
  return list[0]
    .split(/^\d+\. /m)
    .slice(1)
    .map((step) => {
      const flat = step.replace(/\s+/g, ' ').trim();
      const all = (pattern) => [...flat.matchAll(pattern)].map((match) => match[1]);
      return { text: flat, names: all(/\*\*(.+?)\*\*/g), codes: all(/`(.+?)`/g) };
    });
}

/** Runs the function of each step; there must be one per step. */
async function follow(file, before, actions) {
  const steps = stepsOf(file, before);
  assert.equal(steps.length, actions.length, `${file}: steps after "${before}"`);
  for (const [i, action] of actions.entries()) {
    try {
      await action(steps[i]);
    } catch (error) {
      throw new Error(`${file}: "${steps[i].text}": ${error.stack ?? error}`);
    }
  }
}

const side = (page, name) => page.getByRole('complementary', { name });
const press = (where, name) => where.getByRole('button', { name, exact: true }).first().click();

/** Option of the display that is expanded. */
const option = (page, name) =>
  side(page, 'Displays')
    .locator('.option', { has: page.locator('.name').getByText(name, { exact: true }) })
    .locator('input, select');

/** Sets the options of a step: each name to the code after it. */
async function set(page, { names, codes }) {
  assert.equal(names.length, codes.length);
  for (const [i, name] of names.entries()) {
    const control = option(page, name);
    if ((await control.evaluate((e) => e.tagName)) === 'SELECT') {
      await control.selectOption(codes[i]);
    } else {
      await control.fill(codes[i]);
      await control.press('Enter');
    }
  }
}

/** Adds a display by its kind, with all others collapsed so that the names of controls are unique. */
async function addByKind(page, { names: [add, kind] }) {
  await press(side(page, 'Displays'), add);
  const list = page.getByRole('group', { name: 'Add a display' });
  const title = page.locator('.title', { hasText: new RegExp(`^${kind}$`) });
  // Kinds are listed after topics, which name their kind too.
  await list.locator('.pick', { has: title }).last().click();
}

const fixedFrame =
  (page) =>
  async ({ names, codes }) => {
    const [name] = names;
    await side(page, 'Displays').getByLabel(name, { exact: true }).selectOption(codes[0]);
    await until(page, `periplus.fixedFrame === ${JSON.stringify(codes[0])}`, 'the fixed frame');
  };

/** Scan shown by the last display. */
async function scanIsShown(page, topic, sizeM) {
  const last = 'periplus.displays[periplus.displays.length - 1]';
  await until(page, `${last}.statuses.Points && ${last}.level === "ok"`, 'the scan');
  const values = await page.evaluate(`({ ...${last}.values })`);
  assert.equal(values.Topic, topic);
  assert.equal(values['Size (m)'], sizeM);
  assert.equal(values.Style, 'Flat Squares');
}

/** Runs a program and follows a text on its page; `shoot` takes a screenshot. */
async function beside(chrome, url, words, look) {
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const { page } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`);
  try {
    await until(
      page,
      'periplus.displays.some((d) => d.kind.title === "World")',
      'the world',
      60_000,
    );
    await until(
      page,
      'periplus.tf.names().length > 3 || periplus.fixedFrame === "world"',
      'frames',
    );
    await look(page);
  } finally {
    await page.close();
    await run.stop();
  }
}

const KBOT = ['launch', 'robots/kbot/launch/kbot.launch', '--no-browser'];
const PLAIN = ['--ros2', 'off'];

const TUTORIALS = {
  /** Third tutorial of kbot: a display for the scan. */
  'kbot scan': (chrome, url, { shoot }) =>
    beside(chrome, url, [...KBOT, ...PLAIN], async (page) => {
      await page.evaluate(async () => {
        const sdf =
          "<sdf version='1.6'><model name='cube'><pose>1.5 0 0.25 0 0 0</pose><link name='link'><collision name='c'><geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision><visual name='v'><geometry><box><size>0.5 0.5 0.5</size></box></geometry></visual></link></model></sdf>";
        await window.periplus.call(`/world/${window.periplus.worldName}/create`, {
          entity_factory: { name: 'cube', sdf, pose: { position: { x: 1.5, y: 0, z: 0.25 } } },
        });
      });
      const values = { topic: '', size: 0 };
      await follow('kbot-slam-maps.md', 'The scan on the page, by hand', [
        (step) => addByKind(page, step),
        (step) => ((values.topic = step.codes[0]), set(page, step)),
        (step) => ((values.size = Number(step.codes[1])), set(page, step)),
        fixedFrame(page),
      ]);
      await scanIsShown(page, values.topic, values.size);
      await shoot(page, 'kbot-scan-by-hand', { distance: 4.5, focal: [0.8, 0, 0] });
    }),

  /** A room is drawn, inserted and saved; the lidar measures it, and the saved world is valid. */
  'kbot room': (chrome, url, { out, shoot }) =>
    beside(chrome, url, [...KBOT, ...PLAIN], async (page) => {
      const editor = page.getByRole('dialog', { name: 'Building Editor' });
      const saves = async (action) => {
        const [download] = await Promise.all([page.waitForEvent('download'), action()]);
        return download;
      };
      let corners = [];
      let name = '';
      await follow('kbot-slam-maps.md', 'draws a room in its Building Editor', [
        async ({ names: [button] }) => {
          await press(page, button);
          await editor.getByRole('application').waitFor();
        },
        async ({ names: [wall], codes }) => {
          await editor.getByRole('button', { name: wall }).click();
          corners = codes.filter((code) => code.includes(',')).map((c) => c.split(',').map(Number));
          const box = await editor.getByRole('application').boundingBox();
          for (const [x, y] of corners) {
            const zoom = await page.evaluate('building.zoom');
            const at = [box.width / 2 + (x - 3) * zoom, box.height / 2 - (y - 2) * zoom];
            await page.mouse.click(box.x + at[0], box.y + at[1]);
          }
          const size = await page.evaluate(
            'building.plan.walls.map((w) => [w.to.x - w.from.x, w.to.y - w.from.y])',
          );
          assert.deepEqual(
            size.map((s) => +Math.hypot(...s).toFixed(2)),
            [6, 4.5, 6, 4.5],
          );
        },
        async (step) => {
          name = step.codes[0];
          const field = editor.getByLabel(step.names[0], { exact: true });
          await field.fill(name);
          await field.press('Tab');
        },
        async ({ names: [model], codes: [file] }) => {
          const saved = await saves(() => press(editor, model));
          assert.equal(saved.suggestedFilename(), file);
        },
        async ({ names: [put] }) => {
          await editor.getByRole('button', { name: put }).click();
          await editor.waitFor({ state: 'hidden' });
        },
        async ({ names: [tab, model, move] }) => {
          await side(page, 'Panels').getByRole('tab', { name: tab }).click();
          await page.getByRole('option', { name: model, exact: true }).click();
          await side(page, 'Panels').getByRole('button', { name: move, exact: true }).waitFor();
        },
        async ({ names: [save] }) => {
          const button = side(page, 'Panels').getByRole('button', { name: save });
          const saved = await saves(() => button.click());
          const world = join(out, 'saved.sdf');
          await saved.saveAs(world);
          const said = execFileSync(PROGRAM, ['check', world], { encoding: 'utf8' });
          assert.match(said, new RegExp(name), said);
        },
      ]);
      await page.waitForTimeout(1500);
      await shoot(page, 'kbot-room-by-hand', { distance: 11, pitch: 1, focal: [1.5, 0.75, 0] });
      // Every beam hits a wall: the farthest corner is nearer than six metres.
      const scan = '/kbot/sensor_laser/scan';
      const far = () => next(page, scan, 'message.ranges.filter((r) => !(r < 6)).length');
      assert.equal(await far(), 0, 'beams that leave the room');
      await page.close();
      await beside(
        chrome,
        url,
        ['sim', join(out, 'saved.sdf'), '--rtf', '1', '--ros2', 'off'],
        (again) =>
          until(
            again,
            `periplus.models.includes(${JSON.stringify(name)})`,
            'the room in the saved world',
          ),
      );
    }),

  'nav2 scan': (chrome, url, { shoot }) =>
    beside(
      chrome,
      url,
      sim(
        'worlds/cube_and_sphere.sdf',
        'robots/sam_bot/urdf/sam_bot.urdf.xacro',
        'publish_odom_tf:=true',
      ),
      async (page) => {
        await until(page, 'periplus.tf.has("odom")', 'odometry');
        await follow('nav2-sensors.md', 'The guide adds the display manually', [
          (step) => addByKind(page, step),
          (step) => set(page, step),
          (step) => set(page, step),
          (step) => set(page, step),
          fixedFrame(page),
        ]);
        await scanIsShown(page, '/scan', 0.1);
        await shoot(page, 'nav2-scan-by-hand');
      },
    ),

  'gz lidar': (chrome, url, { shoot }) =>
    beside(chrome, url, ['sim', 'worlds/pong.sdf', '--rtf', '1', ...PLAIN], async (page) => {
      const panels = side(page, 'Panels');
      const lidar = 'periplus.displays.find((d) => d.kind.title === "Visualize Lidar")';
      await follow('gz-lidar.md', "Gazebo's Key Publisher and Visualize Lidar are", [
        async ({ names: [tab, keys] }) => {
          await panels.getByRole('tab', { name: tab }).click();
          await panels.getByLabel(keys).check();
          await panels.getByLabel(keys).uncheck();
        },
        async ({ names: [tab, visualize] }) => {
          await panels.getByRole('tab', { name: tab }).click();
          await press(panels, visualize);
        },
        (step) => set(page, { names: step.names, codes: step.codes.slice(0, 1) }),
        async ({ names: [hitless] }) => {
          await until(page, `${lidar}?.statuses.Rays?.level === "ok"`, 'rays');
          await shoot(page, 'gz-lidar', { distance: 24, pitch: 0.9, focal: [4, 0, 0] });
          await option(page, hitless).uncheck();
          assert.equal(await page.evaluate(`${lidar}.values['Show Non Hitting Rays']`), false);
        },
        async ({ names: [frame], codes }) => {
          const frames = side(page, 'Displays').getByLabel(frame, { exact: true });
          assert.deepEqual(await frames.locator('option').allTextContents(), [codes[1]]);
        },
      ]);
    }),
};

export async function tutorials(chrome, url, out, attempt, shoot = async () => {}) {
  for (const [name, test] of Object.entries(TUTORIALS)) {
    await attempt(`tutorial ${name}`, () => test(chrome, url, { out, shoot }));
  }
}
