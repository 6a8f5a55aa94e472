/**
 * Parts of three.js' renderer that this page never reaches, as small as the renderer allows: no headset, no environment
 * maps, no morph targets, no uniform groups, no output passes, no point lights with shadows. `three.ts` puts them in
 * place of the modules of three.js, and the tests in the browser draw every display with them.
 */

/** Without a headset: never enabled. */
export class WebXRManager {
  enabled = false;
  isPresenting = false;
  addEventListener() {}
  removeEventListener() {}
  setAnimationLoop() {}
  getEnvironmentBlendMode() {}
  dispose() {}
}

/** A texture is used as it is; environment maps would be converted. */
export function WebGLEnvironments() {
  return { get: (texture) => texture ?? null, dispose() {} };
}

export function WebGLMorphtargets() {
  return { update() {} };
}

export function WebGLUniformsGroups() {
  return { update() {}, bind() {}, dispose() {} };
}

/** Made for output buffers of more than 8 bits only. */
export class WebGLOutput {}

/** Made for shadows of point lights only. */
export class WebGLCubeRenderTarget {}

/** Table of physically based materials, which look it up only if they are used. */
export const getDFGLUT = () => null;
