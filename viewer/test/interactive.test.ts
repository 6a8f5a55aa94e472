import { Quaternion, Ray, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { effortColor, effortPart } from '../src/displays/effort';
import { drag, type Grip } from '../src/displays/interactive_drag';
import {
  axisColor,
  completed,
  menuTree,
  MODE,
  type InteractiveMarker,
} from '../src/displays/interactive_messages';
import { kindForType, kindOf } from '../src/displays/registry';
import { defaultsOf } from '../src/displays/options';

const NONE = { x: 0, y: 0, z: 0, w: 0 };
const control = (mode: number, name = 'a') => ({
  name,
  orientation: NONE,
  orientation_mode: 0,
  interaction_mode: mode,
  always_visible: false,
  markers: [],
  independent_marker_orientation: false,
  description: '',
});
const marker = (...controls: ReturnType<typeof control>[]): InteractiveMarker => ({
  header: { stamp: { sec: 0, nanosec: 0 }, frame_id: 'map' },
  pose: { position: { x: 0, y: 0, z: 0 }, orientation: NONE },
  name: 'm',
  description: '',
  scale: 0,
  menu_entries: [],
  controls,
});

describe('completion of interactive markers', () => {
  test('sizes and rotations', () => {
    const { scale, pose } = completed(marker(control(MODE.moveAxis)));
    expect([scale, pose.orientation.w]).toEqual([1, 1]);
  });
  test('an axis gets two arrows', () => {
    const [one] = completed(marker(control(MODE.moveAxis))).controls;
    expect(one!.markers.map((m) => m.points.map((p) => p.x))).toEqual([
      [0.5, 0.9],
      [-0.5, -0.9],
    ]);
  });
  test('names are unique', () => {
    const { controls } = completed(marker(control(1), control(1)));
    expect(controls.map((c) => c.name)).toEqual(['a', 'a_u0']);
  });
  test('a ring is closed: 36 parts of two triangles', () =>
    expect(
      completed(marker(control(MODE.rotateAxis))).controls[0]!.markers[0]!.points,
    ).toHaveLength(216));
  test('the colour of the z axis is blue', () => {
    const s = Math.SQRT1_2;
    const { r, g, b } = axisColor({ x: 0, y: -s, z: 0, w: s });
    expect([r, g, b].map((v) => Math.round(v * 100) / 100)).toEqual([0, 0, 1]);
  });
  test('a menu as a tree, without cycles', () => {
    const entry = (id: number, parent_id: number) => ({
      id,
      parent_id,
      title: '',
      command: '',
      command_type: 0,
    });
    const tree = menuTree([entry(1, 0), entry(2, 1), entry(3, 4), entry(4, 3), entry(0, 0)]);
    expect(tree.map((n) => [n.entry.id, n.children.map((c) => c.entry.id)])).toEqual([[1, [2]]]);
  });
});

describe('dragging', () => {
  const grip = (mode: number, axis: Vector3, point = new Vector3(1, 0, 0)): Grip => ({
    mode,
    axis,
    view: new Vector3(0, 0, 1),
    point,
    start: { position: new Vector3(), quaternion: new Quaternion() },
  });
  /** Ray straight down at a point of the floor. */
  const down = (x: number, y: number) => new Ray(new Vector3(x, y, 10), new Vector3(0, 0, -1));
  const X = new Vector3(1, 0, 0);
  const Z = new Vector3(0, 0, 1);
  const close = (v: Vector3, expected: number[]) =>
    v.toArray().forEach((one, i) => expect(one).toBeCloseTo(expected[i]!, 9));

  test('along an axis', () => close(drag(grip(MODE.moveAxis, X), down(3, 5))!.position, [2, 0, 0]));
  test('not along an axis that points to the camera', () =>
    expect(drag(grip(MODE.moveAxis, Z), down(3, 5))).toBeUndefined());
  test('in a plane', () => close(drag(grip(MODE.movePlane, Z), down(3, 5))!.position, [2, 5, 0]));
  test('around an axis', () => {
    const { quaternion, position } = drag(grip(MODE.rotateAxis, Z), down(0, 2))!;
    close(X.clone().applyQuaternion(quaternion), [0, 1, 0]);
    close(position, [0, 0, 0]);
  });
  test('pulled: the grip stays under the mouse', () => {
    const { quaternion, position } = drag(grip(MODE.moveRotate, Z), down(0, 3))!;
    close(X.clone().applyQuaternion(quaternion).add(position), [0, 3, 0]);
    close(position, [0, 2, 0]);
  });
  test('across the view', () => close(drag(grip(MODE.move3d, X), down(1, 1))!.position, [0, 1, 0]));
});

describe('efforts', () => {
  test('part of the limit', () => expect(effortPart(-5, 10)).toBeCloseTo(0.55, 12));
  test('without a limit', () => expect(effortPart(2, 0)).toBeCloseTo(2.05, 12));
  test('the limit is red', () => expect(effortColor(1).toArray()).toEqual([1, 0, 0]));
});

describe('displays of single values and vectors', () => {
  test('defaults of RViz', () => {
    const values = defaultsOf(kindOf('rviz_default_plugins/Temperature')!.options);
    expect([values['Invert Rainbow'], values['Max Intensity'], values['Channel Name']]).toEqual([
      true,
      100,
      'temperature',
    ]);
  });
  test('a wrench of ROS 1', () => expect(kindOf('rviz/WrenchStamped')!.title).toBe('Wrench'));
  test('types', () =>
    expect(
      ['nav_msgs/msg/GridCells', 'visualization_msgs/msg/InteractiveMarkerUpdate'].map(
        (type) => kindForType(type)!.title,
      ),
    ).toEqual(['GridCells', 'InteractiveMarkers']));
});
