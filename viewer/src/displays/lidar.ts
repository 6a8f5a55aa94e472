/** Visualize Lidar: rays, points or triangles of a scan, as in Gazebo. */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
} from 'three';
import type { Pose } from '../core/pose';
import type { LaserScan } from '../core/types';
import { segments } from '../scene/shapes';
import { FramedDisplay, type Kind } from './display';
import { bool, choice, int, note, topic } from './options';
import { t } from '../texts/language.svelte';

const BLUE = new Color(0, 0, 1);
const BLACK = new Color(0, 0, 0);

export interface Fans {
  /** Corners of triangles, three numbers per corner. */
  hit: number[];
  open: number[];
  deadZone: number[];
  /** End points of lines. */
  rays: number[];
  openRays: number[];
  points: number[];
}

/**
 * Geometry of a scan. As in gz-sim's plugin, a beam has no hit if its range is infinite (of either sign) or at
 * least `range_max`; it is then drawn up to `range_max`. Rays begin at `range_min`; nearer than that is the
 * deadZone zone.
 */
export function fansOf(scan: LaserScan, showsOpen: boolean): Fans {
  const out: Fans = { hit: [], open: [], deadZone: [], rays: [], openRays: [], points: [] };
  const { range_min: min, range_max: max } = scan;
  let last: { near: number[]; far: number[]; isOpen: boolean } | undefined;
  for (let i = 0; i < scan.ranges.length; i++) {
    const range = scan.ranges[i]!;
    const isOpen = !Number.isFinite(range) || range >= max;
    const angle = scan.angle_min + i * scan.angle_increment;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const reach = isOpen ? max : range;
    const near = [c * min, s * min, 0];
    const far = [c * reach, s * reach, 0];
    if (!isOpen) out.points.push(...far);
    if (!isOpen) out.rays.push(...near, ...far);
    else if (showsOpen) out.openRays.push(...near, ...far);
    if (last) {
      out.deadZone.push(0, 0, 0, ...last.near, ...near);
      const isStripOpen = isOpen || last.isOpen;
      if (!isStripOpen || showsOpen) {
        const strip = isStripOpen ? out.open : out.hit;
        strip.push(...last.near, ...last.far, ...far, ...last.near, ...far, ...near);
      }
    }
    last = { near, far, isOpen };
  }
  return out;
}

function strip(corners: number[], color: Color, transparency: number): Mesh {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  const material = new MeshBasicMaterial({
    color,
    transparent: true,
    opacity: 1 - transparency,
    side: DoubleSide,
    depthWrite: false,
  });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  mesh.renderOrder = 5;
  return mesh;
}

class LidarDisplay extends FramedDisplay<LaserScan> {
  protected override show(scan: LaserScan, fixedFromFrame: Pose): void {
    this.empty();
    const fans = fansOf(scan, this.get('Show Non Hitting Rays'));
    const group = new Group();
    const type = this.get<string>('Visual Type');
    if (type === 'Triangles') {
      if (fans.hit.length) group.add(strip(fans.hit, BLUE, 0.4));
      if (fans.open.length) group.add(strip(fans.open, BLUE, 0.8));
      if (fans.deadZone.length) group.add(strip(fans.deadZone, BLACK, 0.4));
    }
    if (type === 'Rays') {
      group.add(segments(fans.rays, BLUE), segments(fans.openRays, BLUE, 0.2));
      if (fans.deadZone.length) group.add(strip(fans.deadZone, BLACK, 0.4));
    }
    if (type !== 'Triangles') {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(new Float32Array(fans.points), 3));
      const size = this.get<number>('Point Size');
      const points = new Points(
        geometry,
        new PointsMaterial({ color: BLUE, size, sizeAttenuation: false }),
      );
      points.frustumCulled = false;
      if (type === 'Points') group.add(points);
    }
    group.visible = this.get('Display Lidar Visual');
    this.root.add(group);
    this.put(group, fixedFromFrame);
    this.host.note('Minimum Range', +scan.range_min.toFixed(3));
    this.host.note('Maximum Range', +scan.range_max.toFixed(3));
    const hitCount = fans.points.length / 3;
    this.host.status('Rays', 'ok', t().displays.rays(hitCount, scan.ranges.length));
  }
}

const SCAN = ['sensor_msgs/msg/LaserScan'];

export const visualizeLidar: Kind = {
  class: 'periplus/VisualizeLidar',
  title: 'Visualize Lidar',
  get help() {
    return t().displayHelp.lidar;
  },
  types: [],
  options: [
    ...topic('Topic', '', SCAN, { reliability: 'Best Effort' }),
    choice('Visual Type', 'Triangles', ['Rays', 'Points', 'Triangles']),
    int('Point Size', 1, { min: 1, max: 20, when: (v) => v['Visual Type'] === 'Points' }),
    bool('Show Non Hitting Rays', true),
    bool('Display Lidar Visual', true),
    note('Minimum Range'),
    note('Maximum Range'),
  ],
  make: (...all) => new LidarDisplay(...all),
};
