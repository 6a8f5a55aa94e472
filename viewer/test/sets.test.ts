import { describe, expect, test } from 'vitest';
import { allPositions, centerOf, movable, rangeOf } from '../src/app/joint_values';
import {
  differences,
  matchingNames,
  parameterMessage,
  readParameters,
  writeParameters,
} from '../src/core/parameter_sets';
import { arraysOf, columnsOf, sorted } from '../src/core/table';
import type { Joint } from '../src/displays/joints';

describe('parameter files', () => {
  const parameters = [
    { name: '/amcl.max_beams', value: 60, type: undefined },
    { name: '/amcl.laser.range', value: 12, type: 'float64' },
    { name: '/amcl.names', value: ['a', 'b'] },
    { name: '/ns/node.enabled', value: true },
  ];
  const text = writeParameters(parameters);
  test('nested names; a float keeps its point', () =>
    expect(text).toBe(
      '/amcl:\n  ros__parameters:\n    laser:\n      range: 12.0\n    max_beams: 60\n' +
        '    names:\n      - a\n      - b\n/ns/node:\n  ros__parameters:\n    enabled: true\n',
    ));
  test('read as they were written', () =>
    expect([...readParameters(text)].sort()).toEqual(
      parameters.map(({ name, value }) => [name, value]).sort(),
    ));
  test('nodes in namespaces, as Nav2 writes its costmaps', () =>
    expect([
      ...readParameters('local_costmap:\n  local_costmap:\n    ros__parameters:\n      x: 1'),
    ]).toEqual([['/local_costmap/local_costmap.x', 1]]));
  test('wildcards', () =>
    expect(matchingNames('/**.use_sim_time', ['/a/b.use_sim_time', '/c.x'])).toEqual([
      '/a/b.use_sim_time',
    ]));
  test('differences', () => {
    const present = Object.fromEntries(parameters.map((one) => [one.name, one]));
    const file = '/amcl:\n  ros__parameters: {max_beams: 30, laser: {range: 12.0}, other: 1}';
    expect(differences(readParameters(file), present)).toEqual({
      changes: [{ name: '/amcl.max_beams', present: 60, wanted: 30 }],
      missing: ['/amcl.other'],
    });
  });
  test('an integer for a float', () =>
    expect(parameterMessage(3, { name: 'a', value: 1.5, type: 'float64' })).toEqual({
      type: 3,
      double_value: 3,
    }));
  test('a list of texts', () =>
    expect(parameterMessage(['a'], { name: 'a', value: [] })).toEqual({
      type: 9,
      string_array_value: ['a'],
    }));
});

describe('joints by hand', () => {
  const joint = (name: string, more: Partial<Joint> = {}): Joint => ({
    name,
    type: 'revolute',
    parent: '',
    child: '',
    axis: [1, 0, 0],
    maxEffort: 0,
    lower: 1,
    upper: 3,
    ...more,
  });
  test('the middle where 0 is not allowed', () => expect(centerOf(joint('a'))).toBe(2));
  test('0 where it is', () => expect(centerOf(joint('a', { lower: -1 }))).toBe(0));
  test('a wheel has a whole turn', () =>
    expect(rangeOf(joint('a', { type: 'continuous' }))).toEqual([-Math.PI, Math.PI]));
  test('followers are no sliders, and follow', () => {
    const mimic = { joint: 'a', multiplier: 2, offset: 1 };
    const all = [joint('a'), joint('b', { mimic }), joint('c', { type: 'fixed' })];
    expect(movable(all).map(({ name }) => name)).toEqual(['a']);
    expect(allPositions(all, { a: 1.5 })).toEqual({ name: ['a', 'b'], position: [1.5, 4] });
  });
  test('two that follow each other end', () => {
    const follows = (name: string) => ({ joint: name, multiplier: 1, offset: 0 });
    const all = [joint('a', { mimic: follows('b') }), joint('b', { mimic: follows('a') })];
    expect(allPositions(all, {}).name).toEqual(['a', 'b']);
  });
});

describe('tables', () => {
  test('columns of nested elements', () =>
    expect(columnsOf([{ id: 1, pose: { x: 2 }, list: [] }])).toEqual(['id', 'pose.x', 'list']));
  test('columns of numbers', () => expect(columnsOf(new Float32Array(2))).toEqual(['value']));
  test('arrays of a message', () =>
    expect(arraysOf({ a: [1], b: { c: new Uint8Array(1), d: 2 } })).toEqual(['a', 'b.c']));
  test('sorted by size, empty ones last', () => {
    const rows = [3, undefined, 10, 'x'].map((cell) => ({ cells: [cell] }));
    expect(sorted(rows, 0, true).map((row) => row.cells[0])).toEqual(['x', 10, 3, undefined]);
  });
});
