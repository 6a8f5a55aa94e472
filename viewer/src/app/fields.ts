/** Messages as text, and the numeric fields in them by path. */
import { t } from '../texts/language.svelte';

const isNumbers = (value: unknown): value is ArrayLike<number | bigint> =>
  ArrayBuffer.isView(value) && !(value instanceof DataView);

/** Message as text in the style of `ros2 topic echo`, with long arrays cut. */
export function show(value: unknown, indent = '', most = 24): string {
  if (isNumbers(value)) {
    const all = Array.from({ length: Math.min(most, value.length) }, (_, i) => number(value[i]!));
    const rest = value.length > most ? `, … ${t().notices.inAll(value.length)}` : '';
    return `[${all.join(', ')}${rest}]`;
  }
  if (Array.isArray(value)) {
    if (value.length === 0) return '[]';
    if (typeof value[0] !== 'object') {
      const rest = value.length > most ? `, … ${t().notices.inAll(value.length)}` : '';
      return `[${value.slice(0, most).join(', ')}${rest}]`;
    }
    const items = value
      .slice(0, 8)
      .map((item) => `\n${indent}- ${show(item, `${indent}  `).trimStart()}`);
    return (
      items.join('') + (value.length > 8 ? `\n${indent}… ${t().notices.inAll(value.length)}` : '')
    );
  }
  if (typeof value === 'object' && value !== null) {
    return Object.entries(value)
      .map(([key, inner]) => {
        const isDeep = typeof inner === 'object' && inner !== null && !isNumbers(inner);
        const isList = Array.isArray(inner);
        const text = show(inner, `${indent}  `, most);
        return isDeep && !isList ? `\n${indent}${key}:${text}` : `\n${indent}${key}: ${text}`;
      })
      .join('')
      .replace(indent === '' ? /^\n/ : /^$/, '');
  }
  if (typeof value === 'number') return number(value);
  const text = String(value);
  return text.length > 2000 ? `${text.slice(0, 2000)}…` : text;
}

function number(value: number | bigint): string {
  return typeof value === 'bigint' || Number.isInteger(value)
    ? String(value)
    : value.toPrecision(6);
}

/** Paths of all numeric fields; of a list, those of the first few elements. */
export function numericPaths(value: unknown, prefix = ''): string[] {
  if (typeof value === 'number' || typeof value === 'boolean') return [prefix];
  if (isNumbers(value) || Array.isArray(value)) {
    const few = Math.min(value.length, 3);
    return Array.from({ length: few }, (_, i) => numericPaths(value[i], `${prefix}[${i}]`)).flat();
  }
  if (typeof value !== 'object' || value === null) return [];
  return Object.entries(value).flatMap(([key, inner]) =>
    numericPaths(inner, prefix ? `${prefix}.${key}` : key),
  );
}

/** Number at a path: "pose.position.x", "ranges[3]", and of a quaternion "orientation.yaw". */
export function numberAt(value: unknown, path: string): number {
  let at: unknown = value;
  for (const part of path.split(/[.[\]]+/).filter(Boolean)) {
    if (typeof at !== 'object' || at === null) return NaN;
    const record = at as Record<string, unknown>;
    if (part === 'yaw' && !('yaw' in record) && 'w' in record) {
      const { x, y, z, w } = record as Record<'x' | 'y' | 'z' | 'w', number>;
      return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    }
    at = record[part];
  }
  return typeof at === 'boolean' ? Number(at) : typeof at === 'number' ? at : NaN;
}

/** Units of numbers by the last name of their path; REP 103. */
const UNITS: [RegExp, string][] = [
  [/(^|\.)linear_acceleration\.[xyz]$|(^|\.)accel\.linear\.[xyz]$/, 'm/s²'],
  [/(^|\.)angular_velocity\.[xyz]$|(^|\.)angular\.[xyz]$/, 'rad/s'],
  [/(^|\.)linear\.[xyz]$|(^|\.)(linear_speed|speed)$/, 'm/s'],
  [/(^|\.)(position|translation|point|origin|points\[\d+\])\.[xyz]$/, 'm'],
  [/(^|\.)(ranges\[\d+\]|range|range_min|range_max|resolution|altitude)$/, 'm'],
  [/(^|\.)(yaw|roll|pitch|angle_min|angle_max|angle_increment|field_of_view)$/, 'rad'],
  [/(^|\.)(force)\.[xyz]$/, 'N'],
  [/(^|\.)(torque)\.[xyz]$/, 'N·m'],
  [/(^|\.)magnetic_field\.[xyz]$/, 'T'],
  [/(^|\.)(scan_time|time_increment|sec)$/, 's'],
  [/(^|\.)nanosec$/, 'ns'],
  [/(^|\.)(latitude|longitude)$/, '°'],
  [/(^|\.)fluid_pressure$/, 'Pa'],
  [/(^|\.)temperature$/, '°C'],
];

/** Unit of the number at a path; empty where the path does not define one. */
export function unitOf(path: string): string {
  return UNITS.find(([pattern]) => pattern.test(path))?.[1] ?? '';
}
