/** Reader of buildings from SDF files: those of the page, and those of Gazebo's Building Editor. */
import { t } from '../texts/language.svelte';
import { emptyPlan, WALL, type Plan } from './plan';
import type { Box } from './solid';

const numbers = (text: string | null | undefined) =>
  (text ?? '').trim().split(/\s+/).filter(Boolean).map(Number);

const child = (element: Element | undefined, name: string) =>
  element && [...element.children].find((c) => c.localName === name);

/** Maximum distance of the bases of walls of one level [m]. */
const CLOSE_LEVEL_M = 1e-3;
/** Maximum distance of a floor from the base of its level [m]. */
const FLOOR_GAP_M = 0.3;
/** Maximum gap between two boxes of one row [m]. */
const CLOSE_M = 1e-4;

interface Link {
  kind: 'Wall' | 'Stairs' | 'Floor';
  x: number;
  y: number;
  z: number;
  yaw: number;
  material: string;
  boxes: Box[];
}

export function readBuilding(text: string, parser: DOMParser = new DOMParser()): Plan {
  const document = parser.parseFromString(text, 'text/xml');
  const models = [...document.getElementsByTagName('model')];
  const model = models.find((m) =>
    [...m.children].some((c) => /^Wall_/.test(c.getAttribute('name') ?? '')),
  );
  if (!model) throw new Error(t().building.noBuilding);
  const [mx = 0, my = 0, , , , myaw = 0] = numbers(child(model, 'pose')?.textContent);
  if (Math.abs(myaw) > 1e-6) throw new Error(t().building.rotatedModel);
  const plan = emptyPlan();
  plan.name = model.getAttribute('name') ?? 'building';
  const links = [...model.children]
    .filter((c) => c.localName === 'link')
    .flatMap((link) => readLink(link, mx, my) ?? []);
  // A level has walls, or only a floor, whose link other programs put at half of its thickness.
  const zOf = (kind: Link['kind']) =>
    links.filter((link) => link.kind === kind).map((link) => +link.z.toFixed(4));
  const bases: number[] = [];
  const isNew = (z: number, gapM: number) => bases.every((base) => Math.abs(base - z) > gapM);
  for (const z of zOf('Wall')) if (isNew(z, CLOSE_LEVEL_M)) bases.push(z);
  for (const z of zOf('Floor')) if (isNew(z, FLOOR_GAP_M)) bases.push(z);
  bases.sort((a, b) => a - b);
  const heights = bases.map((base) => {
    const own = links.filter((link) => Math.abs(link.z - base) <= CLOSE_LEVEL_M);
    const tops = own.filter(({ kind }) => kind !== 'Floor').map(topOf);
    return tops.length > 0 ? Math.max(...tops) : WALL.heightM;
  });
  plan.levels = bases.map((base, i) => ({
    name: t().building.levelName(i + 1),
    heightM: +((bases[i + 1] ?? base + heights[i]!) - base).toFixed(4),
  }));
  const levelOf = (z: number) =>
    bases.reduce(
      (best, base, i) => (Math.abs(base - z) < Math.abs(bases[best]! - z) ? i : best),
      0,
    );
  for (const link of links) {
    if (link.kind === 'Wall') addWall(plan, link, levelOf(link.z));
    if (link.kind === 'Stairs') addStairs(plan, link, levelOf(link.z));
  }
  if (plan.levels.length === 0) plan.levels = emptyPlan().levels;
  return plan;
}

const topOf = (link: Link) => Math.max(...link.boxes.map((b) => b.z + b.sizeZ / 2));

function readLink(link: Element, mx: number, my: number): Link | undefined {
  const kind = /^(Wall|Stairs|Floor)_/.exec(link.getAttribute('name') ?? '')?.[1];
  if (!kind) return undefined;
  const [x = 0, y = 0, z = 0, , , yaw = 0] = numbers(child(link, 'pose')?.textContent);
  const boxes: Box[] = [];
  for (const shape of [...link.children].filter((c) => c.localName === 'collision')) {
    const [bx = 0, by = 0, bz = 0] = numbers(child(shape, 'pose')?.textContent);
    const size = numbers(child(child(child(shape, 'geometry'), 'box'), 'size')?.textContent);
    const [sizeX, sizeY, sizeZ] = size;
    if (sizeX === undefined || sizeY === undefined || sizeZ === undefined) continue;
    boxes.push({ x: bx, y: by, z: bz, sizeX, sizeY, sizeZ });
  }
  if (boxes.length === 0) return undefined;
  const material = link
    .getElementsByTagName('script')[0]
    ?.getElementsByTagName('name')[0]?.textContent;
  return {
    kind: kind as Link['kind'],
    x: mx + x,
    y: my + y,
    z,
    yaw,
    material: material?.trim() ?? 'Gazebo/Grey',
    boxes,
  };
}

function addWall(plan: Plan, link: Link, level: number): void {
  const left = Math.min(...link.boxes.map((b) => b.x - b.sizeX / 2));
  const right = Math.max(...link.boxes.map((b) => b.x + b.sizeX / 2));
  const top = topOf(link);
  const thicknessM = link.boxes[0]!.sizeY;
  // The line ends half a thickness before the wall does.
  const [from, to] = [left + thicknessM / 2, right - thicknessM / 2];
  const at = (u: number) => ({
    x: round(link.x + Math.cos(link.yaw) * u),
    y: round(link.y + Math.sin(link.yaw) * u),
  });
  const wall = ++plan.lastId;
  const heightM = round(top);
  plan.walls.push({
    id: wall,
    level,
    from: at(from),
    to: at(to),
    thicknessM,
    heightM,
    material: link.material,
  });
  for (const hole of holesOf(link.boxes, left, right, top)) {
    plan.openings.push({
      id: ++plan.lastId,
      wall,
      kind: hole.low < CLOSE_M ? 'door' : 'window',
      atM: round((hole.from + hole.to) / 2 - from),
      widthM: round(hole.to - hole.from),
      heightM: round(hole.high - hole.low),
      sillM: round(hole.low),
    });
  }
}

const round = (v: number) => Math.round(v * 1e4) / 1e4;

/** Openings left by the boxes of a wall: rectangles as wide as possible. */
function holesOf(boxes: Box[], left: number, right: number, top: number) {
  const edges = (values: number[]) => {
    const sorted = [...values].sort((a, b) => a - b);
    return sorted.filter((v, i) => i === 0 || v - sorted[i - 1]! > CLOSE_M);
  };
  const us = edges([left, right, ...boxes.flatMap((b) => [b.x - b.sizeX / 2, b.x + b.sizeX / 2])]);
  const vs = edges([0, top, ...boxes.flatMap((b) => [b.z - b.sizeZ / 2, b.z + b.sizeZ / 2])]);
  const isFull = (u: number, v: number) =>
    boxes.some((b) => Math.abs(u - b.x) < b.sizeX / 2 && Math.abs(v - b.z) < b.sizeZ / 2);
  const out: { from: number; to: number; low: number; high: number }[] = [];
  for (let i = 0; i + 1 < us.length; i++) {
    const u = (us[i]! + us[i + 1]!) / 2;
    for (let j = 0; j + 1 < vs.length; j++) {
      if (isFull(u, (vs[j]! + vs[j + 1]!) / 2)) continue;
      const low = vs[j]!;
      while (j + 2 < vs.length && !isFull(u, (vs[j + 1]! + vs[j + 2]!) / 2)) j++;
      const high = vs[j + 1]!;
      const before = out.find(
        (h) =>
          Math.abs(h.to - us[i]!) < CLOSE_M &&
          Math.abs(h.low - low) < CLOSE_M &&
          Math.abs(h.high - high) < CLOSE_M,
      );
      if (before) before.to = us[i + 1]!;
      else out.push({ from: us[i]!, to: us[i + 1]!, low, high });
    }
  }
  return out;
}

function addStairs(plan: Plan, link: Link, level: number): void {
  const left = Math.min(...link.boxes.map((b) => b.x - b.sizeX / 2));
  const right = Math.max(...link.boxes.map((b) => b.x + b.sizeX / 2));
  const middle = (left + right) / 2;
  plan.stairs.push({
    id: ++plan.lastId,
    level,
    at: {
      x: round(link.x + Math.cos(link.yaw) * middle),
      y: round(link.y + Math.sin(link.yaw) * middle),
    },
    yawRad: link.yaw,
    lengthM: round(right - left),
    widthM: link.boxes[0]!.sizeY,
    steps: link.boxes.length,
  });
}
