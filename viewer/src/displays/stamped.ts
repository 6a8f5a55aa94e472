/** GridCells, PointStamped, Wrench, TwistStamped and AccelStamped. */
import { t } from '../texts/language.svelte';
import { Group, Matrix4, Mesh, Quaternion, Vector3 } from 'three';
import type { Pose } from '../core/pose';
import type { Header, Point } from '../core/types';
import {
  arrowGeometry,
  colorOf,
  flatMaterial,
  instances,
  polyline,
  surface,
  UNIT_BOX,
  UNIT_SPHERE,
} from '../scene/shapes';
import { dispose } from '../scene/stage';
import { FramedDisplay, type Display, type Kind } from './display';
import { alpha, bool, color, int, number, topic, type Option } from './options';

/** Display that keeps the last messages, up to "History Length". */
export abstract class HistoryDisplay<M extends { header: Header }> extends FramedDisplay<M> {
  private kept: Group[] = [];

  /** Shape of a message in its frame. */
  protected abstract build(message: M): Group;

  protected override show(message: M, fixedFromFrame: Pose): void {
    const group = this.build(message);
    this.root.add(group);
    this.put(group, fixedFromFrame);
    this.kept.push(group);
    const most = Math.max(1, this.get<number>('History Length'));
    while (this.kept.length > most) dispose(this.kept.shift()!);
  }

  override changed(path: string): void {
    if (!path.startsWith('Topic')) this.clear();
    super.changed(path);
  }

  override clear(): void {
    this.kept = [];
    super.clear();
  }
}

const isFinitePoint = ({ x, y, z }: Point) => [x, y, z].every(Number.isFinite);

interface GridCellsMessage {
  header: Header;
  cell_width: number;
  cell_height: number;
  cells: Point[];
}

class GridCellsDisplay extends FramedDisplay<GridCellsMessage> {
  protected override show(message: GridCellsMessage, fixedFromFrame: Pose): void {
    this.empty();
    const { cell_width: width, cell_height: height, cells } = message;
    if (!(width > 0 && height > 0)) {
      throw new Error(t().valueDisplays.cellSize(width, height));
    }
    const valid = cells.filter(isFinitePoint);
    const tile = UNIT_BOX.clone().scale(width, height, 1e-3);
    // The copy is not shared, and is freed with the display.
    tile.userData = {};
    const matrices = valid.map(({ x, y, z }) => new Matrix4().makeTranslation(x, y, z));
    const paint = flatMaterial(colorOf(this.get('Color')), this.get<number>('Alpha'));
    const mesh = instances(tile, paint, matrices);
    this.root.add(mesh);
    this.put(mesh, fixedFromFrame);
    const lost = cells.length - valid.length;
    const text = t().valueDisplays.cells(valid.length, lost);
    this.host.status('Cells', lost ? 'warn' : 'ok', text);
  }
}

class PointDisplay extends HistoryDisplay<{ header: Header; point: Point }> {
  protected override build({ point }: { point: Point }): Group {
    if (!isFinitePoint(point)) throw new Error(t().valueDisplays.notFinite);
    const group = new Group();
    const paint = surface(colorOf(this.get('Color')), this.get<number>('Alpha'));
    const ball = new Mesh(UNIT_SPHERE, paint);
    // RViz scales a sphere of diameter 1 by the radius.
    ball.scale.setScalar(this.get('Radius'));
    ball.position.set(point.x, point.y, point.z);
    group.add(ball);
    group.userData.inspect = () => ({ Point: `${point.x}, ${point.y}, ${point.z} m` });
    return group;
  }
}

/** Shape of a vector, such as a force: an arrow along it. RViz: the head takes 0.23 of the length. */
function vectorArrow(vector: Vector3, scale: number, width: number): Mesh {
  const length = vector.length() * scale;
  const geometry = arrowGeometry(
    length * 0.77,
    width * 0.1 * 0.5,
    length * 0.23,
    width * 0.2 * 0.5,
  );
  const mesh = new Mesh(geometry);
  mesh.quaternion.setFromUnitVectors(new Vector3(1, 0, 0), vector.clone().normalize());
  return mesh;
}

/** Parts of a circle that RViz draws around a rotation axis: from the 4th to the 32nd of 32. */
const FIRST_PART = 4;
const PARTS = 32;

/** Circle with an arrow head around an axis, at half of its length. */
function turnCircle(axis: Vector3, scale: number): { points: number[]; head: Matrix4 } {
  const length = axis.length() * scale;
  const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), axis.clone().normalize());
  const points: number[] = [];
  for (let i = FIRST_PART; i <= PARTS; i++) {
    const angle = (i * 2 * Math.PI) / PARTS;
    const at = new Vector3(Math.cos(angle), Math.sin(angle), 2).multiplyScalar(length / 4);
    points.push(...at.applyQuaternion(turn).toArray());
  }
  const at = new Vector3(length / 4, 0, length / 2).applyQuaternion(turn);
  const forward = new Vector3(0, 1, 0).applyQuaternion(turn);
  const facing = new Quaternion().setFromUnitVectors(new Vector3(1, 0, 0), forward);
  return { points, head: new Matrix4().compose(at, facing, new Vector3(1, 1, 1)) };
}

interface Names {
  linear: string;
  angular: string;
  /** Vectors of a message. */
  of(message: never): { linear: Point; angular: Point };
}

class ScrewDisplay extends HistoryDisplay<{ header: Header }> {
  constructor(
    private names: Names,
    ...all: Parameters<Kind['make']>
  ) {
    super(...all);
  }

  protected override build(message: { header: Header }): Group {
    const { linear, angular } = this.names.of(message as never);
    if (!isFinitePoint(linear) || !isFinitePoint(angular))
      throw new Error(t().valueDisplays.notFinite);
    const group = new Group();
    this.add(group, this.names.linear, linear, false);
    this.add(group, this.names.angular, angular, true);
    return group;
  }

  private add(group: Group, name: string, { x, y, z }: Point, isTurn: boolean): void {
    const vector = new Vector3(x, y, z);
    const scale = this.get<number>(`${name} Arrow Scale`);
    const width = this.get<number>('Arrow Width');
    const length = vector.length() * scale;
    const isHidden = this.values['Hide Small Values'] === true && length <= width;
    if (isHidden || length < 1e-9) return;
    const paint = surface(colorOf(this.get(`${name} Color`)), this.get<number>('Alpha'));
    const arrow = vectorArrow(vector, scale, width);
    arrow.material = paint;
    group.add(arrow);
    if (!isTurn) return;
    const { points, head } = turnCircle(vector, scale);
    group.add(polyline(points, paint.color, this.get<number>('Alpha'), width * 0.05));
    const cone = new Mesh(arrowGeometry(1e-6, 1e-6, width * 0.1, width * 0.1), paint);
    cone.applyMatrix4(head);
    group.add(cone);
  }
}

const FORCE: Names = {
  linear: 'Force',
  angular: 'Torque',
  of: ({ wrench }: { wrench: { force: Point; torque: Point } }) => ({
    linear: wrench.force,
    angular: wrench.torque,
  }),
};
const TWIST: Names = {
  linear: 'Linear',
  angular: 'Angular',
  of: ({ twist }: { twist: { linear: Point; angular: Point } }) => twist,
};
const ACCEL: Names = {
  linear: 'Linear',
  angular: 'Angular',
  of: ({ accel }: { accel: { linear: Point; angular: Point } }) => accel,
};

export const history = int('History Length', 1, { min: 1, max: 100_000 });

const screwOptions = ({ linear, angular }: Names): Option[] => [
  color(`${linear} Color`, '204; 51; 51'),
  color(`${angular} Color`, '204; 204; 51'),
  alpha('Alpha', 1),
  number(`${linear} Arrow Scale`, 2, { min: 0, step: 0.1 }),
  number(`${angular} Arrow Scale`, 2, { min: 0, step: 0.1 }),
  number('Arrow Width', 0.5, { min: 0.001, step: 0.05 }),
  history,
];

function kind(
  name: string,
  also: string[],
  type: string,
  help: () => string,
  options: Option[],
  make: (...all: Parameters<Kind['make']>) => Display,
): Kind {
  return {
    class: `rviz_default_plugins/${name}`,
    also,
    title: name,
    get help() {
      return help();
    },
    types: [type],
    options: [...topic('Topic', '', [type], { isFiltered: true }), ...options],
    make,
  };
}

export const gridCells = kind(
  'GridCells',
  ['rviz/GridCells'],
  'nav_msgs/msg/GridCells',
  () => t().valueDisplays.gridCells,
  [color('Color', '25; 255; 0'), alpha('Alpha', 1)],
  (...all) => new GridCellsDisplay(...all),
);

export const pointStamped = kind(
  'PointStamped',
  ['rviz/PointStamped'],
  'geometry_msgs/msg/PointStamped',
  () => t().valueDisplays.pointStamped,
  [
    color('Color', '204; 41; 204'),
    alpha('Alpha', 1),
    number('Radius', 0.2, { min: 0.001, step: 0.05 }),
    history,
  ],
  (...all) => new PointDisplay(...all),
);

export const wrench = kind(
  'Wrench',
  ['rviz/WrenchStamped', 'rviz/Wrench', 'rviz_default_plugins/WrenchStamped'],
  'geometry_msgs/msg/WrenchStamped',
  () => t().valueDisplays.wrench,
  screwOptions(FORCE),
  (...all) => new ScrewDisplay(FORCE, ...all),
);
export const twistStamped = kind(
  'TwistStamped',
  ['rviz/TwistStamped'],
  'geometry_msgs/msg/TwistStamped',
  () => t().valueDisplays.twistStamped,
  [...screwOptions(TWIST), bool('Hide Small Values', true)],
  (...all) => new ScrewDisplay(TWIST, ...all),
);

export const accelStamped = kind(
  'AccelStamped',
  ['rviz/AccelStamped'],
  'geometry_msgs/msg/AccelStamped',
  () => t().valueDisplays.accelStamped,
  [...screwOptions(ACCEL), bool('Hide Small Values', true)],
  (...all) => new ScrewDisplay(ACCEL, ...all),
);
