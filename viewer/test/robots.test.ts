import { expect, test } from 'vitest';
import { frameCopier } from '../src/core/frame_names';
import {
  findRobots,
  frameHere,
  frameThere,
  robotName,
  robotOfTopic,
  type Endpoints,
} from '../src/core/robots';
import { parseSchema } from '../src/core/schema';

const TYPES: [RegExp, string][] = [
  [/robot_description$/, 'std_msgs/msg/String'],
  [/\/tf(_static)?$/, 'tf2_msgs/msg/TFMessage'],
  [/\/odom$/, 'nav_msgs/msg/Odometry'],
  [/cmd_vel$/, 'geometry_msgs/msg/Twist'],
];

/** Topics of a recording: without nodes. */
const named = (...names: string[]): Endpoints[] =>
  names.map((name) => ({
    name,
    type: TYPES.find(([pattern]) => pattern.test(name))?.[1] ?? 'a/msg/B',
    publishers: [],
    subscribers: [],
  }));
const find = (names: string[], frames: string[] = [], services: string[] = []) =>
  findRobots({
    topics: named(...names),
    frames,
    services: services.map((name) => ({ name })),
  });
const namespaces = (...all: Parameters<typeof find>) =>
  find(...all).map(({ namespace }) => namespace);

test('the robots of the bringup of Nav2 for several robots: transforms of their own', () => {
  const of = (name: string) =>
    ['robot_description', 'tf', 'tf_static', 'cmd_vel', 'odom', 'scan'].map(
      (one) => `/${name}/${one}`,
    );
  const robots = find(
    ['/clock', '/tf', '/map', ...of('robot1'), ...of('robot2')],
    ['map'],
    ['/robot2/navigate_to_pose/_action/send_goal'],
  );
  expect(robots).toEqual([
    {
      namespace: '/robot1',
      framePrefix: 'robot1/',
      hasOwnTf: true,
      description: '/robot1/robot_description',
      commandTopics: ['/robot1/cmd_vel'],
      navigator: undefined,
    },
    {
      namespace: '/robot2',
      framePrefix: 'robot2/',
      hasOwnTf: true,
      description: '/robot2/robot_description',
      commandTopics: ['/robot2/cmd_vel'],
      navigator: '/robot2',
    },
  ]);
});

test('robots with prefixes of frames on common transforms', () => {
  const robots = find(
    ['/tf', '/a/robot_description', '/a/cmd_vel', '/b/robot_description', '/b/cmd_vel'],
    ['map', 'a/odom', 'a/base_link', 'b/odom', 'b/base_footprint'],
  );
  expect(robots.map((one) => [one.namespace, one.framePrefix, one.hasOwnTf])).toEqual([
    ['/a', 'a/', false],
    ['/b', 'b/', false],
  ]);
  expect(frameHere(robots[0]!, 'a/base_link')).toBe('a/base_link');
});

test('one robot without a namespace, also with topics of sensors and controllers in one', () => {
  expect(find(['/robot_description', '/tf', '/cmd_vel', '/demo/odom', '/kbot/scan'])).toMatchObject(
    [{ namespace: '', framePrefix: '', hasOwnTf: false, commandTopics: ['/cmd_vel'] }],
  );
  expect(namespaces(['/robot_description', '/diff_drive/cmd_vel', '/arm/odom'])).toEqual(['']);
  // Inputs of a multiplexer are no robots.
  expect(namespaces(['/cmd_vel', '/joystick/cmd_vel', '/teleop/cmd_vel'])).toEqual(['']);
});

test('one robot without a namespace whose frames have a prefix', () => {
  const [robot] = find(['/robot_description', '/tf'], ['odom', 'bot/base_link']);
  expect([robot!.namespace, robot!.framePrefix]).toEqual(['', 'bot/']);
});

test("Gazebo's own topic of transforms is not that of a robot", () => {
  const robots = find(['/model/bot/tf', '/model/bot/cmd_vel', '/lidar']);
  expect(robots).toMatchObject([{ hasOwnTf: false, framePrefix: '' }]);
});

test('robots by their commands alone, or by their odometry', () => {
  expect(namespaces(['/turtle1/cmd_vel', '/turtle2/cmd_vel', '/turtle1/pose'])).toEqual([
    '/turtle1',
    '/turtle2',
  ]);
  expect(namespaces(['/a/odom', '/b/odom'])).toEqual(['/a', '/b']);
  expect(namespaces(['/chatter'])).toEqual([]);
});

test('a robot inside of the namespace of another belongs to it', () => {
  const robots = find(['/r/robot_description', '/r/arm/robot_description', '/r/base/cmd_vel']);
  expect(robots.map(({ namespace }) => namespace)).toEqual(['/r']);
  expect(robots[0]!.commandTopics).toEqual(['/r/base/cmd_vel']);
  expect(namespaces(['/r/robot_description', '/r2/robot_description'])).toEqual(['/r', '/r2']);
});

test('what only this page publishes is no robot', () => {
  const topic: Endpoints = {
    name: '/cmd_vel',
    type: 'geometry_msgs/msg/Twist',
    publishers: ['/viewers'],
    subscribers: [],
  };
  expect(findRobots({ topics: [topic], services: [], frames: [] })).toEqual([]);
  const driven = { ...topic, subscribers: ['/base'] };
  expect(findRobots({ topics: [driven], services: [], frames: [] })).toHaveLength(1);
});

test('topics of a second recording are not those of another robot', () => {
  expect(namespaces(['/robot_description', 'B:/robot_description', 'B:/r/tf'])).toEqual(['']);
});

test('frames of a robot with transforms of its own, here and there', () => {
  const robots = find(['/r1/tf', '/r1/robot_description', '/r2/tf', '/r2/robot_description']);
  const r1 = robotOfTopic(robots, '/r1/scan')!;
  expect(robotName(r1)).toBe('r1');
  expect(robotOfTopic(robots, '/r10/scan')).toBeUndefined();
  const here = ['odom', '/base_link', 'map', 'r1/odom', ''].map((frame) => frameHere(r1, frame));
  expect(here).toEqual(['r1/odom', 'r1/base_link', 'map', 'r1/odom', '']);
  expect(here.map((frame) => frameThere(r1, frame))).toEqual([
    'odom',
    'base_link',
    'map',
    'odom',
    '',
  ]);
});

test('a message is copied with other names of its frames, and stays as it is', () => {
  const schema = parseSchema(
    'x/msg/Poses',
    'std_msgs/Header header\nx/Pose[] poses\nfloat64[] data\n' +
      '===\nMSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n' +
      '===\nMSG: x/Pose\nstd_msgs/Header header\nfloat64 x\n',
  );
  const data = new Float64Array([1, 2]);
  const message = {
    header: { frame_id: 'odom' },
    poses: [{ header: { frame_id: 'map' }, x: 1 }],
    data,
  };
  const copy = frameCopier(schema)!(message, (frame) => `r/${frame}`);
  expect(copy).toEqual({
    header: { frame_id: 'r/odom' },
    poses: [{ header: { frame_id: 'r/map' }, x: 1 }],
    data,
  });
  expect(copy.data).toBe(data);
  expect(message.header.frame_id).toBe('odom');
  expect(frameCopier(parseSchema('std_msgs/msg/Int32', 'int32 data'))).toBeUndefined();
});
