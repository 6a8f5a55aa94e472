/** Motion of a model that is dragged by a handle, from the ray under the pointer. All in the world frame. */
import { Quaternion, Vector3, type Ray } from 'three';
import { multiplyQuat, rotate, yawOf, type Pose, type Quat, type Vec3 } from '../core/pose';

/** Handles: arrows along the axes, the horizontal plane, rings about the axes. */
export type Handle = 'x' | 'y' | 'z' | 'xy' | 'turnX' | 'turnY' | 'turnZ';

const AXES: Record<Handle, Vec3> = {
  x: [1, 0, 0],
  y: [0, 1, 0],
  z: [0, 0, 1],
  xy: [0, 0, 1],
  turnX: [1, 0, 0],
  turnY: [0, 1, 0],
  turnZ: [0, 0, 1],
};

export const isRing = (handle: Handle) => handle.startsWith('turn');

export type Motion =
  { kind: 'translation'; by: Vec3 } | { kind: 'rotation'; axis: Vec3; angleRad: number };

export const ANGLE_STEP_RAD = Math.PI / 12;
/** Smallest sine of the angle between a ray and a plane at which their intersection is used. */
const LEAST_SINE = 0.02;
/** The same for rings, below which the pointer's distance along the tangent counts. */
const LEAST_RING_SINE = 0.2;

const round = (value: number, step: number) => +(Math.round(value / step) * step).toFixed(6);

export class Drag {
  private readonly axis: Vector3;
  private readonly grabbed: Vector3;
  private readonly tangent?: Vector3;
  private readonly radiusM: number = 1;
  private readonly startRad: number = 0;

  /** `grabbed` is the point of the handle or model under the pointer: it stays there. */
  constructor(
    readonly handle: Handle,
    private readonly pivot: Vector3,
    grabbed: Vector3,
    ray: Ray,
  ) {
    this.axis = new Vector3(...AXES[handle]);
    this.grabbed = grabbed.clone();
    if (!isRing(handle)) return;
    const arm = grabbed.clone().sub(pivot).projectOnPlane(this.axis);
    this.radiusM = Math.max(arm.length(), 1e-3);
    if (Math.abs(ray.direction.dot(this.axis)) < LEAST_RING_SINE) {
      this.tangent = this.axis.clone().cross(arm).normalize();
    } else this.startRad = this.angleAt(ray) ?? 0;
  }

  /** Motion since the grab; `undefined` where the ray does not determine it, such as above the horizon. */
  motion(ray: Ray): Motion | undefined {
    if (isRing(this.handle)) return this.rotation(ray);
    if (this.handle === 'xy') {
      const now = onPlane(ray, this.grabbed, this.axis, LEAST_SINE);
      return now && { kind: 'translation', by: now.sub(this.grabbed).setZ(0).toArray() };
    }
    const along = onLine(ray, this.grabbed, this.axis);
    if (along === undefined) return undefined;
    return { kind: 'translation', by: this.axis.clone().multiplyScalar(along).toArray() };
  }

  private rotation(ray: Ray): Motion | undefined {
    const axis = this.axis.toArray();
    if (this.tangent) {
      const along = onLine(ray, this.grabbed, this.tangent);
      if (along === undefined) return undefined;
      return { kind: 'rotation', axis, angleRad: along / this.radiusM };
    }
    const angle = this.angleAt(ray);
    if (angle === undefined) return undefined;
    const turn = angle - this.startRad;
    return { kind: 'rotation', axis, angleRad: Math.atan2(Math.sin(turn), Math.cos(turn)) };
  }

  private angleAt(ray: Ray): number | undefined {
    const at = onPlane(ray, this.pivot, this.axis, LEAST_SINE)?.sub(this.pivot);
    if (!at) return undefined;
    // Two axes that form a right-handed system with the axis of the ring.
    const [x, y, z] = at.toArray();
    if (this.axis.x) return Math.atan2(z, y);
    if (this.axis.y) return Math.atan2(x, z);
    return Math.atan2(y, x);
  }
}

function onPlane(ray: Ray, point: Vector3, normal: Vector3, least: number): Vector3 | undefined {
  const slope = ray.direction.dot(normal);
  if (Math.abs(slope) < least) return undefined;
  const distance = point.clone().sub(ray.origin).dot(normal) / slope;
  return distance < 0 ? undefined : ray.at(distance, new Vector3());
}

/** Distance along a line, from its point, to where the line is nearest to the ray. */
function onLine(ray: Ray, point: Vector3, direction: Vector3): number | undefined {
  const slope = direction.dot(ray.direction);
  const scale = 1 - slope * slope;
  if (scale < 1e-3) return undefined;
  const offset = ray.origin.clone().sub(point);
  return (offset.dot(direction) - slope * offset.dot(ray.direction)) / scale;
}

/** Motion rounded to the grid [m] and to 15 degrees; a single model gets a position on the grid. */
export function snapped(motion: Motion, gridM: number, single?: Pose): Motion {
  if (motion.kind === 'rotation') {
    const isUpright = single && Math.hypot(single.q[0], single.q[1]) < 1e-6;
    const isAboutZ = motion.axis[2] === 1;
    const startRad = isUpright && isAboutZ ? yawOf(single.q) : 0;
    const to = Math.round((startRad + motion.angleRad) / ANGLE_STEP_RAD) * ANGLE_STEP_RAD;
    return { ...motion, angleRad: to - startRad };
  }
  const by = motion.by.map((value, i) => {
    // Axes along which the handle does not move stay as they are.
    if (value === 0) return 0;
    const start = single ? single.t[i]! : 0;
    return round(start + value, gridM) - start;
  });
  return { kind: 'translation', by: by as Vec3 };
}

/** Poses after a motion about a pivot. */
export function movedPoses(
  motion: Motion,
  pivot: Vec3,
  starts: ReadonlyMap<string, Pose>,
): Map<string, Pose> {
  const out = new Map<string, Pose>();
  if (motion.kind === 'translation') {
    const [x, y, z] = motion.by;
    for (const [name, { t, q }] of starts) out.set(name, { t: [t[0] + x, t[1] + y, t[2] + z], q });
    return out;
  }
  const turn = new Quaternion()
    .setFromAxisAngle(new Vector3(...motion.axis), motion.angleRad)
    .toArray() as Quat;
  for (const [name, { t, q }] of starts) {
    const arm = rotate(turn, [t[0] - pivot[0], t[1] - pivot[1], t[2] - pivot[2]]);
    out.set(name, {
      t: [pivot[0] + arm[0], pivot[1] + arm[1], pivot[2] + arm[2]],
      q: multiplyQuat(turn, q),
    });
  }
  return out;
}
