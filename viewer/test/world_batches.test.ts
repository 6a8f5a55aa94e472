import { Color, Group, InstancedMesh, Matrix4, Mesh, Vector3 } from 'three';
import { expect, test } from 'vitest';
import { batch } from '../src/displays/world_batches';
import { fade } from '../src/scene/meshes';
import { surface, UNIT_BOX, UNIT_SPHERE } from '../src/scene/shapes';

function part(x: number, geometry = UNIT_BOX as Mesh['geometry'], alpha = 1): Group {
  const group = new Group();
  group.position.x = x;
  const mesh = new Mesh(geometry, surface(new Color(1, 0, 0), alpha));
  mesh.scale.set(2, 1, 1);
  return group.add(mesh);
}

test('opaque parts of one shape are drawn at once, where they are', () => {
  const holder = new Group();
  const parts = [part(1), part(2), part(3, UNIT_BOX, 0.5), part(4, UNIT_SPHERE)];
  holder.add(...parts);
  const batches = () => holder.children.filter((one) => one instanceof InstancedMesh);
  batch(holder, parts);
  expect(parts.map(({ visible }) => visible)).toEqual([false, false, true, true]);
  expect(batches().map(({ count }) => count)).toEqual([2]);
  const matrix = new Matrix4();
  batches()[0]!.getMatrixAt(1, matrix);
  // The corner at half a unit, stretched by 2, of the part at x = 2.
  expect(new Vector3(0.5, 0, 0).applyMatrix4(matrix).toArray()).toEqual([3, 0, 0]);
  // One becomes glass: the other is alone, and needs no batch.
  fade((parts[0]!.children[0] as Mesh).material as never, 0.2);
  batch(holder, parts);
  expect(batches()).toEqual([]);
  expect(parts.every(({ visible }) => visible)).toBe(true);
});
