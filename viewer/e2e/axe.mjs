// Accessibility: axe finds no serious violation in the main states of the page, and on a phone all main
// controls are reachable.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { open, periplus, sim, until, port } from './lib.mjs';

const PORT = port(8826);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';
const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const PANELS = [
  'Drive',
  'Navigate',
  'World',
  'Topics',
  'Nodes',
  'Parameters',
  'Services',
  'Plot',
  'Log',
];
export const PHONE = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** Violations found by axe that keep people from using the page. */
export async function wrong(page, state) {
  if (!(await page.evaluate('!!window.axe'))) await page.evaluate(AXE);
  const found = await page.evaluate(async () => {
    // Includes landmarks, headings and names that differ from the visible text.
    const { violations } = await window.axe.run(document, {
      resultTypes: ['violations'],
      rules: { 'label-content-name-mismatch': { enabled: true } },
    });
    const counts = ['serious', 'critical'];
    const also = ['page-has-heading-one', 'landmark-unique', 'region'];
    return violations
      .filter(({ id, impact }) => counts.includes(impact) || also.includes(id))
      .map(({ id, impact, nodes }) => ({
        id,
        impact,
        nodes: nodes.map((n) => [n.html, n.failureSummary]),
      }));
  });
  return found.map((one) => ({ state, ...one }));
}

/** The panel World while models are edited. */
async function edited(page, state) {
  const all = [];
  for (const count of [1, 3]) {
    await page.evaluate((n) => (periplus.selection = periplus.models.slice(0, n)), count);
    await page.waitForTimeout(250);
    all.push(...(await wrong(page, `${state}: ${count} selected models`)));
  }
  const image = Buffer.concat([Buffer.from('P5\n8 4\n255\n'), Buffer.alloc(32, 60)]);
  const file = { name: 'plan.pgm', mimeType: '', buffer: image };
  await page.getByTestId('underlay-file').setInputFiles(file);
  const panel = page.getByRole('tabpanel');
  await panel.getByRole('group', { name: 'Floor plan' }).waitFor();
  await page.evaluate(() => (periplus.selectedModel = 'cube'));
  await page.keyboard.press('Control+ArrowRight');
  const changes = panel.getByRole('button', { name: 'Show changes' });
  if (await changes.isVisible()) {
    await changes.click();
    await panel.getByRole('region', { name: /^Changes in/ }).waitFor();
  }
  all.push(...(await wrong(page, `${state}: floor plan and changes`)));
  await page.keyboard.press('Control+z');
  await panel.getByRole('button', { name: 'Remove the picture' }).click();
  await page.evaluate(() => (periplus.selection = []));
  return all;
}

async function states(page, state) {
  const all = await wrong(page, `${state}: start`);
  const panels = page.getByRole('button', { name: 'Panels', exact: true });
  if ((await panels.getAttribute('aria-pressed')) === 'false') await panels.click();
  for (const name of PANELS) {
    await page.getByRole('tab', { name }).click();
    await page.waitForTimeout(250);
    all.push(...(await wrong(page, `${state}: ${name}`)));
    if (name === 'World') all.push(...(await edited(page, state)));
  }
  const displays = page.getByRole('button', { name: 'Displays', exact: true });
  if ((await displays.getAttribute('aria-pressed')) === 'false') await displays.click();
  await page.getByRole('button', { name: 'Options of World' }).click();
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  await page.evaluate(() => {
    for (const level of ['info', 'warn', 'error']) window.periplus.notice(level, `a ${level}`);
  });
  await page.waitForTimeout(250);
  all.push(...(await wrong(page, `${state}: displays and messages`)));
  for (const close of await page.getByRole('button', { name: 'Close', exact: true }).all()) {
    await close.click({ timeout: 1000 }).catch(() => {});
  }
  await page.getByRole('button', { name: 'Add', exact: true }).click();
  if (state === 'phone') await displays.click();
  await page.getByRole('button', { name: 'Building Editor' }).click();
  await page.getByRole('application').waitFor();
  await page.waitForTimeout(250);
  all.push(...(await wrong(page, `${state}: Building Editor`)));
  return all;
}

/** On a phone the main controls are on the screen, and no text mentions keys. */
async function phone(page) {
  const width = page.viewportSize().width;
  for (const name of [
    'Pause',
    'Step',
    'Reset',
    'Panels',
    'Displays',
    'Building Editor',
    'Measure',
  ]) {
    const box = await page.getByRole('button', { name, exact: true }).first().boundingBox();
    assert.ok(box && box.x >= 0 && box.x + box.width <= width, `${name}: ${JSON.stringify(box)}`);
    assert.ok(box.width >= 24 && box.height >= 24, `${name} is too small for a finger`);
  }
  const wide = await page.evaluate('document.querySelector(".bar").scrollWidth');
  assert.ok(wide <= width, `the toolbar is ${wide} px wide`);
  await page.getByRole('button', { name: 'Panels', exact: true }).click();
  await page.getByRole('tab', { name: 'Drive' }).click();
  await page.getByRole('button', { name: 'Measure' }).first().click();
  const keys = await page.evaluate(() =>
    [...document.querySelectorAll('kbd, .keys-only')]
      .filter((e) => e.checkVisibility())
      .map((e) => e.textContent),
  );
  assert.deepEqual(keys, []);
  await page.getByRole('button', { name: 'Measure' }).first().click();
  await page.getByRole('button', { name: 'Panels', exact: true }).click();
}

export async function axe(chrome, url, attempt) {
  if (!attempt.isWanted('axe')) return;
  const words = sim('worlds/cube_and_sphere.sdf', SAM_BOT, 'publish_odom_tf:=true');
  const run = await periplus([...words, `--page=127.0.0.1:${PORT}`], PORT);
  const look = async (options, test) => {
    const address = `${url}?ws=ws://127.0.0.1:${PORT}/`;
    const { page } = await open(chrome, address, options);
    try {
      await until(page, 'periplus.displays.some((d) => d.kind.title === "World")', 'the world');
      await until(page, '!periplus.isPaused', 'a run');
      await test(page);
    } finally {
      await page.close();
    }
  };
  const nothing = (state) => async (page) => assert.deepEqual(await states(page, state), []);
  try {
    await attempt('axe dark', () => look({ colorScheme: 'dark' }, nothing('dark')));
    await attempt('axe light', () => look({ colorScheme: 'light' }, nothing('light')));
    await attempt('axe phone', () => look({ ...PHONE, colorScheme: 'light' }, nothing('phone')));
    await attempt('axe phone toolbar', () => look(PHONE, phone));
  } finally {
    await run.stop();
  }
}
