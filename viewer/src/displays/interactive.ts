/** InteractiveMarkers: handles of nodes that are moved, turned and clicked, with menus. */
import { Group, Matrix4, Mesh, Quaternion, Vector3, type Object3D } from 'three';
import type { Message } from '../core/cdr';
import { multiply, type Pose } from '../core/pose';
import { poseOf, seconds, stampOf } from '../core/types';
import { axesGeometry, axesMaterial } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { t } from '../texts/language.svelte';
import { Display, type Kind } from './display';
import { asRotation, drag, type Grip, type Placed } from './interactive_drag';
import { stepped, type Direction, type Steps } from './interactive_keys';
import { openMenu } from './interactive_menu';
import {
  completed,
  EVENT,
  menuTree,
  MODE,
  ORIENTATION,
  titleOf,
  type Control,
  type InteractiveMarker,
  type Update,
} from './interactive_messages';
import { markerObject } from './marker_shapes';
import { bool, type Option } from './options';

const UPDATE = ['visualization_msgs/msg/InteractiveMarkerUpdate'];
const FEEDBACK = 'visualization_msgs/msg/InteractiveMarkerFeedback';
const KEEP_ALIVE_TYPE = 0;
/** Time between feedback messages while a marker is held still [ms]. */
const KEEP_ALIVE_MS = 1000;
/** Shortest time between two poses of a drag [ms]. */
const POSE_MS = 33;
const RETRY_MS = 2000;
const CLICK_PX = 5;

interface Part {
  control: Control;
  holder: Group;
}

interface Entry {
  marker: InteractiveMarker;
  root: Group;
  parts: Part[];
  title: Object3D;
  axes: Object3D;
}

interface Held {
  entry: Entry;
  control: Control;
  grip: Grip;
  x: number;
  y: number;
  sentMs: number;
  isMoved: boolean;
}

let clients = 0;

/** A marker and the controls that a user can move or press. */
export interface MarkerHandle {
  name: string;
  description: string;
  hasMenu: boolean;
  controls: { index: number; name: string; mode: number }[];
}

export class InteractiveMarkersDisplay extends Display {
  private entries = new Map<string, Entry>();
  private sequence: bigint | undefined;
  private waiting: Update[] = [];
  private isAsking = false;
  private retryMs = 0;
  private held?: Held;
  private hovered?: Part;
  private closeMenu?: () => void;
  private clientId = `periplus_page_${++clients}_${Math.random().toString(36).slice(2, 8)}`;
  private events = new AbortController();

  override start(): void {
    this.events.abort();
    this.events = new AbortController();
    this.sequence = undefined;
    this.waiting = [];
    this.retryMs = 0;
    this.isAsking = false;
    const namespace = this.namespace;
    this.values.Topic = namespace ? `${namespace}/update` : '';
    super.start();
    this.listen();
  }

  private get namespace(): string {
    return this.get<string>('Interactive Markers Namespace').replace(/\/(update)?$/, '');
  }

  // Messages.

  /** Asks for all markers: updates have only what changes. */
  private async ask(nowMs: number): Promise<void> {
    const service = `${this.namespace}/get_interactive_markers`;
    this.retryMs = nowMs + RETRY_MS;
    if (!this.context.hasService(service)) {
      this.host.status('Markers', 'warn', t().valueDisplays.noService(service));
      return;
    }
    this.isAsking = true;
    const { signal } = this.events;
    try {
      const answer = await this.context.call(service, {});
      if (signal.aborted) return;
      this.clear();
      this.sequence = BigInt(answer.sequence_number as number | bigint);
      this.set(answer.markers as never);
      const waiting = this.waiting.filter((update) => BigInt(update.seq_num) > this.sequence!);
      this.waiting = [];
      for (const update of waiting) this.update(update);
    } catch (error) {
      if (!signal.aborted) this.host.status('Markers', 'error', (error as Error).message);
    } finally {
      if (!signal.aborted) this.isAsking = false;
    }
  }

  protected override receive(message: Message): void {
    const update = message as never as Update;
    const isReady = this.sequence !== undefined && !this.isAsking;
    if (!isReady && this.context.hasService(`${this.namespace}/get_interactive_markers`)) {
      this.waiting.push(update);
      if (this.waiting.length > 100) this.waiting.shift();
      return;
    }
    this.update(update);
  }

  private update(update: Update): void {
    const number = BigInt(update.seq_num);
    const isAlive = update.type === KEEP_ALIVE_TYPE;
    // A gap: an update was lost.
    const expected = this.sequence === undefined ? number : this.sequence + (isAlive ? 0n : 1n);
    if (number > expected) {
      this.sequence = undefined;
      return;
    }
    if (isAlive) return;
    this.sequence = number;
    this.set(update.markers);
    for (const { name, header, pose } of update.poses) {
      const entry = this.entries.get(name);
      // While the user holds a marker, its pose is the user's.
      if (entry && entry !== this.held?.entry) Object.assign(entry.marker, { header, pose });
    }
    for (const name of update.erases) this.erase(name);
    this.count();
  }

  private set(markers: readonly InteractiveMarker[]): void {
    for (const given of markers) {
      if (given.name === this.held?.entry.marker.name) continue;
      this.erase(given.name);
      this.build(completed(given, this.get<boolean>('Enable Transparency')));
    }
    this.count();
  }

  private count(): void {
    this.host.status('Markers', 'ok', t().valueDisplays.interactive(this.entries.size));
    this.context.stage.invalidate();
  }

  private erase(name: string): void {
    const entry = this.entries.get(name);
    if (!entry) return;
    dispose(entry.root);
    this.entries.delete(name);
    if (this.held?.entry === entry) this.release();
    if (this.hovered && entry.parts.includes(this.hovered)) this.hovered = undefined;
  }

  private build(marker: InteractiveMarker): void {
    const root = new Group();
    root.matrixAutoUpdate = false;
    root.visible = false;
    const done = (why?: string) => {
      if (why) this.host.status('Meshes', 'error', why);
      this.context.stage.invalidate();
    };
    const parts = marker.controls.map((control): Part => {
      const holder = new Group();
      holder.matrixAutoUpdate = false;
      for (const one of control.markers) {
        const object = markerObject(one, this.context.meshes, done);
        const place = new Group();
        place.position.set(one.pose.position.x, one.pose.position.y, one.pose.position.z);
        const { x, y, z, w } = one.pose.orientation;
        place.quaternion.set(x, y, z, w);
        place.add(object);
        holder.add(place);
      }
      holder.userData.inspect = () => ({
        'Interactive marker': marker.name,
        Control: control.description || control.name,
      });
      root.add(holder);
      return { control, holder };
    });
    const title = new Group();
    if (marker.description) {
      const caption = titleOf(marker);
      const text = markerObject(caption, this.context.meshes, done);
      text.position.setZ(caption.pose.position.z);
      title.add(text);
    }
    const axes = new Mesh(axesGeometry(marker.scale * 0.5, marker.scale * 0.02), axesMaterial());
    root.add(title, axes);
    this.root.add(root);
    this.entries.set(marker.name, { marker, root, parts, title, axes });
  }

  // Drawing.

  override tick(nowMs: number): void {
    const isMissing = this.sequence === undefined && !this.isAsking && this.namespace !== '';
    if (isMissing && nowMs >= this.retryMs) void this.ask(nowMs);
    for (const entry of this.entries.values()) this.place(entry);
    const { held } = this;
    if (held && nowMs - held.sentMs > KEEP_ALIVE_MS)
      this.send(held.entry, held.control.name, EVENT.keepAlive);
  }

  private place(entry: Entry): void {
    const { marker, root, parts } = entry;
    const fixed = this.fixedFromFrame(marker);
    root.visible = fixed !== undefined;
    if (!fixed) return;
    const { t, q } = multiply(fixed, poseOf(marker.pose));
    const before = root.matrix.clone();
    root.matrix.compose(new Vector3(...t), new Quaternion(...q), new Vector3(1, 1, 1));
    root.matrixWorldNeedsUpdate = true;
    entry.title.visible = this.get('Show Descriptions');
    entry.axes.visible = this.get('Show Axes');
    const inverse = new Quaternion(...q).invert();
    for (const { control, holder } of parts) {
      const turn = new Quaternion();
      if (control.orientation_mode === ORIENTATION.fixed) {
        // The frame's rotation without that of the marker.
        turn.copy(inverse).multiply(new Quaternion(...fixed.q));
      } else if (
        control.orientation_mode === ORIENTATION.viewFacing &&
        !control.independent_marker_orientation
      ) {
        turn.copy(inverse).multiply(this.facing());
      }
      holder.matrix.makeRotationFromQuaternion(turn);
      holder.matrixWorldNeedsUpdate = true;
      const isActive = this.held?.entry === entry || control.interaction_mode !== MODE.none;
      holder.visible = control.always_visible || isActive;
    }
    if (!before.equals(root.matrix)) this.context.stage.invalidate();
  }

  private fixedFromFrame({ header }: InteractiveMarker) {
    const { tf } = this.context;
    const fixed = this.context.fixedFrame();
    const stampS = seconds(header.stamp);
    // A stamp of 0 means that the marker moves with its frame.
    const then = stampS > 0 ? tf.lookup(fixed, header.frame_id, stampS) : undefined;
    const found = then?.kind === 'found' ? then : tf.lookup(fixed, header.frame_id);
    if (found.kind === 'found') {
      this.host.status('Transform', 'ok');
      return found.pose;
    }
    this.host.status('Transform', 'error', found.why);
    return undefined;
  }

  /** Rotation of a control whose x axis points to the camera and whose z axis points up on the screen. */
  private facing(): Quaternion {
    const { camera } = this.context.stage.view;
    const x = new Vector3(0, 0, 1).applyQuaternion(camera.quaternion);
    const z = new Vector3(0, 1, 0).applyQuaternion(camera.quaternion);
    const y = z.clone().cross(x);
    return new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(x, y, z));
  }

  // The mouse.

  private listen(): void {
    const canvas = this.context.stage.renderer.domElement;
    const options = { capture: true, signal: this.events.signal };
    canvas.addEventListener('pointerdown', (event) => this.down(event), options);
    canvas.addEventListener('pointermove', (event) => this.move(event), options);
    canvas.addEventListener('pointerup', (event) => this.up(event), options);
    canvas.addEventListener('pointercancel', () => this.release(), options);
  }

  /** Control under a point of the page, in front of everything else. */
  private hit(event: PointerEvent): { entry: Entry; part: Part; point: Vector3 } | undefined {
    if (this.entries.size === 0) return undefined;
    const caster = this.context.stage.view.ray(event.clientX, event.clientY);
    const all = [...this.entries.values()].flatMap((entry) =>
      entry.root.visible
        ? entry.parts
            .filter(
              ({ control, holder }) => control.interaction_mode !== MODE.none && holder.visible,
            )
            .map((part) => ({ entry, part }))
        : [],
    );
    const found = all
      .flatMap(({ entry, part }) => {
        const [first] = caster.intersectObject(part.holder, true);
        return first ? [{ entry, part, point: first.point, distance: first.distance }] : [];
      })
      .sort((a, b) => a.distance - b.distance)[0];
    return found;
  }

  private down(event: PointerEvent): void {
    const { view } = this.context.stage;
    if (view.isHeld || (event.button !== 0 && event.button !== 2)) return;
    const found = this.hit(event);
    if (!found) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    const { entry, part, point } = found;
    const isMenu = part.control.interaction_mode === MODE.menu || event.button === 2;
    if (isMenu) {
      this.menu(entry, part.control, event);
      return;
    }
    view.isHeld = true;
    this.context.stage.renderer.domElement.setPointerCapture(event.pointerId);
    this.held = {
      entry,
      control: part.control,
      grip: this.grip(entry, part, point),
      x: event.clientX,
      y: event.clientY,
      sentMs: performance.now(),
      isMoved: false,
    };
    this.send(entry, part.control.name, EVENT.mouseDown, point);
  }

  private grip({ root }: Entry, { control, holder }: Part, point: Vector3): Grip {
    const position = new Vector3();
    const quaternion = new Quaternion();
    root.matrix.decompose(position, quaternion, new Vector3());
    const { x, y, z, w } = control.orientation;
    const turn = new Quaternion().setFromRotationMatrix(holder.matrix);
    const isFacing = control.orientation_mode === ORIENTATION.viewFacing;
    const view = new Vector3(0, 0, 1).applyQuaternion(this.context.stage.view.camera.quaternion);
    const axis = isFacing
      ? view.clone()
      : new Vector3(1, 0, 0)
          .applyQuaternion(new Quaternion(x, y, z, w))
          .applyQuaternion(turn)
          .applyQuaternion(quaternion);
    const start = { position, quaternion };
    return { mode: control.interaction_mode, axis: axis.normalize(), view, point, start };
  }

  private move(event: PointerEvent): void {
    const { held } = this;
    if (!held) {
      if (event.buttons === 0) this.hover(this.hit(event)?.part);
      return;
    }
    event.stopImmediatePropagation();
    const distance = Math.hypot(event.clientX - held.x, event.clientY - held.y);
    if (!held.isMoved && distance < CLICK_PX) return;
    held.isMoved = true;
    const { ray } = this.context.stage.view.ray(event.clientX, event.clientY);
    // As in RViz: with Ctrl a control of all six degrees of freedom turns.
    const isTurn = held.grip.mode === MODE.moveRotate3d && event.ctrlKey;
    const placed = drag(isTurn ? asRotation(held.grip) : held.grip, ray);
    if (!placed || !this.setPose(held.entry, placed)) return;
    if (performance.now() - held.sentMs >= POSE_MS) {
      held.sentMs = performance.now();
      this.send(held.entry, held.control.name, EVENT.poseUpdate);
    }
  }

  /** Sets the pose of a marker from one in the fixed frame; false without a transform. */
  private setPose({ marker }: Entry, placed: Placed): boolean {
    const fixed = this.fixedFromFrame(marker);
    if (!fixed) return false;
    const fixedFromFrame = new Matrix4().compose(
      new Vector3(...fixed.t),
      new Quaternion(...fixed.q),
      new Vector3(1, 1, 1),
    );
    const pose = new Matrix4().compose(placed.position, placed.quaternion, new Vector3(1, 1, 1));
    const frameFromMarker = fixedFromFrame.invert().multiply(pose);
    const [p, q] = [new Vector3(), new Quaternion()];
    frameFromMarker.decompose(p, q, new Vector3());
    marker.pose = {
      position: { x: p.x, y: p.y, z: p.z },
      orientation: { x: q.x, y: q.y, z: q.z, w: q.w },
    };
    this.context.stage.invalidate();
    return true;
  }

  private up(event: PointerEvent): void {
    const { held } = this;
    if (!held) return;
    event.stopImmediatePropagation();
    const { entry, control } = held;
    if (held.isMoved) this.send(entry, control.name, EVENT.poseUpdate);
    else if (control.interaction_mode === MODE.button) {
      this.send(entry, control.name, EVENT.buttonClick, held.grip.point);
    } else if (entry.marker.menu_entries.length > 0) {
      this.menu(entry, control, event);
    }
    this.send(entry, control.name, EVENT.mouseUp);
    this.release();
  }

  // The keyboard.

  /** Markers of which a control can be moved or pressed, by name. */
  handles(): MarkerHandle[] {
    return [...this.entries.values()]
      .map(({ marker }) => ({
        name: marker.name,
        description: marker.description,
        hasMenu: marker.menu_entries.length > 0,
        controls: marker.controls.flatMap((control, index) => {
          const mode = control.interaction_mode;
          const name = control.description || control.name;
          return mode === MODE.none || mode === MODE.menu ? [] : [{ index, name, mode }];
        }),
      }))
      .filter(({ hasMenu, controls }) => hasMenu || controls.length > 0)
      .sort((a, b) => a.name.localeCompare(b.name));
  }

  /** Pose of a marker in its frame. */
  poseOf(name: string): { frame: string; pose: Pose } | undefined {
    const marker = this.entries.get(name)?.marker;
    return marker && { frame: marker.header.frame_id, pose: poseOf(marker.pose) };
  }

  /** Moves a marker by a step of a control; false if the control does not move in this direction. */
  step(name: string, index: number, by: Direction, steps: Steps, isTurn = false): boolean {
    const entry = this.entries.get(name);
    const part = entry?.parts[index];
    if (!entry?.root.visible || !part || this.held) return false;
    // Two steps may come between two frames.
    this.place(entry);
    const { camera } = this.context.stage.view;
    const position = new Vector3();
    const quaternion = new Quaternion();
    entry.root.matrix.decompose(position, quaternion, new Vector3());
    const { mode, axis, start } = this.grip(entry, part, position);
    const { x, y, z, w } = part.control.orientation;
    const turn = new Quaternion(x, y, z, w).premultiply(
      new Quaternion().setFromRotationMatrix(part.holder.matrix),
    );
    const along = (vector: Vector3, q: Quaternion) => vector.applyQuaternion(q).normalize();
    const inFixed = (vector: Vector3) => along(vector.applyQuaternion(turn), quaternion);
    const screen = {
      x: along(new Vector3(1, 0, 0), camera.quaternion),
      y: along(new Vector3(0, 1, 0), camera.quaternion),
      z: along(new Vector3(0, 0, 1), camera.quaternion),
    };
    const isFacing = part.control.orientation_mode === ORIENTATION.viewFacing;
    const control = isFacing
      ? { x: axis, y: screen.x, z: screen.y }
      : { x: axis, y: inFixed(new Vector3(0, 1, 0)), z: inFixed(new Vector3(0, 0, 1)) };
    const asked = isTurn && mode === MODE.moveRotate3d ? MODE.rotate3d : mode;
    const placed = stepped(asked, control, screen, start, by, steps);
    if (!placed) return false;
    this.send(entry, part.control.name, EVENT.mouseDown, position);
    if (this.setPose(entry, placed)) this.send(entry, part.control.name, EVENT.poseUpdate);
    this.send(entry, part.control.name, EVENT.mouseUp);
    return true;
  }

  /** Presses a button control, or opens the menu of the marker; false if it has neither. */
  press(name: string, index: number, at: { clientX: number; clientY: number }): boolean {
    const entry = this.entries.get(name);
    if (!entry) return false;
    const control = entry.marker.controls[index];
    if (control?.interaction_mode === MODE.button) {
      const position = new Vector3().setFromMatrixPosition(entry.root.matrix);
      this.send(entry, control.name, EVENT.mouseDown, position);
      this.send(entry, control.name, EVENT.buttonClick, position);
      this.send(entry, control.name, EVENT.mouseUp);
      return true;
    }
    if (entry.marker.menu_entries.length === 0) return false;
    const [first] = entry.marker.controls;
    const chosen = control ?? first;
    if (!chosen) return false;
    this.menu(entry, chosen, at);
    return true;
  }

  private release(): void {
    if (!this.held) return;
    this.held = undefined;
    this.context.stage.view.isHeld = false;
  }

  private hover(part: Part | undefined): void {
    if (part === this.hovered) return;
    this.hovered = part;
    const { style } = this.context.stage.renderer.domElement;
    style.cursor = part ? 'pointer' : '';
    this.context.stage.invalidate();
  }

  private menu(entry: Entry, control: Control, at: { clientX: number; clientY: number }): void {
    const nodes = menuTree(entry.marker.menu_entries);
    if (nodes.length === 0) return;
    this.closeMenu?.();
    const name = entry.marker.description || entry.marker.name;
    this.closeMenu = openMenu(nodes, name, at, (chosen) => {
      if (chosen.command_type !== 0) {
        this.host.status('Menu', 'warn', t().valueDisplays.command(chosen.title, chosen.command));
        return;
      }
      this.send(entry, control.name, EVENT.menuSelect, undefined, chosen.id);
    });
  }

  private send(
    { marker }: Entry,
    controlName: string,
    event: number,
    fixedPoint?: Vector3,
    menuEntry = 0,
  ): void {
    const { held } = this;
    if (held) held.sentMs = performance.now();
    const fixed = fixedPoint && this.fixedFromFrame(marker);
    const point = fixedPoint?.clone();
    if (fixed && point) {
      point.sub(new Vector3(...fixed.t)).applyQuaternion(new Quaternion(...fixed.q).invert());
    }
    this.context.publish(`${this.namespace}/feedback`, FEEDBACK, {
      header: { stamp: stampOf(this.context.nowS()), frame_id: marker.header.frame_id },
      client_id: this.clientId,
      marker_name: marker.name,
      control_name: controlName,
      event_type: event,
      pose: marker.pose,
      menu_entry_id: menuEntry,
      mouse_point: point ? { x: point.x, y: point.y, z: point.z } : { x: 0, y: 0, z: 0 },
      mouse_point_valid: point !== undefined,
    });
  }

  // Options.

  override changed(path: string): void {
    if (path === 'Interactive Markers Namespace' || path === 'Enable Transparency') {
      this.clear();
      this.start();
    }
    super.changed(path);
  }

  /** Markers by name, for tests. */
  names(): string[] {
    return [...this.entries.keys()];
  }

  override clear(): void {
    this.release();
    this.closeMenu?.();
    for (const name of [...this.entries.keys()]) this.erase(name);
  }

  override stop(): void {
    this.clear();
    this.events.abort();
    super.stop();
  }
}

const options: Option[] = [
  { path: 'Interactive Markers Namespace', kind: 'text', default: '' },
  bool('Show Descriptions', true),
  bool('Show Axes', false),
  bool('Show Visual Aids', false),
  bool('Enable Transparency', true),
];

export const interactiveMarkers: Kind = {
  class: 'rviz_default_plugins/InteractiveMarkers',
  also: ['rviz/InteractiveMarkers'],
  title: 'InteractiveMarkers',
  get help() {
    return t().valueDisplays.interactiveMarkers;
  },
  types: UPDATE,
  options,
  make: (context, values, host) => {
    // Added by its topic; ROS 1 saves the topic of the updates.
    const topic = values.Topic ?? values['Update Topic'];
    if (typeof topic === 'string' && topic && !values['Interactive Markers Namespace']) {
      values['Interactive Markers Namespace'] = topic.replace(/\/update(_full)?$/, '');
    }
    return new InteractiveMarkersDisplay(context, values, host);
  },
};
