/** States over time: spans in which a field has one value. */

export type StateValue = number | string | boolean;

export interface Band {
  value: StateValue;
  fromS: number;
  toS: number;
}

const MAX_CHANGES = 5000;

/** Changes of one field. */
export class Transitions {
  private changes: { timeS: number; value: StateValue }[] = [];
  /** Time of the last message. */
  lastS = -Infinity;

  clear(): void {
    this.changes = [];
    this.lastS = -Infinity;
  }

  add(timeS: number, value: StateValue): void {
    // Time jumped back: what came later is not known any more.
    if (timeS < this.lastS) this.changes = this.changes.filter((one) => one.timeS <= timeS);
    this.lastS = timeS;
    const last = this.changes[this.changes.length - 1];
    if (last && Object.is(last.value, value)) return;
    this.changes.push({ timeS, value });
    if (this.changes.length > MAX_CHANGES) this.changes.shift();
  }

  get present(): StateValue | undefined {
    return this.changes[this.changes.length - 1]?.value;
  }

  /** Bands between two times. The last value holds until the end. */
  bands(fromS: number, toS: number): Band[] {
    const out: Band[] = [];
    for (let i = 0; i < this.changes.length; i++) {
      const { timeS, value } = this.changes[i]!;
      const end = this.changes[i + 1]?.timeS ?? toS;
      if (end < fromS || timeS > toS) continue;
      out.push({ value, fromS: Math.max(fromS, timeS), toS: Math.min(toS, end) });
    }
    return out;
  }
}

/** State of a field as a value, or `undefined` for what is no state. */
export function stateOf(value: unknown): StateValue | undefined {
  switch (typeof value) {
    case 'boolean':
    case 'string':
      return value;
    case 'number':
      return Number.isNaN(value) ? undefined : value;
    case 'bigint':
      return Number(value);
    default:
      return undefined;
  }
}

/** Number of a colour for a value: the same for the same text, whatever came before. */
export function colorIndex(text: string, count: number): number {
  let hash = 0;
  for (const char of text) hash = (hash * 31 + char.codePointAt(0)!) >>> 0;
  return hash % count;
}
