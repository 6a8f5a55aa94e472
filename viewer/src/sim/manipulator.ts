/** Dragging of the selected models by handles, and selection by a rectangle. */
import { Ray, Vector3, type Intersection } from 'three';
import type { App } from '../app/app.svelte';
import { yawOf, type Pose, type Vec3 } from '../core/pose';
import { label, matrixOf } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import { Drag, isRing, movedPoses, snapped, type Handle } from './drag';
import type { WorldEditor } from './editor.svelte';
import { Handles } from './handles';

/** Point in page coordinates, with the keys that were held. */
export interface PagePoint {
  clientX: number;
  clientY: number;
  ctrlKey?: boolean;
  metaKey?: boolean;
  shiftKey?: boolean;
}

/** Length of the handles on the screen, for a mouse and for fingers [px]. */
const HANDLE_PX = 92;
const TOUCH_HANDLE_PX = 130;
/** Cosine of the angle between a handle and the line of sight above which the handle is not shown. */
const MOST_ALONG_SIGHT = 0.97;
/** Shortest distance of the pointer that draws a rectangle [px]. */
const BOX_PX = 5;

const SHOWN: Record<string, Handle[]> = {
  move: ['x', 'y', 'z', 'xy', 'turnZ'],
  select: ['x', 'y', 'z', 'xy', 'turnZ'],
  translate: ['x', 'y', 'z', 'xy'],
  rotate: ['turnX', 'turnY', 'turnZ'],
};

interface Active {
  drag: Drag;
  pivot: Vec3;
  starts: ReadonlyMap<string, Pose>;
  single?: Pose;
}

export class Manipulator {
  private handles = new Handles();
  private touch = window.matchMedia('(pointer: coarse)');
  private active?: Active;
  private box?: { from: PagePoint; element: HTMLElement };
  private caption?: ReturnType<typeof label>;

  constructor(
    private app: App,
    private editor: WorldEditor,
  ) {}

  get isDragging(): boolean {
    return this.active !== undefined;
  }

  /** Draws the handles and frames for the present selection; called once per frame of the active view. */
  tick(stage: Stage, tool: string): void {
    const { handles, app } = this;
    const world = app.world();
    if (handles.root.parent !== stage.scene) stage.scene.add(handles.root);
    const isEditable = world && app.worldName !== '';
    const movable = isEditable ? app.selection.filter((model) => !world.isGround(model)) : [];
    const pivot = this.pivot(movable);
    handles.show(pivot ? this.seen(stage, SHOWN[tool] ?? []) : []);
    const boxes = movable.flatMap((model) => world!.extentOf(model) ?? []);
    if (handles.frame(boxes)) stage.invalidate();
    if (!pivot || !world) return;
    handles.root.matrix.copy(matrixOf(world.fixedFromWorld));
    handles.root.matrixWorldNeedsUpdate = true;
    const lengthPx = this.touch.matches ? TOUCH_HANDLE_PX : HANDLE_PX;
    handles.place(pivot, this.metresOf(stage, lengthPx, pivot));
  }

  /** Handles without those along the line of sight, which would only cover the model. */
  private seen(stage: Stage, all: readonly Handle[]): Handle[] {
    const sight = stage.view.camera.getWorldDirection(new Vector3());
    const along = sight.transformDirection(this.handles.root.matrix.clone().invert());
    const isSeen = (axis: number) => Math.abs(axis) < MOST_ALONG_SIGHT;
    return all.filter((handle) => {
      if (handle === 'x') return isSeen(along.x);
      if (handle === 'y') return isSeen(along.y);
      return handle !== 'z' || isSeen(along.z);
    });
  }

  /** Origin of one model; of several the middle of their origins. */
  private pivot(models: readonly string[]): Vec3 | undefined {
    const all = models.flatMap((model) => this.editor.poseOf(model) ?? []);
    if (all.length === 0) return undefined;
    const mean = (i: 0 | 1 | 2) => all.reduce((sum, { t }) => sum + t[i], 0) / all.length;
    return [mean(0), mean(1), mean(2)];
  }

  private metresOf({ view }: Stage, px: number, at: Vec3): number {
    if (view.state.kind === 'TopDownOrtho') return px / view.state.scale;
    const point = new Vector3(...at).applyMatrix4(this.handles.root.matrix);
    const distance = view.perspective.position.distanceTo(point);
    return (px * 2 * distance * Math.tan((view.perspective.fov * Math.PI) / 360)) / view.height;
  }

  /** Ray through a point of the page, in the world frame of the simulation. */
  private ray(stage: Stage, at: PagePoint): Ray {
    return this.inWorld(stage.view.ray(at.clientX, at.clientY).ray);
  }

  private inWorld(ray: Ray): Ray {
    return ray.clone().applyMatrix4(this.handles.root.matrix.clone().invert());
  }

  /** Grabs the handle under the pointer; returns false without one. */
  grab(at: PagePoint): boolean {
    const { stage } = this.app;
    const found = stage && this.handles.hit(stage.view.ray(at.clientX, at.clientY));
    if (!found) return false;
    this.begin(found.handle, found.point, at);
    return true;
  }

  /** Grabs a selected model itself at a point of it. */
  grabModel(hit: Intersection, handle: 'xy' | 'turnZ', at: PagePoint): void {
    const world = this.app.world();
    // The handles follow the selection, which may have changed with the same press.
    if (world) this.handles.root.matrix.copy(matrixOf(world.fixedFromWorld));
    this.begin(handle, hit.point, at);
  }

  private begin(handle: Handle, point: Vector3, at: PagePoint): void {
    const stage = this.app.stage!;
    const starts = this.editor.beginDrag();
    const pivot = this.pivot([...starts.keys()]);
    if (!pivot) return this.cancel();
    const grabbed = point.clone().applyMatrix4(this.handles.root.matrix.clone().invert());
    const drag = new Drag(handle, new Vector3(...pivot), grabbed, this.ray(stage, at));
    const single = starts.size === 1 ? [...starts.values()][0] : undefined;
    this.active = { drag, pivot, starts, single };
    this.handles.highlight(handle);
  }

  /** Moves what was grabbed; highlights the handle under the pointer otherwise. */
  moved(at: PagePoint): void {
    const { stage } = this.app;
    if (!stage) return;
    if (this.box) this.draw(this.box, at);
    if (!this.active) {
      const isIdle = this.app.selection.length > 0;
      const found = isIdle
        ? this.handles.hit(stage.view.ray(at.clientX, at.clientY))?.handle
        : undefined;
      if (this.handles.highlight(found)) stage.invalidate();
      return;
    }
    const { drag, pivot, starts, single } = this.active;
    const raw = drag.motion(this.ray(stage, at));
    if (!raw) return;
    const isFree = at.ctrlKey || at.metaKey || !this.editor.isSnapping;
    const motion = isFree ? raw : snapped(raw, this.editor.gridM, single);
    const poses = movedPoses(motion, pivot, starts);
    this.editor.drag(poses);
    this.describe(stage, poses);
    stage.invalidate();
  }

  /** Pose of the first dragged model beside it. */
  private describe(stage: Stage, poses: ReadonlyMap<string, Pose>): void {
    this.clearCaption();
    const [first] = poses.values();
    if (!first) return;
    const [x, y, z] = first.t.map((v) => v.toFixed(2)) as [string, string, string];
    const degrees = ((yawOf(first.q) * 180) / Math.PI).toFixed(0);
    const heightM = this.metresOf(stage, 20, first.t);
    this.caption = label(`${x}, ${y}, ${z} m, ${degrees}°`, heightM, '#d5ffe6', true);
    this.caption.position.set(first.t[0], first.t[1], first.t[2] + 3 * heightM);
    this.caption.renderOrder = 70;
    this.caption.material.depthTest = false;
    this.handles.root.add(this.caption);
  }

  private clearCaption(): void {
    if (this.caption) dispose(this.caption);
    this.caption = undefined;
  }

  /** Ends a drag; returns false if there was none. */
  drop(): boolean {
    const { active } = this;
    if (!active) return false;
    this.active = undefined;
    this.clearCaption();
    this.handles.highlight(undefined);
    void this.editor.endDrag(isRing(active.drag.handle) ? 'rotate' : 'move');
    this.app.stage?.invalidate();
    return true;
  }

  /** Puts dragged models back, and ends a rectangle. */
  cancel(): void {
    this.box?.element.remove();
    this.box = undefined;
    this.clearCaption();
    this.handles.highlight(undefined);
    if (this.editor.isDragging) void this.editor.endDrag('move', true);
    this.active = undefined;
    this.app.stage?.invalidate();
  }

  // Selection by a rectangle.

  beginBox(from: PagePoint): void {
    const element = document.createElement('div');
    element.setAttribute('aria-hidden', 'true');
    element.style.cssText =
      'position:fixed;z-index:2;border:1.5px dashed var(--accent);background:var(--accent-soft);pointer-events:none';
    this.box = { from, element };
  }

  private draw({ from, element }: { from: PagePoint; element: HTMLElement }, to: PagePoint): void {
    const [x, y] = [Math.min(from.clientX, to.clientX), Math.min(from.clientY, to.clientY)];
    const width = Math.abs(to.clientX - from.clientX);
    const height = Math.abs(to.clientY - from.clientY);
    if (Math.max(width, height) >= BOX_PX && !element.isConnected) document.body.append(element);
    Object.assign(element.style, {
      left: `${x}px`,
      top: `${y}px`,
      width: `${width}px`,
      height: `${height}px`,
    });
  }

  /** Selects the models whose origins are in the rectangle; returns false if it was only a click. */
  endBox(to: PagePoint): boolean {
    const { box, app } = this;
    const { stage } = app;
    this.box = undefined;
    box?.element.remove();
    const world = app.world();
    if (!box || !stage || !world) return false;
    const { from } = box;
    const [left, right] = [from.clientX, to.clientX].sort((a, b) => a - b) as [number, number];
    const [top, bottom] = [from.clientY, to.clientY].sort((a, b) => a - b) as [number, number];
    if (right - left < BOX_PX && bottom - top < BOX_PX) return false;
    const page = stage.renderer.domElement.getBoundingClientRect();
    const scene = matrixOf(world.fixedFromWorld);
    const found = app.models.filter((model) => {
      const pose = world.poseOf(model);
      if (!pose || world.isGround(model)) return false;
      const at = new Vector3(...pose.t).applyMatrix4(scene).project(stage.view.camera);
      const x = page.left + ((at.x + 1) / 2) * page.width;
      const y = page.top + ((1 - at.y) / 2) * page.height;
      return at.z < 1 && x >= left && x <= right && y >= top && y <= bottom;
    });
    const kept = to.shiftKey ? app.selection.filter((model) => !found.includes(model)) : [];
    app.selection = [...kept, ...found];
    return true;
  }
}
