import { Quaternion, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { DIRECTIONS, stepped } from '../src/displays/interactive_keys';
import { MODE } from '../src/displays/interactive_messages';

const axes = { x: new Vector3(1, 0, 0), y: new Vector3(0, 1, 0), z: new Vector3(0, 0, 1) };
/** Screen of a camera above, with north up. */
const screen = { x: new Vector3(0, 1, 0), y: new Vector3(0, 0, 1), z: new Vector3(1, 0, 0) };
const start = { position: new Vector3(5, 0, 0), quaternion: new Quaternion() };
const steps = { lengthM: 0.1, angleRad: Math.PI / 2 };
const after = (mode: number, key: string) =>
  stepped(mode, axes, screen, start, DIRECTIONS[key]!, steps);

test('an axis is followed by each arrow', () => {
  expect(after(MODE.moveAxis, 'ArrowRight')!.position.toArray()).toEqual([5.1, 0, 0]);
  expect(after(MODE.moveAxis, 'ArrowDown')!.position.toArray()).toEqual([4.9, 0, 0]);
  expect(after(MODE.moveAxis, 'PageUp')).toBeUndefined();
});

test('a plane has two directions', () => {
  expect(after(MODE.movePlane, 'ArrowRight')!.position.toArray()).toEqual([5, 0.1, 0]);
  expect(after(MODE.movePlane, 'ArrowUp')!.position.toArray()).toEqual([5, 0, 0.1]);
});

test('a rotation turns in place', () => {
  const { position, quaternion } = after(MODE.rotateAxis, 'ArrowUp')!;
  expect(position.toArray()).toEqual([5, 0, 0]);
  expect(new Vector3(0, 1, 0).applyQuaternion(quaternion).z).toBeCloseTo(1);
});

test('a plane with rotation turns by Page Up', () => {
  const { quaternion } = after(MODE.moveRotate, 'PageDown')!;
  expect(new Vector3(0, 1, 0).applyQuaternion(quaternion).z).toBeCloseTo(-1);
});

test('motion in space is that of the screen', () => {
  expect(after(MODE.move3d, 'ArrowRight')!.position.toArray()).toEqual([5, 0.1, 0]);
  expect(after(MODE.move3d, 'PageUp')!.position.toArray()).toEqual([4.9, 0, 0]);
});

test('a button and a menu do not move', () => {
  expect(after(MODE.button, 'ArrowUp')).toBeUndefined();
  expect(after(MODE.menu, 'ArrowUp')).toBeUndefined();
});
