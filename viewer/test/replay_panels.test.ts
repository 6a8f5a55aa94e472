import { expect, test } from 'vitest';
import { kindOfFile } from '../src/app/drop';
import { changedValues } from '../src/app/job_values';
import { mostImportant } from '../src/app/mark_kinds';
import { topicDifferences, trajectoryDifference } from '../src/app/replay_difference';
import { clustered, dateText, offsetText, panned, ticks, zoomed } from '../src/app/replay_time';
import { suggestionFor } from '../src/app/auto';
import { fromYaw, IDENTITY } from '../src/core/pose';
import type { JobParameter } from '../src/core/protocol';
import { differenceOf } from '../src/displays/map_difference';
import { MemoryServer } from './replay_server';

test('offsets and dates', () => {
  expect(offsetText(0)).toBe('0:00.000');
  expect(offsetText(62.3456e9)).toBe('1:02.346');
  expect(offsetText(3723e9, 0)).toBe('1:02:03');
  expect(offsetText(-1.5e9, 1)).toBe('−0:01.5');
  expect(offsetText(59.9996e9)).toBe('1:00.000');
  expect(dateText(12)).toBe('');
  expect(dateText(1.7e9)).toMatch(/^2023-11-1[45] \d\d:\d\d:20$/);
});

test('ticks are at round offsets', () => {
  expect(ticks({ fromNs: 0, toNs: 10e9 }, 5).map((tick) => tick.text)).toEqual([
    '0:00',
    '0:02',
    '0:04',
    '0:06',
    '0:08',
    '0:10',
  ]);
  expect(ticks({ fromNs: 1.05e9, toNs: 1.25e9 }, 2).map((tick) => tick.text)).toEqual([
    '0:01.1',
    '0:01.2',
  ]);
});

test('zooming keeps the position under the pointer, within the recording', () => {
  const bounds = { fromNs: 0, toNs: 100e9 };
  expect(zoomed(bounds, 0.5, 20e9, bounds)).toEqual({ fromNs: 10e9, toNs: 60e9 });
  expect(zoomed({ fromNs: 10e9, toNs: 60e9 }, 4, 60e9, bounds)).toEqual(bounds);
  expect(panned({ fromNs: 10e9, toNs: 60e9 }, 90e9, bounds)).toEqual({ fromNs: 50e9, toNs: 100e9 });
});

test('marks that touch are one, drawn as the most important', () => {
  const at = (positionNs: number) => ({ positionNs });
  expect(clustered([at(0), at(4), at(5), at(20)], 5)).toEqual([[at(0), at(4)], [at(5)], [at(20)]]);
  expect(mostImportant(['goal', 'collision', 'warning'])).toBe('collision');
  expect(mostImportant(['later'])).toBe('later');
});

test('differences of topics: missing, counts and rates', () => {
  const server = new MemoryServer();
  const entry = (topic: string, atS: number) => {
    return { topic, atS, type: 'std_msgs/msg/Int32', message: { data: 0 } };
  };
  const span = [entry('/span', 0), entry('/span', 10)];
  const many = (topic: string, count: number) =>
    Array.from({ length: count }, (_, i) => entry(topic, i / 10));
  const a = server.recording(1, 0, [...span, ...many('/scan', 20), ...many('/old', 5)]);
  const b = server.recording(2, 0, [...span, ...many('/scan', 40), ...many('/new', 5)]);
  const found = topicDifferences(a, b).map(({ topic, kind, ratesHz }) => [topic, kind, ...ratesHz]);
  expect(found).toEqual([
    ['/new', 'second', undefined, 0.5],
    ['/old', 'first', 0.5, undefined],
    ['/scan', 'rate', 2, 4],
    ['/span', 'same', 0.2, 0.2],
  ]);
});

test('RMS distance of trajectories at equal times, with the frames tied', () => {
  const at = (atNs: number, x: number) => ({ atNs, pose: fromYaw(0, [x, 0, 0]) });
  const first = [at(0, 0), at(1, 1), at(2, 2)];
  const second = [at(0, 3), at(1, 1), at(5, 9)];
  expect(trajectoryDifference(first, second, IDENTITY)).toEqual({
    rmsM: Math.sqrt(4.5),
    worstM: 3,
    count: 2,
  });
  const moved = [at(0, 10), at(1, 11)];
  expect(trajectoryDifference(first, moved, fromYaw(0, [-10, 0, 0]))!.rmsM).toBe(0);
  expect(trajectoryDifference(first, [], IDENTITY)).toBeUndefined();
});

function gridOf(width: number, height: number, data: number[]) {
  const origin = { position: { x: 0, y: 0, z: 0 }, orientation: { x: 0, y: 0, z: 0, w: 1 } };
  const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'map' };
  return { header, info: { resolution: 1, width, height, origin }, data: Int8Array.from(data) };
}

test('cells occupied in one map, in the other, or in both; also where only one map is', () => {
  const first = gridOf(2, 2, [100, 100, 0, -1]);
  const second = gridOf(2, 2, [100, 0, 0, 100]);
  expect(differenceOf(first, second, IDENTITY, 65).counts).toEqual({
    first: 1,
    second: 1,
    both: 1,
  });
  // Moved by one cell to the left: both grids together are three cells wide.
  const moved = differenceOf(first, second, fromYaw(0, [-1, 0, 0]), 65);
  expect([moved.width, moved.height, moved.fromX, moved.fromY]).toEqual([3, 2, -1, 0]);
  expect([...moved.cells]).toEqual([2, 1, 1, 0, 2, 0]);
});

test('kinds of files by content, then by name', () => {
  const bytes = (text: string) => Uint8Array.from([...text].map((c) => c.charCodeAt(0)));
  expect(kindOfFile('a.mcap', bytes('\x89MCAP0\r\n'))).toBe('recording');
  expect(kindOfFile('a', bytes('#ROSBAG V2.0\n'))).toBe('recording');
  expect(kindOfFile('a_0.db3', bytes('SQLite format 3\0'))).toBe('recording');
  expect(kindOfFile('intel.log', bytes('# log\nFLASER 2 1.0 1.0'))).toBe('recording');
  expect(kindOfFile('house.world', bytes('<sdf version="1.6">'))).toBe('world');
  expect(kindOfFile('nav.rviz', bytes('Panels:'))).toBe('rviz');
  expect(kindOfFile('notes.txt', bytes('hello'))).toBe('unknown');
});

const parameter = (name: string, type: string, value: never, min?: number): JobParameter => ({
  ...{ name, type, default: value, min: min ?? null, max: null, unit: null, doc: '' },
});

test('only changed parameters are sent, and invalid ones are named', () => {
  const all = [
    parameter('resolution', 'double', 0.05 as never, 0.01),
    parameter('count', 'int', 3 as never),
    parameter('on', 'bool', true as never),
    parameter('frames', 'string[]', ['a'] as never),
  ];
  expect(changedValues(all, { resolution: '0.05', on: true })).toEqual({ values: {}, invalid: [] });
  const entered = { resolution: '0.1', on: false, frames: '["b"]' };
  expect(changedValues(all, entered).values).toEqual({ resolution: 0.1, on: false, frames: ['b'] });
  const pose = [parameter('pose', 'numbers', '' as never)];
  expect(changedValues(pose, { pose: '1, 2 0.5' }).values).toEqual({ pose: [1, 2, 0.5] });
  expect(changedValues(pose, { pose: '1, x' }).invalid).toEqual(['pose']);
  expect(changedValues(all, { resolution: '0', count: '1.5' }).invalid).toEqual([
    'resolution',
    'count',
  ]);
});

test('a topic of a second recording gets the display of the first, in its own colour and frames', () => {
  const scan = suggestionFor('B:/scan', 'sensor_msgs/msg/LaserScan')!;
  expect([scan.name, scan.values.Topic, scan.values.Color]).toEqual([
    'B: scan',
    'B:/scan',
    '64; 160; 255',
  ]);
  const robot = suggestionFor('B:/robot_description', 'std_msgs/msg/String')!;
  expect(robot.values['TF Prefix']).toBe('B:');
  expect(robot.values['Description Topic']).toBe('B:/robot_description');
});
