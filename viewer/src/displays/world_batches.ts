/**
 * Batches: the boxes, balls and cylinders of a link that are opaque, each kind drawn at once.
 *
 * A hall has hundreds of parts, and without a GPU each call to draw costs more than the triangles of a part.
 */
import { Color, type Group, InstancedMesh, Matrix4, Mesh, type MeshLambertMaterial } from 'three';
import { instances, surface, UNIT_BOX, UNIT_CYLINDER, UNIT_SPHERE } from '../scene/shapes';
import { dispose } from '../scene/stage';

const SHAPES = [UNIT_BOX, UNIT_CYLINDER, UNIT_SPHERE] as const;

type Solid = Mesh<(typeof SHAPES)[number], MeshLambertMaterial>;

export const isBatch = (object: { userData: object }): boolean => 'isBatch' in object.userData;

/** The only mesh of a part, if it can be drawn with others. */
function solidOf(part: Group): Solid | undefined {
  const [mesh, ...more] = part.children;
  if (!(mesh instanceof Mesh) || mesh instanceof InstancedMesh || more.length > 0) return undefined;
  const solid = mesh as Solid;
  const { map, transparent } = solid.material;
  return SHAPES.includes(solid.geometry) && !map && !transparent ? solid : undefined;
}

/** Draws the parts of a holder in batches where it can, and hides those; removes the batches that were there. */
export function batch(holder: Group, parts: readonly Group[]): void {
  for (const old of holder.children.filter(isBatch)) dispose(old);
  const alike = new Map<string, { part: Group; solid: Solid }[]>();
  for (const part of parts) {
    part.visible = true;
    const solid = solidOf(part);
    if (!solid) continue;
    const key = `${SHAPES.indexOf(solid.geometry)} ${solid.castShadow} ${solid.receiveShadow}`;
    alike.set(key, [...(alike.get(key) ?? []), { part, solid }]);
  }
  for (const found of alike.values()) {
    if (found.length < 2) continue;
    const { geometry, castShadow, receiveShadow } = found[0]!.solid;
    const matrices = found.map(({ part, solid }) => {
      part.updateMatrix();
      solid.updateMatrix();
      part.visible = false;
      return new Matrix4().multiplyMatrices(part.matrix, solid.matrix);
    });
    const colors = found.map(({ solid }) => solid.material.color);
    const all = instances(geometry, surface(new Color(0xffffff)), matrices, colors);
    Object.assign(all, { castShadow, receiveShadow, frustumCulled: true });
    all.userData.isBatch = true;
    holder.add(all);
  }
}
