/** Map: one byte texture, coloured by a palette in the shader; updates change only their cells. */
import {
  BufferGeometry,
  DataTexture,
  DoubleSide,
  GLSL3,
  Mesh,
  NearestFilter,
  PlaneGeometry,
  RawShaderMaterial,
  RedFormat,
  RGBAFormat,
  Vector2,
} from 'three';
import type { Message } from '../core/cdr';
import { multiply, type Pose } from '../core/pose';
import { poseOf, seconds, type OccupancyGrid, type OccupancyGridUpdate } from '../core/types';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { alpha, bool, choice, int, note, topic } from './options';
import { palette, SCHEMES, type Scheme } from './palette';
import { t } from '../texts/language.svelte';

const VERTEX = /* glsl */ `
precision highp float;
uniform mat4 modelViewMatrix, projectionMatrix;
in vec3 position; in vec2 uv; out vec2 at;
void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

const FRAGMENT = /* glsl */ `
precision highp float;
uniform sampler2D cells, colors; uniform float alpha;
in vec2 at; out vec4 color;
void main() {
  int cell = int(texture(cells, at).r * 255.0 + 0.5);
  vec4 found = texelFetch(colors, ivec2(cell, 0), 0);
  color = vec4(found.rgb, found.a * alpha);
  if (color.a < 0.004) discard;
}`;

/** Offset by which a map is drawn below other displays in its plane [m]. */
const UNDER_M = 0.002;

class MapDisplay extends Display {
  private grid?: OccupancyGrid;
  private cells?: DataTexture;
  private colors = new DataTexture(new Uint8Array(1024), 256, 1, RGBAFormat);
  private mesh?: Mesh;
  private unsubscribeUpdates?: () => void;
  private placed?: Pose;
  /** True after a jump in a recording, until a map of the new time arrived. */
  private isStale = false;

  override start(): void {
    super.start();
    this.unsubscribeUpdates?.();
    const topic = this.get<string>('Topic');
    if (!topic) return;
    if (!this.values['Update Topic']) {
      this.values['Update Topic'] = `${topic}_updates`;
    }
    const updates = this.get<string>('Update Topic');
    this.unsubscribeUpdates = this.context.subscribe(updates, (message) => this.update(message), {
      isUpdates: true,
    });
  }

  /** Keeps the texture: the map of the new time mostly has the same size. */
  override reset(): void {
    this.isStale = true;
    super.reset();
  }

  protected override receive(message: Message): void {
    this.isStale = false;
    const grid = message as unknown as OccupancyGrid;
    const { width, height, resolution } = grid.info;
    if (!(width > 0 && height > 0 && resolution > 0)) {
      throw new Error(t().displays.emptyMap(width, height, resolution));
    }
    if (grid.data.length < width * height) throw new Error(t().displays.shortMap);
    const most = this.context.stage.renderer.capabilities.maxTextureSize;
    if (Math.max(width, height) > most) {
      throw new Error(t().displays.largeMap(most));
    }
    const old = this.grid?.info;
    const bytes = new Uint8Array(grid.data.buffer, grid.data.byteOffset, width * height);
    // Own copy: updates are written into it.
    const copy = bytes.slice();
    this.grid = { ...grid, data: new Int8Array(copy.buffer) };
    if (this.cells && old?.width === width && old.height === height) {
      (this.cells.image as { data: Uint8Array }).data = copy;
      this.cells.needsUpdate = true;
    } else {
      this.build(copy, width, height);
    }
    this.mesh!.scale.set(width * resolution, height * resolution, 1);
    this.describe();
    this.placed = undefined;
    this.context.stage.invalidate();
  }

  private build(bytes: Uint8Array<ArrayBuffer>, width: number, height: number): void {
    this.clear();
    this.cells = new DataTexture(bytes, width, height, RedFormat);
    this.cells.needsUpdate = true;
    this.colors.magFilter = this.colors.minFilter = NearestFilter;
    const material = new RawShaderMaterial({
      glslVersion: GLSL3,
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: {
        cells: { value: this.cells },
        colors: { value: this.colors },
        alpha: { value: 1 },
      },
      transparent: true,
      depthWrite: false,
      side: DoubleSide,
    });
    const plane = new PlaneGeometry(1, 1).translate(0.5, 0.5, 0);
    this.mesh = new Mesh<BufferGeometry>(plane, material);
    this.mesh.frustumCulled = false;
    this.mesh.userData.inspect = (_i: number, uv?: Vector2) => this.inspect(uv);
    this.mesh.userData.inspectMore = (
      uv: Vector2,
      report: (more: Record<string, string>) => void,
    ) => this.layers(uv, report);
    this.root.add(this.mesh);
    this.applyStyle();
  }

  /** Applies an update of a part of the map. */
  private update(message: Message): void {
    const { grid, cells } = this;
    const change = message as unknown as OccupancyGridUpdate;
    if (!grid || !cells) return;
    const { width, height } = grid.info;
    const { x, y, width: w, height: h, data } = change;
    if (x < 0 || y < 0 || x + w > width || y + h > height || data.length < w * h) {
      this.host.status('Update', 'error', t().displays.updateOutside);
      return;
    }
    if (w === 0 || h === 0) return;
    const bytes = (cells.image as unknown as { data: Uint8Array }).data;
    const patch = new Uint8Array(data.buffer, data.byteOffset, w * h);
    for (let row = 0; row < h; row++) {
      bytes.set(patch.subarray(row * w, (row + 1) * w), (y + row) * width + x);
    }
    this.host.status('Update', 'ok', t().displays.lastUpdate(w, h));
    // A texture that was never drawn is uploaded completely anyway.
    const known = this.context.stage.renderer.properties.get(cells) as { __webglTexture?: unknown };
    if (!known.__webglTexture || cells.version === 0) {
      cells.needsUpdate = true;
    } else {
      const part = new DataTexture(patch, w, h, RedFormat);
      part.needsUpdate = true;
      this.context.stage.renderer.copyTextureToTexture(part, cells, null, new Vector2(x, y));
      part.dispose();
    }
    this.context.stage.invalidate();
  }

  private describe(): void {
    const { info } = this.grid!;
    const { position: p, orientation: q } = info.origin;
    const of = (...all: number[]) => all.map((v) => +v.toFixed(4)).join('; ');
    this.host.note('Resolution', +info.resolution.toFixed(6));
    this.host.note('Width', info.width);
    this.host.note('Height', info.height);
    this.host.note('Position', of(p.x, p.y, p.z));
    this.host.note('Orientation', of(q.x, q.y, q.z, q.w));
  }

  private applyStyle(): void {
    const material = this.mesh?.material as RawShaderMaterial | undefined;
    if (!material) return;
    const isBinary = this.get<boolean>('Binary representation');
    const from = isBinary ? this.get<number>('Binary threshold') : undefined;
    const scheme = this.get<Scheme>('Color Scheme');
    (this.colors.image as { data: Uint8Array }).data = palette(scheme, from) as never;
    this.colors.needsUpdate = true;
    material.uniforms.alpha!.value = this.get('Alpha');
    const behind = this.get<boolean>('Draw Behind');
    // Maps first, costmaps over them, then other displays; objects on a map hide it in either case.
    this.mesh!.renderOrder = behind ? -30 : scheme === 'costmap' ? -10 : -20;
  }

  override changed(path: string): void {
    super.changed(path);
    if (path === 'Topic') this.values['Update Topic'] = `${this.get<string>('Topic')}_updates`;
    if (path === 'Update Topic') this.start();
    this.applyStyle();
  }

  override tick(): void {
    if (this.isStale) {
      this.isStale = false;
      this.clear();
      this.context.stage.invalidate();
    }
    const { grid, mesh } = this;
    if (!grid || !mesh) return;
    const fixed = this.context.fixedFrame();
    const at = this.get<boolean>('Use Timestamp') ? seconds(grid.header.stamp) : undefined;
    const found = this.context.tf.lookup(fixed, grid.header.frame_id, at);
    mesh.visible = found.kind === 'found';
    if (found.kind !== 'found') {
      this.host.status('Transform', 'error', t().displays.noTransform(found.why));
      return;
    }
    const fixedFromMap: Pose = multiply(found.pose, poseOf(grid.info.origin));
    if (this.placed && isSame(this.placed, fixedFromMap)) return;
    this.placed = fixedFromMap;
    this.host.status('Transform', 'ok');
    const [x, y, z] = fixedFromMap.t;
    mesh.position.set(x, y, z - UNDER_M);
    mesh.quaternion.set(...fixedFromMap.q);
    this.context.stage.invalidate();
  }

  private inspect(uv?: Vector2): Record<string, string> {
    const { grid } = this;
    if (!grid || !uv) return {};
    const { resolution, origin } = grid.info;
    const { i, j } = cellOf(grid, uv);
    const value = this.valueAt(uv);
    return {
      [t().found.map]: this.get('Topic'),
      [t().found.cell]: `${i}, ${j}`,
      [t().found.center]:
        `${(origin.position.x + (i + 0.5) * resolution).toFixed(3)}, ${(origin.position.y + (j + 0.5) * resolution).toFixed(3)} m`,
      [t().found.value]: value === 255 ? t().found.unknownCell : String(value),
      [t().found.meaning]: meaning(value, this.get<Scheme>('Color Scheme')),
    };
  }

  /** Costs of the layers of a costmap in the cell, from the topics that Nav2 publishes beside the master grid. */
  private layers(uv: Vector2, report: (more: Record<string, string>) => void): void {
    const { grid } = this;
    if (!grid || this.get('Color Scheme') !== 'costmap') return;
    const topic = this.get<string>('Topic');
    const base = topic.slice(0, topic.lastIndexOf('/') + 1);
    const isLayer = (name: string) => name.startsWith(base) && /_layer$/.test(name);
    const names = this.context.topicsOfType(MAP).filter(isLayer);
    const sum = this.valueAt(uv);
    const values = new Map<string, number>();
    for (const name of names) {
      const unsubscribe = this.context.subscribe(name, (message) => {
        unsubscribe();
        const layer = message as unknown as OccupancyGrid;
        if (layer.info.width !== grid.info.width || layer.info.height !== grid.info.height) return;
        const value = layer.data[cellOf(grid, uv).at];
        if (value === undefined) return;
        values.set(name.slice(base.length), value);
        const most = Math.max(...values.values());
        const makers = [...values].filter(([, v]) => v === most && v >= 99).map(([n]) => n);
        const why =
          values.size < names.length
            ? t().found.waitingForLayers
            : makers.length > 0 && sum >= 99 && sum !== 255
              ? t().found.markedBy(makers.join(', '))
              : sum > 0 && sum !== 255
                ? t().found.byInflation
                : t().found.unmarked;
        const all = [...values].map(([n, v]) => [
          t().found.layer(n),
          v < 0 ? t().found.unknown : String(v),
        ]);
        report({ ...Object.fromEntries(all), [t().found.why]: why });
      });
      // A layer that publishes nothing is not waited for.
      setTimeout(unsubscribe, 3000);
    }
  }

  private valueAt(uv: Vector2): number {
    const { data } = this.cells!.image as unknown as { data: Uint8Array };
    return data[cellOf(this.grid!, uv).at]!;
  }

  override clear(): void {
    if (this.isStale) return;
    if (this.mesh) dispose(this.mesh);
    this.cells?.dispose();
    this.cells = undefined;
    this.mesh = undefined;
  }

  override stop(): void {
    this.unsubscribeUpdates?.();
    this.cells?.dispose();
    this.colors.dispose();
    super.stop();
  }
}

const isSame = (a: Pose, b: Pose) =>
  a.t.every((v, i) => v === b.t[i]) && a.q.every((v, i) => v === b.q[i]);

function cellOf({ info: { width, height } }: OccupancyGrid, uv: Vector2) {
  const i = Math.min(width - 1, Math.floor(uv.x * width));
  const j = Math.min(height - 1, Math.floor(uv.y * height));
  return { i, j, at: j * width + i };
}

/** Meaning of the value of an OccupancyGrid cell. Nav2 publishes costs scaled to 0..100. */
export function meaning(value: number, scheme: Scheme): string {
  if (value === 255) return t().found.neverObserved;
  if (scheme !== 'costmap') return t().found.occupied(value);
  if (value === 0) return t().found.free;
  if (value === 100) return t().found.lethal;
  if (value === 99) return t().found.inscribed;
  // nav2_costmap_2d: 1 + 97 (cost - 1) / 251.
  const cost = Math.round(1 + ((value - 1) * 251) / 97);
  return t().found.cost(cost);
}

const MAP = ['nav_msgs/msg/OccupancyGrid'];

export const map: Kind = {
  class: 'rviz_default_plugins/Map',
  also: ['rviz/Map'],
  title: 'Map',
  get help() {
    return t().displayHelp.map;
  },
  types: MAP,
  options: [
    ...topic('Topic', '', MAP, { isFiltered: true }),
    ...topic('Update Topic', '', ['map_msgs/msg/OccupancyGridUpdate']),
    alpha('Alpha', 0.7),
    choice('Color Scheme', 'map', SCHEMES),
    bool('Draw Behind', false),
    bool('Use Timestamp', false),
    bool('Binary representation', false),
    int('Binary threshold', 100, {
      min: 0,
      max: 255,
      when: (v) => v['Binary representation'] === true,
    }),
    note('Resolution'),
    note('Width'),
    note('Height'),
    note('Position'),
    note('Orientation'),
  ],
  make: (...all) => new MapDisplay(...all),
};
