/** Names of values from the constants of a message definition, such as `STATUS_SUCCEEDED` for 4. */
import { definitionOf, type Constant, type Definition, type Schema } from './schema';

function sameValue(constant: Constant, value: unknown): boolean {
  if (typeof value === 'boolean') return /^(true|1)$/i.test(constant.value) === value;
  return typeof value === 'string' ? constant.value === value : Number(constant.value) === value;
}

/**
 * Constant that names the value of a field. Definitions do not state which constants belong to which field: those whose
 * name begins with the field's name do, otherwise those of its type, if they give each value one name.
 */
export function constantOf(
  definition: Definition,
  fieldName: string,
  value: unknown,
): string | undefined {
  const field = definition.fields.find((one) => one.name === fieldName);
  if (!field || field.isComplex) return undefined;
  const typed = definition.constants.filter((one) => one.type === field.type);
  const prefix = `${fieldName.toUpperCase()}_`;
  const own = typed.filter((one) => one.name.startsWith(prefix));
  // Constants of another field are not candidates.
  const others = definition.fields
    .filter((one) => one.name !== fieldName)
    .map((one) => `${one.name.toUpperCase()}_`);
  const rest = typed.filter((one) => !others.some((other) => one.name.startsWith(other)));
  const candidates = own.length > 0 ? own : rest;
  const found = candidates.filter((one) => sameValue(one, value));
  return found.length === 1 ? found[0]!.name : undefined;
}

/** Definition that has the last field of a path, and its name; `undefined` if the path leads elsewhere. */
export function ownerOf(
  schema: Schema,
  path: string,
): { definition: Definition; field: string } | undefined {
  const names = path.split('.').map((part) => part.replace(/(\[\d+\])+$/, ''));
  let definition = schema.root;
  for (const name of names.slice(0, -1)) {
    const field = definition.fields.find((one) => one.name === name);
    if (!field?.isComplex) return undefined;
    definition = definitionOf(schema, field.type);
  }
  const field = names[names.length - 1]!;
  return definition.fields.some((one) => one.name === field) ? { definition, field } : undefined;
}
