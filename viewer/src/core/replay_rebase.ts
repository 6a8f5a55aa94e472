/** Frames and stamps of a second recording: own names, and the time of the first one. */
import type { Message } from './cdr';
import { FRAME_FIELDS } from './frame_names';
import { definitionOf, type Schema } from './schema';
import { frameName } from './tf';
import type { Stamp } from './types';

const NS_PER_S = 1_000_000_000n;

type Change = (value: Message, prefix: string, shiftNs: bigint) => void;

/** Moves a stamp; the stamp zero means "newest" and stays. */
function shift(stamp: Stamp, shiftNs: bigint): void {
  if (stamp.sec === 0 && stamp.nanosec === 0) return;
  const ns = BigInt(stamp.sec) * NS_PER_S + BigInt(stamp.nanosec) + shiftNs;
  const nanosec = ((ns % NS_PER_S) + NS_PER_S) % NS_PER_S;
  stamp.nanosec = Number(nanosec);
  stamp.sec = Number((ns - nanosec) / NS_PER_S);
}

/**
 * Function that prefixes all frames of a decoded message and shifts its stamps; `undefined` for types without frames
 * and stamps.
 */
export function rebaseOf(schema: Schema): Change | undefined {
  const known = new Map<string, Change | undefined>();
  const changeOf = (type: string): Change | undefined => {
    if (known.has(type)) return known.get(type);
    // A definition with a cycle must not recurse without end.
    known.set(type, undefined);
    const parts: Change[] = [];
    for (const { name, type: inner, isComplex, array } of definitionOf(schema, type).fields) {
      if (!isComplex) {
        if (inner !== 'string' || array !== undefined || !FRAME_FIELDS.has(name)) continue;
        parts.push((value, prefix) => {
          const frame = String(value[name] ?? '');
          if (frame) value[name] = prefix + frameName(frame);
        });
      } else if (inner === 'builtin_interfaces/Time' && array === undefined) {
        parts.push((value, _prefix, shiftNs) => {
          if (shiftNs !== 0n) shift(value[name] as Stamp, shiftNs);
        });
      } else {
        const change = changeOf(inner);
        if (!change) continue;
        parts.push((value, prefix, shiftNs) => {
          const all = array === undefined ? [value[name]] : (value[name] as unknown[]);
          for (const one of all) change(one as Message, prefix, shiftNs);
        });
      }
    }
    const whole: Change | undefined =
      parts.length === 0
        ? undefined
        : (value, prefix, shiftNs) => {
            for (const part of parts) part(value, prefix, shiftNs);
          };
    known.set(type, whole);
    return whole;
  };
  return changeOf(schema.root.name);
}
