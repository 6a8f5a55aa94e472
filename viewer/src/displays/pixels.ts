/** Conversion of all raw encodings of sensor_msgs/Image to RGBA. */
import type { ImageMessage } from '../core/types';
import { t } from '../texts/language.svelte';

/** Values shown as black and as white. */
export interface Extent {
  min: number;
  max: number;
}

type Reader = (u: number, v: number) => number;
const rgb = (r: number, g: number, b: number) => (r << 16) | (g << 8) | b;
const CHANNELS: Record<string, [number, number, number, number]> = {
  // Bytes per pixel, and offsets of red, green and blue.
  rgb8: [3, 0, 1, 2],
  '8UC3': [3, 2, 1, 0],
  bgr8: [3, 2, 1, 0],
  rgba8: [4, 0, 1, 2],
  bgra8: [4, 2, 1, 0],
  '8UC4': [4, 2, 1, 0],
  mono8: [1, 0, 0, 0],
  '8UC1': [1, 0, 0, 0],
};
/** Position of red in the 2 x 2 Bayer pattern. */
const BAYER: Record<string, [number, number]> = {
  bayer_rggb8: [0, 0],
  bayer_bggr8: [1, 1],
  bayer_gbrg8: [0, 1],
  bayer_grbg8: [1, 0],
};

/** Encodings with one value per pixel, which needs a range to become grey. */
export function isDepth(encoding: string): boolean {
  return ['16UC1', 'mono16', '32FC1', '16SC1', '32SC1', '64FC1'].includes(encoding);
}

/** Reader that returns 0xrrggbb of a pixel. */
export function pixelReader(image: ImageMessage): Reader {
  const { data, step, encoding } = image;
  const known = CHANNELS[encoding];
  if (known) {
    const [size, r, g, b] = known;
    return (u, v) => {
      const at = v * step + u * size;
      return rgb(data[at + r] ?? 0, data[at + g] ?? 0, data[at + b] ?? 0);
    };
  }
  const bayer = BAYER[encoding];
  if (bayer) {
    const [ru, rv] = bayer;
    return (u, v) => {
      const [u0, v0] = [u & ~1, v & ~1];
      const at = (du: number, dv: number) => data[(v0 + dv) * step + u0 + du] ?? 0;
      const green = (at(1 - ru, rv) + at(ru, 1 - rv)) >> 1;
      return rgb(at(ru, rv), green, at(1 - ru, 1 - rv));
    };
  }
  if (
    encoding === 'yuv422' ||
    encoding === 'uyvy' ||
    encoding === 'yuv422_yuy2' ||
    encoding === 'yuyv'
  ) {
    const luma = encoding === 'yuv422' || encoding === 'uyvy' ? 1 : 0;
    return (u, v) => {
      const at = v * step + (u & ~1) * 2;
      const y = data[at + luma + (u & 1) * 2] ?? 0;
      const cb = (data[at + 1 - luma] ?? 128) - 128;
      const cr = (data[at + 3 - luma] ?? 128) - 128;
      const clamp = (n: number) => Math.max(0, Math.min(255, Math.round(n)));
      // ITU-R BT.601.
      return rgb(clamp(y + 1.402 * cr), clamp(y - 0.344 * cb - 0.714 * cr), clamp(y + 1.772 * cb));
    };
  }
  throw new Error(t().displays.imageEncoding(encoding));
}

type Numbers = ArrayLike<number>;

/** Values of a depth image in its own unit; a view of the message if it is aligned. */
function numbersOf(image: ImageMessage): { numbers: Numbers; perRow: number } {
  const { data, step, encoding, height, width } = image;
  const size =
    encoding.startsWith('16') || encoding === 'mono16' ? 2 : encoding === '64FC1' ? 8 : 4;
  const usable = Math.min(data.length, step * height);
  if (!image.is_bigendian && step % size === 0) {
    const bytes = data.byteOffset % size === 0 ? data : data.slice();
    const [at, count] = [bytes.byteOffset, Math.floor(usable / size)];
    const { buffer } = bytes;
    const perRow = step / size;
    if (encoding === '32FC1') return { numbers: new Float32Array(buffer, at, count), perRow };
    if (encoding === '64FC1') return { numbers: new Float64Array(buffer, at, count), perRow };
    if (encoding === '16SC1') return { numbers: new Int16Array(buffer, at, count), perRow };
    if (encoding === '32SC1') return { numbers: new Int32Array(buffer, at, count), perRow };
    return { numbers: new Uint16Array(buffer, at, count), perRow };
  }
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const little = !image.is_bigendian;
  const read = (at: number): number => {
    if (at + size > data.length) return NaN;
    if (encoding === '32FC1') return view.getFloat32(at, little);
    if (encoding === '64FC1') return view.getFloat64(at, little);
    if (encoding === '16SC1') return view.getInt16(at, little);
    if (encoding === '32SC1') return view.getInt32(at, little);
    return view.getUint16(at, little);
  };
  const numbers = new Float64Array(width * height);
  for (let i = 0; i < numbers.length; i++) {
    numbers[i] = read(Math.floor(i / width) * step + (i % width) * size);
  }
  return { numbers, perRow: width };
}

/** Minimum and maximum of a depth image; infinite and NaN values are ignored. */
export function extentOf(image: ImageMessage): Extent {
  const { numbers, perRow } = numbersOf(image);
  let [min, max] = [Infinity, -Infinity];
  for (let v = 0; v < image.height; v++) {
    for (let at = v * perRow, end = at + image.width; at < end; at++) {
      const n = numbers[at]!;
      if (n < min && n > -Infinity) min = n;
      if (n > max && n < Infinity) max = n;
    }
  }
  return { min, max };
}

/** Fills RGBA pixels. Depth is grey within `extent`. */
export function toPixels(image: ImageMessage, out: Uint8ClampedArray, extent: Extent): void {
  const { width, height, encoding, data, step } = image;
  const words = new Uint32Array(out.buffer, out.byteOffset, width * height);
  const known = CHANNELS[encoding];
  let to = 0;
  if (known && data.length >= step * (height - 1) + width * known[0]) {
    const [size, r, g, b] = known;
    for (let v = 0; v < height; v++) {
      for (let u = 0, at = v * step; u < width; u++, at += size) {
        words[to++] = 0xff000000 | (data[at + b]! << 16) | (data[at + g]! << 8) | data[at + r]!;
      }
    }
    return;
  }
  if (!isDepth(encoding)) {
    const read = pixelReader(image);
    for (let v = 0; v < height; v++) {
      for (let u = 0; u < width; u++) {
        const c = read(u, v);
        words[to++] = 0xff000000 | ((c & 0xff) << 16) | (c & 0xff00) | (c >> 16);
      }
    }
    return;
  }
  const { numbers, perRow } = numbersOf(image);
  const { min, max } = extent;
  const scale = max > min ? 255 / (max - min) : 0;
  for (let v = 0; v < height; v++) {
    for (let at = v * perRow, end = at + width; at < end; at++) {
      const grey = (numbers[at]! - min) * scale;
      // NaN is black.
      const byte = grey > 255 ? 255 : grey > 0 ? grey | 0 : 0;
      words[to++] = 0xff000000 | (byte << 16) | (byte << 8) | byte;
    }
  }
}
