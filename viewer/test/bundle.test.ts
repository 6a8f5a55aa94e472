import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, test } from 'vitest';
import { fileNames } from '../bundle/chunks';
import { REPLACED, shortGlsl } from '../bundle/three';
import * as unused from '../bundle/three_unused.js';

const ROOT = join(__dirname, '..');
const THREE = join(ROOT, 'node_modules/three/src');
const read = (folder: string, ending: RegExp) =>
  (readdirSync(folder, { recursive: true }) as string[])
    .filter((name) => ending.test(name))
    .map((name) => readFileSync(join(folder, name), 'utf8'))
    .join('\n');

describe('three.js without its unused parts', () => {
  test('the page uses nothing that its build leaves out', () => {
    const page = read(join(ROOT, 'src'), /\.(ts|svelte)$/);
    const leftOut = [
      /\bMesh(?!Basic|Lambert|Depth|Distance)\w+Material\b/,
      /\b(Shadow|Physical)Material\b/,
      /\b(SkinnedMesh|BatchedMesh|CubeTexture|CubeCamera|PMREMGenerator|UniformsGroup|LightProbe\w*)\b/,
      /\b(Point|Spot|RectArea)Light\b/,
      /\b(alphaMap|aoMap|bumpMap|displacementMap|emissiveMap|envMap|lightMap|normalMap)\b/,
      /\b(alphaHash|dithering|morphAttributes|outputBufferType|\.xr)\b/,
      /\bscene\.environment\b/,
    ];
    expect(leftOut.flatMap((one) => one.exec(page)?.[0] ?? [])).toEqual([]);
  });

  test('every module that is replaced exists, with the name that replaces it', () => {
    for (const [path, name] of Object.entries(REPLACED)) {
      const code = readFileSync(join(THREE, path), 'utf8');
      expect(code, path).toMatch(
        new RegExp(`export (\\{[^}]*\\b${name}\\b|(function|class|const) ${name}\\b)`),
      );
      expect(Object.keys(unused)).toContain(name);
    }
  });

  test('the renderer asks the headset for nothing else than there is', () => {
    const renderer = read(join(THREE, 'renderers/webgl'), /\.js$/);
    const code = renderer + readFileSync(join(THREE, 'renderers/WebGLRenderer.js'), 'utf8');
    const asked = new Set([...code.matchAll(/\bxr\.(\w+)/g)].map(([, name]) => name!));
    // Only while a headset shows the scene.
    for (const name of ['cameraAutoUpdate', 'getCamera', 'getDepthSensingMesh', 'updateCamera'])
      asked.delete(name);
    // After `isPresenting === false ||`.
    asked.delete('hasDepthSensing');
    const manager = new unused.WebXRManager() as unknown as Record<string, unknown>;
    expect([...asked].filter((name) => manager[name!] === undefined)).toEqual([]);
  });

  test('shaders keep their lines of the preprocessor, and lose comments and space', () => {
    const long = `
      // A comment.
      #ifdef  USE_MAP
        vec4 color = texture2D( map, vUv ); /* sampled
        once */
      #endif
      if ( a < - 1.0 ) return b;
    `;
    expect(shortGlsl(long)).toBe(
      '#ifdef USE_MAP\nvec4 color=texture2D(map,vUv);\n#endif\nif(a<-1.0)return b;',
    );
  });

  test('two operators never become another one', () => {
    expect(shortGlsl('a = b - -c + +d; x = i ++ + j;')).toBe('a=b- -c+ +d;x=i ++ +j;');
  });
});

describe('files of the page', () => {
  const modules: Record<string, { now: string[]; later?: string[] }> = {
    '/src/main.ts': {
      now: ['/src/shared.ts'],
      later: ['/src/panels/APanel.svelte', '/src/dock.ts'],
    },
    '/src/shared.ts': { now: [], later: ['/src/panels/BPanel.svelte'] },
    '/src/dock.ts': { now: ['/src/both.ts'] },
    '/src/both.ts': { now: [] },
    '/src/panels/APanel.svelte': { now: ['/src/shared.ts', '/src/both.ts', '/src/own.ts'] },
    '/src/panels/BPanel.svelte': { now: ['/src/own.ts'] },
    '/src/own.ts': { now: [] },
  };
  const graph = {
    getModuleInfo: (id: string) => ({
      importedIds: modules[id]!.now,
      dynamicallyImportedIds: modules[id]!.later ?? [],
    }),
  };

  test('what panels alone need is one file; the rest is left to the bundler', () => {
    const name = fileNames('/src/main.ts');
    const inPanels = Object.keys(modules).filter((id) => name(id, graph) === 'panels');
    expect(inPanels).toEqual([
      '/src/panels/APanel.svelte',
      '/src/panels/BPanel.svelte',
      '/src/own.ts',
    ]);
  });
});
