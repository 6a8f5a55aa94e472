/** Arrows, axes, lines and labels, from which displays are built. */
import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Color,
  ConeGeometry,
  CylinderGeometry,
  DoubleSide,
  InstancedMesh,
  Line,
  LineBasicMaterial,
  LineSegments,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  Vector3,
} from 'three';
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js';
import { Line2 } from 'three/examples/jsm/lines/Line2.js';
import { LineGeometry } from 'three/examples/jsm/lines/LineGeometry.js';
import { LineMaterial } from 'three/examples/jsm/lines/LineMaterial.js';
import type { Pose } from '../core/pose';

/** Parses a colour as RViz writes it: "255; 25; 0". */
export function colorOf(text: string): Color {
  const [r = 255, g = 255, b = 255] = text.split(';').map(Number);
  return new Color().setRGB(r / 255, g / 255, b / 255, 'srgb');
}

export function matrixOf(pose: Pose, scale: [number, number, number] = [1, 1, 1]): Matrix4 {
  return new Matrix4().compose(
    new Vector3(...pose.t),
    new Quaternion(...pose.q),
    new Vector3(...scale),
  );
}

export function surface(color: Color, alpha = 1): MeshLambertMaterial {
  return new MeshLambertMaterial({
    color,
    transparent: alpha < 0.999,
    opacity: alpha,
    depthWrite: alpha >= 0.999,
  });
}

function shared<G extends BufferGeometry>(geometry: G): G {
  geometry.userData.isShared = true;
  return geometry;
}

export const UNIT_BOX = shared(new BoxGeometry(1, 1, 1));
export const UNIT_SPHERE = shared(new SphereGeometry(0.5, 24, 16));
/** Cylinder along z, as in ROS. */
export const UNIT_CYLINDER = shared(new CylinderGeometry(0.5, 0.5, 1, 32).rotateX(Math.PI / 2));

/** Arrow along x with its tail at the origin. */
export function arrowGeometry(
  shaftLength: number,
  shaftRadius: number,
  headLength: number,
  headRadius: number,
): BufferGeometry {
  const shaft = new CylinderGeometry(shaftRadius, shaftRadius, shaftLength, 12);
  shaft.translate(0, shaftLength / 2, 0);
  const head = new ConeGeometry(headRadius, headLength, 16);
  head.translate(0, shaftLength + headLength / 2, 0);
  return mergeGeometries([shaft, head]).rotateZ(-Math.PI / 2);
}

/** Axes x, y and z in red, green and blue. */
export function axesGeometry(length: number, radius: number): BufferGeometry {
  const bars = (['x', 'y', 'z'] as const).map((axis, i) => {
    const bar = new CylinderGeometry(radius, radius, length, 10).translate(0, length / 2, 0);
    if (axis === 'x') bar.rotateZ(-Math.PI / 2);
    if (axis === 'z') bar.rotateX(Math.PI / 2);
    const color = new Color(['#e5383b', '#2fb344', '#2f6fed'][i]);
    const colors = new Float32Array(bar.getAttribute('position').count * 3);
    for (let j = 0; j < colors.length; j += 3) color.toArray(colors, j);
    bar.setAttribute('color', new BufferAttribute(colors, 3));
    return bar;
  });
  return mergeGeometries(bars);
}

export function axesMaterial(alpha = 1): MeshLambertMaterial {
  return new MeshLambertMaterial({ vertexColors: true, transparent: alpha < 1, opacity: alpha });
}

/** Flat arrow of lines along x, of length one. */
export function flatArrowGeometry(): BufferGeometry {
  const points = [0, 0, 0, 1, 0, 0, 1, 0, 0, 0.75, 0.2, 0, 1, 0, 0, 0.75, -0.2, 0];
  return new BufferGeometry().setAttribute(
    'position',
    new BufferAttribute(new Float32Array(points), 3),
  );
}

/** Instances of one shape at many poses. */
export function instances(
  geometry: BufferGeometry,
  material: Material,
  matrices: Matrix4[],
  colors?: Color[],
): InstancedMesh {
  const mesh = new InstancedMesh(geometry, material, Math.max(1, matrices.length));
  mesh.count = matrices.length;
  matrices.forEach((matrix, i) => mesh.setMatrixAt(i, matrix));
  colors?.forEach((color, i) => mesh.setColorAt(i, color));
  mesh.frustumCulled = false;
  return mesh;
}

/** Line through points; `width` in metres, or one pixel if it is 0. */
export function polyline(
  points: ArrayLike<number>,
  color: Color,
  alpha = 1,
  width = 0,
): Line | Line2 {
  if (width > 0 && points.length >= 6) {
    const geometry = new LineGeometry().setPositions(points as number[]);
    const material = new LineMaterial({
      color,
      linewidth: width,
      worldUnits: true,
      transparent: alpha < 1,
      opacity: alpha,
    });
    const line = new Line2(geometry, material);
    line.frustumCulled = false;
    return line;
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(points), 3));
  const line = new Line(
    geometry,
    new LineBasicMaterial({ color, transparent: alpha < 1, opacity: alpha }),
  );
  line.frustumCulled = false;
  return line;
}

export function segments(points: ArrayLike<number>, color: Color, alpha = 1): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(Float32Array.from(points), 3));
  const lines = new LineSegments(
    geometry,
    new LineBasicMaterial({ color, transparent: alpha < 1, opacity: alpha }),
  );
  lines.frustumCulled = false;
  return lines;
}

/** Text that faces the camera; `height` in metres. */
export function label(text: string, height: number, color = '#e8edf4', backing = false): Sprite {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d')!;
  const lines = text.split('\n').slice(0, 12);
  const font = '500 48px system-ui, sans-serif';
  context.font = font;
  const width = Math.max(8, ...lines.map((line) => context.measureText(line).width)) + 24;
  canvas.width = Math.min(2048, Math.ceil(width));
  canvas.height = 60 * lines.length;
  context.font = font;
  if (backing) {
    context.fillStyle = 'rgba(12,16,22,0.72)';
    context.roundRect(0, 0, canvas.width, canvas.height, 14);
    context.fill();
  }
  context.fillStyle = color;
  context.textBaseline = 'middle';
  context.textAlign = 'center';
  lines.forEach((line, i) => context.fillText(line, canvas.width / 2, 60 * i + 31));
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = 'srgb';
  const material = new SpriteMaterial({ map: texture, depthTest: !backing, transparent: true });
  const sprite = new Sprite(material);
  sprite.scale.set((height * canvas.width) / 60, (height * canvas.height) / 60, 1);
  material.addEventListener('dispose', () => texture.dispose());
  return sprite;
}

/** Filled polygon inside a closed line, visible from both sides. */
export function flatMaterial(color: Color, alpha: number): MeshBasicMaterial {
  return new MeshBasicMaterial({
    color,
    transparent: alpha < 1,
    opacity: alpha,
    side: DoubleSide,
    depthWrite: alpha >= 1,
  });
}

export function solid(geometry: BufferGeometry, color: Color, alpha: number, pose: Pose): Mesh {
  const mesh = new Mesh(geometry, surface(color, alpha));
  mesh.position.set(...pose.t);
  mesh.quaternion.set(...pose.q);
  return mesh;
}
