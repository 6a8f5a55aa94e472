/** Odometry, Path, Pose, PoseArray, ParticleCloud, Range. */
import {
  type BufferGeometry,
  Color,
  DoubleSide,
  Group,
  type Material,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
} from 'three';
import type { Message } from '../core/cdr';
import type { Need } from '../core/feed';
import { multiply, type Pose } from '../core/pose';
import { poseOf, type Header, type Odometry, type Path, type PoseMessage } from '../core/types';
import {
  arrowGeometry,
  axesGeometry,
  axesMaterial,
  colorOf,
  flatArrowGeometry,
  instances,
  matrixOf,
  polyline,
  segments,
  surface,
} from '../scene/shapes';
import { dispose } from '../scene/stage';
import { covarianceOf, covarianceOptions, type Get } from './covariance';
import { type Display, FramedDisplay, type Kind } from './display';
import {
  alpha,
  bool,
  choice,
  color,
  int,
  number,
  topic,
  vector,
  type Option,
  type Values,
} from './options';
import { t } from '../texts/language.svelte';

const SHAPES = ['Arrow', 'Axes'];

/** Shape of a pose. RViz uses the same option names with and without "Shape/". */
function shapeOptions(prefix: string): Option[] {
  const isArrow = (v: Values) => v.Shape === 'Arrow';
  const isAxes = (v: Values) => v.Shape === 'Axes';
  const extra = (when: typeof isArrow) => ({ min: 0.001, step: 0.05, when });
  return [
    choice('Shape', 'Arrow', SHAPES),
    color(`${prefix}Color`, '255; 25; 0', { when: isArrow }),
    alpha(`${prefix}Alpha`, 1),
    number(`${prefix}Shaft Length`, 1, extra(isArrow)),
    number(`${prefix}Shaft Radius`, 0.05, extra(isArrow)),
    number(`${prefix}Head Length`, 0.3, extra(isArrow)),
    number(`${prefix}Head Radius`, 0.1, extra(isArrow)),
    number(`${prefix}Axes Length`, 1, extra(isAxes)),
    number(`${prefix}Axes Radius`, 0.1, extra(isAxes)),
  ];
}

function shapeOf(get: Get, prefix: string): { geometry: BufferGeometry; material: Material } {
  const opacity = get<number>(`${prefix}Alpha`);
  if (get('Shape') === 'Axes') {
    const geometry = axesGeometry(get(`${prefix}Axes Length`), get(`${prefix}Axes Radius`));
    return { geometry, material: axesMaterial(opacity) };
  }
  const geometry = arrowGeometry(
    get(`${prefix}Shaft Length`),
    get(`${prefix}Shaft Radius`),
    get(`${prefix}Head Length`),
    get(`${prefix}Head Radius`),
  );
  return { geometry, material: surface(colorOf(get(`${prefix}Color`)), opacity) };
}

function placed(mesh: Mesh, frameFromMesh: Matrix4): Mesh {
  mesh.matrixAutoUpdate = false;
  mesh.matrix.copy(frameFromMesh);
  return mesh;
}

/** Messages fetched from a recording for a display that keeps all. */
const MAX_KEPT = 5000;

class OdometryDisplay extends FramedDisplay<Odometry> {
  private kept: { object: Group; pose: Pose }[] = [];

  protected override need(): Need {
    return { count: this.get<number>('Keep') || MAX_KEPT };
  }

  protected override show(message: Odometry, fixedFromFrame: Pose): void {
    const pose = multiply(fixedFromFrame, poseOf(message.pose.pose));
    const last = this.kept[this.kept.length - 1];
    if (last && !this.isFar(last.pose, pose)) return;
    const get: Get = (path) => this.get(path);
    const { geometry, material } = shapeOf(get, 'Shape/');
    const object = new Group();
    const frameFromPose = matrixOf(poseOf(message.pose.pose));
    object.add(placed(new Mesh(geometry, material), frameFromPose));
    if (this.get('Covariance')) {
      object.add(covarianceOf(get, message.pose.covariance, frameFromPose));
    }
    this.root.add(object);
    this.put(object, fixedFromFrame);
    this.kept.push({ object, pose });
    const most = this.get<number>('Keep');
    while (most > 0 && this.kept.length > most) dispose(this.kept.shift()!.object);
  }

  private isFar(a: Pose, b: Pose): boolean {
    const distance = Math.hypot(a.t[0] - b.t[0], a.t[1] - b.t[1], a.t[2] - b.t[2]);
    const dot = Math.abs(a.q[0] * b.q[0] + a.q[1] * b.q[1] + a.q[2] * b.q[2] + a.q[3] * b.q[3]);
    const angle = 2 * Math.acos(Math.min(1, dot));
    return (
      distance > this.get<number>('Position Tolerance') ||
      angle > this.get<number>('Angle Tolerance')
    );
  }

  override changed(path: string): void {
    this.clear();
    super.changed(path);
  }

  override clear(): void {
    this.kept = [];
    super.clear();
  }
}

class PathDisplay extends FramedDisplay<Path> {
  private drawn: Group[] = [];

  protected override need(): Need {
    return { count: this.get<number>('Buffer Length') };
  }

  protected override show(message: Path, fixedFromFrame: Pose): void {
    const group = new Group();
    const offset = ['X', 'Y', 'Z'].map((axis) => this.get<number>(`Offset/${axis}`));
    const points = message.poses.flatMap(({ pose: { position: p } }) => [
      p.x + offset[0]!,
      p.y + offset[1]!,
      p.z + offset[2]!,
    ]);
    const width = this.get('Line Style') === 'Billboards' ? this.get<number>('Line Width') : 0;
    const paint = colorOf(this.get('Color'));
    if (points.length >= 6) group.add(polyline(points, paint, this.get<number>('Alpha'), width));
    this.styled(group, message);
    this.root.add(group);
    this.put(group, fixedFromFrame);
    this.drawn.push(group);
    const most = Math.max(1, this.get<number>('Buffer Length'));
    while (this.drawn.length > most) dispose(this.drawn.shift()!);
    this.host.status('Path', 'ok', t().displays.poses(message.poses.length));
  }

  private styled(group: Group, message: Path): void {
    const style = this.get<string>('Pose Style');
    if (style === 'None') return;
    const matrices = message.poses.map(({ pose }) => matrixOf(poseOf(pose)));
    const geometry =
      style === 'Axes'
        ? axesGeometry(this.get('Length'), this.get('Radius'))
        : arrowGeometry(
            this.get('Shaft Length'),
            this.get<number>('Shaft Diameter') / 2,
            this.get('Head Length'),
            this.get<number>('Head Diameter') / 2,
          );
    const paint = style === 'Axes' ? axesMaterial() : surface(colorOf(this.get('Pose Color')));
    group.add(instances(geometry, paint, matrices));
  }

  override changed(path: string): void {
    if (!path.startsWith('Topic')) this.clear();
    super.changed(path);
  }

  override clear(): void {
    this.drawn = [];
    super.clear();
  }
}

interface PoseMessageStamped {
  header: Header;
  pose: PoseMessage | { pose: PoseMessage; covariance: Float64Array };
}

class PoseDisplay extends FramedDisplay<PoseMessageStamped> {
  protected override show(message: PoseMessageStamped, fixedFromFrame: Pose): void {
    this.empty();
    const inner = 'pose' in message.pose ? message.pose.pose : message.pose;
    const get: Get = (path) => this.get(path);
    const { geometry, material } = shapeOf(get, '');
    const frameFromPose = matrixOf(poseOf(inner));
    const group = new Group();
    group.add(placed(new Mesh(geometry, material), frameFromPose));
    if ('covariance' in message.pose && this.values.Covariance) {
      group.add(covarianceOf(get, message.pose.covariance, frameFromPose));
    }
    this.root.add(group);
    this.put(group, fixedFromFrame);
  }
}

interface Many {
  header: Header;
  poses?: PoseMessage[];
  particles?: { pose: PoseMessage; weight: number }[];
}

class PoseArrayDisplay extends FramedDisplay<Many> {
  protected override show(message: Many, fixedFromFrame: Pose): void {
    this.empty();
    const { particles } = message;
    const poses = particles ? particles.map((p) => p.pose) : (message.poses ?? []);
    const heaviest = Math.max(1e-12, ...(particles ?? []).map((p) => p.weight));
    const lengths = particles?.map((p) => this.weighted(p.weight / heaviest));
    const paint = colorOf(this.get('Color'));
    const opacity = (this.values.Alpha as number | undefined) ?? 1;
    const shape = this.get<string>('Shape');
    const flat = this.values['Arrow Length'] as number | undefined;
    const scales = poses.map(
      (_, i) => lengths?.[i] ?? (shape === 'Arrow (Flat)' ? (flat ?? 0.3) : 1),
    );
    const matrices = poses.map((pose, i) =>
      matrixOf(poseOf(pose), [scales[i]!, scales[i]!, scales[i]!]),
    );
    const group = new Group();
    if (shape === 'Arrow (Flat)') group.add(flatArrows(matrices, paint, opacity));
    else if (shape === 'Axes') {
      const [length, radius] = lengths
        ? [1, 0.1]
        : [this.get<number>('Axes Length'), this.get<number>('Axes Radius')];
      group.add(instances(axesGeometry(length, radius), axesMaterial(opacity), matrices));
    } else {
      const arrow = lengths
        ? arrowGeometry(0.77, 0.03, 0.23, 0.1)
        : arrowGeometry(
            this.get('Shaft Length'),
            this.get('Shaft Radius'),
            this.get('Head Length'),
            this.get('Head Radius'),
          );
      group.add(instances(arrow, surface(paint, opacity), matrices));
    }
    this.root.add(group);
    this.put(group, fixedFromFrame);
    this.host.status('Poses', 'ok', t().displays.poses(poses.length));
  }

  /** Arrow lengths proportional to the weights of the particles. */
  private weighted(part: number): number {
    const [min, max] = [this.get<number>('Min Arrow Length'), this.get<number>('Max Arrow Length')];
    return min + (max - min) * part;
  }
}

/** All flat arrows in one geometry: thousands of particles at 30 Hz. */
function flatArrows(matrices: Matrix4[], paint: Color, opacity: number) {
  const shape = flatArrowGeometry().getAttribute('position').array;
  const points = new Float32Array(matrices.length * shape.length);
  matrices.forEach(({ elements: e }, i) => {
    for (let j = 0; j < shape.length; j += 3) {
      const [x, y, z] = [shape[j]!, shape[j + 1]!, shape[j + 2]!];
      const at = i * shape.length + j;
      points[at] = e[0]! * x + e[4]! * y + e[8]! * z + e[12]!;
      points[at + 1] = e[1]! * x + e[5]! * y + e[9]! * z + e[13]!;
      points[at + 2] = e[2]! * x + e[6]! * y + e[10]! * z + e[14]!;
    }
  });
  return segments(points, paint, opacity);
}

interface PolygonMessage {
  header: Header;
  polygon: { points: { x: number; y: number; z: number }[] };
}

class PolygonDisplay extends FramedDisplay<PolygonMessage> {
  protected override show(message: PolygonMessage, fixedFromFrame: Pose): void {
    this.empty();
    const { points } = message.polygon;
    if (points.length < 2) return;
    const flat = [...points, points[0]!].flatMap((p) => [p.x, p.y, p.z]);
    const line = polyline(flat, colorOf(this.get('Color')), this.get<number>('Alpha'));
    this.root.add(line);
    this.put(line, fixedFromFrame);
  }
}

interface RangeMessage {
  header: Header;
  field_of_view: number;
  min_range: number;
  max_range: number;
  range: number;
}

class RangeDisplay extends FramedDisplay<RangeMessage> {
  private drawn: Mesh[] = [];

  protected override need(): Need {
    return { count: this.get<number>('Buffer Length') };
  }

  protected override show(message: RangeMessage, fixedFromFrame: Pose): void {
    const range = Math.min(message.range, message.max_range);
    const isSeen = message.range >= message.min_range && range > 0 && Number.isFinite(range);
    if (!isSeen) {
      this.host.status('Range', 'ok', t().displays.rangeNotDrawn(message.range));
      this.clear();
      return;
    }
    const cone = new Mesh(
      coneGeometry(range, Math.min(message.field_of_view, 3)),
      new MeshBasicMaterial({
        color: colorOf(this.get('Color')),
        transparent: true,
        opacity: this.get<number>('Alpha'),
        depthWrite: false,
        side: DoubleSide,
      }),
    );
    this.root.add(cone);
    this.put(cone, fixedFromFrame);
    this.drawn.push(cone);
    const most = Math.max(1, this.get<number>('Buffer Length'));
    while (this.drawn.length > most) dispose(this.drawn.shift()!);
    this.host.status('Range', 'ok', `${message.range.toFixed(3)} m`);
  }

  override clear(): void {
    this.drawn = [];
    super.clear();
  }
}

/** Cone along x with its apex at the sensor. */
function coneGeometry(length: number, angle: number): BufferGeometry {
  const radius = length * Math.tan(angle / 2);
  // An arrow without a shaft is a cone that points in the opposite direction.
  const cone = arrowGeometry(1e-6, 1e-6, length, Math.max(radius, 1e-3));
  return cone.rotateZ(Math.PI).translate(length, 0, 0);
}

const kind = (
  name: string,
  types: string[],
  help: () => string,
  options: Option[],
  make: new (...all: Parameters<Kind['make']>) => Display,
  more: Partial<Kind> = {},
): Kind => ({
  class: `rviz_default_plugins/${name}`,
  also: [`rviz/${name}`],
  title: name,
  get help() {
    return help();
  },
  types,
  options,
  make: (...all) => new make(...all),
  ...more,
});

const ODOMETRY = ['nav_msgs/msg/Odometry'];
export const odometry = kind(
  'Odometry',
  ODOMETRY,
  () => t().displayHelp.odometry,
  [
    ...topic('Topic', '', ODOMETRY, { isFiltered: true }),
    number('Position Tolerance', 0.1, { min: 0, step: 0.05 }),
    number('Angle Tolerance', 0.1, { min: 0, step: 0.05 }),
    int('Keep', 100, { min: 0 }),
    ...shapeOptions('Shape/'),
    ...covarianceOptions(),
  ],
  OdometryDisplay,
);

const PATH = ['nav_msgs/msg/Path'];
const styledAs = (style: string) => ({ when: (v: Values) => v['Pose Style'] === style });
export const path = kind(
  'Path',
  PATH,
  () => t().displayHelp.path,
  [
    ...topic('Topic', '', PATH, { isFiltered: true }),
    choice('Line Style', 'Lines', ['Lines', 'Billboards']),
    number('Line Width', 0.03, {
      min: 0.001,
      step: 0.01,
      when: (v) => v['Line Style'] === 'Billboards',
    }),
    color('Color', '25; 255; 0'),
    alpha('Alpha', 1),
    int('Buffer Length', 1, { min: 1 }),
    ...vector('Offset', [0, 0, 0]),
    choice('Pose Style', 'None', ['None', 'Axes', 'Arrows']),
    number('Length', 0.3, styledAs('Axes')),
    number('Radius', 0.03, styledAs('Axes')),
    color('Pose Color', '255; 85; 255', styledAs('Arrows')),
    number('Shaft Length', 0.1, styledAs('Arrows')),
    number('Head Length', 0.2, styledAs('Arrows')),
    number('Shaft Diameter', 0.1, styledAs('Arrows')),
    number('Head Diameter', 0.3, styledAs('Arrows')),
  ],
  PathDisplay,
);

const POSE = ['geometry_msgs/msg/PoseStamped'];
export const pose = kind(
  'Pose',
  POSE,
  () => t().displayHelp.pose,
  [...topic('Topic', '', POSE, { isFiltered: true }), ...shapeOptions('')],
  PoseDisplay,
);

const WITH_COVARIANCE = ['geometry_msgs/msg/PoseWithCovarianceStamped'];
export const poseWithCovariance = kind(
  'PoseWithCovariance',
  WITH_COVARIANCE,
  () => t().displayHelp.poseWithCovariance,
  [
    ...topic('Topic', '', WITH_COVARIANCE, { isFiltered: true }),
    ...shapeOptions(''),
    ...covarianceOptions(),
  ],
  PoseDisplay,
);

const ARRAY = ['geometry_msgs/msg/PoseArray'];
const ARRAY_SHAPES = ['Arrow (Flat)', 'Arrow (3D)', 'Axes'];
const shaped = (shape: string) => ({
  min: 0.001,
  step: 0.01,
  when: (v: Values) => v.Shape === shape,
});
export const poseArray = kind(
  'PoseArray',
  ARRAY,
  () => t().displayHelp.poseArray,
  [
    ...topic('Topic', '', ARRAY, { isFiltered: true }),
    choice('Shape', 'Arrow (Flat)', ARRAY_SHAPES),
    color('Color', '255; 25; 0', { when: (v) => v.Shape !== 'Axes' }),
    alpha('Alpha', 1),
    number('Arrow Length', 0.3, shaped('Arrow (Flat)')),
    number('Head Radius', 0.03, shaped('Arrow (3D)')),
    number('Head Length', 0.07, shaped('Arrow (3D)')),
    number('Shaft Radius', 0.01, shaped('Arrow (3D)')),
    number('Shaft Length', 0.23, shaped('Arrow (3D)')),
    number('Axes Length', 0.3, shaped('Axes')),
    number('Axes Radius', 0.01, shaped('Axes')),
  ],
  PoseArrayDisplay,
);

const PARTICLES = ['nav2_msgs/msg/ParticleCloud'];
export const particleCloud = kind(
  'ParticleCloud',
  PARTICLES,
  () => t().displayHelp.particleCloud,
  [
    ...topic('Topic', '', PARTICLES, { isFiltered: true, reliability: 'Best Effort' }),
    choice('Shape', 'Arrow (Flat)', ARRAY_SHAPES),
    color('Color', '0; 180; 0'),
    alpha('Alpha', 1),
    number('Min Arrow Length', 0.02, { min: 0.001, step: 0.01 }),
    number('Max Arrow Length', 0.3, { min: 0.001, step: 0.01 }),
  ],
  PoseArrayDisplay,
  { class: 'nav2_rviz_plugins/ParticleCloud', also: [] },
);

const POLYGON = ['geometry_msgs/msg/PolygonStamped'];
export const polygon = kind(
  'Polygon',
  POLYGON,
  () => t().displayHelp.polygon,
  [
    ...topic('Topic', '', POLYGON, { isFiltered: true }),
    color('Color', '25; 255; 0'),
    alpha('Alpha', 1),
  ],
  PolygonDisplay,
);

const RANGE = ['sensor_msgs/msg/Range'];
export const range = kind(
  'Range',
  RANGE,
  () => t().displayHelp.range,
  [
    ...topic('Topic', '', RANGE, { isFiltered: true }),
    color('Color', '255; 255; 255'),
    alpha('Alpha', 0.5),
    int('Buffer Length', 1, { min: 1 }),
  ],
  RangeDisplay,
);

export type { Message };
