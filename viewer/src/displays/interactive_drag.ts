/** Geometry of dragging a control of an interactive marker: from rays of the mouse to a new pose. */
import { Plane, Quaternion, Ray, Vector3 } from 'three';
import { MODE } from './interactive_messages';

/** Pose of a marker in the fixed frame. */
export interface Placed {
  position: Vector3;
  quaternion: Quaternion;
}

export interface Grip {
  mode: number;
  /** Axis of the control in the fixed frame, of length one. */
  axis: Vector3;
  /** Direction of the camera. */
  view: Vector3;
  /** Point that was grabbed. */
  point: Vector3;
  start: Placed;
}

/** Smallest sine of the angle between a ray and an axis or plane. */
const MIN_SINE = 0.02;

/** Point on a line that is nearest to a ray, as its distance from `origin`; `undefined` if they are parallel. */
export function alongAxis(ray: Ray, origin: Vector3, axis: Vector3): number | undefined {
  const between = origin.clone().sub(ray.origin);
  const cos = axis.dot(ray.direction);
  const sine2 = 1 - cos * cos;
  if (sine2 < MIN_SINE * MIN_SINE) return undefined;
  return (cos * ray.direction.dot(between) - axis.dot(between)) / sine2;
}

/** Intersection of a ray with a plane; `undefined` if it is parallel or behind. */
export function onPlane(ray: Ray, normal: Vector3, point: Vector3): Vector3 | undefined {
  if (Math.abs(normal.dot(ray.direction)) < MIN_SINE) return undefined;
  const plane = new Plane().setFromNormalAndCoplanarPoint(normal, point);
  return ray.intersectPlane(plane, new Vector3()) ?? undefined;
}

/** Angle from `a` to `b` around an axis [rad]. */
export function angleAround(axis: Vector3, a: Vector3, b: Vector3): number {
  return Math.atan2(axis.dot(a.clone().cross(b)), a.dot(b));
}

function moved(start: Placed, by: Vector3): Placed {
  return { position: start.position.clone().add(by), quaternion: start.quaternion.clone() };
}

function turned(start: Placed, by: Quaternion, position = start.position): Placed {
  return { position: position.clone(), quaternion: by.clone().multiply(start.quaternion) };
}

/** Pose for a ray of the mouse; `undefined` where the ray does not determine one. */
export function drag(grip: Grip, ray: Ray): Placed | undefined {
  const { mode, axis, view, point, start } = grip;
  switch (mode) {
    case MODE.moveAxis: {
      const distance = alongAxis(ray, point, axis);
      return distance === undefined
        ? undefined
        : moved(start, axis.clone().multiplyScalar(distance));
    }
    case MODE.movePlane: {
      const at = onPlane(ray, axis, point);
      return at && moved(start, at.sub(point));
    }
    case MODE.rotateAxis: {
      const at = onPlane(ray, axis, point);
      if (!at) return undefined;
      // Around the point of the axis in the plane of the grip.
      const height = axis.dot(point.clone().sub(start.position));
      const middle = start.position.clone().addScaledVector(axis, height);
      const angle = angleAround(axis, point.clone().sub(middle), at.sub(middle));
      return turned(start, new Quaternion().setFromAxisAngle(axis, angle));
    }
    case MODE.moveRotate: {
      const at = onPlane(ray, axis, point);
      if (!at) return undefined;
      return pulled(grip, at);
    }
    case MODE.move3d:
    case MODE.moveRotate3d: {
      const at = onPlane(ray, view, point);
      return at && moved(start, at.sub(point));
    }
    case MODE.rotate3d: {
      const at = onPlane(ray, view, point);
      return at && tumbled(grip, at);
    }
    default:
      return undefined;
  }
}

/** The marker follows the grabbed point like a thing that is pulled by a string. */
function pulled({ axis, point, start }: Grip, at: Vector3): Placed {
  const arm = point.clone().sub(start.position);
  arm.addScaledVector(axis, -axis.dot(arm));
  const toHand = at.clone().sub(start.position);
  toHand.addScaledVector(axis, -axis.dot(toHand));
  const angle = angleAround(axis, arm, toHand);
  const turn = new Quaternion().setFromAxisAngle(axis, angle);
  const position = at.clone().sub(point.clone().sub(start.position).applyQuaternion(turn));
  return turned(start, turn, position);
}

/** Trackball: a motion by the distance of the grip from the middle turns by one radian. */
function tumbled({ view, point, start }: Grip, at: Vector3): Placed {
  const by = at.sub(point);
  const length = by.length();
  if (length < 1e-9) return moved(start, new Vector3());
  const radius = Math.max(0.05, point.distanceTo(start.position));
  const axis = by.cross(view).normalize();
  return turned(start, new Quaternion().setFromAxisAngle(axis, length / radius));
}

/** Turns with the mouse in a view-facing control: a grip for rotation while a key is held. */
export const asRotation = (grip: Grip): Grip => ({ ...grip, mode: MODE.rotate3d });
