import { describe, expect, test } from 'vitest';
import { Diagnostics } from '../src/core/diagnostics';
import { fromRpy } from '../src/core/pose';
import { rateOf, rpyOf, TransformMonitor } from '../src/core/transform_monitor';
import { Transitions } from '../src/core/transitions';
import type { TransformStamped } from '../src/core/types';

const transform = (parent: string, child: string, timeS = 0, w = 1): TransformStamped => ({
  header: { stamp: { sec: timeS, nanosec: 0 }, frame_id: parent },
  child_frame_id: child,
  transform: { translation: { x: 0, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w } },
});
const monitorOf = (...all: [TransformStamped, boolean?][]) => {
  const monitor = new TransformMonitor();
  for (const [one, isStatic] of all) monitor.add(one, isStatic ?? false);
  return monitor;
};

describe('transforms', () => {
  test('a tree, parents first', () => {
    const monitor = monitorOf(
      [transform('odom', 'base')],
      [transform('base', 'laser'), true],
      [transform('map', 'odom')],
    );
    expect(monitor.rows(2).map((row) => [row.name, row.depth, row.isStatic, row.ageS])).toEqual([
      ['map', 0, false, undefined],
      ['odom', 1, false, 2],
      ['base', 2, false, 2],
      ['laser', 3, true, undefined],
    ]);
    expect(monitor.faults()).toEqual([]);
  });
  test('in a recording the age is that of the reception', () => {
    const monitor = new TransformMonitor();
    monitor.add(transform('odom', 'base', 1000), false, 4);
    expect(monitor.rows(5).find((row) => row.name === 'base')!.ageS).toBe(1);
  });
  test('two parents', () =>
    expect(monitorOf([transform('a', 'c', 5)], [transform('b', 'c', 6)]).faults()).toContainEqual({
      kind: 'parents',
      frame: 'c',
      parents: ['a', 'b'],
    }));
  test('a parent of long ago is none', () =>
    expect(monitorOf([transform('a', 'c', 1)], [transform('b', 'c', 9)]).faults()).toEqual([]));
  test('a loop', () => {
    const monitor = monitorOf([transform('a', 'b')], [transform('b', 'a')]);
    expect(monitor.faults()).toEqual([{ kind: 'loop', frames: ['a', 'b'] }]);
    expect(monitor.rows(0)).toHaveLength(2);
  });
  test('two trees', () =>
    expect(monitorOf([transform('a', 'b')], [transform('c', 'd')]).faults()).toEqual([
      { kind: 'trees', roots: ['a', 'c'] },
    ]));
  test('its own parent', () =>
    expect(monitorOf([transform('a', 'a')]).faults()).toEqual([{ kind: 'self', frame: 'a' }]));
  test('a rotation of length 2', () =>
    expect(monitorOf([transform('a', 'b', 0, 2)]).faults()).toEqual([
      { kind: 'number', frame: 'b' },
    ]));
  test('static and not', () =>
    expect(monitorOf([transform('a', 'b')], [transform('a', 'b'), true]).faults()).toEqual([
      { kind: 'both', frame: 'b' },
    ]));
  test('a rate', () => expect(rateOf([0, 0.5, 1, 1.5])).toBe(2));
  test('no rate of one message', () => expect(rateOf([1])).toBeUndefined());
  test('roll, pitch, yaw', () =>
    rpyOf(fromRpy(0.1, 0.2, 0.3)).forEach((angle, i) =>
      expect(angle).toBeCloseTo([0.1, 0.2, 0.3][i]!, 12),
    ));
});

describe('diagnostics', () => {
  const status = (name: string, level: number) => ({
    name,
    level,
    message: 'm',
    hardware_id: '',
    values: [],
  });
  const model = new Diagnostics();
  model.add({ status: [status('/base/motor', 2), status('/base/battery', 0)] }, 10);
  model.add({ status: [status('lidar', 1)] }, 14);
  const rows = (nowS: number, search = '', onlyProblems = false) =>
    model
      .rows(nowS, { search, onlyProblems, isOpen: () => true })
      .map((row) => `${' '.repeat(row.depth)}${row.name} ${row.level}`);
  test('a tree with the worst level', () =>
    expect(rows(14)).toEqual(['base 2', ' battery 0', ' motor 2', 'lidar 1']));
  test('stale after 5 s', () =>
    expect(rows(16)).toEqual(['base 3', ' battery 3', ' motor 3', 'lidar 1']));
  test('only problems', () =>
    expect(rows(14, '', true)).toEqual(['base 2', ' motor 2', 'lidar 1']));
  test('search', () => expect(rows(14, 'LID')).toEqual(['lidar 1']));
  test('counts', () => expect(model.counts(14)).toEqual([1, 1, 1, 0]));
});

describe('states', () => {
  const line = new Transitions();
  [
    [0, 'a'],
    [1, 'a'],
    [2, 'b'],
  ].forEach(([timeS, value]) => line.add(timeS as number, value as string));
  test('bands of equal values', () =>
    expect(line.bands(0.5, 5)).toEqual([
      { value: 'a', fromS: 0.5, toS: 2 },
      { value: 'b', fromS: 2, toS: 5 },
    ]));
  test('time that jumps back forgets what came later', () => {
    const again = new Transitions();
    [0, 5, 2].forEach((timeS) => again.add(timeS, timeS));
    expect(again.bands(0, 9).map((band) => band.value)).toEqual([0, 2]);
  });
});
