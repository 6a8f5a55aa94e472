/** Empty message of a type, for the user to edit. */
import { definitionOf, type Definition, type Field, type Schema } from '../core/schema';

const MOST_DEEP = 8;

/** Empty value of one type of a schema. */
export function templateOf(schema: Schema, type: string): Record<string, unknown> {
  return structure(schema, definitionOf(schema, type), 0);
}

/** Empty element of an array field. */
export const elementOf = (schema: Schema, field: Field): unknown => one(schema, field, 0);

export function template(schema: Schema): Record<string, unknown> {
  return structure(schema, schema.root, 0);
}

function structure(schema: Schema, definition: Definition, depth: number): Record<string, unknown> {
  return Object.fromEntries(definition.fields.map((f) => [f.name, value(schema, f, depth)]));
}

/** Value of a default in a definition: `1.5`, `true`, `"text"`, `[1, 2]`; `undefined` if it is something else. */
function defaultOf({ type, default: text }: Field): unknown {
  if (text === undefined) return undefined;
  const quoted = /^'(.*)'$/.exec(text);
  if (quoted) return quoted[1];
  try {
    return JSON.parse(text.replace(/^(True|False)$/, (word) => word.toLowerCase())) as unknown;
  } catch {
    return type.endsWith('string') ? text : undefined;
  }
}

function value(schema: Schema, field: Field, depth: number): unknown {
  const written = defaultOf(field);
  if (written !== undefined) return written;
  if (field.array === 'sequence') return [];
  if (typeof field.array === 'number') {
    return Array.from({ length: field.array }, () => one(schema, field, depth));
  }
  return one(schema, field, depth);
}

function one(schema: Schema, field: Field, depth: number): unknown {
  if (!field.isComplex) {
    if (field.type === 'bool') return false;
    return field.type.endsWith('string') ? '' : 0;
  }
  if (depth > MOST_DEEP) return {};
  const inner = structure(schema, definitionOf(schema, field.type), depth + 1);
  // The identity rotation.
  if (field.type === 'geometry_msgs/Quaternion') inner.w = 1;
  return inner;
}
