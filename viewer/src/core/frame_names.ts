/** Other names for the frames of messages. The messages stay as they are: others receive them, too. */
import type { Message } from './cdr';
import { definitionOf, type Schema } from './schema';

/** Names of fields of the type `string` that hold a frame. */
export const FRAME_FIELDS: ReadonlySet<string> = new Set(['frame_id', 'child_frame_id']);

type Rename = (frame: string) => string;
type Copier = (message: Message, rename: Rename) => Message;

const copiers = new WeakMap<Schema, Copier | undefined>();

/** Returns a function that copies a message with other names of its frames; `undefined` for types without frames. */
export function frameCopier(schema: Schema): Copier | undefined {
  if (!copiers.has(schema)) copiers.set(schema, make(schema));
  return copiers.get(schema);
}

function make(schema: Schema): Copier | undefined {
  const known = new Map<string, Copier | undefined>();
  const of = (type: string): Copier | undefined => {
    if (known.has(type)) return known.get(type);
    // A definition with a cycle must not recurse without end.
    known.set(type, undefined);
    const parts: ((from: Message, to: Message, rename: Rename) => void)[] = [];
    for (const { name, type: inner, isComplex, array } of definitionOf(schema, type).fields) {
      if (!isComplex) {
        if (inner !== 'string' || array !== undefined || !FRAME_FIELDS.has(name)) continue;
        parts.push((from, to, rename) => (to[name] = rename(String(from[name] ?? ''))));
        continue;
      }
      const copy = of(inner);
      if (!copy) continue;
      parts.push((from, to, rename) => {
        const value = from[name];
        to[name] = (
          array === undefined
            ? copy(value as Message, rename)
            : (value as Message[]).map((one) => copy(one, rename))
        ) as Message[string];
      });
    }
    const whole: Copier | undefined =
      parts.length === 0
        ? undefined
        : (from, rename) => {
            const to = { ...from };
            for (const part of parts) part(from, to, rename);
            return to;
          };
    known.set(type, whole);
    return whole;
  };
  return of(schema.root.name);
}
