/** Checks that a value fits to a message type, with a sentence for each part that does not. */
import { t } from '../texts/language.svelte';
import { definitionOf, type Definition, type Field, type Schema } from './schema';

/** Ranges of whole numbers by their type. */
const RANGES: Record<string, [bigint, bigint]> = Object.fromEntries(
  [8, 16, 32, 64].flatMap((bits): [string, [bigint, bigint]][] => {
    const half = 1n << BigInt(bits - 1);
    return [
      [`int${bits}`, [-half, half - 1n]],
      [`uint${bits}`, [0n, 2n * half - 1n]],
    ];
  }),
);
RANGES.byte = RANGES.char = RANGES.uint8!;

const isTree = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' &&
  value !== null &&
  !Array.isArray(value) &&
  !ArrayBuffer.isView(value);

/** Short text of a value. */
function shown(value: unknown): string {
  const text = typeof value === 'bigint' ? String(value) : (JSON.stringify(value) ?? String(value));
  return text.length > 40 ? `${text.slice(0, 40)}…` : text;
}

/** What does not fit to the type of a schema, one sentence for each value. Missing fields are allowed. */
export function misfits(schema: Schema, value: unknown, definition = schema.root): string[] {
  const out: string[] = [];
  structure(schema, definition, value, '', out);
  return out;
}

function structure(
  schema: Schema,
  definition: Definition,
  value: unknown,
  path: string,
  out: string[],
): void {
  if (!isTree(value)) {
    out.push(t().publish.notFields(path || definition.name, definition.name, shown(value)));
    return;
  }
  for (const [name, inner] of Object.entries(value)) {
    const field = definition.fields.find((one) => one.name === name);
    const at = path ? `${path}.${name}` : name;
    if (!field) {
      const known = definition.fields.map((one) => one.name).join(', ');
      out.push(t().publish.noField(at, definition.name, known || '–'));
    } else one(schema, field, inner, at, out);
  }
}

function one(schema: Schema, field: Field, value: unknown, path: string, out: string[]): void {
  if (field.array === undefined) {
    scalar(schema, field, value, path, out);
    return;
  }
  if (!Array.isArray(value) && !ArrayBuffer.isView(value)) {
    out.push(t().publish.notList(path, field.type, shown(value)));
    return;
  }
  const list = Array.from(value as ArrayLike<unknown>);
  if (typeof field.array === 'number' && list.length !== field.array) {
    out.push(t().publish.wrongLength(path, field.array, list.length));
  }
  list.forEach((inner, i) => scalar(schema, field, inner, `${path}[${i}]`, out));
}

function scalar(schema: Schema, field: Field, value: unknown, path: string, out: string[]): void {
  const { type } = field;
  if (field.isComplex) {
    structure(schema, definitionOf(schema, type), value, path, out);
    return;
  }
  const isFit = type.endsWith('string')
    ? typeof value === 'string'
    : type === 'bool'
      ? typeof value === 'boolean'
      : /^float/.test(type)
        ? typeof value === 'number'
        : isWhole(type, value);
  if (isFit) return;
  const range = RANGES[type];
  out.push(
    range
      ? t().publish.notWhole(path, type, String(range[0]), String(range[1]), shown(value))
      : t().publish.notType(path, type, shown(value)),
  );
}

function isWhole(type: string, value: unknown): boolean {
  if (typeof value !== 'bigint' && !(typeof value === 'number' && Number.isInteger(value))) {
    return false;
  }
  const range = RANGES[type];
  return !range || (BigInt(value) >= range[0] && BigInt(value) <= range[1]);
}

/** A value with the fields that it lacks, from a template of the same type. */
export function filled(template: unknown, value: unknown): unknown {
  if (!isTree(template) || !isTree(value)) return value === undefined ? template : value;
  const names = new Set([...Object.keys(template), ...Object.keys(value)]);
  return Object.fromEntries([...names].map((name) => [name, filled(template[name], value[name])]));
}
