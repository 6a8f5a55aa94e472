// Measures the time from the shell prompt to the first picture: `periplus demo` is started, and a tab is opened in
// a running browser. Medians of five runs.
//
//   npm run bench:first     PERIPLUS=path/to/periplus
import { spawn } from 'node:child_process';
import { browser, PROGRAM, port } from '../e2e/lib.mjs';

const PORT = port(8851);
const RUNS = 5;
const chrome = await browser();
const found = { 'the port answers': [], 'the page has come': [], 'the robot is drawn': [] };
for (let i = 0; i < RUNS; i++) {
  const page = await chrome.newPage({ viewport: { width: 1280, height: 720 } });
  const from = performance.now();
  const note = (what) => found[what].push(performance.now() - from);
  const words = ['demo', '--no-browser', `--page=127.0.0.1:${PORT}`];
  const program = spawn(PROGRAM, words, { stdio: 'ignore' });
  const isOver = new Promise((resolve) => program.once('exit', resolve));
  const url = `http://127.0.0.1:${PORT}/`;
  const answers = () =>
    fetch(url).then(
      () => true,
      () => false,
    );
  while (!(await answers())) await new Promise((resolve) => setTimeout(resolve, 10));
  note('the port answers');
  await page.goto(url, { waitUntil: 'commit' });
  await page.waitForFunction(() => window.periplus?.stage);
  note('the page has come');
  // Posed by its frames, and drawn.
  await page.waitForFunction(() => {
    const robot = window.periplus.displays.find((d) => d.kind.title === 'RobotModel');
    return robot?.display?.root.children.some((link) => link.visible);
  });
  await page.evaluate(
    () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))),
  );
  note('the robot is drawn');
  await page.close();
  program.kill('SIGINT');
  await isOver;
}
await chrome.close();
for (const [what, all] of Object.entries(found)) {
  const sorted = all.sort((a, b) => a - b);
  const [low, middle, high] = [sorted[0], sorted[RUNS >> 1], sorted.at(-1)].map((ms) =>
    (ms / 1000).toFixed(2),
  );
  console.log(`${what} after ${middle} s (${low} to ${high})`);
}
