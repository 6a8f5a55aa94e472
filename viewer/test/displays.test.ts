import { describe, expect, test } from 'vitest';
import { rowsOfCloud, rowsOfScan } from '../src/displays/cloud_rows';
import { fansOf } from '../src/displays/lidar';
import { extentOf, isDepth, toPixels } from '../src/displays/pixels';
import { boxOf, leadRadius, principal } from '../src/displays/inertia';
import { ellipsoidOf } from '../src/displays/covariance';
import { KINDS, kindOf } from '../src/displays/registry';
import { thinned } from '../src/scene/cloud';
import { voxels } from '../src/displays/voxels';
import { numberAt, numericPaths, show, unitOf } from '../src/app/fields';
import { faster, FIRST_SPEEDS, MOVES, qtCode, twist } from '../src/app/teleop';
import { suggestionFor } from '../src/app/auto';
import { mapTruths, percent } from '../src/app/truth';
import { Clock } from '../src/app/clock';
import { estimatorsOf } from '../src/app/estimators';
import { SensorFrames } from '../src/sim/sensor_frames';
import type { ImageMessage, LaserScan, PointCloud2 } from '../src/core/types';

const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: 'laser' };
const scan: LaserScan = {
  header,
  angle_min: 0,
  angle_max: Math.PI / 2,
  angle_increment: Math.PI / 4,
  time_increment: 0,
  scan_time: 0,
  range_min: 0.5,
  range_max: 10,
  ranges: new Float32Array([2, Infinity, 3]),
  intensities: new Float32Array([7, 8, 9]),
};
const floats = (words: Uint32Array) =>
  new Float32Array(words.buffer, words.byteOffset, words.length);

describe('points', () => {
  test('a scan has points only for beams with a return', () => {
    const rows = rowsOfScan(scan);
    expect(rows.count).toBe(2);
    const all = floats(rows.words);
    expect([all[0], all[1], all[3]]).toEqual([2, 0, 7]);
    expect(all[5]).toBeCloseTo(3, 6);
  });

  const cloud = (step: number, offset: number): PointCloud2 => {
    const data = new Uint8Array(2 * step);
    const view = new DataView(data.buffer);
    for (let i = 0; i < 2; i++) {
      [i, 10, 20].forEach((v, k) => view.setFloat32(i * step + offset + k * 4, v, true));
    }
    const fields = ['x', 'y', 'z'].map((name, k) => ({
      name,
      offset: offset + k * 4,
      datatype: 7,
      count: 1,
    }));
    return {
      header,
      height: 1,
      width: 2,
      fields,
      is_bigendian: false,
      point_step: step,
      row_step: 2 * step,
      data,
    };
  };

  test('a cloud of aligned 32-bit fields is not copied', () => {
    const message = cloud(16, 0);
    const rows = rowsOfCloud(message, 'intensity');
    expect(rows.words.buffer).toBe(message.data.buffer);
    expect([rows.stride, rows.xyz, rows.count, rows.value]).toEqual([4, 0, 2, undefined]);
  });

  test('a cloud with an unaligned point step is copied without a change of its values', () => {
    const rows = rowsOfCloud(cloud(15, 1), 'intensity');
    expect([...floats(rows.words)].filter((_, i) => i % 5 < 3)).toEqual([0, 10, 20, 1, 10, 20]);
  });

  test('a large cloud is thinned evenly', () => {
    const words = new Uint32Array([1, 2, 3, 4, 5, 6, 7, 8, 9, 10]);
    const thin = thinned({ words, stride: 2, count: 5, xyz: 0 }, 2);
    expect([thin.every, thin.count, ...thin.words]).toEqual([3, 1, 1, 2]);
    expect(thinned({ words, stride: 2, count: 5, xyz: 0 }, 5).words).toBe(words);
  });

  test('a cloud without coordinates is refused with a reason', () => {
    expect(() => rowsOfCloud({ ...cloud(16, 0), fields: [] }, '')).toThrow('no fields x, y and z');
  });
});

test('Visualize Lidar: a beam without a hit is drawn to the maximum range, or not at all', () => {
  const all = fansOf(scan, true);
  expect(all.points.length).toBe(6);
  expect(all.rays.length).toBe(12);
  expect(all.openRays.slice(3).map((v) => +v.toFixed(4))).toEqual([7.0711, 7.0711, 0]);
  expect(all.hit.length).toBe(0);
  expect(all.open.length).toBe(2 * 18);
  expect(all.deadZone.length).toBe(2 * 9);
  expect(fansOf(scan, false).open.length).toBe(0);
});

test('a marked voxel has two bits, an unknown one has one', () => {
  const grid = {
    header,
    data: new Uint32Array([0x0003_0001]),
    origin: { x: 0, y: 0, z: 0 },
    resolutions: { x: 1, y: 1, z: 1 },
    size_x: 1,
    size_y: 1,
    size_z: 16,
  };
  expect(voxels(grid, 'marked')).toEqual([[0.5, 0.5, 0.5]]);
  expect(voxels(grid, 'unknown')).toEqual([[0.5, 0.5, 1.5]]);
});

describe('images', () => {
  const image = (encoding: string, data: number[], width = 1): ImageMessage => ({
    header,
    height: 1,
    width,
    encoding,
    is_bigendian: 0,
    step: data.length,
    data: new Uint8Array(data),
  });
  const pixels = (message: ImageMessage) => {
    const out = new Uint8ClampedArray(message.width * 4);
    toPixels(message, out, isDepth(message.encoding) ? extentOf(message) : { min: 0, max: 1 });
    return [...out];
  };

  test('channels in any order', () => {
    expect(pixels(image('rgb8', [1, 2, 3]))).toEqual([1, 2, 3, 255]);
    expect(pixels(image('bgr8', [1, 2, 3]))).toEqual([3, 2, 1, 255]);
    expect(pixels(image('mono8', [9]))).toEqual([9, 9, 9, 255]);
  });

  test('depth is grey from minimum to maximum; missing values are black', () => {
    const depth = [...new Uint8Array(new Float32Array([1, NaN, 3]).buffer)];
    expect(pixels(image('32FC1', depth, 3))).toEqual([
      0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255,
    ]);
  });

  test('an unknown encoding is reported by name', () => {
    expect(() => pixels(image('nv21', [1]))).toThrow('nv21');
  });
});

describe('inertia and covariance', () => {
  test('the box of an inertia has the edges of the body for any rotation of its axes', () => {
    // 2 kg, 1 x 2 x 3 m: 2/12 (4 + 9), 2/12 (1 + 9), 2/12 (1 + 4).
    const plain = principal([13 / 6, 0, 0, 10 / 6, 0, 5 / 6]);
    expect(
      boxOf(2, plain.moments)!
        .toArray()
        .map((v) => +v.toFixed(6)),
    ).toEqual([1, 2, 3]);
    // The same, turned by 45 degrees around z.
    const [sum, half] = [23 / 12, 3 / 12];
    const turned = principal([sum, half, 0, sum, 0, 5 / 6]);
    const edges = boxOf(2, turned.moments)!
      .toArray()
      .sort((a, b) => a - b);
    expect(edges.map((v) => +v.toFixed(6))).toEqual([1, 2, 3]);
    expect(boxOf(1, [1, 1, 3])).toBeUndefined();
    expect(leadRadius(11_340 * (4 / 3) * Math.PI)).toBeCloseTo(1, 12);
  });

  test('the ellipse of a covariance; unmeasured components are not drawn', () => {
    const covariance = new Float64Array(36);
    expect(ellipsoidOf(covariance)).toBeUndefined();
    covariance[0] = 0.25;
    covariance[7] = 0.04;
    covariance[14] = 1e12;
    expect(ellipsoidOf(covariance)!.radii.toArray()).toEqual([0.5, 0.2, 0.002]);
    covariance[0] = 1e9;
    expect(ellipsoidOf(covariance)).toBeUndefined();
  });
});

test('every display has a unique class, and defaults for all of its options', () => {
  const names = KINDS.flatMap((kind) => [kind.class, ...(kind.also ?? [])]);
  expect(new Set(names).size).toBe(names.length);
  for (const { options } of KINDS) {
    const paths = options.map((o) => o.path);
    expect(new Set(paths).size).toBe(paths.length);
  }
  expect(kindOf('rviz/LaserScan')?.title).toBe('LaserScan');
});

test('fields of messages', () => {
  const message = {
    pose: { orientation: { x: 0, y: 0, z: 1, w: 0 } },
    ranges: new Float32Array([1.5]),
  };
  expect(numericPaths(message)).toContain('ranges[0]');
  expect(numberAt(message, 'ranges[0]')).toBe(1.5);
  expect(numberAt(message, 'pose.orientation.yaw')).toBeCloseTo(Math.PI, 12);
  expect(numberAt(message, 'pose.nothing.x')).toBeNaN();
  expect(show({ a: 1, b: { c: 'x' }, d: [1, 2] })).toBe('a: 1\nb:\n  c: x\nd: [1, 2]');
});

describe('driving', () => {
  test('keys are those of teleop_twist_keyboard', () => {
    expect(twist(MOVES.u!, FIRST_SPEEDS)).toMatchObject({ linear: { x: 0.5 }, angular: { z: 1 } });
    expect(twist(MOVES.m!, FIRST_SPEEDS)).toMatchObject({
      linear: { x: -0.5 },
      angular: { z: -1 },
    });
    expect(twist(MOVES.J!, FIRST_SPEEDS)).toMatchObject({ linear: { x: 0, y: 0.5 } });
    const there = faster('z', faster('q', FIRST_SPEEDS));
    expect(there.linearMS).toBeCloseTo(0.495, 12);
    expect(faster('w', FIRST_SPEEDS)).toEqual({ linearMS: 0.55, angularRadS: 1 });
  });

  test('Qt key codes', () => {
    const codes = [
      'ArrowUp',
      'ArrowDown',
      'ArrowLeft',
      'ArrowRight',
      'w',
      'S',
      ' ',
      'Escape',
      'F5',
    ].map(qtCode);
    expect(codes).toEqual([16777235, 16777237, 16777234, 16777236, 87, 83, 32, 16777216, 16777268]);
    expect(qtCode('Unidentified')).toBeUndefined();
  });
});

test('displays added automatically', () => {
  expect(
    suggestionFor('/global_costmap/costmap', 'nav_msgs/msg/OccupancyGrid')?.values['Color Scheme'],
  ).toBe('costmap');
  expect(suggestionFor('/world/x/scene', 'visualization_msgs/msg/MarkerArray')?.class).toBe(
    'periplus/World',
  );
  expect(suggestionFor('/world/x/poses', 'tf2_msgs/msg/TFMessage')).toBeUndefined();
  expect(suggestionFor('/tf', 'tf2_msgs/msg/TFMessage')).toBeUndefined();
  expect(suggestionFor('/scan', 'sensor_msgs/msg/LaserScan')?.isEnabled).toBe(true);
  expect(suggestionFor('/chatter', 'std_msgs/msg/String')).toBeUndefined();
});

test('the clock has the real time factor, and detects pauses and jumps back', () => {
  const clock = new Clock();
  for (let i = 0; i <= 10; i++) expect(clock.set(i * 0.2, i * 100)).toBe(false);
  expect(clock.factor()).toBeCloseTo(2, 9);
  expect(clock.isPaused(1100)).toBe(false);
  expect(clock.isPaused(2000)).toBe(true);
  expect(clock.set(0, 2100)).toBe(true);
});

test('the pause state comes from the simulation, also on a slow machine', () => {
  const clock = new Clock();
  // Two steps in four seconds: the heuristic for other servers would report a pause.
  clock.set(0.1, 0);
  clock.setStats({ timeS: 0.1, realS: 0, isPaused: false });
  clock.set(0.2, 4000);
  clock.setStats({ timeS: 0.2, realS: 4, isPaused: false });
  expect(clock.isPaused(5500)).toBe(false);
  expect(clock.factor()).toBeCloseTo(0.025, 9);
  clock.setStats({ timeS: 0.2, realS: 4, isPaused: true });
  expect(clock.isPaused(5500)).toBe(true);
  clock.forgetStats();
  expect(clock.isPaused(9999)).toBe(true);
});

test('the real time factor needs a second of samples', () => {
  const clock = new Clock();
  for (let i = 0; i <= 4; i++) clock.set(i * 2, i * 100);
  expect(clock.factor()).toBeUndefined();
});

test('an estimator publishes transforms and subscribes to measurements', () => {
  const row = (name: string, type: string, publishers: string[], subscribers: string[]) => ({
    ...{ name, type, publishers, subscribers },
  });
  const scan = row('/scan', 'sensor_msgs/msg/LaserScan', ['/lidar'], ['/viewers']);
  const tf = row('/tf', 'tf2_msgs/msg/TFMessage', ['/diff_drive', '/viewers'], ['/viewers']);
  expect(estimatorsOf([scan])).toEqual([]);
  // The page subscribes to all topics, and publishes no transforms.
  expect(estimatorsOf([scan, { ...tf, publishers: ['/diff_drive'] }])).toEqual([]);
  const joined = { ...scan, subscribers: ['/viewers', '/amcl'] };
  expect(estimatorsOf([joined, { ...tf, publishers: ['/diff_drive', '/amcl'] }])).toEqual([
    '/amcl',
  ]);
});

test('poses of sensors come from the simulation', () => {
  const frames = new SensorFrames();
  const one = (parent: string, child: string, x: number, sec = 1) => ({
    header: { stamp: { sec, nanosec: 0 }, frame_id: parent },
    child_frame_id: child,
    transform: { translation: { x, y: 0, z: 0 }, rotation: { x: 0, y: 0, z: 0, w: 1 } },
  });
  const mounts = [one('bot/base', '/lidar', 0.5), one('bot/base', 'lidar_frame', 0.5)];
  frames.setMounts({ transforms: mounts } as never);
  expect(frames.worldFromData('/lidar', 'lidar_frame', 1)).toBeUndefined();
  frames.addPoses({ transforms: [one('world', 'bot/base', 1, 1)] } as never);
  frames.addPoses({ transforms: [one('world', 'bot/base', 3, 2)] } as never);
  expect(frames.worldFromData('/lidar', 'any', 1.5)?.t).toEqual([2.5, 0, 0]);
  // Bridged to another topic name, and newer than the last pose.
  expect(frames.worldFromData('/laser_scan', '/lidar_frame', 2.5)?.t).toEqual([3.5, 0, 0]);
  expect(frames.worldFromData('/camera', 'camera', 1)).toBeUndefined();
});

test('comparison of maps with the truth', () => {
  const values = { free_iou: '0.962', walls_iou: '0.9', wall_mean_m: '0.021', explored: '0.5' };
  const status = {
    level: 0,
    name: '/map',
    message: 'the map agrees',
    values: Object.entries(values).map(([key, value]) => ({ key, value })),
  };
  const [map] = mapTruths({ status: [status] } as never);
  expect(map).toMatchObject({ topic: '/map', isGood: true, freeIou: 0.962, wallMeanM: 0.021 });
  expect(percent(map!.freeIou)).toBe('96 %');
  expect(percent(NaN)).toBe('–');
});

test('units follow from the path of a field', () => {
  const check = (path: string, unit: string) => expect([path, unitOf(path)]).toEqual([path, unit]);
  check('ranges[720]', 'm');
  check('pose.pose.position.x', 'm');
  check('twist.twist.linear.x', 'm/s');
  check('twist.twist.angular.z', 'rad/s');
  check('linear_acceleration.z', 'm/s²');
  check('angular_velocity.z', 'rad/s');
  check('pose.pose.orientation.yaw', 'rad');
  check('wrench.force.x', 'N');
  check('header.stamp.sec', 's');
  check('data', '');
  check('intensities[3]', '');
});
