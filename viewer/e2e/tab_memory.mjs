// Memory of the page without a server: the module, and the heaps of the page and its worker, each minute.
//
//   node e2e/tab_memory.mjs [--minutes 30]
import { browser, open } from './lib.mjs';
import { serveFolder } from './static.mjs';
import { PAGE, realTimeFactor } from './tab.mjs';

const at = process.argv.indexOf('--minutes');
const minutes = at < 0 ? 30 : Number(process.argv[at + 1]);
if (!(minutes > 0)) {
  console.error('usage: node e2e/tab_memory.mjs [--minutes N]');
  process.exit(2);
}
const site = await serveFolder(PAGE);
const chrome = await browser();
const { page } = await open(chrome, `${site.url}?explore`, { bypassCSP: true });
await page.waitForFunction('window.periplusTab?.phase.kind === "running"', undefined, {
  timeout: 60_000,
});
const devtools = await page.context().newCDPSession(page);
const MIB = 2 ** 20;
console.log('minute  module [MiB]  heap of the page [MiB]  real time  received [MB]');
for (let minute = 0; minute <= minutes; minute++) {
  const factor = minute === 0 ? NaN : await realTimeFactor(page, 55);
  await devtools.send('HeapProfiler.collectGarbage');
  const { usedSize } = await devtools.send('Runtime.getHeapUsage');
  const [module, received] = await page.evaluate(() => [
    window.periplusTab.memoryBytes,
    window.periplus.client.bytesReceived,
  ]);
  const cells = [minute, (module / MIB).toFixed(1), (usedSize / MIB).toFixed(1)];
  console.log([...cells, factor.toFixed(3), (received / 1e6).toFixed(1)].join('  '));
  if (minute > 0) await page.waitForTimeout(5000);
}
await chrome.close();
site.stop();
