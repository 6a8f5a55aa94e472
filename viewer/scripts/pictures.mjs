// Pictures of the page for the documentation, from running examples: docs/pictures/viewer-*.png, and docs/displays.md
// with its own.
//
//   npm run pictures [demo] [house] [navigation] [building] [displays] [tutorials]     PERIPLUS=path/to/periplus
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { browser, open, periplus, ROOT, servePage, sim, port } from '../e2e/lib.mjs';
import { goal, pixel, ready } from '../e2e/navigate.mjs';
import { tutorials } from '../e2e/tutorials.mjs';
import { displays } from './show.mjs';

const OUT = join(ROOT, 'docs/pictures');
const PORT = port(8841);
const SAM_BOT = 'robots/sam_bot/urdf/sam_bot.urdf.xacro';
mkdirSync(OUT, { recursive: true });

const pages = await servePage();
const chrome = await browser();

/** Runs a world, opens the page on it, and calls a function with it. */
async function scene(args, look, options = {}) {
  const run = await periplus([...args, `--page=127.0.0.1:${PORT}`], PORT);
  const { page } = await open(chrome, `${pages.url}?ws=ws://127.0.0.1:${PORT}/`, options);
  try {
    await page.waitForFunction('periplus.displays.length > 3', undefined, { timeout: 30_000 });
    await page.waitForTimeout(2500);
    await look(page);
  } finally {
    await page.close();
    await run.stop();
  }
}

const whole = (page, name) => page.screenshot({ path: join(OUT, `viewer-${name}.png`) });
/** Screenshots by name. */
const PICTURES = {
  demo: () =>
    scene(['demo', '--no-browser', '--explore'], async (page) => {
      await page.waitForTimeout(Number(process.env.DEMO_MS ?? 12_000));
      await whole(page, 'demo');
    }),
  house: () =>
    scene(
      [...sim('worlds/house.sdf', SAM_BOT), '--pose', '3,2.5,0.4'],
      async (page) => {
        await page.getByRole('tab', { name: 'World' }).click();
        await page.waitForTimeout(2500);
        await whole(page, 'house');
      },
      { colorScheme: 'light' },
    ),
  navigation: () =>
    scene([...sim('worlds/house.sdf', SAM_BOT), '--pose', '0,0,0', '--navigation'], navigation),
  building,
  displays: () => displays(chrome, pages.url, OUT),
  tutorials: ofTutorials,
};

/** A goal that is blocked, and then a drive to waypoints with the trajectories of the controller. */
async function navigation(page) {
  const side = page.getByRole('complementary', { name: 'Panels' });
  await ready(page);
  await page.evaluate(() => {
    const { periplus } = window;
    // With the default tolerance the planner takes a free cell beside the wall.
    const name = '/planner_server.GridBased.tolerance';
    periplus.client.setParameter({ name, value: 0.05 });
    periplus.setView({ kind: 'TopDownOrtho', scale: 95, x: 1.2, y: 0.2 });
  });
  await goal(page, [1.6, 0.8], [1.6, 1.4]);
  await page.getByTestId('navigation-reason').filter({ hasText: 'layer' }).waitFor();
  await page.waitForTimeout(1000);
  await side.screenshot({ path: join(OUT, 'viewer-navigation-reason.png') });
  await page.getByRole('button', { name: 'Cancel the goal' }).click();
  await page.getByRole('checkbox', { name: 'Show the trajectories of MPPI' }).check();
  await page.getByRole('button', { name: 'Waypoints', exact: true }).first().click();
  for (const [x, y] of [
    [2.6, 0.1],
    [3.5, -0.1],
    [4.3, 0],
  ])
    await page.mouse.click(...(await pixel(page, x, y)));
  await page.getByRole('button', { name: 'Go', exact: true }).click();
  await page.mouse.move(640, 5);
  const visible = `periplus.displays.find((d) => d.name === 'trajectories')?.display?.entries.size > 100`;
  await page.waitForFunction(visible, undefined, { timeout: 60_000 });
  await page.waitForTimeout(500);
  await whole(page, 'navigation');
}

async function building() {
  const { page } = await open(chrome, `${pages.url}#building`);
  const plan = page.getByRole('application');
  const box = await plan.boundingBox();
  const press = async (x, y) => {
    const zoom = await page.evaluate('building.zoom');
    await page.mouse.click(
      box.x + box.width / 2 + (x - 3) * zoom,
      box.y + box.height / 2 - (y - 2) * zoom,
    );
  };
  const line = async (...points) => {
    await page.keyboard.press('w');
    for (const [x, y] of points) await press(x, y);
    await page.keyboard.press('Escape');
  };
  await line([-1, -1], [8, -1], [8, 5], [-1, 5], [-1, -1]);
  await line([3, -1], [3, 5]);
  await line([3, 2], [8, 2]);
  for (const [key, x, y] of [
    ['d', 0.5, -1],
    ['d', 3, 0.5],
    ['d', 3, 4],
    ['n', 1, 5],
    ['n', 5.5, 5],
    ['n', 8, 0.5],
    ['s', 5.8, 3.5],
  ]) {
    await page.keyboard.press(key);
    await press(x, y);
  }
  await page.keyboard.press('v');
  await press(3, 2.6);
  await page.waitForTimeout(800);
  await whole(page, 'building');
  await page.close();
}

/** Screenshots of the manual steps of the tutorials, taken by the tests that follow the texts. */
async function ofTutorials() {
  const out = mkdtempSync(join(tmpdir(), 'periplus-pictures-'));
  const shoot = async (page, name, view = {}) => {
    await page.evaluate((state) => {
      window.periplus.setView(state);
      for (const { id } of [...window.periplus.notices]) window.periplus.dismiss(id);
      document.activeElement?.blur();
    }, view);
    await page.mouse.move(640, 5);
    await page.waitForTimeout(1500);
    await page.screenshot({ path: join(OUT, 'tutorials', `${name}.png`) });
  };
  try {
    await tutorials(chrome, pages.url, out, (_, take) => take(), shoot);
  } finally {
    rmSync(out, { recursive: true });
  }
}

const wanted = process.argv.slice(2);
try {
  for (const [name, take] of Object.entries(PICTURES)) {
    if (wanted.length === 0 || wanted.includes(name)) await take();
  }
} finally {
  await chrome.close();
  pages.stop();
}
