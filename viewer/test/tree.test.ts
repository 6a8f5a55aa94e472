import { describe, expect, test } from 'vitest';
import { constantOf, ownerOf } from '../src/core/constants';
import { parseSchema } from '../src/core/schema';
import { isEqual, jsonOf, treeRows } from '../src/core/tree';
import { fieldAt, numberAt, numericPathsOf } from '../src/app/fields';

const schema = parseSchema(
  'a/Thing',
  `int8 RED=1
int8 BLUE=2
int8 color
string name
float64[] values
a/Part[] parts
builtin_interfaces/Time stamp
geometry_msgs/Quaternion q
================
MSG: a/Part
int32 id
================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w`,
);
const message = {
  color: 2,
  name: 'box',
  values: new Float64Array([1, 2.5]),
  parts: [{ id: 7 }],
  stamp: { sec: 3, nanosec: 5 },
  q: { x: 0, y: 0, z: 1, w: 0 },
};
const all = { isOpen: () => true, first: () => 0 };
const rows = (other?: typeof message, now = message, state = all) =>
  treeRows(schema, now, other, state);
const row = (path: string, ...more: Parameters<typeof rows>) =>
  rows(...more).find((one) => one.path === path);

describe('the tree of a message', () => {
  test('paths', () =>
    expect(rows().map((one) => one.path)).toEqual([
      'color',
      'name',
      'values',
      'values[0]',
      'values[1]',
      'parts',
      'parts[0]',
      'parts[0].id',
      'stamp',
      'q',
      ...['q.x', 'q.y', 'q.z', 'q.w', 'q.roll', 'q.pitch', 'q.yaw'],
    ]));
  test('constants', () => expect(row('color')!.constant).toBe('BLUE'));
  test('times', () => expect(row('stamp')!.text).toBe('3.000000005'));
  test('a yaw is derived', () => expect(row('q.yaw')!.value).toBeCloseTo(Math.PI, 12));
  test('a changed value marks its parents', () => {
    const before = { ...message, parts: [{ id: 8 }] };
    expect(['parts', 'parts[0]', 'parts[0].id', 'name'].map((p) => row(p, before)!.change)).toEqual(
      ['changed', 'changed', 'changed', 'same'],
    );
  });
  test('a new element', () => {
    const before = { ...message, values: new Float64Array([1]) };
    expect(row('values[1]', before)!.change).toBe('added');
  });
  test('a removed element is shown with its last value', () => {
    const before = { ...message, parts: [{ id: 7 }, { id: 9 }] };
    const found = row('parts[1].id', before)!;
    expect([found.change, found.text]).toEqual(['removed', '9']);
  });
  test('nothing is new without another message', () =>
    expect(rows().every((one) => one.change === 'same')).toBe(true));
  test('closed objects have no rows', () => {
    const closed = { isOpen: () => false, first: () => 0 };
    expect(rows(undefined, message, closed)).toHaveLength(6);
  });
  test('pages of long arrays', () => {
    const long = { ...message, values: new Float64Array(120) };
    const state = { isOpen: () => true, first: () => 50 };
    const found = rows(undefined, long, state);
    expect(found.filter((one) => /^values\[\d/.test(one.path))).toHaveLength(50);
    expect(found.find((one) => one.kind === 'page')!.text).toBe('50–99');
  });
  test('NaN equals NaN', () => expect(isEqual([NaN], [NaN])).toBe(true));
  test('an object is no list', () => expect(isEqual({}, [])).toBe(false));
  test('JSON for the clipboard', () =>
    expect(JSON.parse(jsonOf({ a: new Float32Array([1, NaN]), b: 2n }))).toEqual({
      a: [1, 'NaN'],
      b: '2',
    }));
});

describe('constants', () => {
  const battery = parseSchema(
    'a/B',
    `uint8 STATUS_FULL=1
uint8 HEALTH_GOOD=1
uint8 status
uint8 health
uint8 other`,
  ).root;
  const check = (field: string, value: unknown, name: string | undefined) =>
    expect(constantOf(battery, field, value)).toBe(name);
  test('by the name of the field', () => check('health', 1, 'HEALTH_GOOD'));
  test('not those of other fields', () => check('other', 1, undefined));
  test('no constant has this value', () => check('status', 5, undefined));
  test('two names for a value are none', () => {
    const marker = parseSchema('a/M', 'int32 ARROW=0\nint32 ADD=0\nint32 type').root;
    expect(constantOf(marker, 'type', 0)).toBeUndefined();
  });
  test('owner of a path', () =>
    expect(ownerOf(schema, 'parts[3].id')).toMatchObject({
      definition: { name: 'a/Part' },
      field: 'id',
    }));
  test('no owner', () => expect(ownerOf(schema, 'parts.nothing')).toBeUndefined());
});

describe('numeric fields', () => {
  test('of a type', () =>
    expect(numericPathsOf(schema)).toEqual([
      'color',
      'values[0]',
      'parts[0].id',
      'stamp',
      ...['q.x', 'q.y', 'q.z', 'q.w', 'q.yaw', 'q.pitch', 'q.roll'],
    ]));
  test('a time in seconds', () => expect(numberAt(message, 'stamp')).toBeCloseTo(3, 6));
  test('a roll', () =>
    expect(numberAt({ q: { x: 1, y: 0, z: 0, w: 0 } }, 'q.roll')).toBeCloseTo(Math.PI, 12));
  test('names of JavaScript are no fields', () =>
    expect(fieldAt(message, 'constructor')).toBeUndefined());
});
