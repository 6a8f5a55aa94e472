/** Difference of two occupancy grids: cells that are occupied in the first, in the second, or in both. */
import {
  DataTexture,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  PlaneGeometry,
  RGBAFormat,
} from 'three';
import type { Message } from '../core/cdr';
import { inverse, multiply, type Pose } from '../core/pose';
import { poseOf, type OccupancyGrid } from '../core/types';
import { colorOf } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { alpha, color, int, topic } from './options';
import { t } from '../texts/language.svelte';

export type Cell = 'first' | 'second' | 'both' | 'none';

/** Grid over both maps with the cells of the first. */
export interface Difference {
  width: number;
  height: number;
  /** Cell of the first map's grid at the lower left corner. */
  fromX: number;
  fromY: number;
  cells: Uint8Array;
  counts: { first: number; second: number; both: number };
}

export const CELLS: readonly Cell[] = ['none', 'first', 'second', 'both'];
/** Largest grid of a difference [cells]. */
const MAX_CELLS = 16_000_000;

/** `firstFromSecond`: pose of the second map's origin, in the frame of the first map's origin. */
export function differenceOf(
  first: OccupancyGrid,
  second: OccupancyGrid,
  firstFromSecond: Pose,
  occupiedFrom: number,
): Difference {
  const { width: w1, height: h1, resolution } = first.info;
  const { width: w2, height: h2, resolution: r2 } = second.info;
  const corners = [
    [0, 0],
    [w2 * r2, 0],
    [0, h2 * r2],
    [w2 * r2, h2 * r2],
  ].map(([x, y]) => multiply(firstFromSecond, { t: [x!, y!, 0], q: [0, 0, 0, 1] }).t);
  const slack = 1e-6;
  const low = (axis: 0 | 1) =>
    Math.min(0, ...corners.map((c) => Math.floor(c[axis] / resolution + slack)));
  const high = (axis: 0 | 1, own: number) =>
    Math.max(own, ...corners.map((c) => Math.ceil(c[axis] / resolution - slack)));
  const [fromX, fromY] = [low(0), low(1)];
  const [width, height] = [high(0, w1) - fromX, high(1, h1) - fromY];
  if (width * height > MAX_CELLS) {
    throw new Error(t().mapDifference.tooFarApart(width, height));
  }
  const cells = new Uint8Array(width * height);
  const counts = { first: 0, second: 0, both: 0 };
  const secondFromFirst = inverse(firstFromSecond);
  const origin = multiply(secondFromFirst, { t: [0, 0, 0], q: [0, 0, 0, 1] }).t;
  const alongX = multiply(secondFromFirst, { t: [1, 0, 0], q: [0, 0, 0, 1] }).t;
  const alongY = multiply(secondFromFirst, { t: [0, 1, 0], q: [0, 0, 0, 1] }).t;
  const isOccupied = (grid: OccupancyGrid, x: number, y: number) => {
    if (x < 0 || y < 0 || x >= grid.info.width || y >= grid.info.height) return false;
    const value = grid.data[y * grid.info.width + x]!;
    return value >= occupiedFrom && value <= 100;
  };
  for (let j = 0; j < height; j++) {
    for (let i = 0; i < width; i++) {
      const [x, y] = [i + fromX, j + fromY];
      const [mx, my] = [(x + 0.5) * resolution, (y + 0.5) * resolution];
      const u = origin[0] + mx * (alongX[0] - origin[0]) + my * (alongY[0] - origin[0]);
      const v = origin[1] + mx * (alongX[1] - origin[1]) + my * (alongY[1] - origin[1]);
      const a = isOccupied(first, x, y);
      const b = isOccupied(second, Math.floor(u / r2), Math.floor(v / r2));
      if (!a && !b) continue;
      const kind = a && b ? 'both' : a ? 'first' : 'second';
      counts[kind]++;
      cells[j * width + i] = CELLS.indexOf(kind);
    }
  }
  return { width, height, fromX, fromY, cells, counts };
}

class MapDifferenceDisplay extends Display {
  private first?: OccupancyGrid;
  private second?: OccupancyGrid;
  private unsubscribeSecond?: () => void;
  private mesh?: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private key = '';
  private isChanged = false;

  override start(): void {
    super.start();
    this.unsubscribeSecond?.();
    const second = this.get<string>('Second Topic');
    if (!second) {
      this.host.status('Second topic', 'warn', t().displays.noTopic);
      return;
    }
    this.host.status('Second topic', 'warn', t().displays.noMessage(second));
    this.unsubscribeSecond = this.context.subscribe(second, (message) => {
      this.second = message as unknown as OccupancyGrid;
      this.host.status('Second topic', 'ok');
      this.isChanged = true;
    });
  }

  protected override receive(message: Message): void {
    this.first = message as unknown as OccupancyGrid;
    this.isChanged = true;
  }

  override changed(path: string): void {
    super.changed(path);
    if (path === 'Second Topic') this.start();
    this.isChanged = true;
  }

  override moved(): void {
    this.isChanged = true;
  }

  override reset(): void {
    this.first = this.second = undefined;
    super.reset();
    const second = this.get<string>('Second Topic');
    if (second) this.host.status('Second topic', 'warn', t().replayTime.noMessageAtTime(second));
  }

  override tick(): void {
    const { first, second } = this;
    if (!first || !second) {
      this.clear();
      return;
    }
    const { tf } = this.context;
    const firstFrame = first.header.frame_id;
    const tie = tf.lookup(firstFrame, second.header.frame_id);
    const fixed = tf.lookup(this.context.fixedFrame(), firstFrame);
    if (tie.kind !== 'found' || fixed.kind !== 'found') {
      const why = tie.kind !== 'found' ? tie.why : fixed.kind !== 'found' ? fixed.why : '';
      this.host.status('Transform', 'error', t().displays.noTransform(why));
      this.clear();
      return;
    }
    this.host.status('Transform', 'ok');
    const firstOrigin = poseOf(first.info.origin);
    const secondOrigin = multiply(tie.pose, poseOf(second.info.origin));
    const firstFromSecond = multiply(inverse(firstOrigin), secondOrigin);
    const key = JSON.stringify([firstFromSecond, fixed.pose, first.info.origin]);
    if (!this.isChanged && key === this.key) return;
    this.isChanged = false;
    this.key = key;
    try {
      this.draw(first, second, firstFromSecond, multiply(fixed.pose, firstOrigin));
      this.host.status('Maps', 'ok');
    } catch (error) {
      this.host.status('Maps', 'error', (error as Error).message);
    }
  }

  private draw(
    first: OccupancyGrid,
    second: OccupancyGrid,
    firstFromSecond: Pose,
    fixedFromFirst: Pose,
  ): void {
    const found = differenceOf(first, second, firstFromSecond, this.get('Occupied from'));
    this.clear();
    const { width, height, cells, counts } = found;
    const colors = ['First Color', 'Second Color', 'Both Color'].map((path) => {
      const hex = colorOf(this.get(path)).getHex();
      return [(hex >> 16) & 255, (hex >> 8) & 255, hex & 255];
    });
    const pixels = new Uint8Array(width * height * 4);
    for (let i = 0; i < cells.length; i++) {
      const rgb = cells[i] ? colors[cells[i]! - 1] : undefined;
      if (rgb) pixels.set([...rgb, 255], i * 4);
    }
    const texture = new DataTexture(pixels, width, height, RGBAFormat);
    texture.magFilter = texture.minFilter = NearestFilter;
    texture.colorSpace = 'srgb';
    texture.needsUpdate = true;
    const material = new MeshBasicMaterial({
      map: texture,
      transparent: true,
      opacity: this.get<number>('Alpha'),
      depthWrite: false,
      side: DoubleSide,
    });
    const { resolution } = first.info;
    const plane = new PlaneGeometry(width * resolution, height * resolution).translate(
      (found.fromX + width / 2) * resolution,
      (found.fromY + height / 2) * resolution,
      0.01,
    );
    this.mesh = new Mesh(plane, material);
    this.mesh.renderOrder = -5;
    this.root.add(this.mesh);
    this.put(this.mesh, fixedFromFirst);
    const { first: inFirst, second: inSecond, both } = counts;
    this.host.status('Cells', 'ok', t().mapDifference.cells(inFirst, inSecond, both));
  }

  override clear(): void {
    if (!this.mesh) return;
    this.mesh.material.map?.dispose();
    dispose(this.mesh);
    this.mesh = undefined;
    this.key = '';
    this.context.stage.invalidate();
  }

  override stop(): void {
    this.unsubscribeSecond?.();
    super.stop();
  }
}

const MAP = ['nav_msgs/msg/OccupancyGrid'];

export const mapDifference: Kind = {
  class: 'periplus/MapDifference',
  title: 'MapDifference',
  get help() {
    return t().mapDifference.help;
  },
  types: [],
  options: [
    ...topic('Topic', '', MAP),
    { path: 'Second Topic', kind: 'topic', default: '', types: MAP },
    int('Occupied from', 65, { min: 1, max: 100 }),
    color('First Color', '230; 60; 60'),
    color('Second Color', '50; 120; 255'),
    color('Both Color', '120; 120; 120'),
    alpha('Alpha', 1),
  ],
  make: (...all) => new MapDifferenceDisplay(...all),
};
