/** Steps of an interactive marker by keys: the same degrees of freedom that dragging its control has. */
import { Quaternion, Vector3 } from 'three';
import type { Placed } from './interactive_drag';
import { MODE } from './interactive_messages';

/** Direction of a step: the arrow keys to the right and up, and Page Up; each -1, 0 or 1. */
export interface Direction {
  right: number;
  up: number;
  page: number;
}

/** Axes of a length of one in the fixed frame. */
export interface Axes {
  x: Vector3;
  y: Vector3;
  z: Vector3;
}

export interface Steps {
  lengthM: number;
  angleRad: number;
}

export const DIRECTIONS: Record<string, Direction> = {
  ArrowRight: { right: 1, up: 0, page: 0 },
  ArrowLeft: { right: -1, up: 0, page: 0 },
  ArrowUp: { right: 0, up: 1, page: 0 },
  ArrowDown: { right: 0, up: -1, page: 0 },
  PageUp: { right: 0, up: 0, page: 1 },
  PageDown: { right: 0, up: 0, page: -1 },
};

/**
 * Pose after a step, or `undefined` if the control does not move in this direction. `control`: axes of the control,
 * whose x axis is that of its motion; `screen`: right, up, and towards the user.
 */
export function stepped(
  mode: number,
  control: Axes,
  screen: Axes,
  start: Placed,
  { right, up, page }: Direction,
  { lengthM, angleRad }: Steps,
): Placed | undefined {
  const moved = (...parts: [Vector3, number][]): Placed | undefined => {
    const by = new Vector3();
    for (const [axis, count] of parts) by.addScaledVector(axis, count * lengthM);
    if (by.lengthSq() === 0) return undefined;
    return { position: start.position.clone().add(by), quaternion: start.quaternion.clone() };
  };
  const turned = (axis: Vector3, count: number): Placed | undefined => {
    if (count === 0) return undefined;
    const by = new Quaternion().setFromAxisAngle(axis, count * angleRad);
    return { position: start.position.clone(), quaternion: by.multiply(start.quaternion) };
  };
  switch (mode) {
    case MODE.moveAxis:
      return moved([control.x, right + up]);
    case MODE.rotateAxis:
      return turned(control.x, right + up);
    case MODE.movePlane:
      return moved([control.y, right], [control.z, up]);
    case MODE.moveRotate:
      return page !== 0 ? turned(control.x, page) : moved([control.y, right], [control.z, up]);
    case MODE.move3d:
    case MODE.moveRotate3d:
      return moved([screen.x, right], [screen.y, up], [screen.z, -page]);
    case MODE.rotate3d:
      if (right !== 0) return turned(screen.y, right);
      return up !== 0 ? turned(screen.x, -up) : turned(screen.z, page);
    default:
      return undefined;
  }
}
