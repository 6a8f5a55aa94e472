/** TF, Grid and Axes. */
import { Group, LineSegments, Mesh } from 'three';
import { multiply, type Pose } from '../core/pose';
import type { Message } from '../core/cdr';
import {
  arrowGeometry,
  axesGeometry,
  axesMaterial,
  colorOf,
  label,
  matrixOf,
  polyline,
  segments,
  surface,
} from '../scene/shapes';
import { dispose } from '../scene/stage';
import { Color, Matrix4, Quaternion, Vector3 } from 'three';
import { Display, type Kind } from './display';
import { alpha, bool, choice, color, frame, int, number, text, vector } from './options';
import { t } from '../texts/language.svelte';

interface Shown {
  axes: Mesh;
  name?: ReturnType<typeof label>;
  arrow?: Mesh;
}

const ARROW_COLOR = new Color('#d79a2b');

class TfDisplay extends Display {
  private shown = new Map<string, Shown>();
  private version = -1;
  private fixed = '';
  private lookedMs = -Infinity;

  protected override receive(_message: Message): void {}

  override changed(path: string): void {
    if (path === 'Frames/All Enabled') this.toggleAll('Frames/', path);
    this.clear();
    super.changed(path);
  }

  override clear(): void {
    for (const name of [...this.shown.keys()]) this.drop(name);
    this.version = -1;
  }

  override moved(): void {
    this.version = -1;
  }

  /** Frames that are missing at the new time are removed by the next frame. */
  override reset(): void {
    this.version = -1;
  }

  private drop(name: string): void {
    const entry = this.shown.get(name)!;
    for (const part of [entry.axes, entry.name, entry.arrow]) if (part) dispose(part);
    this.shown.delete(name);
  }

  private wanted(name: string): boolean {
    if (this.values[`Frames/${name}`] === false) return false;
    const allowed = pattern(this.get('Filter (whitelist)'));
    const denied = pattern(this.get('Filter (blacklist)'));
    return (!allowed || allowed.test(name)) && !denied?.test(name);
  }

  override tick(nowMs: number): void {
    const { tf } = this.context;
    const fixed = this.context.fixedFrame();
    const isNew = tf.version !== this.version || fixed !== this.fixed;
    if (!isNew || nowMs - this.lookedMs < this.get<number>('Update Interval') * 1000) return;
    this.version = tf.version;
    this.fixed = fixed;
    this.lookedMs = nowMs;
    const timeoutMs = this.get<number>('Frame Timeout') * 1000;
    const all = tf.names();
    for (const name of all) {
      if (!(`Frames/${name}` in this.values)) {
        this.host.note(`Frames/${name}`, this.get('Frames/All Enabled'));
      }
    }
    const names = all.filter((name) => this.wanted(name));
    for (const name of this.shown.keys()) if (!names.includes(name)) this.drop(name);
    let lost = 0;
    for (const name of names) {
      const found = tf.lookup(fixed, name);
      const age = tf.ageMs(name, this.context.arrivalMs?.() ?? nowMs);
      if (found.kind !== 'found' || age > timeoutMs) {
        if (this.shown.has(name)) this.drop(name);
        lost++;
        continue;
      }
      this.place(name, found.pose, age > timeoutMs / 3);
    }
    this.host.status(
      'Frames',
      lost > 0 ? 'warn' : 'ok',
      t().displays.frames(names.length - lost, lost, fixed),
    );
    this.context.stage.invalidate();
  }

  private place(name: string, pose: Pose, isOld: boolean): void {
    const scale = this.get<number>('Marker Scale');
    let entry = this.shown.get(name);
    if (!entry) {
      entry = { axes: new Mesh(axesGeometry(0.2, 0.012), axesMaterial(0.999)) };
      entry.axes.userData.inspect = () => ({
        [t().found.frame]: name,
        [t().found.parent]: this.context.tf.parentOf(name) ?? t().found.none,
      });
      this.root.add(entry.axes);
      if (this.get('Show Names')) {
        entry.name = label(name, 0.075 * scale);
        // Names are drawn over the geometry that surrounds their frames.
        entry.name.material.depthTest = false;
        entry.name.renderOrder = 40;
        this.root.add(entry.name);
      }
      this.shown.set(name, entry);
    }
    entry.axes.visible = this.get('Show Axes');
    (entry.axes.material as { opacity: number }).opacity = isOld ? 0.35 : 0.999;
    entry.axes.matrixAutoUpdate = false;
    entry.axes.matrix.copy(matrixOf(pose, [scale, scale, scale]));
    entry.name?.position.set(pose.t[0], pose.t[1], pose.t[2] + 0.07 * scale);
    if (this.get('Show Arrows')) this.arrow(name, entry, pose);
  }

  /** Arrow from a frame to its parent. */
  private arrow(name: string, entry: Shown, pose: Pose): void {
    const parent = this.context.tf.parentOf(name);
    const found = parent ? this.context.tf.lookup(this.context.fixedFrame(), parent) : undefined;
    if (found?.kind !== 'found') return;
    const from = new Vector3(...pose.t);
    const toParent = new Vector3(...found.pose.t).sub(from);
    const length = toParent.length();
    entry.arrow ??= this.makeArrow();
    entry.arrow.visible = length > 0.01;
    if (length <= 0.01) return;
    const turn = new Quaternion().setFromUnitVectors(
      new Vector3(1, 0, 0),
      toParent.divideScalar(length),
    );
    const thick = Math.min(1, length / 0.4) * this.get<number>('Marker Scale');
    entry.arrow.matrix = new Matrix4().compose(from, turn, new Vector3(length, thick, thick));
  }

  private makeArrow(): Mesh {
    const arrow = new Mesh(arrowGeometry(0.85, 0.004, 0.15, 0.018), surface(ARROW_COLOR));
    arrow.matrixAutoUpdate = false;
    this.root.add(arrow);
    return arrow;
  }
}

function pattern(written: string): RegExp | undefined {
  if (!written) return undefined;
  try {
    return new RegExp(written);
  } catch {
    return undefined;
  }
}

class GridDisplay extends Display {
  private lines = new Group();

  protected override receive(): void {}

  override start(): void {
    this.root.add(this.lines);
    this.build();
  }

  override changed(path: string): void {
    this.build();
    super.changed(path);
  }

  private build(): void {
    for (const child of [...this.lines.children]) dispose(child);
    const count = Math.min(500, Math.max(1, this.get<number>('Plane Cell Count')));
    const layers = Math.min(50, Math.max(0, this.get<number>('Normal Cell Count')));
    const cell = this.get<number>('Cell Size');
    const half = (count * cell) / 2;
    const paint = colorOf(this.get('Color'));
    const opacity = this.get<number>('Alpha');
    const points: number[] = [];
    for (let k = 0; k <= layers; k++) {
      const z = (k - layers / 2) * cell;
      for (let i = 0; i <= count; i++) {
        const at = i * cell - half;
        points.push(at, -half, z, at, half, z, -half, at, z, half, at, z);
      }
    }
    for (let i = 0; layers > 0 && i <= count; i++) {
      for (let j = 0; j <= count; j++) {
        const [x, y, z] = [i * cell - half, j * cell - half, (layers * cell) / 2];
        points.push(x, y, -z, x, y, z);
      }
    }
    if (this.get('Line Style') === 'Billboards') {
      const width = this.get<number>('Line Style/Line Width');
      for (let i = 0; i < points.length; i += 6) {
        this.lines.add(polyline(points.slice(i, i + 6), paint, opacity, width));
      }
    } else {
      const grid: LineSegments = segments(points, paint, opacity);
      grid.renderOrder = -5;
      (grid.material as { depthWrite: boolean }).depthWrite = false;
      this.lines.add(grid);
    }
    const plane = this.get<string>('Plane');
    this.lines.rotation.set(plane === 'XZ' ? Math.PI / 2 : 0, plane === 'YZ' ? Math.PI / 2 : 0, 0);
  }

  override tick(): void {
    const found = this.context.tf.lookup(
      this.context.fixedFrame(),
      place(this, this.context.fixedFrame()),
    );
    this.root.visible = found.kind === 'found';
    if (found.kind !== 'found') {
      this.host.status('Transform', 'error', found.why);
      return;
    }
    this.host.status('Transform', 'ok');
    const offset = ['X', 'Y', 'Z'].map((axis) => this.get<number>(`Offset/${axis}`));
    const pose = multiply(found.pose, { t: offset as never, q: [0, 0, 0, 1] });
    this.root.position.set(...pose.t);
    this.root.quaternion.set(...pose.q);
  }
}

function place(display: Display, fixed: string): string {
  const name = (display as unknown as { values: Record<string, string> }).values['Reference Frame'];
  return !name || name === '<Fixed Frame>' ? fixed : name;
}

class AxesDisplay extends Display {
  protected override receive(): void {}

  override start(): void {
    this.empty();
    const mesh = new Mesh(
      axesGeometry(this.get('Length'), this.get('Radius')),
      axesMaterial(Math.min(0.999, this.get('Alpha'))),
    );
    this.root.add(mesh);
  }

  override changed(path: string): void {
    this.start();
    super.changed(path);
  }

  override tick(): void {
    const found = this.context.tf.lookup(
      this.context.fixedFrame(),
      place(this, this.context.fixedFrame()),
    );
    this.root.visible = found.kind === 'found';
    if (found.kind === 'found') this.put(this.root, found.pose);
  }
}

export const tf: Kind = {
  class: 'rviz_default_plugins/TF',
  also: ['rviz/TF'],
  title: 'TF',
  get help() {
    return t().displayHelp.tf;
  },
  types: ['tf2_msgs/msg/TFMessage'],
  options: [
    bool('Show Names', false),
    bool('Show Axes', true),
    bool('Show Arrows', true),
    number('Marker Scale', 1, { min: 0.01, step: 0.1 }),
    number('Update Interval', 0, { min: 0, step: 0.1 }),
    number('Frame Timeout', 15, { min: 1 }),
    text('Filter (whitelist)', ''),
    text('Filter (blacklist)', ''),
    bool('Frames/All Enabled', true),
  ],
  make: (...all) => new TfDisplay(...all),
};

export const grid: Kind = {
  class: 'rviz_default_plugins/Grid',
  also: ['rviz/Grid'],
  title: 'Grid',
  get help() {
    return t().displayHelp.grid;
  },
  types: [],
  options: [
    frame('Reference Frame', '<Fixed Frame>'),
    int('Plane Cell Count', 10, { min: 1, max: 500 }),
    int('Normal Cell Count', 0, { min: 0, max: 50 }),
    number('Cell Size', 1, { min: 0.01, step: 0.5 }),
    choice('Line Style', 'Lines', ['Lines', 'Billboards']),
    number('Line Style/Line Width', 0.03, {
      min: 0.001,
      step: 0.01,
      when: (v) => v['Line Style'] === 'Billboards',
    }),
    color('Color', '160; 160; 164'),
    alpha('Alpha', 0.5),
    choice('Plane', 'XY', ['XY', 'XZ', 'YZ']),
    ...vector('Offset', [0, 0, 0]),
  ],
  make: (...all) => new GridDisplay(...all),
};

export const axes: Kind = {
  class: 'rviz_default_plugins/Axes',
  also: ['rviz/Axes'],
  title: 'Axes',
  get help() {
    return t().displayHelp.axes;
  },
  types: [],
  options: [
    frame('Reference Frame', '<Fixed Frame>'),
    number('Length', 1, { min: 0.01, step: 0.1 }),
    number('Radius', 0.1, { min: 0.001, step: 0.01 }),
    alpha('Alpha', 1),
  ],
  make: (...all) => new AxesDisplay(...all),
};
