/** The page without a server: its start, its policy, and the module that is copied into it. */
import { existsSync, readFileSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const MODULE = '../../target/wasm32-unknown-unknown/wasm/periplus_tab.wasm';

/** The WebAssembly module; `cargo xtask wasm` builds it. */
export const moduleFile =
  process.env.PERIPLUS_MODULE ?? fileURLToPath(new URL(MODULE, import.meta.url));

const ROOT = fileURLToPath(new URL('../..', import.meta.url));
/** Ready sessions, with the files of the repository that they need. */
const SESSIONS = join(ROOT, 'crates/apps/tab/sessions/sessions.json');

/** Files of the ready sessions by their paths in the page. */
function* sessionFiles(): Generator<[string, Buffer]> {
  const none = Buffer.from('{"sessions": []}\n');
  const list = existsSync(SESSIONS) ? readFileSync(SESSIONS) : none;
  yield ['files/sessions.json', list];
  const { sessions } = JSON.parse(list.toString()) as { sessions: { files: string[] }[] };
  for (const path of new Set(sessions.flatMap(({ files }) => files))) {
    yield [`files/${path}`, readFileSync(join(ROOT, path))];
  }
}

/** As the server of the page sends it; see crates/transports/web/src/server/page.rs. */
const POLICY = [
  "default-src 'self'",
  "connect-src 'self' blob: data:",
  "img-src 'self' data: blob:",
  "style-src 'self' 'unsafe-inline'",
  "font-src 'self' data:",
  "script-src 'self' 'wasm-unsafe-eval'",
  "worker-src 'self' blob:",
].join('; ');

export function tabPage(): Plugin {
  if (!existsSync(moduleFile)) {
    throw new Error(`${moduleFile} does not exist: build it with \`cargo xtask wasm --page\``);
  }
  return {
    name: 'periplus-tab',
    config: () => ({ define: { MODULE_BYTES: String(statSync(moduleFile).size) } }),
    generateBundle() {
      for (const [fileName, source] of sessionFiles()) {
        this.emitFile({ type: 'asset', fileName, source });
      }
    },
    transformIndexHtml: {
      order: 'pre',
      handler: (html) => ({
        html: html.replace('./src/main.ts', './src/tab/main.ts'),
        tags: [
          {
            tag: 'meta',
            attrs: { 'http-equiv': 'Content-Security-Policy', content: POLICY },
            injectTo: 'head-prepend',
          },
        ],
      }),
    },
  };
}
