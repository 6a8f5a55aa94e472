/** Snapping of points: to ends of walls, to the grid, to multiples of 15 degrees. */
import { along, lengthOf, nearestWall, type Plan, type Point } from './plan';

export interface Snapped {
  at: Point;
  /** Target of the snapping. */
  to: 'end' | 'wall' | 'angle' | 'grid' | 'none';
}

export interface Settings {
  /** Maximum distance at which a point snaps [m]. */
  reachM: number;
  gridM: number;
  /** Disables snapping. */
  isOff: boolean;
}

const ANGLE_STEP_RAD = Math.PI / 12;

export function snap(
  plan: Plan,
  level: number,
  at: Point,
  from: Point | undefined,
  s: Settings,
): Snapped {
  if (s.isOff) return { at, to: 'none' };
  let best: Point | undefined;
  let nearest = s.reachM;
  for (const wall of plan.walls) {
    if (wall.level !== level) continue;
    for (const end of [wall.from, wall.to]) {
      const distance = Math.hypot(end.x - at.x, end.y - at.y);
      if (distance < nearest) [best, nearest] = [end, distance];
    }
  }
  if (best) return { at: { ...best }, to: 'end' };
  const onWall = nearestWall(plan, level, at);
  if (
    onWall &&
    onWall.distanceM < s.reachM / 2 &&
    onWall.atM > 0 &&
    onWall.atM < lengthOf(onWall.wall)
  ) {
    const m = Math.round(onWall.atM / s.gridM) * s.gridM;
    return { at: along(onWall.wall, Math.min(lengthOf(onWall.wall), m)), to: 'wall' };
  }
  if (from) return { at: angled(plan, level, at, from, s), to: 'angle' };
  return { at: gridded(at, s.gridM), to: 'grid' };
}

function angled(plan: Plan, level: number, at: Point, from: Point, s: Settings): Point {
  const [dx, dy] = [at.x - from.x, at.y - from.y];
  const angle = Math.round(Math.atan2(dy, dx) / ANGLE_STEP_RAD) * ANGLE_STEP_RAD;
  let length = Math.round(Math.hypot(dx, dy) / s.gridM) * s.gridM;
  // In line with the end of another wall, perpendicular to the start of this one.
  const [c, sn] = [Math.cos(angle), Math.sin(angle)];
  for (const wall of plan.walls) {
    if (wall.level !== level) continue;
    for (const end of [wall.from, wall.to]) {
      const u = (end.x - from.x) * c + (end.y - from.y) * sn;
      if (u > s.gridM && Math.abs(u - Math.hypot(dx, dy)) < s.reachM) length = u;
    }
  }
  return { x: tidy(from.x + c * length), y: tidy(from.y + sn * length) };
}

/** Rounds away the errors of sine and cosine. */
const tidy = (v: number) => Math.round(v * 1e6) / 1e6;

export function gridded(at: Point, gridM: number): Point {
  return { x: tidy(Math.round(at.x / gridM) * gridM), y: tidy(Math.round(at.y / gridM) * gridM) };
}
