import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vitest/config';
import { fileURLToPath } from 'node:url';
import { moduleFile, tabPage } from './bundle/tab.ts';
import { fileNames } from './bundle/chunks.ts';
import { threeSubset } from './bundle/three.ts';

const path = (name: string) => fileURLToPath(new URL(name, import.meta.url));

// The page is built into the crate that serves it, so that a build of the program needs no Node. With `--mode tab` it
// is built without a server, with the simulator in a worker.
export default defineConfig(({ command, mode }) => ({
  plugins: [
    svelte(),
    ...(command === 'build' ? [threeSubset()] : []),
    ...(mode === 'tab' ? [tabPage()] : []),
  ],
  base: './',
  resolve: {
    alias: [
      ...(command === 'build' ? [{ find: /^three$/, replacement: 'three/src/Three.js' }] : []),
      { find: /^periplus-module/, replacement: moduleFile },
    ],
  },
  worker: { format: 'es' },
  build: {
    outDir: mode === 'tab' ? '../target/tab/page' : '../crates/transports/web/page',
    emptyOutDir: true,
    target: 'es2022',
    chunkSizeWarningLimit: 900,
    assetsInlineLimit: 4096,
    modulePreload: { polyfill: false },
    // What the page holds of others, with their terms.
    license: { fileName: 'licenses.md' },
    rolldownOptions: {
      output: {
        codeSplitting: {
          groups: [
            {
              name: fileNames(path(mode === 'tab' ? 'src/tab/main.ts' : 'src/main.ts')),
              includeDependenciesRecursively: false,
            },
          ],
        },
      },
    },
  },
  server: { proxy: { '/ws': { target: 'ws://localhost:8765', ws: true } } },
  test: { include: ['test/**/*.test.ts'], environment: 'node' },
}));
