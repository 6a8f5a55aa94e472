/** VoxelGrid: cells marked by Nav2's voxel layer. */
import { Color, Matrix4 } from 'three';
import type { Pose } from '../core/pose';
import type { Header, Point } from '../core/types';
import { colorOf, instances, matrixOf, surface, UNIT_BOX } from '../scene/shapes';
import { FramedDisplay, type Kind } from './display';
import { alpha, bool, choice, color, topic } from './options';
import { t } from '../texts/language.svelte';

interface VoxelGrid {
  header: Header;
  data: Uint32Array;
  origin: Point;
  resolutions: Point;
  size_x: number;
  size_y: number;
  size_z: number;
}

/**
 * Centers of the cells with a state. A column is one 32-bit word: the upper half has the bits of marked cells,
 * the lower half those of cells that are not known to be free (nav2_voxel_grid).
 */
export function voxels(grid: VoxelGrid, want: 'marked' | 'unknown'): [number, number, number][] {
  const out: [number, number, number][] = [];
  const { size_x: nx, size_y: ny, size_z: nz, origin: o, resolutions: r } = grid;
  for (let y = 0; y < ny; y++) {
    for (let x = 0; x < nx; x++) {
      const column = grid.data[y * nx + x] ?? 0;
      if (column === 0) continue;
      for (let z = 0; z < Math.min(nz, 16); z++) {
        const bits = ((column >>> z) & 1) + ((column >>> (z + 16)) & 1);
        if (bits !== (want === 'marked' ? 2 : 1)) continue;
        out.push([o.x + (x + 0.5) * r.x, o.y + (y + 0.5) * r.y, o.z + (z + 0.5) * r.z]);
      }
    }
  }
  return out;
}

const HIGH = new Color('#f2b134');

class VoxelGridDisplay extends FramedDisplay<VoxelGrid> {
  protected override show(message: VoxelGrid, fixedFromFrame: Pose): void {
    this.empty();
    const { resolutions: r } = message;
    const cells = voxels(message, this.get<string>('Cells') === 'Unknown' ? 'unknown' : 'marked');
    const low = colorOf(this.get('Color'));
    const top = message.origin.z + message.size_z * r.z;
    const matrices = cells.map((at) => new Matrix4().makeScale(r.x, r.y, r.z).setPosition(...at));
    const colors = cells.map((at) =>
      this.get('Color by height') ? low.clone().lerp(HIGH, at[2] / Math.max(top, 1e-6)) : low,
    );
    const opacity = this.get<number>('Alpha');
    const mesh = instances(UNIT_BOX, surface(new Color(0xffffff), opacity), matrices, colors);
    this.root.add(mesh);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(matrixOf(fixedFromFrame));
    this.host.status('Voxels', 'ok', t().displays.cells(cells.length));
  }
}

const VOXELS = ['nav2_msgs/msg/VoxelGrid'];

export const voxelGrid: Kind = {
  class: 'periplus/VoxelGrid',
  title: 'VoxelGrid',
  get help() {
    return t().displayHelp.voxels;
  },
  types: VOXELS,
  options: [
    ...topic('Topic', '', VOXELS, { isFiltered: true }),
    choice('Cells', 'Marked', ['Marked', 'Unknown']),
    color('Color', '64; 126; 201'),
    bool('Color by height', true),
    alpha('Alpha', 0.9),
  ],
  make: (...all) => new VoxelGridDisplay(...all),
};
