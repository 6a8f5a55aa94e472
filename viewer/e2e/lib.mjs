// Library of the tests and screenshots: a running Periplus, and a browser with the page.
import { spawn } from 'node:child_process';
import { existsSync, readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliDecompressSync } from 'node:zlib';
import { chromium } from 'playwright-core';

export const ROOT = fileURLToPath(new URL('../..', import.meta.url));
const PAGE = join(ROOT, 'crates/transports/web/page');
export const PROGRAM = process.env.PERIPLUS ?? join(ROOT, 'target/release/periplus');
const BROWSER = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Port of a test; `PERIPLUS_PORT_OFFSET` moves all of them, for two runs on one machine. */
export const port = (number) => number + Number(process.env.PERIPLUS_PORT_OFFSET ?? 0);

/** Arguments that run a world with a robot in real time, invisible to other programs. */
export const sim = (world, robot, ...more) => [
  'sim',
  world,
  '--robot',
  robot,
  ...more,
  '--rtf',
  '1',
  '--ros2',
  'off',
];

/** Runs the program; resolves once its port responds. */
export async function periplus(args, port, environment = {}, cwd = ROOT) {
  if (!existsSync(PROGRAM))
    throw new Error(`${PROGRAM} does not exist: build it, or set PERIPLUS=...`);
  const child = spawn(PROGRAM, args, {
    cwd,
    stdio: ['ignore', 'pipe', 'pipe'],
    env: { ...process.env, ...environment },
  });
  let said = '';
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => (said += data));
  const isOver = new Promise((resolve) => child.once('exit', resolve));
  for (let i = 0; i < 300; i++) {
    const answers = await fetch(`http://127.0.0.1:${port}/`).then(
      () => true,
      () => false,
    );
    if (answers) break;
    if (child.exitCode !== null) throw new Error(`periplus ${args.join(' ')} ended:\n${said}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  return {
    said: () => said,
    stop: async () => {
      child.kill('SIGINT');
      const late = setTimeout(() => child.kill('SIGKILL'), 5000);
      await isOver;
      clearTimeout(late);
    },
  };
}

const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
};

/** Serves the latest build of the page, for a program that was built with an older one. */
export async function servePage() {
  const server = createServer((request, response) => {
    const path = new URL(request.url, 'http://x').pathname;
    const name = path === '/' ? '/index.html' : path;
    const file = join(PAGE, `${name}.br`);
    if (name.includes('..') || !existsSync(file)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { 'content-type': TYPES[extname(name)] ?? 'text/plain' });
    response.end(brotliDecompressSync(readFileSync(file)));
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${server.address().port}/`, stop: () => server.close() };
}

/** Debian's Chromium without a window, with its software renderer. */
export async function browser() {
  return chromium.launch({
    executablePath: BROWSER,
    args: [
      '--no-sandbox',
      '--use-gl=angle',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      '--hide-scrollbars',
    ],
  });
}

/** Opens the page and waits until it is connected; errors of the page fail the test. */
export async function open(chrome, url, options = {}) {
  const page = await chrome.newPage({
    viewport: { width: 1280, height: 720 },
    colorScheme: 'dark',
    ...options,
  });
  const complaints = [];
  page.on('pageerror', (error) => complaints.push(String(error.stack ?? error)));
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(message.text());
  });
  await page.goto(url);
  return { page, complaints };
}

/** Waits until an expression in the page is true. */
export const until = (page, expression, what, timeout = 30_000) =>
  page.waitForFunction(expression, undefined, { timeout }).catch(async () => {
    const now = await page.evaluate(() => ({
      displays: window.periplus.displays.map((d) => [
        d.name,
        ...Object.values(d.statuses).map((s) => s.text),
      ]),
      notices: window.periplus.notices.map((n) => n.text),
      frames: window.periplus.frames,
    }));
    throw new Error(`${what} did not happen; the state of the page is ${JSON.stringify(now)}`);
  });

/** Numbers of a message of a topic, received by the page. */
export const next = (page, topic, pick) =>
  page.evaluate(
    ([name, text]) =>
      new Promise((resolve, reject) => {
        setTimeout(() => reject(new Error(`no message received on ${name}`)), 8000);
        const leave = window.periplus.client.subscribe(name, (message) => {
          leave();
          resolve(new Function('message', `return ${text}`)(message));
        });
      }),
    [topic, pick],
  );
