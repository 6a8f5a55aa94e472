/** State of the Building Editor: the plan, the selection, and the effect of the next click. */
import { t } from '../texts/language.svelte';
import { History } from './history';
import {
  along,
  DOOR,
  emptyPlan,
  lengthOf,
  nearestWall,
  STAIRS,
  WALL,
  WINDOW,
  yawOfWall,
  type FloorPlan,
  type Opening,
  type Plan,
  type Point,
  type Stairs,
  type Wall,
} from './plan';
import { gridded, snap, type Snapped } from './snap';

export type Mode = 'select' | 'wall' | 'door' | 'window' | 'stairs' | 'scale';

/** Maximum distance from the cursor to the wall that gets an opening [m]. */
const WALL_REACH_M = 0.6;

export class Editor {
  plan: Plan = $state(emptyPlan());
  mode: Mode = $state('wall');
  level = $state(0);
  selected = $state(0);
  /** Start of the wall being drawn. */
  start: Point | undefined = $state();
  /** Position of the mouse or of the keyboard cursor. */
  cursor: Snapped = $state({ at: { x: 0, y: 0 }, to: 'grid' });
  gridM = $state(0.1);
  isSnapping = $state(true);
  /** Length typed while drawing a wall. */
  typed = $state('');
  canUndo = $state(false);
  canRedo = $state(false);
  /** Ends of the line of known length in the image. */
  scaleFrom: Point | undefined = $state();
  scaleTo: Point | undefined = $state();
  /** Pixels per metre on the screen, from which the snapping distance follows. */
  zoom = $state(60);
  private history: History<Plan>;
  private chainStart?: Point;

  /** Number of plans opened so far: the view fits each new one. */
  opened = $state(0);

  /** Starts with an empty plan over an image. */
  constructor(picture?: FloorPlan) {
    this.plan.picture = picture;
    this.history = History.of($state.snapshot(this.plan));
  }

  /** Opens another plan; the image stays. */
  open(plan: Plan): void {
    this.opened++;
    this.plan = { ...plan, picture: plan.picture ?? this.plan.picture };
    this.level = 0;
    this.choose(0);
    this.cancel();
    this.note();
  }

  /** Records the state for undo; to be called after each change. */
  note(): void {
    this.history.note($state.snapshot(this.plan));
    this.canUndo = this.history.canUndo;
    this.canRedo = this.history.canRedo;
  }

  undo(): void {
    this.restore(this.history.undo());
  }

  redo(): void {
    this.restore(this.history.redo());
  }

  private restore(plan: Plan | undefined): void {
    if (!plan) return;
    this.plan = plan;
    this.level = Math.min(this.level, plan.levels.length - 1);
    this.choose(0);
    this.start = undefined;
    this.canUndo = this.history.canUndo;
    this.canRedo = this.history.canRedo;
  }

  choose(id: number): void {
    this.selected = id;
  }

  setMode(mode: Mode): void {
    this.mode = mode;
    this.cancel();
  }

  cancel(): void {
    this.start = undefined;
    this.chainStart = undefined;
    this.typed = '';
  }

  wall(id: number): Wall | undefined {
    return this.plan.walls.find((w) => w.id === id);
  }

  // Cursor.

  point(at: Point, isFree = false): void {
    const settings = {
      reachM: 12 / this.zoom,
      gridM: this.gridM,
      isOff: isFree || !this.isSnapping,
    };
    if (this.mode === 'scale') this.cursor = { at, to: 'none' };
    else this.cursor = snap(this.plan, this.level, at, this.start, settings);
  }

  /** Moves the cursor by arrow keys. */
  nudge(dx: number, dy: number): void {
    const { at } = this.cursor;
    this.cursor = { at: gridded({ x: at.x + dx, y: at.y + dy }, this.gridM / 10), to: 'grid' };
  }

  /** Applies the current mode at the cursor. */
  press(): void {
    const at = { ...this.cursor.at };
    if (this.mode === 'wall') this.pressWall(at);
    else if (this.mode === 'door' || this.mode === 'window') this.addOpening(this.mode, at);
    else if (this.mode === 'stairs') this.addStairs(at);
    else if (this.mode === 'scale') {
      if (!this.scaleFrom || this.scaleTo) [this.scaleFrom, this.scaleTo] = [at, undefined];
      else this.scaleTo = at;
    }
  }

  private pressWall(at: Point): void {
    if (!this.start) {
      this.start = at;
      this.chainStart = at;
      return;
    }
    this.endWall(at);
  }

  /** Ends the wall in the direction of the cursor, with the length typed. */
  endTyped(): void {
    const length = Number(this.typed.replace(',', '.'));
    const { start } = this;
    if (!start || !(length > 0)) return;
    const yaw = Math.atan2(this.cursor.at.y - start.y, this.cursor.at.x - start.x);
    const tidy = (v: number) => Math.round(v * 1e6) / 1e6;
    this.endWall({
      x: tidy(start.x + Math.cos(yaw) * length),
      y: tidy(start.y + Math.sin(yaw) * length),
    });
  }

  private endWall(to: Point): void {
    const from = this.start!;
    this.typed = '';
    if (Math.hypot(to.x - from.x, to.y - from.y) < 0.01) return;
    const id = ++this.plan.lastId;
    const last = this.plan.walls[this.plan.walls.length - 1];
    // Thickness and height of the last wall.
    const { thicknessM, heightM, material } = last ?? WALL;
    this.plan.walls.push({ id, level: this.level, from, to, thicknessM, heightM, material });
    const first = this.chainStart!;
    const isClosed = Math.hypot(to.x - first.x, to.y - first.y) < 1e-6;
    this.start = isClosed ? undefined : to;
    this.choose(id);
    this.note();
  }

  addOpening(kind: 'door' | 'window', at: Point): void {
    const near = nearestWall(this.plan, this.level, at);
    if (!near || near.distanceM > WALL_REACH_M) return;
    const size = kind === 'door' ? DOOR : WINDOW;
    const length = lengthOf(near.wall);
    const half = Math.min(size.widthM, length) / 2;
    const raw = Math.round(near.atM / this.gridM) * this.gridM;
    const atM = Math.min(length - half, Math.max(half, raw));
    const id = ++this.plan.lastId;
    this.plan.openings.push({ id, wall: near.wall.id, kind, atM, ...size, widthM: half * 2 });
    this.choose(id);
    this.note();
  }

  addStairs(at: Point): void {
    const id = ++this.plan.lastId;
    this.plan.stairs.push({ id, level: this.level, at, yawRad: 0, ...STAIRS });
    this.choose(id);
    this.note();
  }

  // Changes of the selection.

  remove(): void {
    const { plan, selected } = this;
    plan.walls = plan.walls.filter((w) => w.id !== selected);
    plan.openings = plan.openings.filter((o) => o.id !== selected && o.wall !== selected);
    plan.stairs = plan.stairs.filter((s) => s.id !== selected);
    this.choose(0);
    this.note();
  }

  /** Changes the length of a wall, which keeps its start and direction; walls joined to its end follow. */
  setLength(wall: Wall, lengthM: number): void {
    if (!(lengthM > 0.01)) return;
    const old = { ...wall.to };
    const yaw = yawOfWall(wall);
    const tidy = (v: number) => Math.round(v * 1e6) / 1e6;
    const to = {
      x: tidy(wall.from.x + Math.cos(yaw) * lengthM),
      y: tidy(wall.from.y + Math.sin(yaw) * lengthM),
    };
    this.moveEnds(old, to, wall.level);
  }

  /** Moves the ends of all walls at a point. */
  moveEnds(from: Point, to: Point, level: number): void {
    const isAt = (p: Point) => Math.hypot(p.x - from.x, p.y - from.y) < 1e-6;
    for (const wall of this.plan.walls) {
      if (wall.level !== level) continue;
      const [isFrom, isTo] = [isAt(wall.from), isAt(wall.to)];
      if (isFrom) wall.from = { ...to };
      if (isTo) wall.to = { ...to };
    }
  }

  /** Moves the selection by an offset [m]. */
  move(dx: number, dy: number): void {
    const { plan, selected } = this;
    const wall = this.wall(selected);
    const shift = (p: Point) => gridded({ x: p.x + dx, y: p.y + dy }, 0.001);
    if (wall) {
      const [from, to] = [{ ...wall.from }, { ...wall.to }];
      this.moveEnds(from, shift(from), wall.level);
      this.moveEnds(to, shift(to), wall.level);
    }
    const stairs = plan.stairs.find((s) => s.id === selected);
    if (stairs) stairs.at = shift(stairs.at);
    const opening = plan.openings.find((o) => o.id === selected);
    const its = opening && this.wall(opening.wall);
    if (opening && its) {
      const yaw = yawOfWall(its);
      this.slide(opening, its, opening.atM + dx * Math.cos(yaw) + dy * Math.sin(yaw));
    }
  }

  slide(opening: Opening, wall: Wall, atM: number): void {
    const half = opening.widthM / 2;
    opening.atM = Math.max(half, Math.min(lengthOf(wall) - half, Math.round(atM * 1000) / 1000));
  }

  // Levels and the image.

  addLevel(): void {
    const { levels } = this.plan;
    levels.push({ name: t().building.levelName(levels.length + 1), heightM: WALL.heightM });
    const top = levels.length - 1;
    // As in Gazebo's Building Editor, a new level starts with the outer walls of the one below.
    for (const wall of this.plan.walls.filter((w) => w.level === top - 1)) {
      this.plan.walls.push({
        ...structuredClone($state.snapshot(wall)),
        id: ++this.plan.lastId,
        level: top,
      });
    }
    this.level = top;
    this.note();
  }

  /** Removes the present level; those above move down. */
  removeLevel(): void {
    const { plan, level: gone } = this;
    if (plan.levels.length < 2) return;
    const walls = plan.walls.filter((w) => w.level === gone).map((w) => w.id);
    plan.walls = plan.walls.filter((w) => w.level !== gone);
    plan.openings = plan.openings.filter((o) => !walls.includes(o.wall));
    plan.stairs = plan.stairs.filter((s) => s.level !== gone);
    for (const one of [...plan.walls, ...plan.stairs]) if (one.level > gone) one.level--;
    plan.levels.splice(gone, 1);
    plan.levels.forEach((level, i) => (level.name = t().building.levelName(i + 1)));
    this.level = Math.min(gone, plan.levels.length - 1);
    this.choose(0);
    this.note();
  }

  /** Changes the height of the present level; walls that reached its ceiling still do. */
  setLevelHeight(heightM: number): void {
    const level = this.plan.levels[this.level]!;
    for (const wall of this.plan.walls) {
      const isFull = wall.level === this.level && Math.abs(wall.heightM - level.heightM) < 1e-6;
      if (isFull) wall.heightM = heightM;
    }
    level.heightM = heightM;
  }

  /** Sets the scale of the image from the length of the line drawn in it. */
  setScale(lengthM: number): void {
    const { picture } = this.plan;
    if (!picture || !this.scaleFrom || !this.scaleTo || !(lengthM > 0)) return;
    const drawn = Math.hypot(this.scaleTo.x - this.scaleFrom.x, this.scaleTo.y - this.scaleFrom.y);
    if (drawn < 1e-6) return;
    picture.pixelsPerM = (picture.pixelsPerM * drawn) / lengthM;
    this.scaleFrom = this.scaleTo = undefined;
    this.setMode('wall');
    this.note();
  }

  openingsOf(level: number): { opening: Opening; wall: Wall; at: Point }[] {
    return this.plan.openings.flatMap((opening) => {
      const wall = this.wall(opening.wall);
      return wall?.level === level ? [{ opening, wall, at: along(wall, opening.atM) }] : [];
    });
  }

  chosen(): { wall?: Wall; opening?: Opening; stairs?: Stairs } {
    const { plan, selected } = this;
    return {
      wall: plan.walls.find((w) => w.id === selected),
      opening: plan.openings.find((o) => o.id === selected),
      stairs: plan.stairs.find((s) => s.id === selected),
    };
  }
}
