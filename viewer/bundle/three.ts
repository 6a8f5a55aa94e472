/**
 * three.js from its sources, without the parts that the page never uses. A bundler cannot find them: the renderer
 * refers to all shaders and all extensions, and decides at run time.
 */
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const UNUSED = fileURLToPath(new URL('three_unused.js', import.meta.url));

/** Modules of three.js below `src`, and what `three_unused.js` has in their place. */
export const REPLACED: Record<string, string> = {
  'renderers/webxr/WebXRManager.js': 'WebXRManager',
  'renderers/webgl/WebGLEnvironments.js': 'WebGLEnvironments',
  'renderers/webgl/WebGLMorphtargets.js': 'WebGLMorphtargets',
  'renderers/webgl/WebGLUniformsGroups.js': 'WebGLUniformsGroups',
  'renderers/webgl/WebGLOutput.js': 'WebGLOutput',
  'renderers/WebGLCubeRenderTarget.js': 'WebGLCubeRenderTarget',
  'renderers/shaders/DFGLUTData.js': 'getDFGLUT',
};

/** Programs of the materials that the page has, and of shadows; all others are left out. */
const PROGRAMS = ['depth', 'linedashed', 'meshbasic', 'meshlambert', 'points', 'sprite'];

/** Parts of programs that are compiled only for other materials, or for features that no material here has. */
const CHUNKS =
  /^(alphahash|aomap|batching|bsdfs|bumpmap|clearcoat|displacementmap|dithering|emissivemap|envmap|gradientmap|iridescence|lightmap|lightprobes|lights_phong|lights_physical|lights_toon|metalnessmap|morph|normalmap|roughnessmap|skin|transmission)/;
/** Used although its name begins like one of those. */
const KEPT = ['specularmap_fragment'];

/** GLSL without comments and without space that has no meaning. */
export function shortGlsl(text: string): string {
  return text
    .replace(/\/\*[\s\S]*?\*\//g, '')
    .split('\n')
    .map((line) => line.replace(/\/\/.*/, '').trim())
    .filter(Boolean)
    .map((line) =>
      line.startsWith('#')
        ? line.replace(/\s+/g, ' ')
        : line
            .replace(/\s+/g, ' ')
            .replace(/ ?([*/%=<>!&|?:,;(){}[\]]) ?/g, '$1')
            // `a - -b` and `a++ + b` keep the space between their operators.
            .replace(/(?<![-+]) ?([-+]) ?(?![-+])/g, '$1'),
    )
    .join('\n');
}

function withShortGlsl(code: string): string {
  return code.replace(/(\/\* glsl \*\/\s*)`([^`]*)`/g, (_all, _mark, text: string) => {
    return '`' + shortGlsl(text) + '`';
  });
}

/** Plugin of vite, for builds. */
export function threeSubset(): Plugin {
  return {
    name: 'three-subset',
    enforce: 'pre',
    load(id) {
      const path = /\/three\/src\/(.*\.js)$/.exec(id)?.[1];
      if (path === undefined) return undefined;
      const name = REPLACED[path];
      if (name) return `export { ${name} } from ${JSON.stringify(UNUSED)};`;
      const program = /shaders\/ShaderLib\/(\w+)\.glsl\.js$/.exec(path)?.[1];
      if (program && !PROGRAMS.includes(program) && program !== 'vsm')
        return `export const vertex = '', fragment = '';`;
      const chunk = /shaders\/ShaderChunk\/(\w+)\.glsl\.js$/.exec(path)?.[1];
      if (chunk && CHUNKS.test(chunk) && !KEPT.includes(chunk)) return `export default '';`;
      return undefined;
    },
    transform(code, id) {
      if (!/\/three\/(src|examples)\//.test(id) || !code.includes('/* glsl */')) return undefined;
      return { code: withShortGlsl(code), map: null };
    },
  };
}
