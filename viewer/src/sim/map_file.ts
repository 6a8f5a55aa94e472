/** Files of maps as map_server writes them: the YAML file, and images in PGM, which browsers cannot read. */
import { load } from 'js-yaml';
import { t } from '../texts/language.svelte';

export interface MapFile {
  /** Name of the image, without folders. */
  image: string;
  /** Side of a cell [m]. */
  resolutionM: number;
  /** Pose of the lower left corner. */
  x: number;
  y: number;
  yawRad: number;
}

export function readMapYaml(text: string): MapFile {
  let tree: unknown;
  try {
    tree = load(text);
  } catch (error) {
    throw new Error(t().notices.notYaml((error as Error).message.split('\n')[0] ?? ''));
  }
  const { image, resolution, origin } = (tree ?? {}) as Record<string, unknown>;
  const at = Array.isArray(origin) ? origin.map(Number) : [];
  const [x = NaN, y = NaN, yawRad = 0] = at;
  const isMap = typeof image === 'string' && Number(resolution) > 0;
  if (!isMap || ![x, y, yawRad].every(Number.isFinite)) throw new Error(t().underlay.notMap);
  return { image: baseName(image), resolutionM: Number(resolution), x, y, yawRad };
}

export const baseName = (path: string) => path.split(/[\\/]/).pop() ?? path;

export interface GrayImage {
  widthPx: number;
  heightPx: number;
  /** Brightness, 0 to 255, row by row from the top. */
  pixels: Uint8Array<ArrayBuffer>;
}

/** Most pixels of an image: beyond this a browser has no memory for it. */
const MOST_PIXELS = 100_000_000;

/** Reads a PGM image, binary (P5) or as text (P2), of 8 or 16 bits. */
export function readPgm(bytes: Uint8Array): GrayImage {
  let at = 0;
  const isSpace = (byte: number | undefined) => byte === 32 || (byte! >= 9 && byte! <= 13);
  const word = (): string => {
    for (;;) {
      while (isSpace(bytes[at])) at++;
      if (bytes[at] !== 35) break;
      // A comment ends with its line.
      while (at < bytes.length && bytes[at] !== 10) at++;
    }
    const from = at;
    while (at < bytes.length && !isSpace(bytes[at])) at++;
    return String.fromCharCode(...bytes.subarray(from, Math.min(at, from + 20)));
  };
  const kind = word();
  if (kind !== 'P5' && kind !== 'P2') throw new Error(t().underlay.notPgm);
  const [widthPx, heightPx, most] = [Number(word()), Number(word()), Number(word())];
  const count = widthPx * heightPx;
  const isValid = Number.isInteger(count) && count > 0 && count <= MOST_PIXELS;
  if (!isValid || !(most >= 1 && most <= 65535)) throw new Error(t().underlay.notPgm);
  const pixels = new Uint8Array(count);
  const width = most > 255 ? 2 : 1;
  // One white space ends the header.
  at++;
  if (kind === 'P5' && bytes.length - at < count * width) throw new Error(t().underlay.shortPgm);
  for (let i = 0; i < count; i++) {
    const value =
      kind === 'P2'
        ? Number(word() || NaN)
        : width === 1
          ? bytes[at + i]!
          : bytes[at + 2 * i]! * 256 + bytes[at + 2 * i + 1]!;
    if (Number.isNaN(value)) throw new Error(t().underlay.shortPgm);
    pixels[i] = Math.round((Math.min(value, most) * 255) / most);
  }
  return { widthPx, heightPx, pixels };
}
