/** Goals with the frame that a user means: the fixed frame where a header has none. */

/** Sets all empty `frame_id` of a message. */
export function withFrames<T>(value: T, frame: string): T {
  if (Array.isArray(value)) return value.map((one) => withFrames(one as never, frame)) as never;
  if (typeof value !== 'object' || value === null) return value;
  return Object.fromEntries(
    Object.entries(value).map(([key, inner]) => [
      key,
      key === 'frame_id' && inner === '' ? frame : withFrames(inner as never, frame),
    ]),
  ) as T;
}
