/** Depth images as points (REP 118: metres as floats, or millimetres as 16-bit integers). */
import type { CameraInfo, ImageMessage } from '../core/types';
import type { Rows } from '../scene/cloud';
import { pixelReader } from './pixels';
import { t } from '../texts/language.svelte';

export function depthRows(depth: ImageMessage, info: CameraInfo, color?: ImageMessage): Rows {
  const { width, height } = depth;
  const is16 = depth.encoding === '16UC1' || depth.encoding === 'mono16';
  if (!is16 && depth.encoding !== '32FC1') {
    throw new Error(t().displays.depthEncoding(depth.encoding));
  }
  const [fx, cx, fy, cy] = [info.k[0]!, info.k[2]!, info.k[4]!, info.k[5]!];
  if (!(fx > 0 && fy > 0)) throw new Error(t().displays.noFocalLength);
  const view = new DataView(depth.data.buffer, depth.data.byteOffset, depth.data.byteLength);
  const little = !depth.is_bigendian;
  const colorAt = color && color.width > 0 ? pixelReader(color) : undefined;
  const out = new Float32Array(width * height * 5);
  const words = new Uint32Array(out.buffer);
  let count = 0;
  for (let v = 0; v < height; v++) {
    for (let u = 0; u < width; u++) {
      const at = v * depth.step + u * (is16 ? 2 : 4);
      if (at + (is16 ? 2 : 4) > depth.data.length) break;
      const z = is16 ? view.getUint16(at, little) / 1000 : view.getFloat32(at, little);
      if (!(z > 0 && z < Infinity)) continue;
      const to = count++ * 5;
      out[to] = ((u - cx) * z) / fx;
      out[to + 1] = ((v - cy) * z) / fy;
      out[to + 2] = z;
      out[to + 3] = z;
      words[to + 4] = colorAt
        ? colorAt(
            Math.min(color!.width - 1, Math.floor((u * color!.width) / width)),
            Math.min(color!.height - 1, Math.floor((v * color!.height) / height)),
          )
        : 0xc8d0da;
    }
  }
  return { words, stride: 5, count, xyz: 0, value: 3, rgb: 4, isOwn: true };
}
