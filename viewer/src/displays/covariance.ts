/** Covariance of a pose: an ellipsoid for the position, a sector for the heading. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  Matrix4,
  Mesh,
  SphereGeometry,
  Vector3,
} from 'three';
import { principal } from './inertia';
import { colorOf, flatMaterial, surface } from '../scene/shapes';
import {
  alpha,
  bool,
  choice,
  color,
  number,
  type Option,
  type Value,
  type Values,
} from './options';

export type Get = <T extends Value>(path: string) => T;

/** Larger variances mean that the value is unknown: drivers write such numbers for what they do not measure [m²]. */
const UNKNOWN_M2 = 1e4;
/** Thickness of a flat ellipsoid [m]. */
const THIN_M = 2e-3;
const STEPS = 24;
const BLUE = new Color('#2f6fed');

export function covarianceOptions(): Option[] {
  const isOn = (v: Values) => v.Covariance === true;
  const place = (v: Values) => isOn(v) && v['Covariance/Position'] === true;
  const turn = (v: Values) => isOn(v) && v['Covariance/Orientation'] === true;
  return [
    bool('Covariance', true),
    bool('Covariance/Position', true, { when: isOn }),
    color('Covariance/Position/Color', '204; 51; 204', { when: place }),
    { ...alpha('Covariance/Position/Alpha', 0.3), when: place },
    number('Covariance/Position/Scale', 1, { min: 0, when: place }),
    bool('Covariance/Orientation', true, { when: isOn }),
    choice('Covariance/Orientation/Frame', 'Local', ['Local', 'Fixed'], { when: turn }),
    choice('Covariance/Orientation/Color Style', 'Unique', ['Unique', 'RGB'], { when: turn }),
    color('Covariance/Orientation/Color', '255; 255; 127', { when: turn }),
    { ...alpha('Covariance/Orientation/Alpha', 0.5), when: turn },
    number('Covariance/Orientation/Offset', 1, { min: 0, when: turn }),
    number('Covariance/Orientation/Scale', 1, { min: 0, when: turn }),
  ];
}

export interface Ellipsoid {
  /** Standard deviations along the axes [m]. */
  radii: Vector3;
  frameFromAxes: Matrix4;
}

/** Ellipsoid of one standard deviation; `undefined` if the position is unknown. */
export function ellipsoidOf(covariance: ArrayLike<number>): Ellipsoid | undefined {
  const at = (row: number, column: number) => covariance[row * 6 + column] ?? 0;
  if (!(at(0, 0) < UNKNOWN_M2 && at(1, 1) < UNKNOWN_M2) || !(at(0, 0) + at(1, 1) > 0)) {
    return undefined;
  }
  // Planar estimators leave z unknown, as zero or as a huge variance.
  const isFlat = !(at(2, 2) > 0 && at(2, 2) < UNKNOWN_M2);
  const z = isFlat ? [0, 0, THIN_M * THIN_M] : [at(0, 2), at(1, 2), at(2, 2)];
  const tensor = [at(0, 0), at(0, 1), z[0]!, at(1, 1), z[1]!, z[2]!];
  const { moments, turn } = principal(tensor);
  const radii = moments.map((square) => Math.max(THIN_M, Math.sqrt(Math.max(0, square))));
  return {
    radii: new Vector3(...radii),
    frameFromAxes: new Matrix4().makeRotationFromQuaternion(turn),
  };
}

/** Sector of one standard deviation to both sides of x. */
function sector(halfAngle: number, length: number): BufferGeometry {
  const wide = Math.min(halfAngle, Math.PI);
  const points: number[] = [];
  const rim = (i: number) => {
    const angle = ((2 * i) / STEPS - 1) * wide;
    return [Math.cos(angle) * length, Math.sin(angle) * length, 0];
  };
  for (let i = 0; i < STEPS; i++) points.push(0, 0, 0, ...rim(i), ...rim(i + 1));
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
  return geometry;
}

/** Ellipsoid around the pose and sector along its heading, in the frame of the message. */
export function covarianceOf(
  get: Get,
  covariance: ArrayLike<number>,
  frameFromPose: Matrix4,
): Group {
  const group = new Group();
  const at = new Vector3().setFromMatrixPosition(frameFromPose);
  const ellipsoid = get('Covariance/Position') ? ellipsoidOf(covariance) : undefined;
  if (ellipsoid) {
    const paint = colorOf(get('Covariance/Position/Color'));
    const opacity = get<number>('Covariance/Position/Alpha');
    const mesh = new Mesh(new SphereGeometry(1, 32, 16), surface(paint, opacity));
    const scale = get<number>('Covariance/Position/Scale');
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(ellipsoid.frameFromAxes).scale(ellipsoid.radii.multiplyScalar(scale));
    mesh.matrix.setPosition(at);
    mesh.renderOrder = 6;
    group.add(mesh);
  }
  const variance = covariance[35] ?? 0;
  if (get('Covariance/Orientation') && variance > 0) {
    const half = Math.sqrt(variance) * get<number>('Covariance/Orientation/Scale');
    const isOwn = get<string>('Covariance/Orientation/Color Style') === 'RGB';
    const paint = isOwn ? BLUE : colorOf(get('Covariance/Orientation/Color'));
    const material = flatMaterial(paint, get<number>('Covariance/Orientation/Alpha'));
    material.depthWrite = false;
    const fan = new Mesh(sector(half, get('Covariance/Orientation/Offset')), material);
    fan.matrixAutoUpdate = false;
    if (get<string>('Covariance/Orientation/Frame') === 'Local') fan.matrix.copy(frameFromPose);
    else fan.matrix.setPosition(at);
    fan.renderOrder = 7;
    group.add(fan);
  }
  return group;
}
