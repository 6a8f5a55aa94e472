import { expect, test } from 'vitest';
import { readRow, readRows, withStamps } from '../src/app/publish_rows';
import { TEXTS } from '../src/app/texts';
import { importFoxglove, type Knowledge } from '../src/app/layout_foxglove';
import { filled, misfits } from '../src/core/fit';
import { knownTypes } from '../src/core/known_types';
import { parseSchema } from '../src/core/schema';

const TWIST = parseSchema('geometry_msgs/msg/Twist', TEXTS['geometry_msgs/msg/Twist']!);
const NUMBERS = parseSchema('x/msg/N', 'uint8 a\nint64 b\nbool c\nfloat64[2] d\nstring[] e\n');

test('a value that fits has no problems, also with fields left out', () => {
  expect(misfits(TWIST, { linear: { x: 1 } })).toEqual([]);
  expect(misfits(NUMBERS, { a: 255, b: -(2n ** 63n), c: true, d: [1, 2.5], e: [] })).toEqual([]);
  expect(misfits(NUMBERS, { d: new Float64Array(2) })).toEqual([]);
});

test('what does not fit is named with its path and what is expected', () => {
  expect(misfits(TWIST, { linaer: {}, angular: { z: 'fast' } })).toEqual([
    'linaer: geometry_msgs/Twist has no such field. It has: linear, angular.',
    'angular.z: expected a value of the type float64, not "fast".',
  ]);
  expect(misfits(NUMBERS, { a: 256, b: 0.5, c: 1, d: [1], e: 'x' })).toEqual([
    'a: expected a whole number of the type uint8, from 0 to 255, not 256.',
    'b: expected a whole number of the type int64, from -9223372036854775808 to 9223372036854775807, not 0.5.',
    'c: expected a value of the type bool, not 1.',
    'd: expected 2 elements, not 1.',
    'e: expected a list of string, not "x".',
  ]);
  expect(misfits(TWIST, { linear: 3 })[0]).toBe(
    'linear: expected the fields of geometry_msgs/Vector3, not 3.',
  );
  expect(misfits(TWIST, null)).toHaveLength(1);
});

test('missing fields get their defaults', () => {
  expect(filled({ a: { x: 0, y: 0 }, b: 1, c: [0] }, { a: { y: 2 }, c: [7, 8] })).toEqual({
    a: { x: 0, y: 2 },
    b: 1,
    c: [7, 8],
  });
});

test('types of topics, and the types in them', () => {
  const types = knownTypes([
    {
      schemaName: 'geometry_msgs/msg/TwistStamped',
      schema: TEXTS['geometry_msgs/msg/TwistStamped']!,
    },
    { schemaName: 'x/srv/Y_Request', schema: 'int32 a' },
  ]);
  expect([...types.keys()].sort()).toEqual([
    'builtin_interfaces/msg/Time',
    'geometry_msgs/msg/Twist',
    'geometry_msgs/msg/TwistStamped',
    'geometry_msgs/msg/Vector3',
    'std_msgs/msg/Header',
  ]);
  const twist = parseSchema('geometry_msgs/msg/Twist', types.get('geometry_msgs/msg/Twist')!);
  expect(misfits(twist, { linear: { x: 1 } })).toEqual([]);
});

test('rows of a saved layout keep what has the right type', () => {
  const row = readRow({ topic: '/a', type: 3, rateHz: 1e9, value: [1], isLatched: true });
  expect(row).toEqual({
    topic: '/a',
    type: '',
    value: {},
    rateHz: 100,
    isLatched: true,
    fillsStamps: true,
  });
  expect(readRows('no list')).toEqual([]);
});

test('stamps of zero get the time', () => {
  const stamp = { sec: 5, nanosec: 6 };
  const at = (sec: number) => ({ header: { stamp: { sec, nanosec: 0 } } });
  expect(withStamps({ ...at(0), list: [at(1), at(0)] }, stamp)).toEqual({
    header: { stamp },
    list: [at(1), { header: { stamp } }],
  });
});

test('the Publish panel of Foxglove', () => {
  const know: Knowledge = {
    typeOf: () => undefined,
    displayOf: () => undefined,
    panel: () => ({ isMany: true }),
  };
  const config = { topicName: '/cmd_vel', datatype: 'geometry_msgs/Twist' };
  const file = (value: string) => ({
    configById: { 'Publish!a': { ...config, value } },
    layout: 'Publish!a',
  });
  const { layout, leftOut } = importFoxglove(file('{"linear": {"x": 0.5}}'), know);
  expect(layout.panels.publish!.state.rows).toEqual([
    { topic: '/cmd_vel', type: 'geometry_msgs/msg/Twist', value: { linear: { x: 0.5 } } },
  ]);
  expect(leftOut).toEqual([]);
  expect(importFoxglove(file('{x'), know).leftOut[0]).toContain('Publish /cmd_vel');
});
