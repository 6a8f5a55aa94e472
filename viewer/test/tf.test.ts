import { expect, test } from 'vitest';
import { apply, fromYaw, type Pose } from '../src/core/pose';
import { TfBuffer } from '../src/core/tf';
import { messageOf, stampOf } from '../src/core/types';

function put(
  buffer: TfBuffer,
  parent: string,
  child: string,
  timeS: number,
  pose: Pose,
  fixed = false,
) {
  const { position: translation, orientation: rotation } = messageOf(pose);
  const header = { stamp: stampOf(timeS), frame_id: parent };
  buffer.add({ header, child_frame_id: child, transform: { translation, rotation } }, fixed);
}

function found(buffer: TfBuffer, to: string, from: string, timeS?: number): Pose {
  const result = buffer.lookup(to, from, timeS);
  if (result.kind !== 'found') throw new Error(result.why);
  return result.pose;
}

test('lookup across two branches', () => {
  const buffer = new TfBuffer();
  put(buffer, 'odom', 'base', 1, fromYaw(Math.PI / 2, [2, 0, 0]));
  put(buffer, 'base', 'laser', 0, fromYaw(0, [1, 0, 0.5]), true);
  put(buffer, 'map', 'odom', 1, fromYaw(0, [0, 10, 0]));
  const laser = apply(found(buffer, 'map', 'laser', 1), [0, 0, 0]);
  expect(laser.map((v) => Math.round(v * 1e9) / 1e9)).toEqual([2, 11, 0.5]);
  const back = apply(found(buffer, 'laser', 'map', 1), laser);
  expect(Math.hypot(...back)).toBeLessThan(1e-12);
});

test('interpolation is linear, rotations take the shorter arc', () => {
  const buffer = new TfBuffer();
  put(buffer, 'odom', 'base', 1, fromYaw(3, [0, 0, 0]));
  put(buffer, 'odom', 'base', 2, fromYaw(-3, [4, 0, 0]));
  const pose = found(buffer, 'odom', 'base', 1.25);
  expect(pose.t[0]).toBeCloseTo(1, 12);
  const yaw = 2 * Math.atan2(pose.q[2], pose.q[3]);
  expect(Math.abs(yaw)).toBeCloseTo(3 + (2 * Math.PI - 6) / 4, 9);
});

test('a lookup in the future can be retried, one in the past cannot', () => {
  const buffer = new TfBuffer();
  put(buffer, 'odom', 'base', 5, fromYaw(0));
  put(buffer, 'odom', 'base', 6, fromYaw(0));
  expect(buffer.lookup('odom', 'base', 6.5).kind).toBe('later');
  expect(buffer.lookup('odom', 'base', 4).kind).toBe('never');
  expect(buffer.lookup('odom', 'nowhere', 5).kind).toBe('later');
});

test('the newest time is the newest that all transforms of the chain have', () => {
  const buffer = new TfBuffer();
  put(buffer, 'map', 'odom', 1, fromYaw(0, [1, 0, 0]));
  put(buffer, 'odom', 'base', 1, fromYaw(0, [5, 0, 0]));
  put(buffer, 'odom', 'base', 9, fromYaw(0, [7, 0, 0]));
  expect(found(buffer, 'map', 'base').t[0]).toBe(6);
});

test('a loop of frames is an error', () => {
  const buffer = new TfBuffer();
  put(buffer, 'a', 'b', 1, fromYaw(0));
  put(buffer, 'b', 'a', 1, fromYaw(0));
  put(buffer, 'x', 'y', 1, fromYaw(0));
  expect(buffer.lookup('a', 'y', 1).kind).toBe('later');
});

test('a jump back by more than the history clears the buffer', () => {
  const buffer = new TfBuffer();
  put(buffer, 'odom', 'base', 100, fromYaw(0, [9, 0, 0]));
  put(buffer, 'odom', 'base', 0.5, fromYaw(0, [1, 0, 0]));
  expect(found(buffer, 'odom', 'base').t[0]).toBe(1);
});

test('a frame is known as long as it has a transform or is the parent of one', () => {
  const buffer = new TfBuffer();
  const known = () => ['map', 'odom', 'base'].filter((name) => buffer.has(name));
  put(buffer, 'odom', 'base', 1, fromYaw(0, [0, 0, 0]));
  expect(known()).toEqual(['odom', 'base']);
  const { treeVersion } = buffer;
  put(buffer, 'odom', 'base', 2, fromYaw(0, [0, 0, 0]));
  expect(buffer.treeVersion).toBe(treeVersion);
  // Another parent: the one before is gone, and the names follow.
  put(buffer, 'map', 'base', 3, fromYaw(0, [0, 0, 0]));
  expect(known()).toEqual(['map', 'base']);
  expect(buffer.names()).toEqual(['base', 'map']);
  expect(buffer.treeVersion).toBe(treeVersion + 1);
  // Time jumped back to that of the parent before.
  buffer.rewind(2.5);
  expect(known()).toEqual(['odom', 'base']);
  buffer.rewind(0);
  expect(known()).toEqual([]);
});
