// Measures the replay of a large recording: from navigation to the first full picture, jumps to random times until all
// displays show these times, and memory of page and server.
//
//   npm run bench:replay FILE     PERIPLUS=path/to/periplus
import { spawn } from 'node:child_process';
import { readdirSync, readFileSync } from 'node:fs';
import { browser, port, PROGRAM, servePage } from '../e2e/lib.mjs';

const PORT = port(8861);
const JUMPS = 30;
const [file] = process.argv.slice(2);
if (!file) {
  console.error('usage: npm run bench:replay FILE');
  process.exit(2);
}

const statusOf = (pid) => {
  try {
    return readFileSync(`/proc/${pid}/status`, 'utf8');
  } catch {
    return '';
  }
};
const residentMb = (pid) => Number(/VmRSS:\s+(\d+)/.exec(statusOf(pid))?.[1] ?? 0) / 1024;
/** Renderer processes below a process. */
function renderers(root) {
  const all = readdirSync('/proc').filter((name) => /^\d+$/.test(name));
  const parents = new Map(all.map((pid) => [pid, /PPid:\s+(\d+)/.exec(statusOf(pid))?.[1]]));
  const isBelow = (pid) => {
    for (let at = pid; at; at = parents.get(at)) if (at === String(root)) return true;
    return false;
  };
  return all.filter((pid) => {
    try {
      const words = readFileSync(`/proc/${pid}/cmdline`, 'utf8');
      return isBelow(pid) && words.includes('--type=renderer');
    } catch {
      return false;
    }
  });
}
const quantile = (all, part) =>
  [...all].sort((a, b) => a - b)[Math.min(all.length - 1, Math.floor(part * all.length))];

const server = spawn(PROGRAM, ['view', file, '--no-browser', `--page=127.0.0.1:${PORT}`], {
  stdio: 'ignore',
});
const isOver = new Promise((resolve) => server.once('exit', resolve));
const url = `http://127.0.0.1:${PORT}/`;
while (
  !(await fetch(url).then(
    () => true,
    () => false,
  ))
) {
  if (server.exitCode !== null) throw new Error(`${PROGRAM} view ${file} ended`);
  await new Promise((resolve) => setTimeout(resolve, 10));
}
const pages = await servePage();
const chrome = await browser();
/** Every enabled display with a topic shows a message, and a frame with all of them was drawn. */
const isFull = () => {
  const app = window.periplus;
  const replay = app?.replay;
  if (!replay || replay.source.isJumping) return false;
  const topics = app.displays.filter((d) => d.isEnabled && d.values.Topic);
  return topics.length > 0 && topics.every((d) => d.statuses.Topic?.level === 'ok');
};
const address = `${pages.url}?ws=ws://127.0.0.1:${PORT}/`;
const opened = [];
let page;
for (let i = 0; i < 5; i++) {
  await page?.close();
  page = await chrome.newPage({ viewport: { width: 1280, height: 720 } });
  const from = performance.now();
  await page.goto(address, { waitUntil: 'commit' });
  await page.waitForFunction(isFull, undefined, { polling: 20, timeout: 60_000 });
  opened.push(performance.now() - from);
}
const jumps = await page.evaluate(async (count) => {
  const app = window.periplus;
  const { replay } = app;
  const frame = () => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve, 0)));
  // The same times in every run.
  let seed = 1;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  // Clouds and debug displays, too.
  for (const entry of app.displays) if (!entry.isEnabled) app.active.setEnabled(entry, true);
  const seen = new Map();
  const topics = [...new Set(app.displays.filter((d) => d.isEnabled).map((d) => d.values.Topic))];
  for (const topic of topics.filter(Boolean)) {
    app.feed.subscribe(topic, (_message, name, _bytes, timeS) => seen.set(name, timeS));
  }
  await new Promise((resolve) => setTimeout(resolve, 1000));
  const out = [];
  for (let i = 0; i < count; i++) {
    const timeS = replay.startS + random() * (replay.endS - replay.startS);
    seen.clear();
    const from = performance.now();
    await replay.show(timeS);
    const delivered = performance.now() - from;
    await frame();
    const drawn = performance.now() - from;
    const late = [...seen.values()].filter((one) => one > timeS + 1e-6).length;
    out.push({ delivered, drawn, topics: seen.size, late });
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
  return out;
}, JUMPS);
const pageMb = renderers(chrome.process?.()?.pid ?? process.pid).map(residentMb);
const serverMb = residentMb(server.pid);
const text = (all) =>
  `median ${quantile(all, 0.5).toFixed(0)} ms, worst ${Math.max(...all).toFixed(0)} ms`;
console.log(`open to the first full picture: ${text(opened)}`);
console.log(`jump until the messages are delivered: ${text(jumps.map((one) => one.delivered))}`);
console.log(`jump until all displays are drawn: ${text(jumps.map((one) => one.drawn))}`);
console.log(
  `topics shown after a jump: ${Math.min(...jumps.map((one) => one.topics))} to ` +
    `${Math.max(...jumps.map((one) => one.topics))}; messages newer than the time: ` +
    `${jumps.reduce((sum, one) => sum + one.late, 0)}`,
);
console.log(`memory: page ${Math.max(...pageMb).toFixed(0)} MB, server ${serverMb.toFixed(0)} MB`);
await chrome.close();
pages.stop();
server.kill('SIGINT');
await isOver;
