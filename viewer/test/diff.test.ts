import { describe, expect, test } from 'vitest';
import { fromRpy, rpyOf, type Vec3 } from '../src/core/pose';
import { diffLines } from '../src/core/unified_diff';
import { readChanges } from '../src/sim/changes';
import { keyMotion } from '../src/sim/nudge';

describe('diff', () => {
  const DIFF =
    '--- a/room.sdf\n+++ b/room.sdf\n@@ -3,3 +3,3 @@\n <model>\n-<pose>0</pose>\n+<pose>1</pose>\n' +
    ' </model>\n@@ -9 +9,2 @@\n </world>\n+<!-- -- end -->\n';

  test('lines have their numbers in both texts', () => {
    expect(diffLines(DIFF)).toEqual([
      { kind: 'same', text: '<model>', before: 3, after: 3 },
      { kind: 'removed', text: '<pose>0</pose>', before: 4 },
      { kind: 'added', text: '<pose>1</pose>', after: 4 },
      { kind: 'same', text: '</model>', before: 5, after: 5 },
      { kind: 'gap', text: '' },
      { kind: 'same', text: '</world>', before: 9, after: 9 },
      { kind: 'added', text: '<!-- -- end -->', after: 10 },
    ]);
    expect(diffLines('')).toEqual([]);
  });

  test('changes without a text are refused', () => {
    const all = { file: null, text: '<sdf/>', diff: '', changes: [] };
    expect(readChanges(JSON.stringify(all))).toEqual(all);
    expect(() => readChanges('{"file": "a.sdf"}')).toThrow('no text');
  });
});

describe('poses by keyboard', () => {
  const north: { right: Vec3; up: Vec3 } = { right: [1, 0, 0], up: [0, 1, 0] };
  /** Seen from the other side. */
  const south: { right: Vec3; up: Vec3 } = { right: [-1, 0.2, 0], up: [-0.2, -1, 0] };

  test('arrows follow the screen', () => {
    expect(keyMotion('ArrowRight', false, 0.5, north)).toEqual({
      kind: 'translation',
      by: [0.5, 0, 0],
    });
    expect(keyMotion('ArrowRight', false, 0.5, south)).toEqual({
      kind: 'translation',
      by: [-0.5, 0, 0],
    });
    expect(keyMotion('ArrowDown', false, 0.5, south)).toEqual({
      kind: 'translation',
      by: [0, 0.5, 0],
    });
    expect(keyMotion('ArrowUp', true, 0.5, south)).toEqual({
      kind: 'translation',
      by: [0, 0, 0.5],
    });
    expect(keyMotion('Enter', false, 0.5, north)).toBeUndefined();
  });

  test('roll, pitch and yaw are those that made the quaternion', () => {
    for (const angles of [
      [0.1, -0.2, 3],
      [0, Math.PI / 2, 0],
      [0.5, -Math.PI / 2, 0],
    ] as Vec3[]) {
      const found = rpyOf(fromRpy(...angles));
      angles.forEach((angle, i) => expect(found[i]).toBeCloseTo(angle, 6));
    }
  });
});
