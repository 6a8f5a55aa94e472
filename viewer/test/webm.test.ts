import { expect, test } from 'vitest';
import { writeWebm } from '../src/app/webm';

/** Elements of a part of an EBML file: id in hexadecimal, content. */
function elements(bytes: Uint8Array): [string, Uint8Array][] {
  const found: [string, Uint8Array][] = [];
  for (let at = 0; at < bytes.length;) {
    const idLength = Math.clz32(bytes[at]!) - 23;
    const id = Buffer.from(bytes.subarray(at, at + idLength)).toString('hex');
    expect(bytes[at + idLength]).toBe(1);
    const size = bytes.subarray(at + idLength + 1, at + idLength + 8);
    const length = size.reduce((sum, byte) => sum * 256 + byte, 0);
    const start = at + idLength + 8;
    found.push([id, bytes.subarray(start, start + length)]);
    at = start + length;
    expect(at).toBeLessThanOrEqual(bytes.length);
  }
  return found;
}
const inside = (bytes: Uint8Array, id: string) =>
  elements(bytes)
    .filter(([one]) => one === id)
    .map(([, content]) => content);

test('a WebM file has a track, clusters that begin with key frames, an index and the duration', () => {
  const packet = (timeMs: number, isKey: boolean) => ({
    timeMs,
    isKey,
    data: new Uint8Array([7, timeMs]),
  });
  const file = writeWebm(
    { codec: 'V_VP9', width: 640, height: 480 },
    [packet(0, true), packet(33, false), packet(100, true)],
    133,
  );
  const [[head], [segmentId, segment]] = elements(file) as [
    [string, Uint8Array],
    [string, Uint8Array],
  ];
  expect([head, segmentId]).toEqual(['1a45dfa3', '18538067']);
  const parts = elements(segment);
  expect(parts.map(([id]) => id)).toEqual([
    '1549a966',
    '1654ae6b',
    '1f43b675',
    '1f43b675',
    '1c53bb6b',
  ]);
  const [duration] = inside(parts[0]![1], '4489');
  expect(new DataView(duration!.buffer, duration!.byteOffset).getFloat64(0)).toBe(133);
  const [entry] = inside(parts[1]![1], 'ae');
  expect(Buffer.from(inside(entry!, '86')[0]!).toString()).toBe('V_VP9');
  const blocks = parts.slice(2, 4).map(([, cluster]) => inside(cluster, 'a3').map((b) => [...b]));
  // Track 1, time relative to the cluster, key frame or not, data.
  expect(blocks).toEqual([
    [
      [0x81, 0, 0, 0x80, 7, 0],
      [0x81, 0, 33, 0, 7, 33],
    ],
    [[0x81, 0, 0, 0x80, 7, 100]],
  ]);
  // The index points at the clusters, from the start of the segment's content.
  const positions = inside(parts[4]![1], 'bb').map((point) => {
    const [place] = inside(point, 'b7');
    return inside(place!, 'f1')[0]!.reduce((sum, byte) => sum * 256 + byte, 0);
  });
  for (const position of positions) {
    expect(Buffer.from(segment.subarray(position, position + 4)).toString('hex')).toBe('1f43b675');
  }
});
