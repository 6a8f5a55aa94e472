/** Waypoints that the user sets on the 3D view, each kept in the frame in which it was set. */
import { Color, Group, Mesh } from 'three';
import { fromYaw, multiply, yawOf, type Pose } from '../core/pose';
import { arrowGeometry, label, polyline, surface } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import type { App } from './app.svelte';

export interface Waypoint {
  id: number;
  frame: string;
  pose: Pose;
}

export const WAYPOINT_COLOR = new Color('#ffb02e');
/** Height above the floor plane, so that maps do not hide the marks [m]. */
const HEIGHT_M = 0.06;
/** Distance between two waypoints below which the second keeps the heading of the first [m]. */
const MIN_STEP_M = 0.01;

export class Waypoints {
  list: Waypoint[] = $state.raw([]);
  private marks = new Group();
  private drawnFor = '';
  private lastId = 0;

  constructor(private app: App) {}

  attach(stage: Stage): void {
    stage.ticks.add(() => this.app.stage === stage && this.draw());
  }

  /** Moves the marks to the 3D view that became the active one. */
  enter(stage: Stage): void {
    stage.scene.add(this.marks);
    this.drawnFor = '';
  }

  /** Adds a waypoint in the fixed frame; without a heading it points away from the one before, or from the robot. */
  add(x: number, y: number, yaw?: number): void {
    const pose = fromYaw(yaw ?? this.arrivalYaw(x, y), [x, y, 0]);
    this.list = [...this.list, { id: ++this.lastId, frame: this.app.fixedFrame, pose }];
  }

  remove(id: number): void {
    this.list = this.list.filter((one) => one.id !== id);
  }

  clear(): void {
    this.list = [];
  }

  private arrivalYaw(x: number, y: number): number {
    const last = this.list[this.list.length - 1];
    const from = last ? this.inFixed(last) : this.robot();
    if (!from) return 0;
    const [dx, dy] = [x - from.t[0], y - from.t[1]];
    return Math.hypot(dx, dy) < MIN_STEP_M ? yawOf(from.q) : Math.atan2(dy, dx);
  }

  private robot(): Pose | undefined {
    const base = this.app.robots.baseFrame();
    const found = base ? this.app.tf.lookup(this.app.fixedFrame, base) : undefined;
    return found?.kind === 'found' ? found.pose : undefined;
  }

  private inFixed({ frame, pose }: Waypoint): Pose | undefined {
    const found = this.app.tf.lookup(this.app.fixedFrame, frame);
    return found.kind === 'found' ? multiply(found.pose, pose) : undefined;
  }

  /** Draws the marks again if a waypoint or its pose in the fixed frame changed. */
  private draw(): void {
    const poses = this.list.map((one) => this.inFixed(one));
    const key = poses.map((one) => one && [...one.t, ...one.q].map((n) => n.toFixed(4))).join(';');
    if (key === this.drawnFor) return;
    this.drawnFor = key;
    for (const child of [...this.marks.children]) dispose(child);
    const line: number[] = [];
    poses.forEach((pose, i) => {
      if (!pose) return;
      const [x, y, z] = pose.t;
      line.push(x, y, z + HEIGHT_M);
      const arrow = waypointArrow();
      arrow.position.set(x, y, z + HEIGHT_M);
      arrow.quaternion.set(...pose.q);
      const number = label(`${i + 1}`, 0.22, '#ffe3b0', true);
      number.position.set(x, y, z + 0.4);
      this.marks.add(arrow, number);
    });
    if (line.length >= 6) this.marks.add(polyline(line, WAYPOINT_COLOR, 0.7));
    this.app.stage?.invalidate();
  }
}

/** Arrow of a waypoint; as long as the drag that sets its heading, at least 0.4 m. */
export function waypointArrow(lengthM = 0): Mesh {
  const length = Math.max(0.4, lengthM);
  return new Mesh(arrowGeometry(length - 0.18, 0.035, 0.18, 0.1), surface(WAYPOINT_COLOR));
}
