/** RViz's palettes of maps: 256 RGBA colours, indexed by the byte of a cell. */

export const SCHEMES = ['map', 'costmap', 'raw'] as const;
export type Scheme = (typeof SCHEMES)[number];

/** Colour of unknown cells. */
const UNKNOWN = [0x70, 0x89, 0x86, 255];

/** `binaryFrom`: first value that gets the second colour, for palettes of two colours. */
export function palette(scheme: Scheme, binaryFrom?: number): Uint8Array {
  const out = new Uint8Array(256 * 4);
  for (let i = 0; i < 256; i++) {
    out.set(binaryFrom === undefined ? plain(scheme, i) : binary(scheme, i, binaryFrom), i * 4);
  }
  return out;
}

function plain(scheme: Scheme, i: number): number[] {
  if (scheme === 'raw') return [i, i, i, 255];
  if (i > 100) return wrong(i);
  if (scheme === 'map') {
    const v = 255 - Math.trunc((255 * i) / 100);
    return [v, v, v, 255];
  }
  if (i === 0) return [0, 0, 0, 0];
  if (i === 99) return [0, 255, 255, 255];
  if (i === 100) return [255, 0, 255, 255];
  const v = Math.trunc((255 * i) / 100);
  return [v, 0, 255 - v, 255];
}

/** Colours of values outside the valid range: green if positive, red to yellow if negative. */
function wrong(i: number): number[] {
  if (i === 255) return UNKNOWN;
  if (i < 128) return [0, 255, 0, 255];
  return [255, Math.trunc((255 * (i - 128)) / (254 - 128)), 0, 255];
}

function binary(scheme: Scheme, i: number, from: number): number[] {
  if (scheme === 'raw') return i < from ? [0, 0, 0, 255] : [255, 255, 255, 255];
  if (i > 100) return wrong(i);
  if (scheme === 'map') return i < from ? [255, 255, 255, 255] : [0, 0, 0, 255];
  return i < from ? [0, 0, 255, 255] : [255, 0, 0, 255];
}
