/** Shapes that visualize masses and inertias. */
import { Matrix3, Matrix4, Quaternion, Vector3 } from 'three';

/** Density of lead [kg/m³]: RViz shows a mass as a ball of lead. */
const LEAD_KG_M3 = 11_340;

/** Radius of a ball of lead of this mass [m]. */
export function leadRadius(massKg: number): number {
  return Math.cbrt((3 * massKg) / (4 * Math.PI * LEAD_KG_M3));
}

export interface Principal {
  moments: [number, number, number];
  /** Rotation from the principal axes to the axes of the tensor. */
  turn: Quaternion;
}

const ROUNDS = 24;

/** Principal moments and axes of a symmetric tensor, by Jacobi rotations. */
export function principal(inertia: readonly number[]): Principal {
  const [xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0] = inertia;
  const a = [
    [xx, xy, xz],
    [xy, yy, yz],
    [xz, yz, zz],
  ];
  const v = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let round = 0; round < ROUNDS; round++) {
    for (const [p, q] of [
      [0, 1],
      [0, 2],
      [1, 2],
    ] as const) {
      if (Math.abs(a[p]![q]!) < 1e-15) continue;
      const angle = Math.atan2(2 * a[p]![q]!, a[q]![q]! - a[p]![p]!) / 2;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (const row of [...a, ...v]) {
        const [x, y] = [row[p]!, row[q]!];
        row[p] = c * x - s * y;
        row[q] = s * x + c * y;
      }
      for (let k = 0; k < 3; k++) {
        const [x, y] = [a[p]![k]!, a[q]![k]!];
        a[p]![k] = c * x - s * y;
        a[q]![k] = s * x + c * y;
      }
    }
  }
  const axes = new Matrix3().set(
    ...(v[0] as [number, number, number]),
    ...(v[1] as [number, number, number]),
    ...(v[2] as [number, number, number]),
  );
  if (axes.determinant() < 0) for (const i of [6, 7, 8]) axes.elements[i]! *= -1;
  const turn = new Quaternion().setFromRotationMatrix(new Matrix4().setFromMatrix3(axes));
  return { moments: [a[0]![0]!, a[1]![1]!, a[2]![2]!], turn };
}

/**
 * Edge lengths of the solid box that has these principal moments: for a box of mass m with edges a, b, c the
 * moment around a is m (b² + c²) / 12. `undefined` if no such box exists: the moments are impossible.
 */
export function boxOf(massKg: number, [i, j, k]: [number, number, number]): Vector3 | undefined {
  const squares = [j + k - i, i + k - j, i + j - k].map((sum) => (6 * sum) / massKg);
  if (!(massKg > 0) || squares.some((square) => !(square >= -1e-9))) return undefined;
  return new Vector3(...squares.map((square) => Math.sqrt(Math.max(square, 1e-8))));
}
