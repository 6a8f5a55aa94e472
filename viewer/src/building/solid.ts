/** Geometry of a plan as boxes, shared by the view and the SDF writer. */
import {
  baseOf,
  lengthOf,
  yawOfWall,
  type Opening,
  type Plan,
  type Point,
  type Wall,
} from './plan';

/** Box in the frame of its part: center and size. */
export interface Box {
  x: number;
  y: number;
  z: number;
  sizeX: number;
  sizeY: number;
  sizeZ: number;
}

export interface Part {
  name: string;
  kind: 'wall' | 'stairs' | 'floor';
  level: number;
  /** Pose of the part in the building, on the floor of its level. */
  at: Point;
  baseM: number;
  yawRad: number;
  material: string;
  boxes: Box[];
}

/** Thickness of a floor; its upper side is the level's floor [m]. */
export const FLOOR_THICKNESS_M = 0.1;

interface Hole {
  from: number;
  to: number;
  low: number;
  high: number;
}

/** Divides a rectangle with holes into the fewest upright strips of rectangles. */
export function cut(
  width: [number, number],
  height: [number, number],
  holes: readonly Hole[],
): { u: [number, number]; v: [number, number] }[] {
  const [left, right] = width;
  const inside = holes
    .map((h) => ({ ...h, from: Math.max(left, h.from), to: Math.min(right, h.to) }))
    .filter((h) => h.to > h.from && h.high > height[0] && h.low < height[1]);
  const edges = [...new Set([left, right, ...inside.flatMap((h) => [h.from, h.to])])];
  edges.sort((a, b) => a - b);
  const out: { u: [number, number]; v: [number, number] }[] = [];
  let last: { to: number; spans: [number, number][]; at: number } | undefined;
  for (let i = 0; i + 1 < edges.length; i++) {
    const [from, to] = [edges[i]!, edges[i + 1]!];
    const middle = (from + to) / 2;
    const spans = spansOf(
      height,
      inside.filter((h) => h.from < middle && h.to > middle),
    );
    // A strip with the same gaps as the previous one extends it.
    if (last && same(last.spans, spans)) {
      for (let k = last.at; k < out.length; k++) out[k]!.u[1] = to;
      last.to = to;
      continue;
    }
    last = { to, spans, at: out.length };
    for (const span of spans) out.push({ u: [from, to], v: span });
  }
  return out;
}

function spansOf([low, high]: [number, number], holes: readonly Hole[]): [number, number][] {
  const out: [number, number][] = [];
  let at = low;
  for (const hole of [...holes].sort((a, b) => a.low - b.low)) {
    if (hole.low > at) out.push([at, Math.min(hole.low, high)]);
    at = Math.max(at, hole.high);
  }
  if (at < high) out.push([at, high]);
  return out;
}

const same = (a: [number, number][], b: [number, number][]) =>
  a.length === b.length && a.every((span, i) => span[0] === b[i]![0] && span[1] === b[i]![1]);

/** Boxes of a wall, which is longer than its line by its thickness so that corners are closed. */
export function wallBoxes(wall: Wall, openings: readonly Opening[]): Box[] {
  const length = lengthOf(wall);
  const half = length / 2;
  const end = half + wall.thicknessM / 2;
  const holes = openings
    .filter((o) => o.wall === wall.id)
    .map((o) => ({
      from: o.atM - o.widthM / 2 - half,
      to: o.atM + o.widthM / 2 - half,
      low: o.sillM,
      high: o.sillM + o.heightM,
    }));
  return cut([-end, end], [0, wall.heightM], holes).map(({ u, v }) => ({
    x: (u[0] + u[1]) / 2,
    y: 0,
    z: (v[0] + v[1]) / 2,
    sizeX: u[1] - u[0],
    sizeY: wall.thicknessM,
    sizeZ: v[1] - v[0],
  }));
}

/** Bounding rectangle of all walls of all levels. */
export function bounds(plan: Plan): { min: Point; max: Point } {
  const points = plan.walls.flatMap((wall) => {
    const t = wall.thicknessM / 2;
    return [wall.from, wall.to].flatMap((p) => [
      { x: p.x - t, y: p.y - t },
      { x: p.x + t, y: p.y + t },
    ]);
  });
  if (points.length === 0) return { min: { x: 0, y: 0 }, max: { x: 0, y: 0 } };
  const by = (pick: (...all: number[]) => number) => ({
    x: pick(...points.map((p) => p.x)),
    y: pick(...points.map((p) => p.y)),
  });
  return { min: by(Math.min), max: by(Math.max) };
}

/** All parts of a building, in the order in which they are written. */
export function partsOf(plan: Plan): Part[] {
  const walls = plan.walls.map((wall, i): Part => ({
    name: `Wall_${i}`,
    kind: 'wall',
    level: wall.level,
    at: { x: (wall.from.x + wall.to.x) / 2, y: (wall.from.y + wall.to.y) / 2 },
    baseM: baseOf(plan, wall.level),
    yawRad: yawOfWall(wall),
    material: wall.material,
    boxes: wallBoxes(wall, plan.openings),
  }));
  const stairs = plan.stairs.map((one, i): Part => {
    const run = one.lengthM / one.steps;
    const rise = (plan.levels[one.level]?.heightM ?? 2.5) / one.steps;
    const boxes = Array.from({ length: one.steps }, (_, k) => ({
      x: -one.lengthM / 2 + (k + 0.5) * run,
      y: 0,
      z: (k + 0.5) * rise,
      sizeX: run,
      sizeY: one.widthM,
      sizeZ: rise,
    }));
    const { at, level, yawRad } = one;
    const baseM = baseOf(plan, level);
    return {
      name: `Stairs_${i}`,
      kind: 'stairs',
      level,
      at,
      baseM,
      yawRad,
      material: 'Gazebo/Grey',
      boxes,
    };
  });
  return [...walls, ...stairs, ...floorsOf(plan)];
}

/** Floors of the levels above the first, with openings for stairs. */
function floorsOf(plan: Plan): Part[] {
  const box = bounds(plan);
  const at = { x: (box.min.x + box.max.x) / 2, y: (box.min.y + box.max.y) / 2 };
  return plan.levels.flatMap((_, level) => {
    if (level === 0 || plan.walls.length === 0) return [];
    const holes = plan.stairs
      .filter((s) => s.level === level - 1)
      .map((s) => {
        const [sin, cos] = [Math.abs(Math.sin(s.yawRad)), Math.abs(Math.cos(s.yawRad))];
        const halfX = (s.lengthM * cos + s.widthM * sin) / 2;
        const halfY = (s.lengthM * sin + s.widthM * cos) / 2;
        const [x, y] = [s.at.x - at.x, s.at.y - at.y];
        return { from: x - halfX, to: x + halfX, low: y - halfY, high: y + halfY };
      });
    const [halfX, halfY] = [(box.max.x - box.min.x) / 2, (box.max.y - box.min.y) / 2];
    const boxes = cut([-halfX, halfX], [-halfY, halfY], holes).map(({ u, v }) => ({
      x: (u[0] + u[1]) / 2,
      y: (v[0] + v[1]) / 2,
      z: -FLOOR_THICKNESS_M / 2,
      sizeX: u[1] - u[0],
      sizeY: v[1] - v[0],
      sizeZ: FLOOR_THICKNESS_M,
    }));
    const baseM = baseOf(plan, level);
    return [
      {
        name: `Floor_${level}`,
        kind: 'floor',
        level,
        at,
        baseM,
        yawRad: 0,
        material: 'Gazebo/Grey',
        boxes,
      } as Part,
    ];
  });
}
