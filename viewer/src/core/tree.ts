/** A message as the visible rows of a tree, compared with another message of its type. */
import { constantOf } from './constants';
import { definitionOf, type Definition, type Field, type Schema } from './schema';

export type Change = 'same' | 'changed' | 'added' | 'removed';

export interface Row {
  /** Path from the message: "status_list[0].status". */
  path: string;
  name: string;
  depth: number;
  type: string;
  kind: 'value' | 'object' | 'array' | 'page';
  /** Value in words; empty for objects. */
  text: string;
  /** Name of the value by the constants of its type. */
  constant: string;
  /** Elements of an array. */
  count: number;
  isOpen: boolean;
  isNumber: boolean;
  /** Computed from other fields, such as a yaw. */
  isDerived: boolean;
  change: Change;
  value: unknown;
}

/** Elements of an array that are shown at once. */
export const PAGE = 50;

export interface TreeState {
  isOpen(path: string, depth: number): boolean;
  /** First shown element of an array. */
  first(path: string): number;
}

type List = ArrayLike<unknown>;
const isList = (value: unknown): value is List =>
  Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** True if two values are equal, to the bit: NaN equals NaN. */
export function isEqual(a: unknown, b: unknown): boolean {
  if (Object.is(a, b) || a === b) return true;
  if (isList(a) && isList(b)) {
    if (a.length !== b.length) return false;
    for (let i = 0; i < a.length; i++) if (!isEqual(a[i], b[i])) return false;
    return true;
  }
  if (isList(a) || isList(b)) return false;
  if (typeof a !== 'object' || typeof b !== 'object' || a === null || b === null) return false;
  const keys = Object.keys(a);
  if (keys.length !== Object.keys(b).length) return false;
  return keys.every((key) => isEqual(a[key as never], b[key as never]));
}

/** Missing counterpart in the other message: there is nothing to compare with, or nothing was there. */
const NOTHING = Symbol('nothing');
type Other = unknown | typeof NOTHING;

const ANGLES = ['roll', 'pitch', 'yaw'] as const;

export function treeRows(
  schema: Schema,
  message: Record<string, unknown>,
  other: Record<string, unknown> | undefined,
  state: TreeState,
): Row[] {
  const out: Row[] = [];
  const walker = new Walker(schema, state, other !== undefined, out);
  walker.fields(schema.root, message, other ?? NOTHING, '', 0);
  return out;
}

class Walker {
  constructor(
    private schema: Schema,
    private state: TreeState,
    private isCompared: boolean,
    private out: Row[],
  ) {}

  fields(
    definition: Definition,
    value: Record<string, unknown>,
    other: Other,
    prefix: string,
    depth: number,
  ): void {
    for (const field of definition.fields) {
      const path = prefix ? `${prefix}.${field.name}` : field.name;
      const before =
        typeof other === 'object' && other !== null
          ? (other as Record<string, unknown>)[field.name]
          : NOTHING;
      const constant = constantOf(definition, field.name, value[field.name]) ?? '';
      this.field(field, field.name, value[field.name], before, path, depth, constant);
    }
    if (definition.name === 'geometry_msgs/Quaternion') {
      this.angles(value as never, other, prefix, depth);
    }
  }

  private field(
    field: Field,
    name: string,
    value: unknown,
    other: Other,
    path: string,
    depth: number,
    constant: string,
  ): void {
    if (field.array !== undefined && isList(value)) {
      this.array(field, name, value, other, path, depth);
      return;
    }
    this.one(field, name, value, other, path, depth, constant);
  }

  private one(
    field: Field,
    name: string,
    value: unknown,
    other: Other,
    path: string,
    depth: number,
    constant: string,
  ): void {
    const row = { path, name, depth, type: field.type, constant, value, isDerived: false };
    const change = this.changeOf(value, other);
    const isTime = /^builtin_interfaces\/(Time|Duration)$/.test(field.type);
    if (!field.isComplex || isTime) {
      this.out.push({
        ...row,
        kind: 'value',
        text: isTime ? timeText(value as never) : valueText(value),
        count: 0,
        isOpen: false,
        isNumber: isTime || !field.type.endsWith('string'),
        change,
      });
      return;
    }
    const isOpen = this.state.isOpen(path, depth);
    this.out.push({
      ...row,
      kind: 'object',
      text: '',
      count: 0,
      isOpen,
      isNumber: false,
      change,
    });
    if (!isOpen) return;
    const definition = definitionOf(this.schema, field.type);
    this.fields(definition, value as Record<string, unknown>, other, path, depth + 1);
  }

  private array(
    field: Field,
    name: string,
    value: List,
    other: Other,
    path: string,
    depth: number,
  ): void {
    const isOpen = this.state.isOpen(path, depth);
    this.out.push({
      path,
      name,
      depth,
      type: `${field.type}[${field.array === 'sequence' ? '' : field.array}]`,
      kind: 'array',
      text: isOpen ? '' : glance(value),
      constant: '',
      count: value.length,
      isOpen,
      isNumber: false,
      isDerived: false,
      change: this.changeOf(value, other),
      value,
    });
    if (!isOpen) return;
    const before = isList(other) ? other : undefined;
    const length = Math.max(value.length, before?.length ?? 0);
    const first = Math.min(this.state.first(path), Math.max(0, length - 1));
    const from = first - (first % PAGE);
    for (let i = from; i < Math.min(length, from + PAGE); i++) {
      const isRemoved = i >= value.length;
      const was: Other = before && i < before.length ? before[i] : NOTHING;
      const start = this.out.length;
      const shown = isRemoved ? was : value[i];
      this.one(field, `[${i}]`, shown, isRemoved ? shown : was, `${path}[${i}]`, depth + 1, '');
      if (!isRemoved) continue;
      for (let j = start; j < this.out.length; j++) this.out[j]!.change = 'removed';
    }
    if (length > PAGE) {
      this.out.push({
        path: `${path}[]`,
        name: path,
        depth: depth + 1,
        type: '',
        kind: 'page',
        text: `${from}–${Math.min(length, from + PAGE) - 1}`,
        constant: '',
        count: length,
        isOpen: false,
        isNumber: false,
        isDerived: false,
        change: 'same',
        value: from,
      });
    }
  }

  private angles(
    { x, y, z, w }: Record<'x' | 'y' | 'z' | 'w', number>,
    other: Other,
    prefix: string,
    depth: number,
  ): void {
    const values = {
      roll: Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
      pitch: Math.asin(Math.min(1, Math.max(-1, 2 * (w * y - z * x)))),
      yaw: Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
    };
    const change = this.changeOf({ x, y, z, w }, other);
    for (const name of ANGLES) {
      this.out.push({
        path: `${prefix}.${name}`,
        name,
        depth,
        type: '',
        kind: 'value',
        text: valueText(values[name]),
        constant: '',
        count: 0,
        isOpen: false,
        isNumber: true,
        isDerived: true,
        change,
        value: values[name],
      });
    }
  }

  private changeOf(value: unknown, other: Other): Change {
    if (!this.isCompared) return 'same';
    if (other === NOTHING) return 'added';
    return isEqual(value, other) ? 'same' : 'changed';
  }
}

const MAX_TEXT = 2000;

function valueText(value: unknown): string {
  if (typeof value === 'number') {
    return Number.isInteger(value) ? String(value) : String(Number(value.toPrecision(9)));
  }
  const text = String(value);
  return text.length > MAX_TEXT ? `${text.slice(0, MAX_TEXT)}…` : text;
}

/** Time in seconds with all its digits. */
function timeText({ sec, nanosec }: { sec: number; nanosec: number }): string {
  return `${sec}.${String(nanosec).padStart(9, '0')}`;
}

/** First values of an array of numbers or texts. */
function glance(value: List): string {
  if (value.length === 0) return '[]';
  if (typeof value[0] === 'object') return '';
  const few = Array.from({ length: Math.min(4, value.length) }, (_, i) => {
    const one = value[i];
    return typeof one === 'number' ? String(Number(one.toPrecision(5))) : String(one).slice(0, 40);
  });
  return `[${few.join(', ')}${value.length > 4 ? ', …' : ''}]`;
}

/** Value as JSON, for the clipboard: arrays of numbers as lists. */
export function jsonOf(value: unknown): string {
  return JSON.stringify(
    value,
    (_key, one: unknown) => {
      if (typeof one === 'bigint') return one.toString();
      if (typeof one === 'number' && !Number.isFinite(one)) return String(one);
      return ArrayBuffer.isView(one) ? Array.from(one as never) : one;
    },
    2,
  );
}
