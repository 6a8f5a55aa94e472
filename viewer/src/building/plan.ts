/** Floor plan: walls between points, openings in walls, stairs, levels. Lengths in metres. */
import { t } from '../texts/language.svelte';

export interface Point {
  x: number;
  y: number;
}

export interface Wall {
  id: number;
  level: number;
  from: Point;
  to: Point;
  thicknessM: number;
  heightM: number;
  material: string;
}

/** Door or window in a wall. */
export interface Opening {
  id: number;
  wall: number;
  kind: 'door' | 'window';
  /** Distance from the start of the wall to the center of the opening. */
  atM: number;
  widthM: number;
  heightM: number;
  /** Height of the sill above the floor. */
  sillM: number;
}

export interface Stairs {
  id: number;
  level: number;
  /** Center of the stairs. */
  at: Point;
  /** Direction of ascent: the x axis turned by this angle. */
  yawRad: number;
  /** Horizontal length and width. */
  lengthM: number;
  widthM: number;
  steps: number;
}

export interface Level {
  name: string;
  heightM: number;
}

export interface FloorPlan {
  /** Name of the file. */
  name: string;
  /** URL of the image. */
  url: string;
  widthPx: number;
  heightPx: number;
  pixelsPerM: number;
  /** Position of the center of the image. */
  at: Point;
  yawRad: number;
  /** 0 to 1. */
  opacity: number;
}

export interface Plan {
  name: string;
  author: string;
  walls: Wall[];
  openings: Opening[];
  stairs: Stairs[];
  levels: Level[];
  picture?: FloorPlan;
  lastId: number;
}

/** Defaults of Gazebo's Building Editor. */
export const WALL = { thicknessM: 0.15, heightM: 2.5, material: 'Gazebo/Grey' };
export const DOOR = { widthM: 0.9, heightM: 2, sillM: 0 };
export const WINDOW = { widthM: 0.8, heightM: 1, sillM: 1 };
export const STAIRS = { lengthM: 3, widthM: 1, steps: 10 };
export const PIXELS_PER_M = 100;

/** Names of Gazebo's materials with their colours. */
export const MATERIALS: Record<string, [number, number, number]> = {
  'Gazebo/Grey': [0.7, 0.7, 0.7],
  'Gazebo/White': [1, 1, 1],
  'Gazebo/Bricks': [0.72, 0.4, 0.32],
  'Gazebo/Wood': [0.65, 0.48, 0.3],
  'Gazebo/CeilingTiled': [0.85, 0.85, 0.82],
  'Gazebo/Red': [0.8, 0.15, 0.15],
  'Gazebo/Green': [0.15, 0.6, 0.2],
  'Gazebo/Blue': [0.15, 0.3, 0.8],
  'Gazebo/Orange': [0.95, 0.5, 0.1],
};

export function emptyPlan(): Plan {
  const levels = [{ name: t().building.levelName(1), heightM: WALL.heightM }];
  return { name: 'building', author: '', walls: [], openings: [], stairs: [], levels, lastId: 0 };
}

export const lengthOf = (wall: Wall) =>
  Math.hypot(wall.to.x - wall.from.x, wall.to.y - wall.from.y);

export const yawOfWall = (wall: Wall) =>
  Math.atan2(wall.to.y - wall.from.y, wall.to.x - wall.from.x);

/** Point at a distance along a wall. */
export function along(wall: Wall, m: number): Point {
  const yaw = yawOfWall(wall);
  return { x: wall.from.x + Math.cos(yaw) * m, y: wall.from.y + Math.sin(yaw) * m };
}

/** Height of a level's floor. */
export function baseOf(plan: Plan, level: number): number {
  return plan.levels.slice(0, level).reduce((sum, l) => sum + l.heightM, 0);
}

/** Wall nearest to a point, and the distance along it. */
export function nearestWall(
  plan: Plan,
  level: number,
  at: Point,
): { wall: Wall; atM: number; distanceM: number } | undefined {
  let best: { wall: Wall; atM: number; distanceM: number } | undefined;
  for (const wall of plan.walls) {
    if (wall.level !== level) continue;
    const length = lengthOf(wall);
    const yaw = yawOfWall(wall);
    const [dx, dy] = [at.x - wall.from.x, at.y - wall.from.y];
    const u = Math.max(0, Math.min(length, dx * Math.cos(yaw) + dy * Math.sin(yaw)));
    const near = along(wall, u);
    const distanceM = Math.hypot(at.x - near.x, at.y - near.y);
    if (!best || distanceM < best.distanceM) best = { wall, atM: u, distanceM };
  }
  return best;
}

/** Tolerance for files of other programs [m]. */
const CLOSE_M = 1e-3;

/** Errors of a plan as text; empty if the building can be written. */
export function problems(plan: Plan): string[] {
  const out: string[] = [];
  if (!/^[A-Za-z0-9_][\w -]*$/.test(plan.name)) out.push(t().building.badName);
  if (plan.walls.length === 0) out.push(t().building.noWalls);
  for (const opening of plan.openings) {
    const wall = plan.walls.find((w) => w.id === opening.wall);
    if (!wall) continue;
    const length = lengthOf(wall);
    // A wall extends beyond its line by half of its thickness.
    const end = wall.thicknessM / 2 + CLOSE_M;
    if (
      opening.atM - opening.widthM / 2 < -end ||
      opening.atM + opening.widthM / 2 > length + end
    ) {
      out.push(t().building.tooWide[opening.kind](length.toFixed(2)));
    }
    if (opening.sillM + opening.heightM > wall.heightM + 1e-6) {
      out.push(t().building.tooHigh[opening.kind](wall.heightM.toFixed(2)));
    }
  }
  return out;
}
