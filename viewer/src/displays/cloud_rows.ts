/** Conversion of messages to rows of points. */
import type { LaserScan, PointCloud2, PointField } from '../core/types';
import type { Rows } from '../scene/cloud';
import { t } from '../texts/language.svelte';

const SIZES = [0, 1, 1, 2, 2, 4, 4, 4, 8];
const FLOAT32 = 7;

/** One row of x, y, z, intensity for each beam with a return, by REP 117. */
export function rowsOfScan(scan: LaserScan): Rows {
  const { ranges, intensities } = scan;
  const out = new Float32Array(ranges.length * 4);
  let count = 0;
  for (let i = 0; i < ranges.length; i++) {
    const range = ranges[i]!;
    if (!(range >= scan.range_min && range <= scan.range_max)) continue;
    const angle = scan.angle_min + i * scan.angle_increment;
    const at = count++ * 4;
    out[at] = range * Math.cos(angle);
    out[at + 1] = range * Math.sin(angle);
    out[at + 3] = intensities[i] ?? 0;
  }
  return { words: new Uint32Array(out.buffer), stride: 4, count, xyz: 0, value: 3, isOwn: true };
}

/**
 * The cloud's own bytes if its fields are aligned 32-bit words, as in most clouds; otherwise a converted copy.
 * `channel` names the field that sets the colour; `isFloats` reads colours from the fields r, g and b.
 */
export function rowsOfCloud(cloud: PointCloud2, channel: string, isFloats = false): Rows {
  const field = (name: string) => cloud.fields.find((f) => f.name === name);
  const [x, y, z] = [field('x'), field('y'), field('z')];
  if (!x || !y || !z) throw new Error(t().displays.noXyz);
  const step = cloud.point_step;
  const tight = cloud.height <= 1 || cloud.row_step === cloud.width * step;
  const count = Math.min(
    cloud.width * cloud.height,
    step > 0 ? Math.floor(cloud.data.length / step) : 0,
  );
  const value = field(channel);
  const rgb = field('rgb') ?? field('rgba');
  const floats = isFloats ? ['r', 'g', 'b'].flatMap((name) => field(name) ?? []) : [];
  if (floats.length === 3) return converted(cloud, [x, y, z], value, rgb, floats);
  const isWord = (f: PointField) => f.datatype === FLOAT32 && f.offset % 4 === 0;
  const fits =
    tight &&
    !cloud.is_bigendian &&
    step % 4 === 0 &&
    isWord(x) &&
    y.offset === x.offset + 4 &&
    z.offset === x.offset + 8 &&
    (!value || isWord(value)) &&
    (!rgb || rgb.offset % 4 === 0);
  if (!fits) return converted(cloud, [x, y, z], value, rgb);
  const bytes = cloud.data.byteOffset % 4 === 0 ? cloud.data : cloud.data.slice();
  return {
    words: new Uint32Array(bytes.buffer, bytes.byteOffset, (count * step) / 4),
    stride: step / 4,
    count,
    xyz: x.offset / 4,
    value: value && value.offset / 4,
    rgb: rgb && rgb.offset / 4,
    isOwn: bytes !== cloud.data,
  };
}

function converted(
  cloud: PointCloud2,
  xyz: [PointField, PointField, PointField],
  value?: PointField,
  rgb?: PointField,
  floats?: PointField[],
): Rows {
  const { data, point_step: step, width, height } = cloud;
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const little = !cloud.is_bigendian;
  const out = new Float32Array(width * height * 5);
  const words = new Uint32Array(out.buffer);
  let count = 0;
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      const at = row * cloud.row_step + column * step;
      if (at + step > data.length) break;
      const to = count++ * 5;
      xyz.forEach((field, i) => (out[to + i] = read(view, at, field, little)));
      if (value) out[to + 3] = read(view, at, value, little);
      if (floats) words[to + 4] = packed(floats.map((f) => read(view, at, f, little)));
      else if (rgb) words[to + 4] = view.getUint32(at + rgb.offset, little);
    }
  }
  const isColored = !!(rgb ?? floats);
  return {
    words,
    stride: 5,
    count,
    xyz: 0,
    value: value && 3,
    rgb: isColored ? 4 : undefined,
    isOwn: true,
  };
}

/** Colours from 0 to 1 packed as 0x00rrggbb. */
function packed(parts: number[]): number {
  const [r, g, b] = parts.map((v) => Math.max(0, Math.min(255, Math.round(v * 255))));
  return (r! << 16) | (g! << 8) | b!;
}

function read(view: DataView, at: number, field: PointField, isLittle: boolean): number {
  const to = at + field.offset;
  if (to + (SIZES[field.datatype] ?? 8) > view.byteLength) return NaN;
  switch (field.datatype) {
    case 1:
      return view.getInt8(to);
    case 2:
      return view.getUint8(to);
    case 3:
      return view.getInt16(to, isLittle);
    case 4:
      return view.getUint16(to, isLittle);
    case 5:
      return view.getInt32(to, isLittle);
    case 6:
      return view.getUint32(to, isLittle);
    case 7:
      return view.getFloat32(to, isLittle);
    case 8:
      return view.getFloat64(to, isLittle);
    default:
      return NaN;
  }
}
