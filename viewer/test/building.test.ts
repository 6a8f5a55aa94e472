import { describe, expect, test } from 'vitest';
import { History } from '../src/building/history';
import { DOOR, emptyPlan, problems, WALL, WINDOW, type Plan } from '../src/building/plan';
import { snap } from '../src/building/snap';
import { bounds, partsOf, wallBoxes } from '../src/building/solid';
import { modelConfig, modelSdf, num, worldSdf } from '../src/building/write';
import { crc32, zip } from '../src/building/zip';

function room(): Plan {
  const plan = emptyPlan();
  plan.name = 'room';
  const corners = [
    { x: 0, y: 0 },
    { x: 6, y: 0 },
    { x: 6, y: 4 },
    { x: 0, y: 4 },
  ];
  corners.forEach((from, i) => {
    plan.walls.push({ id: i + 1, level: 0, from, to: corners[(i + 1) % 4]!, ...WALL });
  });
  plan.lastId = 4;
  return plan;
}
const sizes = (plan: Plan, wall = 0) =>
  wallBoxes(plan.walls[wall]!, plan.openings).map((b) =>
    [b.x, b.z, b.sizeX, b.sizeY, b.sizeZ].map((v) => +v.toFixed(6)),
  );

describe('walls', () => {
  test('a wall is longer than its line by its thickness', () => {
    expect(sizes(room())).toEqual([[0, 1.25, 6.15, 0.15, 2.5]]);
  });

  test('a door divides a wall into two sides and a lintel', () => {
    const plan = room();
    plan.openings.push({ id: 9, wall: 1, kind: 'door', atM: 3, ...DOOR });
    expect(sizes(plan)).toEqual([
      [-1.7625, 1.25, 2.625, 0.15, 2.5],
      [0, 2.25, 0.9, 0.15, 0.5],
      [1.7625, 1.25, 2.625, 0.15, 2.5],
    ]);
  });

  test('a window leaves the wall below and above it', () => {
    const plan = room();
    plan.openings.push({ id: 9, wall: 1, kind: 'window', atM: 1, ...WINDOW });
    expect(sizes(plan).map(([, z, x, , h]) => [z, x, h])).toEqual([
      [1.25, 0.675, 2.5],
      [0.5, 0.8, 1],
      [2.25, 0.8, 0.5],
      [1.25, 4.675, 2.5],
    ]);
  });

  test('the boxes of a wall have its volume minus the union of all openings', () => {
    const plan = room();
    plan.openings.push({ id: 9, wall: 1, kind: 'window', atM: 1, ...WINDOW });
    plan.openings.push({
      id: 10,
      wall: 1,
      kind: 'door',
      atM: 1.5,
      widthM: 1,
      heightM: 2,
      sillM: 0,
    });
    const volume = sizes(plan).reduce((sum, [, , x, y, z]) => sum + x! * y! * z!, 0);
    // The union of both openings: the door, and the 0.4 by 1 m of the window beside it.
    expect(volume).toBeCloseTo((6.15 * 2.5 - (1 * 2 + 0.4 * 1)) * 0.15, 9);
  });

  test('an opening beyond the end of its wall is reported', () => {
    const plan = room();
    plan.openings.push({ id: 9, wall: 1, kind: 'door', atM: 5.8, ...DOOR });
    expect(problems(plan)).toEqual(['A door extends beyond its wall of length 6.00 m']);
  });
});

describe('storeys', () => {
  test('the second level has a floor with an opening over the stairs', () => {
    const plan = room();
    plan.levels.push({ name: 'Level 2', heightM: 2.5 });
    plan.stairs.push({
      id: 9,
      level: 0,
      at: { x: 3, y: 2 },
      yawRad: 0,
      lengthM: 3,
      widthM: 1,
      steps: 10,
    });
    const floor = partsOf(plan).find((p) => p.kind === 'floor')!;
    const area = floor.boxes.reduce((sum, b) => sum + b.sizeX * b.sizeY, 0);
    expect(area).toBeCloseTo(6.15 * 4.15 - 3, 9);
    expect(floor.baseM).toBe(2.5);
    const steps = partsOf(plan).find((p) => p.kind === 'stairs')!.boxes;
    expect(steps.length).toBe(10);
    expect(steps[9]!.z + steps[9]!.sizeZ / 2).toBeCloseTo(2.5, 12);
  });
});

describe('files', () => {
  test('names and poses are those of the Building Editor', () => {
    const plan = room();
    plan.openings.push({ id: 9, wall: 1, kind: 'door', atM: 3, ...DOOR });
    const text = modelSdf(plan);
    expect(text).toContain('<pose>3 2 0 0 0 0</pose>');
    expect(text).toContain('<link name="Wall_0">\n      <pose>0 -2 0 0 0 0</pose>');
    expect(text).toContain('<collision name="Wall_0_Collision_1">');
    expect(text).toContain('<size>0.9 0.15 0.5</size>');
    expect(text).toContain('<collision name="Wall_1_Collision">');
    expect(text).toContain('<static>1</static>');
    expect(modelConfig(plan)).toContain('<sdf version="1.6">model.sdf</sdf>');
    expect(worldSdf(plan)).toContain('<world name="room_world">');
    expect(bounds(plan)).toEqual({ min: { x: -0.075, y: -0.075 }, max: { x: 6.075, y: 4.075 } });
  });

  test('names are escaped in XML', () => {
    const plan = room();
    plan.name = 'a"/><plugin name="x';
    expect(modelSdf(plan)).not.toContain('<plugin');
  });

  test('numbers are written in their shortest form', () => {
    expect([0.1 + 0.2, -0.0000001, 3, 2.5, -1.25].map(num)).toEqual([
      '0.3',
      '0',
      '3',
      '2.5',
      '-1.25',
    ]);
  });

  test('files are stored in a ZIP archive', () => {
    expect(crc32(new TextEncoder().encode('123456789'))).toBe(0xcbf43926);
    const bytes = zip({ 'a.txt': 'hi' });
    expect([...bytes.subarray(0, 4)]).toEqual([0x50, 0x4b, 3, 4]);
    const end = new DataView(bytes.buffer, bytes.length - 22);
    expect(end.getUint32(0, true)).toBe(0x06054b50);
    expect(end.getUint32(16, true)).toBe(30 + 5 + 2);
    expect(end.getUint32(12, true)).toBe(46 + 5);
  });
});

describe('snapping', () => {
  const settings = { reachM: 0.2, gridM: 0.1, isOff: false };

  test('snaps to ends, to angles of 15 degrees, to the grid, or not at all', () => {
    const plan = room();
    expect(snap(plan, 0, { x: 6.1, y: 0.1 }, undefined, settings)).toEqual({
      at: { x: 6, y: 0 },
      to: 'end',
    });
    const line = snap(emptyPlan(), 0, { x: 2.03, y: 0.1 }, { x: 0, y: 0 }, settings);
    expect(line).toEqual({ at: { x: 2, y: 0 }, to: 'angle' });
    expect(snap(plan, 0, { x: 3.04, y: 2.06 }, undefined, settings).at).toEqual({ x: 3, y: 2.1 });
    const free = { x: 6.1, y: 0.1 };
    expect(snap(plan, 0, free, undefined, { ...settings, isOff: true }).at).toEqual(free);
  });

  test('the last wall of a room snaps to the start of the first one', () => {
    const plan = room();
    const at = snap(plan, 0, { x: 6.07, y: 8.02 }, { x: 0.03, y: 8 }, settings).at;
    expect(at.x).toBeCloseTo(6, 9);
  });
});

test('undo and redo', () => {
  const history = History.of({ n: 0 });
  history.note({ n: 1 });
  history.note({ n: 1 });
  history.note({ n: 2 });
  expect(history.undo()).toEqual({ n: 1 });
  expect(history.undo()).toEqual({ n: 0 });
  expect(history.undo()).toBeUndefined();
  expect(history.redo()).toEqual({ n: 1 });
  history.note({ n: 5 });
  expect(history.canRedo).toBe(false);
});
