/** Shapes of visualization_msgs/Marker by type. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  Mesh,
  type MeshLambertMaterial,
  type Object3D,
} from 'three';
import type { Color as ColorMessage, Marker, Point } from '../core/types';
import { Cloud } from '../scene/cloud';
import { copyOf, type MeshLibrary } from '../scene/meshes';
import {
  arrowGeometry,
  flatMaterial,
  instances,
  label,
  polyline,
  segments,
  surface,
  UNIT_BOX,
  UNIT_CYLINDER,
  UNIT_SPHERE,
} from '../scene/shapes';
import { Quaternion, Vector3 } from 'three';
import { t } from '../texts/language.svelte';

/**
 * Width up to which a line is drawn one pixel wide [m]: a controller publishes hundreds of such lines, which would
 * otherwise take longer than a frame.
 */
const THIN_M = 0.015;

const paintOf = (c: ColorMessage) => new Color().setRGB(c.r, c.g, c.b, 'srgb');
const flat = (points: Point[]) => points.flatMap((p) => [p.x, p.y, p.z]);

/** Object in the frame of the marker's pose. Meshes and textures are added when they are loaded. */
export function markerObject(
  marker: Marker,
  library: MeshLibrary,
  done: (why?: string) => void,
): Object3D {
  const { scale: s, color: c } = marker;
  const paint = paintOf(c);
  const solid = (geometry: BufferGeometry) => {
    const mesh = new Mesh(geometry, surface(paint, c.a));
    if (marker.texture_resource) dress(mesh, marker.texture_resource, library, done);
    mesh.castShadow = c.a > 0.9;
    mesh.receiveShadow = true;
    mesh.scale.set(s.x, s.y, s.z);
    return mesh;
  };
  switch (marker.type) {
    case 0:
      return arrow(marker, paint);
    case 1:
      return solid(UNIT_BOX);
    case 2:
      return solid(UNIT_SPHERE);
    case 3:
      return solid(UNIT_CYLINDER);
    case 4:
      return lines(
        marker,
        flat(marker.points),
        polyline(flat(marker.points), paint, c.a, s.x > THIN_M ? s.x : 0),
      );
    case 5:
      return lines(marker, flat(marker.points), segments(flat(marker.points), paint, c.a));
    case 6:
    case 7:
      return list(marker, marker.type === 6 ? UNIT_BOX : UNIT_SPHERE, paint);
    case 8:
      return points(marker, paint);
    case 9: {
      const text = label(marker.text, s.z, `#${paint.getHexString()}`);
      text.material.opacity = c.a;
      return text;
    }
    case 10:
      return mesh(marker, library, paint, done);
    case 11:
      return triangles(marker, paint);
    default:
      throw new Error(t().displays.markerType(marker.type));
  }
}

/** Applies a texture once it is loaded. */
function dress(
  object: Object3D,
  uri: string,
  library: MeshLibrary,
  done: (why?: string) => void,
): void {
  library.texture(uri).then(
    (texture) => {
      object.traverse((part) => {
        const { material } = part as Mesh;
        for (const one of material ? [material].flat() : []) {
          Object.assign(one as MeshLambertMaterial, { map: texture, needsUpdate: true });
        }
      });
      done();
    },
    (error: Error) => done(`${uri}: ${error.message}`),
  );
}

function arrow(marker: Marker, paint: Color): Object3D {
  const { scale: s, points: p } = marker;
  const material = surface(paint, marker.color.a);
  if (p.length >= 2) {
    // From one point to another: scale has the shaft diameter, head diameter and head length.
    const from = new Vector3(p[0]!.x, p[0]!.y, p[0]!.z);
    const direction = new Vector3(p[1]!.x, p[1]!.y, p[1]!.z).sub(from);
    const length = direction.length();
    const head = s.z > 0 ? Math.min(s.z, length) : length * 0.23;
    const mesh = new Mesh(arrowGeometry(length - head, s.x / 2, head, s.y / 2), material);
    mesh.position.copy(from);
    mesh.quaternion.setFromUnitVectors(new Vector3(1, 0, 0), direction.normalize());
    return mesh;
  }
  // RViz: the shaft takes 0.77 of the length.
  const mesh = new Mesh(arrowGeometry(0.77, 0.25, 0.23, 0.5), material);
  mesh.scale.set(s.x, s.y, s.z);
  return mesh;
}

function lines(marker: Marker, flatPoints: number[], object: Object3D): Object3D {
  if (marker.colors.length !== marker.points.length || flatPoints.length === 0) return object;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(flatPoints), 3));
  geometry.setAttribute('color', new BufferAttribute(colorsOf(marker.colors), 3));
  const plain =
    marker.type === 4
      ? polyline(flatPoints, new Color(0xffffff), marker.color.a)
      : segments(flatPoints, new Color(0xffffff), marker.color.a);
  plain.geometry = geometry as never;
  (plain.material as { vertexColors?: boolean }).vertexColors = true;
  return plain;
}

function colorsOf(colors: ColorMessage[]): Float32Array {
  const out = new Float32Array(colors.length * 3);
  colors.forEach((color, i) => paintOf(color).toArray(out, i * 3));
  return out;
}

function list(marker: Marker, shape: BufferGeometry, paint: Color): InstancedMesh {
  const { scale: s, points: p, colors } = marker;
  const isColored = colors.length === p.length && p.length > 0;
  const none = new Quaternion();
  const size = new Vector3(s.x, s.y, s.z);
  const matrices = p.map((at) => new Matrix4().compose(new Vector3(at.x, at.y, at.z), none, size));
  const material = surface(isColored ? new Color(0xffffff) : paint, marker.color.a || 1);
  return instances(shape, material, matrices, isColored ? colors.map(paintOf) : undefined);
}

function points(marker: Marker, paint: Color): Object3D {
  const { points: p, colors, scale } = marker;
  const isColored = colors.length === p.length && p.length > 0;
  const out = new Float32Array(p.length * 4);
  const words = new Uint32Array(out.buffer);
  p.forEach((at, i) => {
    out.set([at.x, at.y, at.z], i * 4);
    const c = isColored ? colors[i]! : marker.color;
    words[i * 4 + 3] = (to8(c.r) << 16) | (to8(c.g) << 8) | to8(c.b);
  });
  const cloud = new Cloud('Flat Squares');
  cloud.show({ words, stride: 4, count: p.length, xyz: 0, rgb: 3 });
  cloud.setAppearance({
    style: 'Flat Squares',
    sizeM: Math.max(scale.x, scale.y),
    sizePx: 0,
    alpha: marker.color.a || 1,
    coloring: 'rgb',
    color: paint,
    low: 0,
    high: 1,
    isRainbow: false,
    isInverted: false,
    lowColor: paint,
    highColor: paint,
    axis: new Vector3(0, 0, 1),
    axisOffset: 0,
  });
  return cloud.object;
}

const to8 = (v: number) => Math.max(0, Math.min(255, Math.round(v * 255)));

function mesh(
  marker: Marker,
  library: MeshLibrary,
  paint: Color,
  done: (why?: string) => void,
): Object3D {
  const holder = new Group();
  const { scale: s, color: c } = marker;
  holder.scale.set(s.x, s.y, s.z);
  // A marker without a colour keeps the materials of its mesh.
  const isPainted = !marker.mesh_use_embedded_materials || c.r + c.g + c.b + c.a > 0;
  library.load(marker.mesh_resource).then(
    ({ object, problem }) => {
      const own = marker.mesh_use_embedded_materials;
      const copy = copyOf(object, isPainted ? paint : undefined, c.a || 1, isPainted && !own);
      holder.add(copy);
      if (marker.texture_resource) dress(copy, marker.texture_resource, library, done);
      done(problem);
    },
    (error: Error) => done(`${marker.mesh_resource}: ${error.message}`),
  );
  return holder;
}

function triangles(marker: Marker, paint: Color): Object3D {
  const { points: p, colors, scale } = marker;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(flat(p)), 3));
  const isColored = colors.length === p.length && p.length > 0;
  if (isColored) geometry.setAttribute('color', new BufferAttribute(colorsOf(colors), 3));
  const material = flatMaterial(isColored ? new Color(0xffffff) : paint, marker.color.a);
  material.vertexColors = isColored;
  const out = new Mesh(geometry, material);
  out.scale.set(scale.x, scale.y, scale.z);
  return out;
}
