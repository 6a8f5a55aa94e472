// Panels that watch and control the nodes of a running system: each shows real content of a navigating robot.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { PHONE, wrong } from './axe.mjs';
import { open, periplus, sim, until, port } from './lib.mjs';

const PORT = port(8845);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';

const show = (page, kind, state = {}) =>
  page.evaluate(([k, s]) => void window.periplus.workbench.open(k, s), [kind, state]);

/** Saves what a button downloads, and returns its content. */
async function downloaded(page, button) {
  const [file] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return readFileSync(await file.path());
}

const STEPS = {
  async messages(page) {
    await show(page, 'messages', { topic: '/demo/odom' });
    const tree = page.getByRole('tree', { name: 'Fields of /demo/odom' });
    await tree.getByRole('treeitem', { name: /^.*child_frame_id base_link/ }).waitFor();
    await tree
      .getByRole('treeitem', { name: /orientation/ })
      .first()
      .click();
    await tree.getByRole('treeitem', { name: /yaw/ }).first().click();
    await page.getByRole('button', { name: 'Plot this' }).click();
  },

  async plot(page) {
    const label = '/demo/odom:pose.pose.orientation.yaw';
    await page.getByTitle(label).waitFor();
    const field = page.getByRole('combobox', { name: 'Expression' }).first();
    await field.fill('sqrt(/demo/odom:twist.twist.linear.x^2 + ');
    await field.press('Enter');
    await page.getByText(/Position \d+: a value is missing before the end/).waitFor();
    await field.fill('derivative(/demo/odom:pose.pose.position.x)');
    await field.press('Enter');
    await page.getByText('m/s', { exact: true }).first().waitFor();
    await page.getByRole('button', { name: 'Statistics' }).click();
    await page.getByText('RMS').first().waitFor();
    await page.waitForTimeout(1500);
    const csv = String(await downloaded(page, page.getByRole('button', { name: 'CSV' })));
    const rows = csv.trim().split('\r\n');
    assert.equal(rows[0].split(',')[0], 'time [s]');
    assert.ok(rows.length > 5, `rows: ${rows.length}`);
    const png = await downloaded(page, page.getByRole('button', { name: 'PNG' }));
    assert.equal(png.subarray(1, 4).toString(), 'PNG');
  },

  async transforms(page) {
    await show(page, 'transforms', { source: 'base_link', target: 'map' });
    await page.getByText('No faults').waitFor();
    await page.getByRole('cell', { name: /Hz/ }).first().waitFor();
    await page.getByText(/rad/).first().waitFor();
  },

  async diagnostics(page) {
    await show(page, 'diagnostics');
    await page.getByRole('button', { name: /slam_toolbox: mapping/ }).waitFor({ timeout: 20_000 });
    await page.getByLabel('Search', { exact: true }).fill('ekf');
    await page
      .getByRole('button', { name: /ekf_filter_node/ })
      .first()
      .waitFor();
    assert.equal(await page.getByRole('button', { name: /slam_toolbox: mapping/ }).count(), 0);
  },

  async actions(page) {
    await show(page, 'actions', { action: '/wait' });
    await page.getByLabel('time.sec', { exact: true }).fill('2');
    await page.getByRole('button', { name: 'Send the goal' }).click();
    const state = page.getByText('succeeded', { exact: true });
    await state.waitFor({ timeout: 60_000 });
    await page.getByText('total_elapsed_time').waitFor();
    await page.getByLabel('time.sec', { exact: true }).fill('500');
    await page.getByRole('button', { name: 'Send the goal' }).click();
    await page.getByText('executing', { exact: true }).waitFor();
    await page.getByRole('button', { name: 'Cancel', exact: true }).click();
    await page.getByText('canceled', { exact: true }).waitFor();
  },

  /** After the actions: the state has the name of its constant. */
  async states(page) {
    const fields = [{ topic: '/wait/_action/status', path: 'status_list[0].status' }];
    await show(page, 'states', { fields });
    await page.getByText('STATUS_SUCCEEDED (4)').first().waitFor();
  },

  async graph(page) {
    await show(page, 'graph');
    await page.getByRole('button', { name: 'Node /slam_toolbox' }).focus();
    await page.keyboard.press('Enter');
    await page.getByText('Publishes').waitFor();
    await page.getByText('/map', { exact: true }).first().waitFor();
  },

  async 'parameter sets'(page) {
    await show(page, 'parameterSets');
    const yaml = String(await downloaded(page, page.getByRole('button', { name: 'Save as YAML' })));
    assert.match(yaml, /\/slam_toolbox:\n {2}ros__parameters:/);
    const changed = yaml.replace(/( +)(map_update_interval: )[\d.]+/, '$1$23.5');
    assert.notEqual(changed, yaml);
    const file = { name: 'set.yaml', mimeType: 'application/yaml', buffer: Buffer.from(changed) };
    await page.getByLabel('Load YAML…').setInputFiles(file);
    await page.getByText('1 values differ').waitFor();
    await page.getByRole('button', { name: 'Apply 1 values' }).click();
    await page
      .getByRole('status')
      .filter({ hasText: /1 values? (was|were) (set|not)|0 values/ })
      .waitFor();
  },

  async joints(page) {
    await show(page, 'joints');
    await page.getByRole('slider', { name: 'drivewhl_l_joint' }).waitFor();
    await page.getByText(/also publishes the joint states/).waitFor();
  },

  async table(page) {
    await show(page, 'table', { topic: '/joint_states', array: 'position' });
    await page.getByRole('columnheader', { name: /value/ }).waitFor();
    const csv = String(await downloaded(page, page.getByRole('button', { name: 'CSV' }).last()));
    assert.equal(csv.trim().split('\r\n').length, 3);
  },

  async 'interactive markers'(page) {
    await page.evaluate(async () => {
      const { client, active } = window.periplus;
      await client.call('/slam_toolbox/toggle_interactive_mode', {});
      active.add('rviz_default_plugins/InteractiveMarkers', 'handles', {
        'Interactive Markers Namespace': '/slam_toolbox',
      });
    });
    await until(
      page,
      `/^[1-9]\\d* interactive/.test(periplus.displays.find((d) => d.name === 'handles').statuses.Markers?.text)`,
      'interactive markers',
    );
  },
};

const KINDS = [
  ...['messages', 'plot', 'states', 'transforms', 'diagnostics', 'graph', 'actions'],
  ...['parameterSets', 'joints', 'table'],
];

/** Every panel fits a phone. */
async function phone(page) {
  await until(page, 'periplus.topics.some((t) => t.name === "/map" && t.type)', 'topics', 60_000);
  for (const kind of KINDS) {
    await show(page, kind);
    await page.waitForTimeout(500);
    const wide = await page.evaluate(() => {
      const all = [...document.querySelectorAll('[role=tabpanel]')].filter(
        (e) => e.clientWidth > 0,
      );
      return all.filter((e) => e.scrollWidth > e.clientWidth + 1).map((e) => [e.id, e.scrollWidth]);
    });
    assert.deepEqual(wide, [], kind);
  }
}

export async function panels(chrome, url, attempt) {
  if (!attempt.isWanted('panels')) return;
  const words = sim('worlds/house.sdf', SAM_BOT, '--pose', '0,0,0', '--navigation');
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const { page, complaints } = await open(chrome, `${url}?ws=ws://127.0.0.1:${PORT}/`, {
    reducedMotion: 'reduce',
  });
  try {
    await until(page, 'periplus.connection === "open"', 'a connection', 60_000);
    await until(page, 'periplus.topics.some((t) => t.name === "/map" && t.type)', 'topics', 60_000);
    for (const [name, step] of Object.entries(STEPS)) {
      await attempt(`panels: ${name}`, () => step(page));
    }
    for (const kind of KINDS) {
      await attempt(`panels: axe ${kind}`, async () => {
        await show(page, kind);
        await page.waitForTimeout(700);
        assert.deepEqual(await wrong(page, kind), []);
      });
    }
    await attempt('panels: no errors', async () => assert.deepEqual(complaints, []));
    await page.close();
    await attempt('panels: phone', async () => {
      const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
      const small = await open(chrome, address, { ...PHONE, reducedMotion: 'reduce' });
      await phone(small.page);
      await small.page.screenshot({ path: process.env.SHOT ?? '/dev/null', type: 'png' });
      assert.deepEqual(small.complaints, []);
      await small.page.close();
    });
  } finally {
    if (!page.isClosed()) await page.close();
    await run.stop();
  }
}
