/** Positions, directions and poses in space. `aFromB` times `bFromC` is `aFromC`. */

export type Vec3 = [number, number, number];
/** Quaternion x, y, z, w. */
export type Quat = [number, number, number, number];

export interface Pose {
  t: Vec3;
  q: Quat;
}

export const IDENTITY: Pose = { t: [0, 0, 0], q: [0, 0, 0, 1] };

export function rotate(q: Quat, v: Vec3): Vec3 {
  const [x, y, z, w] = q;
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [
    v[0] + w * tx + y * tz - z * ty,
    v[1] + w * ty + z * tx - x * tz,
    v[2] + w * tz + x * ty - y * tx,
  ];
}

export function multiplyQuat(a: Quat, b: Quat): Quat {
  return [
    a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
    a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
    a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
  ];
}

export function multiply(a: Pose, b: Pose): Pose {
  const r = rotate(a.q, b.t);
  return { t: [a.t[0] + r[0], a.t[1] + r[1], a.t[2] + r[2]], q: multiplyQuat(a.q, b.q) };
}

export function inverse(p: Pose): Pose {
  const q: Quat = [-p.q[0], -p.q[1], -p.q[2], p.q[3]];
  const t = rotate(q, p.t);
  return { t: [-t[0], -t[1], -t[2]], q };
}

export function apply(p: Pose, v: Vec3): Vec3 {
  const r = rotate(p.q, v);
  return [r[0] + p.t[0], r[1] + p.t[1], r[2] + p.t[2]];
}

export function fromYaw(yaw: number, t: Vec3 = [0, 0, 0]): Pose {
  return { t, q: [0, 0, Math.sin(yaw / 2), Math.cos(yaw / 2)] };
}

/** Fixed-axis roll, pitch, yaw, as in URDF and SDF. */
export function fromRpy(roll: number, pitch: number, yaw: number): Quat {
  const [sr, cr] = [Math.sin(roll / 2), Math.cos(roll / 2)];
  const [sp, cp] = [Math.sin(pitch / 2), Math.cos(pitch / 2)];
  const [sy, cy] = [Math.sin(yaw / 2), Math.cos(yaw / 2)];
  return [
    sr * cp * cy - cr * sp * sy,
    cr * sp * cy + sr * cp * sy,
    cr * cp * sy - sr * sp * cy,
    cr * cp * cy + sr * sp * sy,
  ];
}

/** Roll, pitch and yaw, as in URDF and SDF; at a pitch of 90 degrees the yaw is 0. */
export function rpyOf(q: Quat): Vec3 {
  const [x, y, z, w] = q;
  const sine = 2 * (w * y - z * x);
  if (Math.abs(sine) > 1 - 1e-9) {
    return [2 * Math.atan2(x, w), (Math.sign(sine) * Math.PI) / 2, 0];
  }
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
    Math.asin(sine),
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
  ];
}

export function yawOf(q: Quat): number {
  const [x, y, z, w] = q;
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

/** Spherical interpolation from `a` to `b` by the fraction `u`, along the shorter arc. */
export function slerp(a: Quat, b: Quat, u: number): Quat {
  let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const sign = dot < 0 ? -1 : 1;
  dot *= sign;
  let wa = 1 - u;
  let wb = u;
  if (dot < 0.9995) {
    const angle = Math.acos(Math.min(1, dot));
    wa = Math.sin((1 - u) * angle) / Math.sin(angle);
    wb = Math.sin(u * angle) / Math.sin(angle);
  }
  wb *= sign;
  return normalize([
    wa * a[0] + wb * b[0],
    wa * a[1] + wb * b[1],
    wa * a[2] + wb * b[2],
    wa * a[3] + wb * b[3],
  ]);
}

/** Quaternion of unit length. A zero quaternion, as in messages that were never filled, becomes the identity. */
export function normalize(q: Quat): Quat {
  const n = Math.hypot(q[0], q[1], q[2], q[3]);
  if (!(n > 1e-9)) return [0, 0, 0, 1];
  return [q[0] / n, q[1] / n, q[2] / n, q[3] / n];
}

export function interpolate(a: Pose, b: Pose, u: number): Pose {
  const mix = (i: 0 | 1 | 2) => a.t[i] + (b.t[i] - a.t[i]) * u;
  return { t: [mix(0), mix(1), mix(2)], q: slerp(a.q, b.q, u) };
}
