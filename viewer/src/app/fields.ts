/** Messages as text, and the numeric fields in them by path. */
import { t } from '../texts/language.svelte';
import { definitionOf, type Definition, type Schema } from '../core/schema';

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

/** Most paths that a type offers, and most levels of nested types in a path. */
const MAX_PATHS = 400;
const MAX_DEPTH = 8;
const ANGLES = ['yaw', 'pitch', 'roll'];

/** Paths of the numeric fields of a type; of arrays the first element stands for all. */
export function numericPathsOf(schema: Schema): string[] {
  const out: string[] = [];
  const visit = (definition: Definition, prefix: string, depth: number): void => {
    for (const field of definition.fields) {
      if (out.length >= MAX_PATHS) return;
      const path = `${prefix}${field.name}${field.array === undefined ? '' : '[0]'}`;
      if (!field.isComplex) {
        if (!field.type.endsWith('string')) out.push(path);
      } else if (/^builtin_interfaces\/(Time|Duration)$/.test(field.type)) out.push(path);
      else if (depth < MAX_DEPTH) {
        visit(definitionOf(schema, field.type), `${path}.`, depth + 1);
        if (field.type === 'geometry_msgs/Quaternion') {
          out.push(...ANGLES.map((angle) => `${path}.${angle}`));
        }
      }
    }
  };
  visit(schema.root, '', 0);
  return out;
}

/** Paths of the fields of a type that have states: truth values, whole numbers and texts. */
export function statePathsOf(schema: Schema): string[] {
  const out: string[] = [];
  const visit = (definition: Definition, prefix: string, depth: number): void => {
    for (const field of definition.fields) {
      if (out.length >= MAX_PATHS) return;
      const path = `${prefix}${field.name}${field.array === undefined ? '' : '[0]'}`;
      const isTime = /^builtin_interfaces\//.test(field.type);
      if (!field.isComplex) {
        if (!/^float/.test(field.type)) out.push(path);
      } else if (depth < MAX_DEPTH && !isTime) {
        visit(definitionOf(schema, field.type), `${path}.`, depth + 1);
      }
    }
  };
  visit(schema.root, '', 0);
  return out;
}

/** Parts of a path: "ranges[3].x" is `ranges`, `3`, `x`. */
const partsOf = (path: string): string[] => path.split(/[.[\]]+/).filter(Boolean);

/** Value at a path: "pose.position", "ranges[3]", and of a quaternion "orientation.yaw"; `undefined` if absent. */
export function fieldAt(value: unknown, path: string): unknown {
  let at: unknown = value;
  for (const part of partsOf(path)) {
    if (typeof at !== 'object' || at === null) return undefined;
    const record = at as Record<string, unknown>;
    if (ANGLES.includes(part) && !(part in record) && 'w' in record) {
      at = angleOf(part, record as never);
    } else at = Object.hasOwn(record, part) ? record[part] : undefined;
  }
  return at;
}

/** Roll, pitch or yaw of a quaternion [rad]: fixed axes x, y, z. */
function angleOf(name: string, { x, y, z, w }: Record<'x' | 'y' | 'z' | 'w', number>): number {
  switch (name) {
    case 'yaw':
      return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
    case 'pitch':
      return Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x))));
    default:
      return Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  }
}

/** Number at a path; a truth value is 0 or 1, a time is in seconds. NaN if there is no number. */
export function numberAt(value: unknown, path: string): number {
  const at = fieldAt(value, path);
  switch (typeof at) {
    case 'number':
      return at;
    case 'boolean':
    case 'bigint':
      return Number(at);
    default:
      return isTime(at) ? at.sec + at.nanosec * 1e-9 : NaN;
  }
}

export function isTime(value: unknown): value is { sec: number; nanosec: number } {
  return typeof value === 'object' && value !== null && 'sec' in value && 'nanosec' in value;
}

/** Units of numbers by the last name of their path; REP 103. */
const UNITS: [RegExp, string][] = [
  [/(^|\.)linear_acceleration\.[xyz]$|(^|\.)accel\.linear\.[xyz]$/, 'm/s²'],
  [/(^|\.)angular_velocity\.[xyz]$|(^|\.)angular\.[xyz]$/, 'rad/s'],
  [/(^|\.)linear\.[xyz]$|(^|\.)(linear_speed|speed)$/, 'm/s'],
  [/(^|\.)(position|translation|point|origin|points\[\d+\])\.[xyz]$/, 'm'],
  [/(^|\.)(ranges\[\d+\]|range|range_min|range_max|resolution|altitude)$/, 'm'],
  [/(^|\.)(yaw|roll|pitch|angle_min|angle_max|angle_increment|field_of_view)$/, 'rad'],
  [/(^|\.)twist\.covariance\[\d+\]$/, ''],
  [/(^|\.)(force)\.[xyz]$/, 'N'],
  [/(^|\.)(torque)\.[xyz]$/, 'N·m'],
  [/(^|\.)magnetic_field\.[xyz]$/, 'T'],
  [
    /(^|\.)(scan_time|time_increment|sec|stamp|lifetime|navigation_time|real_time|sim_time|clock)$/,
    's',
  ],
  [/(^|\.)estimated_time_remaining$/, 's'],
  [/(^|\.)(distance_remaining|distance_to_goal|min_range|max_range|distance_traveled)$/, 'm'],
  [/(^|\.)nanosec$/, 'ns'],
  [/(^|\.)(latitude|longitude)$/, '°'],
  [/(^|\.)fluid_pressure$/, 'Pa'],
  [/(^|\.)temperature$/, '°C'],
  [/(^|\.)illuminance$/, 'lx'],
  [/(^|\.)(voltage|cell_voltage\[\d+\])$/, 'V'],
  [/(^|\.)current$/, 'A'],
  [/(^|\.)(charge|capacity|design_capacity)$/, 'Ah'],
];

/** Unit of the number at a path; empty where the path does not define one. */
export function unitOf(path: string): string {
  return UNITS.find(([pattern]) => pattern.test(path))?.[1] ?? '';
}
