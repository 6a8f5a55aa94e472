import { Ray, Vector3 } from 'three';
import { describe, expect, test } from 'vitest';
import { fromYaw, IDENTITY, yawOf, type Pose } from '../src/core/pose';
import { aligned, distributed, type Extent } from '../src/sim/align';
import { Drag, movedPoses, snapped, type Handle, type Motion } from '../src/sim/drag';
import { EditHistory, MOST_STEPS, type Edit, type EditedWorld } from '../src/sim/edits';
import { freeName, modelSdf, modelsIn, poseIn, renamed } from '../src/sim/sdf_text';

const at = (x: number, y = 0, z = 0): Pose => ({ t: [x, y, z], q: [0, 0, 0, 1] });
const source = { sdf: '<sdf/>', file: '' };
const insert = (model: string, x: number): Edit => ({
  kind: 'insert',
  models: [model],
  changes: [{ kind: 'insert', model, source, pose: at(x) }],
});
const remove = (model: string, x: number): Edit => ({
  kind: 'delete',
  models: [model],
  changes: [{ kind: 'delete', model, source, pose: at(x) }],
});
const move = (before: number, after: number, ...models: string[]): Edit => ({
  kind: 'move',
  models,
  changes: models.map((model) => ({
    kind: 'move',
    model,
    before: at(before),
    after: at(after),
  })),
});
const rename = (from: string, to: string, x: number): Edit => ({
  kind: 'rename',
  models: [to],
  changes: [...remove(from, x).changes, ...insert(to, x).changes],
});

/** A world of models at positions on the x axis. */
class Line implements EditedWorld {
  models = new Map<string, number>();
  async insert(model: string, _: unknown, pose: Pose) {
    if (this.models.has(model)) return false;
    this.models.set(model, pose.t[0]);
    return true;
  }
  async delete(model: string) {
    return this.models.delete(model);
  }
  async move(model: string, pose: Pose) {
    if (!this.models.has(model)) return false;
    this.models.set(model, pose.t[0]);
    return true;
  }
  text() {
    return [...this.models].map(([name, x]) => `${name}${x}`).sort();
  }
}

describe('history', () => {
  test('undo and redo pass through the same states', async () => {
    const world = new Line();
    const history = new EditHistory();
    const edits = [
      insert('a', 1),
      insert('b', 5),
      move(1, 5, 'a'),
      rename('a', 'c', 5),
      move(5, 7, 'c', 'b'),
      remove('b', 7),
    ];
    const states = [world.text()];
    for (const edit of edits) {
      expect(await history.make(world, edit)).toBe(true);
      states.push(world.text());
    }
    for (let i = edits.length - 1; i >= 0; i--) {
      expect(await history.undo(world)).toBe(edits[i]);
      expect(world.text()).toEqual(states[i]);
    }
    for (let i = 1; i <= edits.length; i++) {
      await history.redo(world);
      expect(world.text()).toEqual(states[i]);
    }
    expect(await history.redo(world)).toBeUndefined();
  });

  test('a step that fails in the middle is taken back and not kept', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    expect(await history.make(world, move(1, 3, 'a', 'missing'))).toBe(false);
    expect(world.text()).toEqual(['a1']);
    expect(history.next.undo?.kind).toBe('insert');
  });

  test('an undo that fails stays the next one', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    await history.make(world, remove('a', 1));
    world.models.set('a', 9);
    expect(await history.undo(world)).toBeUndefined();
    expect(history.next.undo?.kind).toBe('delete');
    world.models.delete('a');
    expect(await history.undo(world)).toBeDefined();
    expect(world.text()).toEqual(['a1']);
  });

  test('a new edit ends redo', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    await history.undo(world);
    await history.make(world, insert('b', 1));
    expect(history.next.redo).toBeUndefined();
  });

  test('at least a hundred steps are kept', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 0));
    for (let x = 0; x < 100; x++) await history.make(world, move(x, x + 1, 'a'));
    for (let x = 0; x < 101; x++) await history.undo(world);
    expect(world.text()).toEqual([]);
    expect(MOST_STEPS).toBeGreaterThanOrEqual(100);
  });

  test('models that another client deleted leave the history, other steps stay', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    await history.make(world, insert('b', 1));
    await history.make(world, move(1, 2, 'a', 'b'));
    world.models.delete('b');
    expect(history.forget(['b'])).toBe(1);
    await history.undo(world);
    expect(world.text()).toEqual(['a1']);
    await history.undo(world);
    expect(world.text()).toEqual([]);
  });

  test('with a renamed model its steps under the old name are dropped', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    await history.make(world, rename('a', 'b', 1));
    expect(history.forget(['b'])).toBe(2);
    expect(history.next).toEqual({});
  });

  test('a reset takes back moves: only insertions and deletions stay', async () => {
    const world = new Line();
    const history = new EditHistory();
    await history.make(world, insert('a', 1));
    await history.make(world, move(1, 2, 'a'));
    expect(history.forgetMoves()).toBe(1);
    expect(history.next.undo?.kind).toBe('insert');
  });
});

describe('text of a world', () => {
  const WORLD =
    '<sdf version="1.7"><world name="w"><!-- <model name="no"/> -->' +
    '<model name="a&amp;b"><model name="inner"/><link name="l"/></model>' +
    "<model name='c'/></world></sdf>";

  test('models are found by name, without those inside of others', () => {
    expect([...modelsIn(WORLD).keys()]).toEqual(['a&b', 'c']);
    expect(modelsIn(WORLD).get('c')).toBe("<model name='c'/>");
    expect(modelSdf(WORLD, 'a&b')).toBe(
      '<?xml version="1.0"?>\n<sdf version="1.7">\n' +
        '<model name="a&amp;b"><model name="inner"/><link name="l"/></model>\n</sdf>\n',
    );
    expect(modelSdf(WORLD, 'inner')).toBeUndefined();
  });

  test('a new name replaces that of the outer model', () => {
    expect(renamed('<sdf><model name="a"><model name="b"/></model></sdf>', 'c<')).toBe(
      '<sdf><model name="c&#60;"><model name="b"/></model></sdf>',
    );
  });

  test('free names count from zero, as in Gazebo', () => {
    expect(freeName('box', new Set())).toBe('box');
    expect(freeName('box', new Set(['box']))).toBe('box_0');
    expect(freeName('box_0', new Set(['box', 'box_0']))).toBe('box_1');
  });
});

describe('alignment', () => {
  const cube = (model: string, x: number, half = 0.5): Extent => ({
    model,
    pose: at(x),
    min: [x - half, -half, -half],
    max: [x + half, half, half],
  });
  const xs = (poses: Map<string, Pose>) => [...poses.values()].map((pose) => pose.t[0]);

  test('sides of the outermost box', () => {
    const two = [cube('a', 0), cube('b', 4, 1)];
    expect(xs(aligned(two, 'left'))).toEqual([0, 0.5]);
    expect(xs(aligned(two, 'right'))).toEqual([4.5, 4]);
    expect(xs(aligned(two, 'centerX'))).toEqual([2.25, 2.25]);
    expect([...aligned(two, 'front').values()].map((pose) => pose.t[1])).toEqual([-0.5, 0]);
  });

  test('equal distances between the outer two', () => {
    expect(xs(distributed([cube('a', 0), cube('c', 10), cube('b', 1)], 0))).toEqual([0, 5, 10]);
  });
});

describe('handles', () => {
  const ray = (from: number[], to: number[]) => {
    const origin = new Vector3(...from);
    return new Ray(origin, new Vector3(...to).sub(origin).normalize());
  };
  /** Motion from the camera at `eye`, while the pointer goes from a point to another. */
  const motion = (handle: Handle, eye: number[], grabbed: number[], to: number[]) =>
    new Drag(handle, new Vector3(), new Vector3(...grabbed), ray(eye, grabbed)).motion(
      ray(eye, to),
    );
  const rounded = (one: Motion | undefined) =>
    one?.kind === 'translation' ? one.by.map((v) => +v.toFixed(6) + 0) : one?.angleRad;

  test('the grabbed point follows the pointer, in perspective and from above', () => {
    for (const eye of [
      [3, -5, 4],
      [0, 0, 500],
    ]) {
      expect(rounded(motion('xy', eye, [0.2, 0.1, 0.5], [1.2, -0.4, 0.5]))).toEqual([1, -0.5, 0]);
      expect(rounded(motion('x', eye, [0.5, 0, 0], [2, 0, 0]))).toEqual([1.5, 0, 0]);
    }
    expect(rounded(motion('z', [3, -5, 4], [0, 0, 0.5], [0, 0, 2]))).toEqual([0, 0, 1.5]);
  });

  test('a handle along the line of sight does not move', () => {
    expect(motion('z', [0, 0, 500], [0, 0, 0.5], [1, 0, 0])).toBeUndefined();
  });

  test('rings turn by the angle of the pointer, also seen from the side', () => {
    expect(rounded(motion('turnZ', [0, 0, 9], [1, 0, 0], [0, 1, 0]))).toBeCloseTo(Math.PI / 2);
    expect(rounded(motion('turnX', [9, 0, 0], [0, 1, 0], [0, 0, 1]))).toBeCloseTo(Math.PI / 2);
    expect(rounded(motion('turnY', [0, 9, 0], [0, 0, 1], [1, 0, 0]))).toBeCloseTo(Math.PI / 2);
    expect(rounded(motion('turnZ', [0, -9, 0], [0, -1, 0], [0.5, -1, 0]))).toBeCloseTo(0.5);
  });

  test('snapping puts one model on the grid, several keep their offsets', () => {
    const by: Motion = { kind: 'translation', by: [0.37, 0, 0] };
    expect(rounded(snapped(by, 0.25, at(0.1)))).toEqual([0.4, 0, 0]);
    expect(rounded(snapped(by, 0.25))).toEqual([0.25, 0, 0]);
  });

  test('angles snap to multiples of 15 degrees', () => {
    const turn: Motion = { kind: 'rotation', axis: [0, 0, 1], angleRad: 0.3 };
    const after = movedPoses(
      snapped(turn, 0.1, fromYaw(0.1)),
      [0, 0, 0],
      new Map([['a', fromYaw(0.1)]]),
    );
    expect(yawOf(after.get('a')!.q)).toBeCloseTo(Math.PI / 6);
  });

  test('several models turn about their pivot', () => {
    const quarter: Motion = { kind: 'rotation', axis: [0, 0, 1], angleRad: Math.PI / 2 };
    const after = movedPoses(quarter, [1, 0, 0], new Map([['a', IDENTITY]]));
    expect(after.get('a')!.t.map((v) => +v.toFixed(6) + 0)).toEqual([1, -1, 0]);
  });
});

describe('the pose of a pasted model', () => {
  const pose = (inner: string) => poseIn(`<model name="a">${inner}</model>`);
  test('is that of the model, not of its links', () =>
    expect(
      pose('<link name="l"><pose>9 9 9 0 0 0</pose></link><pose>1 2 3 0 0 0.5</pose>'),
    ).toEqual([1, 2, 3, 0, 0, 0.5]));
  test('may be in degrees', () =>
    expect(pose('<pose degrees="true">0 0 0 0 0 180</pose>')[5]).toBeCloseTo(Math.PI));
  test('is zero without one', () => expect(pose('<static>1</static>')).toEqual([0, 0, 0, 0, 0, 0]));
  test('must have six numbers', () => expect(() => pose('<pose>1 2 x</pose>')).toThrow('1 2 x'));
});
