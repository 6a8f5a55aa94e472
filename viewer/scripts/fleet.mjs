// Frame rate with many robots that drive, each with its description, transforms and scan.
//
//   npm run bench:fleet [ROBOTS [PICTURE.png]]
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { browser, open, periplus, port, servePage, sim, until } from '../e2e/lib.mjs';
import { count, measure } from './frames.mjs';

const robots = Number(process.argv[2] ?? 100);
const PORT = port(8870);
const folder = mkdtempSync(join(tmpdir(), 'periplus-fleet-'));
const drives = join(folder, 'drives.yaml');
const turns = Array.from(
  { length: robots },
  (_, i) =>
    `- {at: 0, until: 600, rate: 5, linear: 0.2, angular: ${(0.3 + 0.005 * (i % 60)).toFixed(3)}, ` +
    `topic: /cart_${i}/cmd_vel}`,
);
writeFileSync(drives, `${turns.join('\n')}\n`);
const words = sim('worlds/warehouse.sdf', 'benches/fleet_robot.urdf', '--pose=-10,-2.5,0');
const run = await periplus(
  [
    ...words,
    `--robots=${robots}`,
    '--dynamics=kinematic',
    `--cmd=${drives}`,
    '--no-browser',
    `--page=127.0.0.1:${PORT}`,
  ],
  PORT,
);
const pages = await servePage();
const chrome = await browser();
try {
  const { page, complaints } = await open(chrome, `${pages.url}?ws=ws://127.0.0.1:${PORT}/`);
  await until(page, `periplus.topics.length >= ${2 * robots}`, 'topics of all robots', 60_000);
  const shown = () => page.evaluate(() => window.periplus.displays.map((it) => it.name));
  await page.waitForTimeout(8000);
  console.log(`displays: ${(await shown()).length}`);
  await page.evaluate(count);
  await page.evaluate(() => window.periplus.setView({ distance: 45, pitch: 1.0 }));
  await measure(page, `${robots} robots`, []);
  if (process.argv[3]) await page.screenshot({ path: process.argv[3] });
  console.log(complaints.join('\n'));
} finally {
  await chrome.close();
  pages.stop();
  await run.stop();
  rmSync(folder, { recursive: true });
  process.exit();
}
