import { svelte } from '@sveltejs/vite-plugin-svelte';
import { defineConfig } from 'vitest/config';
import { fileURLToPath } from 'node:url';
import { fileNames } from './bundle/chunks.ts';
import { threeSubset } from './bundle/three.ts';

const MAIN = fileURLToPath(new URL('src/main.ts', import.meta.url));

// The page is built into the crate that serves it, so that a build of the program needs no Node.
export default defineConfig(({ command }) => ({
  plugins: [svelte(), ...(command === 'build' ? [threeSubset()] : [])],
  base: './',
  resolve: {
    alias: command === 'build' ? [{ find: /^three$/, replacement: 'three/src/Three.js' }] : [],
  },
  build: {
    outDir: '../crates/transports/web/page',
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
          groups: [{ name: fileNames(MAIN), includeDependenciesRecursively: false }],
        },
      },
    },
  },
  server: { proxy: { '/ws': { target: 'ws://localhost:8765', ws: true } } },
  test: { include: ['test/**/*.test.ts'], environment: 'node' },
}));
