// Memory of the page without a server: the module, and the heaps of the page and its worker, each minute.
//
//   node e2e/tab_memory.mjs [--minutes 30] [--speed 1]
//
// With a speed above 1 the simulated minutes are counted, where that many are wanted.
import { browser, open } from './lib.mjs';
import { serveFolder } from './static.mjs';
import { PAGE, realTimeFactor } from './tab.mjs';

const at = process.argv.indexOf('--minutes');
const minutes = at < 0 ? 30 : Number(process.argv[at + 1]);
const speedAt = process.argv.indexOf('--speed');
const speed = speedAt < 0 ? 1 : Number(process.argv[speedAt + 1]);
if (!(minutes > 0 && speed > 0)) {
  console.error('usage: node e2e/tab_memory.mjs [--minutes N] [--speed FACTOR]');
  process.exit(2);
}
const site = await serveFolder(PAGE);
const chrome = await browser();
const { page } = await open(chrome, `${site.url}?explore`, { bypassCSP: true });
await page.waitForFunction('window.periplusTab?.phase.kind === "running"', undefined, {
  timeout: 60_000,
});
await page.evaluate(async (speed) => {
  // The services are listed shortly after the run has begun.
  let now;
  while (!now?.time_step) {
    await new Promise((resolve) => setTimeout(resolve, 200));
    now = await window.periplus.call('/get_physics_properties', {}).catch(() => undefined);
  }
  await window.periplus.call('/set_physics_properties', {
    time_step: now.time_step,
    max_update_rate: speed / now.time_step,
    gravity: now.gravity,
    ode_config: now.ode_config,
  });
}, speed);
const devtools = await page.context().newCDPSession(page);
const MIB = 2 ** 20;
console.log(
  'minute  simulated [min]  module [MiB]  heap of the page [MiB]  real time  received [MB]',
);
let simulated = 0;
for (let minute = 0; (speed > 1 ? simulated : minute) <= minutes; minute++) {
  const factor = minute === 0 ? NaN : await realTimeFactor(page, 55);
  simulated = (await page.evaluate('window.periplus.clock.nowS')) / 60;
  if (minute > 3 * minutes) break;
  await devtools.send('HeapProfiler.collectGarbage');
  const { usedSize } = await devtools.send('Runtime.getHeapUsage');
  const [module, received] = await page.evaluate(() => [
    window.periplusTab.memoryBytes,
    window.periplus.client.bytesReceived,
  ]);
  const cells = [
    minute,
    simulated.toFixed(1),
    (module / MIB).toFixed(1),
    (usedSize / MIB).toFixed(1),
  ];
  console.log([...cells, factor.toFixed(3), (received / 1e6).toFixed(1)].join('  '));
  if (minute > 0) await page.waitForTimeout(5000);
}
await chrome.close();
site.stop();
