/** Values of fields over time, kept from the messages of a live run. */
import { numberAt } from '../app/fields';
import type { Message } from '../core/cdr';
import type { Handler } from '../core/client';
import { seconds, type Stamp } from '../core/types';
import { refText, type FieldRef, type Samples } from './expression';

/** Time of a message: its header's stamp, or when the page received it. */
export type TimeSource = 'header' | 'receive';

const MAX_SAMPLES = 20_000;
/** Longest history [s]. */
export const MAX_HISTORY_S = 600;

class Line implements Samples {
  times: number[] = [];
  values: number[] = [];

  add(timeS: number, value: number): void {
    const last = this.times[this.times.length - 1];
    // Time jumped back: a simulation was reset.
    if (last !== undefined && timeS < last - 1) this.clear();
    // Messages that overtake each other are put in order.
    let at = this.times.length;
    while (at > 0 && this.times[at - 1]! > timeS) at--;
    if (at > 0 && this.times[at - 1] === timeS) this.values[at - 1] = value;
    else {
      this.times.splice(at, 0, timeS);
      this.values.splice(at, 0, value);
    }
    if (this.times.length > MAX_SAMPLES * 1.2) this.forget(this.times.length - MAX_SAMPLES);
    else if (this.times[0]! < timeS - MAX_HISTORY_S * 1.2) {
      this.forget(this.times.findIndex((one) => one >= timeS - MAX_HISTORY_S));
    }
  }

  clear(): void {
    this.times.length = this.values.length = 0;
  }

  private forget(count: number): void {
    this.times.splice(0, count);
    this.values.splice(0, count);
  }
}

const EMPTY: Samples = { times: [], values: [] };

/** Stamp of a message's header; `undefined` without one, or where it is not set. */
export function headerTime(message: Message): number | undefined {
  const stamp = (message.header as { stamp?: Stamp } | undefined)?.stamp ?? undefined;
  const timeS = stamp && seconds(stamp);
  return timeS ? timeS : undefined;
}

export class Recorder {
  timeSource: TimeSource = 'header';
  private lines = new Map<string, { ref: FieldRef; line: Line }>();
  private topics = new Map<string, () => void>();

  constructor(
    private subscribe: (topic: string, handler: Handler) => () => void,
    private nowS: () => number,
  ) {}

  /** Records these fields; the values of fields that stay are kept. */
  record(refs: readonly FieldRef[]): void {
    const wanted = new Map(refs.map((ref) => [refText(ref), ref]));
    for (const key of this.lines.keys()) if (!wanted.has(key)) this.lines.delete(key);
    for (const [key, ref] of wanted) {
      if (!this.lines.has(key)) this.lines.set(key, { ref, line: new Line() });
    }
    const topics = new Set(refs.map((ref) => ref.topic));
    for (const [topic, leave] of this.topics) {
      if (topics.has(topic)) continue;
      leave();
      this.topics.delete(topic);
    }
    for (const topic of topics) {
      if (this.topics.has(topic)) continue;
      this.topics.set(
        topic,
        this.subscribe(topic, (message) => this.received(topic, message)),
      );
    }
  }

  private received(topic: string, message: Message): void {
    const stamp = this.timeSource === 'header' ? headerTime(message) : undefined;
    const timeS = stamp ?? this.nowS();
    for (const { ref, line } of this.lines.values()) {
      if (ref.topic === topic) line.add(timeS, numberAt(message, ref.path));
    }
  }

  samples(ref: FieldRef): Samples {
    return this.lines.get(refText(ref))?.line ?? EMPTY;
  }

  clear(): void {
    for (const { line } of this.lines.values()) line.clear();
  }

  stop(): void {
    for (const leave of this.topics.values()) leave();
    this.topics.clear();
    this.lines.clear();
  }
}
