/** Rows of the panel that publishes messages, as they are saved with a layout. */

export interface PublishRow {
  topic: string;
  /** Full name: `geometry_msgs/msg/Twist`. */
  type: string;
  /** Fields of the message; missing ones have their defaults. */
  value: Record<string, unknown>;
  rateHz: number;
  /** True to keep the last message for late subscribers. */
  isLatched: boolean;
  /** True to fill stamps that are zero with the time of publication. */
  fillsStamps: boolean;
}

const DEFAULT: PublishRow = {
  topic: '',
  type: '',
  value: {},
  rateHz: 1,
  isLatched: false,
  fillsStamps: true,
};
export const MAX_RATE_HZ = 100;
const MAX_ROWS = 50;

const isTree = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

/** A row from a saved layout; what has another type gets its default. */
export function readRow(saved: unknown): PublishRow {
  const given = isTree(saved) ? saved : {};
  const entries = Object.entries(DEFAULT).map(([key, value]) => {
    const kept = given[key];
    const isSame = typeof kept === typeof value && isTree(kept) === isTree(value);
    return [key, isSame ? kept : structuredClone(value)];
  });
  const row = Object.fromEntries(entries) as PublishRow;
  return { ...row, rateHz: Math.min(MAX_RATE_HZ, Math.max(0.01, row.rateHz || DEFAULT.rateHz)) };
}

export const readRows = (saved: unknown): PublishRow[] =>
  (Array.isArray(saved) ? saved : []).slice(0, MAX_ROWS).map(readRow);

/** Copy of a value whose stamps of zero have a time. */
export function withStamps<T>(value: T, stamp: { sec: number; nanosec: number }): T {
  if (Array.isArray(value)) return value.map((one) => withStamps(one as never, stamp)) as never;
  if (!isTree(value)) return value;
  return Object.fromEntries(
    Object.entries(value).map(([key, inner]) => {
      const isEmpty =
        key === 'stamp' && isTree(inner) && Number(inner.sec) === 0 && Number(inner.nanosec) === 0;
      return [key, isEmpty ? { ...stamp } : withStamps(inner as never, stamp)];
    }),
  ) as T;
}
