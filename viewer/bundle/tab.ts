/** The page without a server: its start, its policy, and the module that is copied into it. */
import { existsSync, statSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const MODULE = '../../target/wasm32-unknown-unknown/wasm/periplus_tab.wasm';

/** The WebAssembly module; `cargo xtask wasm` builds it. */
export const moduleFile =
  process.env.PERIPLUS_MODULE ?? fileURLToPath(new URL(MODULE, import.meta.url));

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
