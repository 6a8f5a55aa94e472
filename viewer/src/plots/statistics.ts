/** Statistics of the visible part of a series, and its export. */
import type { Samples } from './expression';

export interface Statistics {
  count: number;
  min: number;
  max: number;
  mean: number;
  /** Root of the mean square. */
  rms: number;
}

/** Statistics of the finite values from `fromS` to `toS`; `undefined` without any. */
export function statistics(
  { times, values }: Samples,
  fromS: number,
  toS: number,
): Statistics | undefined {
  let [count, sum, squares, min, max] = [0, 0, 0, Infinity, -Infinity];
  for (let i = 0; i < times.length; i++) {
    const value = values[i]!;
    if (times[i]! < fromS || times[i]! > toS || !Number.isFinite(value)) continue;
    count++;
    sum += value;
    squares += value * value;
    min = Math.min(min, value);
    max = Math.max(max, value);
  }
  if (count === 0) return undefined;
  return { count, min, max, mean: sum / count, rms: Math.sqrt(squares / count) };
}

/** Index of the last sample at or before a time; -1 before the first one. */
export function indexAt(times: ArrayLike<number>, timeS: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= timeS) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** Value at a time: that of the last sample before it. */
export function valueAt({ times, values }: Samples, timeS: number): number | undefined {
  const value = values[indexAt(times, timeS)];
  return value === undefined || Number.isNaN(value) ? undefined : value;
}

/** All times once, and for each series its value there or `null`. */
export function aligned(
  series: readonly Samples[],
  fromS: number,
  toS: number,
): { times: number[]; columns: (number | null)[][] } {
  const all = new Set<number>();
  for (const { times } of series) {
    // One sample beyond each end, so that the curve reaches the border.
    const from = Math.max(0, indexAt(times, fromS));
    const to = Math.min(times.length - 1, indexAt(times, toS) + 1);
    for (let i = from; i <= to; i++) all.add(times[i]!);
  }
  const times = [...all].sort((a, b) => a - b);
  const columns = series.map((one) => {
    const at = new Map<number, number>();
    for (let i = 0; i < one.times.length; i++) at.set(one.times[i]!, one.values[i]!);
    return times.map((timeS) => {
      const value = at.get(timeS);
      return value === undefined || !Number.isFinite(value) ? null : value;
    });
  });
  return { times, columns };
}

/** Rows as CSV (RFC 4180). */
export function csv(rows: readonly (readonly unknown[])[]): string {
  const cell = (value: unknown) => {
    const text = value === null || value === undefined ? '' : String(value);
    return /[",\n\r]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return rows.map((row) => row.map(cell).join(',')).join('\r\n') + '\r\n';
}
