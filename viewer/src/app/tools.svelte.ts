/** Tools of the 3D view, and requests to the simulation. */
import {
  Matrix4,
  Points,
  Raycaster,
  Vector2,
  Vector3,
  type Intersection,
  type Object3D,
} from 'three';
import { fromYaw, inverse, multiply, yawOf, type Pose, type Vec3 } from '../core/pose';
import { messageOf } from '../core/types';
import { arrowGeometry, label, polyline, surface } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import { WorldEditor } from '../sim/editor.svelte';
import { Manipulator, type PagePoint } from '../sim/manipulator';
import { editKey, pasteInto } from '../sim/shortcuts';
import { isUnderlayFile, Underlay } from '../sim/underlay.svelte';
import { Color, Group, Mesh } from 'three';
import type { App } from './app.svelte';
import type { Navigation } from './navigation.svelte';
import { waypointArrow, type Waypoints } from './waypoints.svelte';
import { t } from '../texts/language.svelte';

export type ToolName =
  | 'move'
  | 'select'
  | 'focus'
  | 'measure'
  | 'pose'
  | 'goal'
  | 'waypoints'
  | 'point'
  | 'translate'
  | 'rotate'
  | 'insert';

export const SHORTCUTS: Record<string, ToolName> = {
  m: 'move',
  i: 'move',
  s: 'select',
  c: 'focus',
  n: 'measure',
  p: 'pose',
  g: 'goal',
  y: 'waypoints',
  u: 'point',
};

const GREEN = new Color('#2fc46b');
const PINK = new Color('#ff5ad2');
/** Height above the floor plane, so that maps do not hide the arrow [m]. */
const ARROW_HEIGHT_M = 0.05;
/** Node name under which all pages appear. */
const OWN_NODE = '/viewers';
/** Topic of goals unless an opened file names another. */
const GOAL_TOPIC = 'goal_pose';
/** Topic of the goals of move_base of ROS 1. */
const ROS1_GOAL_TOPIC = '/move_base_simple/goal';
/** Shortest drag that sets a heading [m]. */
const MIN_DRAG_M = 0.05;

/** Tools with which models can be dragged by their handles. */
const EDITING: readonly ToolName[] = ['move', 'select', 'translate', 'rotate'];

const STEP_PX = 12;
/** Motion of the mouse up to which pressing and releasing is a click [px]. */
const CLICK_PX = 4;
const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

type InspectMore = (uv: Vector2, report: (more: Record<string, string>) => void) => void;

export class Tools {
  active: ToolName = $state('move');
  /** Result of a selection. */
  found: Record<string, string> | undefined = $state();
  measured = $state('');
  /** Cursor of the keyboard, while it is in use. */
  cross: PagePoint | undefined = $state();
  /** SDF of the model that the next click inserts. */
  toInsert?: { name: string; sdf: string; file: string };
  private marks = new Group();
  /** Last pose estimate and last goal, each kept in its frame until the next one. */
  private poses = new Group();
  private arrows = new Map<'pose' | 'goal', { frame: string; pose: Pose; mesh: Mesh }>();
  private start?: Vector3;
  private fading?: ReturnType<typeof setTimeout>;
  private points: Vector3[] = [];
  /** Edits of the simulated world. */
  readonly editor: WorldEditor;
  /** Picture below the scene. */
  readonly underlay: Underlay;
  /** Line that was measured last. */
  line: { from: Vec3; lengthM: number } | undefined = $state.raw();
  private manipulator: Manipulator;
  private isListening = false;
  /** Where the button was pressed. */
  private pressed?: PagePoint;

  constructor(
    private app: App,
    readonly navigation: Navigation,
    readonly waypoints: Waypoints,
  ) {
    this.editor = new WorldEditor(app);
    this.underlay = new Underlay(app);
    this.manipulator = new Manipulator(app, this.editor);
  }

  /** Listens to a 3D view; the tools act on it while it is the active one. */
  attach(canvas: HTMLCanvasElement, stage: Stage): void {
    const isActive = () => this.app.stage === stage;
    stage.ticks.add(() => this.tick(stage));
    this.waypoints.attach(stage);
    this.listen();
    // Capture: before the camera controls receive the event.
    canvas.addEventListener(
      'pointerdown',
      (event) => {
        this.cross = undefined;
        if (event.button !== 0 || !isActive()) return;
        this.down(event);
        // A drag goes on outside of the view.
        if (this.manipulator.isDragging) canvas.setPointerCapture(event.pointerId);
      },
      true,
    );
    canvas.addEventListener('pointermove', (event) => isActive() && this.moved(event), true);
    canvas.addEventListener('pointerup', (event) => isActive() && this.up(event), true);
    canvas.addEventListener('pointercancel', () => this.manipulator.cancel(), true);
    canvas.addEventListener('keydown', (event) => isActive() && this.key(event, canvas), true);
  }

  /** Another 3D view became the active one: marks and the tool move to it. */
  enter(stage: Stage): void {
    for (const { stage: other } of this.app.viewports) {
      if (other && other !== stage) {
        other.view.isHeld = false;
        other.invalidate();
      }
    }
    stage.view.isHeld = this.active !== 'move';
    stage.scene.add(this.marks, this.poses);
    this.waypoints.enter(stage);
    stage.invalidate();
  }

  /** The marks of the tools are drawn in the active 3D view. */
  private tick(stage: Stage): void {
    this.underlay.tick(stage);
    if (stage !== this.app.stage) return;
    if (this.marks.parent !== stage.scene) stage.scene.add(this.marks, this.poses);
    this.placeArrows();
    this.manipulator.tick(stage, this.active);
  }

  private listen(): void {
    if (this.isListening) return;
    this.isListening = true;
    window.addEventListener(
      'keydown',
      (event) => {
        if (!editKey(this.app, this.editor, event)) return;
        event.preventDefault();
        event.stopPropagation();
      },
      true,
    );
    window.addEventListener('paste', (event) => {
      if (pasteInto(this.app, this.editor, event)) event.preventDefault();
    });
    // Pictures and map files; other files are left to the rest of the page.
    window.addEventListener(
      'dragover',
      (event) => {
        const items = [...(event.dataTransfer?.items ?? [])];
        const areImages = items.every(({ kind, type }) => kind === 'file' && /^image/.test(type));
        if (items.length > 0 && areImages) event.preventDefault();
      },
      true,
    );
    window.addEventListener(
      'drop',
      (event) => {
        const files = [...(event.dataTransfer?.files ?? [])];
        if (files.length === 0 || !files.every(({ name }) => isUnderlayFile(name))) return;
        event.preventDefault();
        void this.underlay.open(files);
      },
      true,
    );
  }

  /** Keeps the mouse from the cameras, or leaves it to them. */
  private holdCameras(isHeld: boolean): void {
    for (const { stage } of this.app.viewports) if (stage) stage.view.isHeld = isHeld;
  }

  /** Mouse by keyboard: arrow keys move a crosshair, Enter presses, and releases after a drag. */
  private key(event: KeyboardEvent, canvas: HTMLCanvasElement): void {
    if (this.active === 'move' || event.ctrlKey || event.metaKey || event.altKey) return;
    const box = canvas.getBoundingClientRect();
    const middle = { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 };
    const at = this.cross ?? middle;
    const by = event.shiftKey ? 1 : STEP_PX;
    const direction = ARROWS[event.key];
    if (direction) {
      this.cross = {
        clientX: Math.min(box.right - 1, Math.max(box.left, at.clientX + direction[0] * by)),
        clientY: Math.min(box.bottom - 1, Math.max(box.top, at.clientY + direction[1] * by)),
      };
      this.moved(this.cross);
    } else if (event.key === 'Enter') {
      this.cross = at;
      const isHeld = () => !!this.start || this.manipulator.isDragging;
      if (isHeld()) this.up(at);
      else {
        this.down(at);
        // A drag goes on until the next Enter; any other tool is done.
        if (!isHeld()) this.up(at);
      }
      if ((this.active as ToolName) === 'move') this.cross = undefined;
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  choose(name: ToolName): void {
    this.active = this.active === name ? 'move' : name;
    this.clear();
    this.cross = undefined;
    if (this.active !== 'select') this.found = undefined;
    if (this.active === 'waypoints') this.navigation.attention++;
    this.holdCameras(this.active !== 'move');
  }

  private clear(): void {
    clearTimeout(this.fading);
    this.manipulator.cancel();
    for (const child of [...this.marks.children]) dispose(child);
    this.start = undefined;
    this.points = [];
    this.measured = '';
    this.line = undefined;
    this.app.stage?.invalidate();
  }

  private done(): void {
    this.active = 'move';
    this.holdCameras(false);
    this.fading = setTimeout(() => this.clear(), 600);
  }

  private down(event: PagePoint): void {
    const { view } = this.app.stage!;
    this.pressed = event;
    const isSimulation = EDITING.includes(this.active);
    if (isSimulation && this.manipulator.grab(event)) {
      view.isHeld = true;
      return;
    }
    if (this.active === 'move') return;
    view.isHeld = true;
    const ground = view.ground(event.clientX, event.clientY);
    const hit = this.hit(event);
    const at = hit?.point ?? ground;
    switch (this.active) {
      case 'pose':
      case 'goal':
      case 'waypoints':
        this.start = ground;
        break;
      case 'translate':
      case 'rotate':
        if (hit && this.pick(hit.object, event.shiftKey)) {
          this.manipulator.grabModel(hit, this.active === 'translate' ? 'xy' : 'turnZ', event);
        }
        break;
      case 'select':
        this.manipulator.beginBox(event);
        break;
      case 'focus':
        if (at) this.app.setView(this.focused(at));
        this.done();
        break;
      case 'point':
        if (at) this.publishPoint(at);
        break;
      case 'measure':
        if (at) this.measure(at);
        break;
      case 'insert':
        if (ground) void this.insertAt(ground);
        break;
    }
  }

  private moved(event: PagePoint): void {
    if (EDITING.includes(this.active)) this.manipulator.moved(event);
    const now = this.start && this.app.stage!.view.ground(event.clientX, event.clientY);
    if (!this.start || !now) return;
    if (isArrowTool(this.active)) this.arrow(this.start, now);
  }

  private up(event: PagePoint): void {
    this.chooseRobot(event);
    if (this.manipulator.drop()) {
      this.holdCameras(this.active !== 'move');
      return;
    }
    if (this.active === 'select' && !this.manipulator.endBox(event)) {
      this.inspect(this.hit(event), event.shiftKey);
    }
    const { start } = this;
    const now = this.app.stage!.view.ground(event.clientX, event.clientY);
    if (!start || !now) return;
    if (this.active === 'waypoints') {
      this.addWaypoint(start, now);
    } else if (this.active === 'pose' || this.active === 'goal') {
      const drag = now.clone().sub(start);
      const yaw = drag.length() > MIN_DRAG_M ? Math.atan2(drag.y, drag.x) : 0;
      this.publishPose(this.active, fromYaw(yaw, [start.x, start.y, 0]), drag.length());
      this.active = 'move';
      this.clear();
      this.holdCameras(false);
    }
    this.start = undefined;
  }

  /** A click on a robot chooses it, where there are several. */
  private chooseRobot(event: PagePoint): void {
    const { pressed, app } = this;
    this.pressed = undefined;
    const mayChoose = this.active === 'move' || this.active === 'select';
    if (!pressed || !mayChoose || !app.robots.isMany || this.manipulator.isDragging) return;
    const movedPx = Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY);
    if (movedPx > CLICK_PX) return;
    // The first model counts: points of a lidar lie on other robots, and maps and paths are no models.
    for (const { object } of this.solids(event)) {
      let at: Object3D | null = object;
      while (at && !at.userData.entity && !at.userData.robotTopic) at = at.parent;
      if (!at) continue;
      const { entity: model, robotTopic: topic } = at.userData as Record<string, string>;
      const robot = app.robots.find({ model, topic });
      if (robot) app.robots.choose(robot.namespace);
      return;
    }
  }

  private focused(at: Vector3) {
    const { origin, state } = this.app.stage!.view;
    if (state.kind === 'TopDownOrtho') return { x: at.x - origin.x, y: at.y - origin.y };
    return { focal: at.clone().sub(origin).toArray() as [number, number, number] };
  }

  private arrow(from: Vector3, to: Vector3): void {
    for (const child of [...this.marks.children]) dispose(child);
    const drag = to.clone().sub(from);
    const arrow =
      this.active === 'waypoints'
        ? waypointArrow(drag.length())
        : arrowOf(this.active === 'pose' ? 'pose' : 'goal', drag.length());
    arrow.position.copy(from).setZ(ARROW_HEIGHT_M);
    arrow.rotation.z = Math.atan2(drag.y, drag.x);
    this.marks.add(arrow);
    this.app.stage!.invalidate();
  }

  /** Adds a waypoint, with a heading if the mouse was dragged. The tool stays active. */
  private addWaypoint(start: Vector3, end: Vector3): void {
    for (const child of [...this.marks.children]) dispose(child);
    const drag = end.clone().sub(start);
    const yaw = drag.length() > MIN_DRAG_M ? Math.atan2(drag.y, drag.x) : undefined;
    if (this.canPlace()) this.waypoints.add(start.x, start.y, yaw);
    this.app.stage!.invalidate();
  }

  /** Sends the waypoints to an action, and ends the tool. */
  drive(action: 'follow_waypoints' | 'navigate_through_poses'): void {
    if (this.active === 'waypoints') this.choose('move');
    this.dropArrow('goal');
    const { robots } = this.app;
    const poses = this.waypoints.list.map((one) => robots.poseThere(one.frame, one.pose));
    const stamped = poses.map(({ frame, pose }) => ({ frame, pose: messageOf(pose) }));
    void this.navigation.send(action, stamped);
  }

  private dropArrow(tool: 'pose' | 'goal'): void {
    const arrow = this.arrows.get(tool);
    if (arrow) dispose(arrow.mesh);
    this.arrows.delete(tool);
    this.app.stage!.invalidate();
  }

  private keepArrow(tool: 'pose' | 'goal', pose: Pose, lengthM: number): void {
    this.dropArrow(tool);
    const mesh = arrowOf(tool, lengthM);
    this.poses.add(mesh);
    this.arrows.set(tool, { frame: this.app.fixedFrame, pose, mesh });
    this.placeArrows();
    this.app.stage!.invalidate();
  }

  /** Keeps each arrow in the frame in which it was published. */
  private placeArrows(): void {
    for (const { frame, pose, mesh } of this.arrows.values()) {
      const found = this.app.tf.lookup(this.app.fixedFrame, frame);
      mesh.visible = found.kind === 'found';
      if (found.kind !== 'found') continue;
      const { t, q } = multiply(found.pose, pose);
      mesh.position.set(t[0], t[1], t[2] + ARROW_HEIGHT_M);
      mesh.quaternion.set(...q);
    }
  }

  /** Pose and frame of the last goal or estimate. */
  shownPose(tool: 'pose' | 'goal'): { frame: string; pose: Pose } | undefined {
    const arrow = this.arrows.get(tool);
    return arrow && { frame: arrow.frame, pose: arrow.pose };
  }

  /** Returns true if the fixed frame is a frame of the TF tree; otherwise reports why the pose was not sent. */
  private canPlace(): boolean {
    const { app } = this;
    if (app.tf.has(app.fixedFrame)) return true;
    const isEmpty = app.tf.names().length === 0;
    const advice = isEmpty ? t().tools.noTf : t().tools.otherFrame;
    app.notice('error', t().tools.notSent(app.fixedFrame, advice));
    return false;
  }

  /** True if another node subscribes to a topic. */
  private hasSubscriber(topic: string): boolean {
    const row = this.app.topics.find((one) => one.name === topic);
    return !!row?.subscribers.some((node) => node !== OWN_NODE);
  }

  /** Topic of the chosen robot: in its namespace, unless only the topic as it is named has a subscriber. */
  private topicOfRobot(named: string): string {
    const plain = absolute(named);
    const { chosen, isMany, list } = this.app.robots;
    if (!chosen?.namespace) return plain;
    const isNamespaced = list.some(
      ({ namespace }) => namespace && plain.startsWith(`${namespace}/`),
    );
    const own = chosen.namespace + plain;
    if (isNamespaced || this.hasSubscriber(own)) return isNamespaced ? plain : own;
    return isMany ? own : plain;
  }

  /** Warns if the topic just published to has no subscriber. */
  private warnOfSilence(topic: string, advice: string): void {
    if (!this.hasSubscriber(topic)) {
      this.app.notice('warn', t().tools.noSubscriber(topic, advice));
    }
  }

  private publishPose(tool: 'pose' | 'goal', pose: Pose, lengthM: number): void {
    const { app } = this;
    if (!this.canPlace()) return;
    this.keepArrow(tool, pose, lengthM);
    const there = app.robots.poseThere(app.fixedFrame, pose);
    const header = app.header(there.frame);
    const [x, y] = pose.t;
    const where = `x ${x.toFixed(2)}, y ${y.toFixed(2)} m, ${((yawOf(pose.q) * 180) / Math.PI).toFixed(0)}°`;
    if (tool === 'goal') {
      const named = this.topicOfRobot(app.active.toolValue('SetGoal', 'Topic', GOAL_TOPIC));
      const isRos1 = !this.hasSubscriber(named) && this.hasSubscriber(ROS1_GOAL_TOPIC);
      const topic = isRos1 ? ROS1_GOAL_TOPIC : named;
      const isUsual = topic.endsWith(`/${GOAL_TOPIC}`);
      if (isUsual && this.navigation.can('navigate_to_pose')) {
        // The action answers if the navigator accepts the goal; the topic does not.
        const goal = { frame: there.frame, pose: messageOf(there.pose) };
        void this.navigation.send('navigate_to_pose', [goal]);
        return;
      }
      app.publish(topic, 'geometry_msgs/msg/PoseStamped', { header, pose: messageOf(there.pose) });
      app.notice('info', t().tools.goalSent(app.fixedFrame, where));
      this.warnOfSilence(topic, t().tools.startNavigator);
      return;
    }
    const covariance = new Float64Array(36);
    covariance[0] = app.active.toolValue('SetInitialPose', 'Covariance x', 0.25);
    covariance[7] = app.active.toolValue('SetInitialPose', 'Covariance y', 0.25);
    covariance[35] = app.active.toolValue('SetInitialPose', 'Covariance yaw', 0.06853891909122467);
    const topic = this.topicOfRobot(app.active.toolValue('SetInitialPose', 'Topic', 'initialpose'));
    const inner = { pose: messageOf(there.pose), covariance };
    app.publish(topic, 'geometry_msgs/msg/PoseWithCovarianceStamped', { header, pose: inner });
    app.notice('info', t().tools.poseSent(app.fixedFrame, where));
    this.warnOfSilence(topic, t().tools.startLocalization);
  }

  private publishPoint(at: Vector3): void {
    const { app } = this;
    if (!this.canPlace()) return;
    const topic = this.topicOfRobot(app.active.toolValue('PublishPoint', 'Topic', 'clicked_point'));
    const there = app.robots.poseThere(app.fixedFrame, { t: at.toArray(), q: [0, 0, 0, 1] });
    const [x, y, z] = there.pose.t;
    const header = app.header(there.frame);
    app.publish(topic, 'geometry_msgs/msg/PointStamped', { header, point: { x, y, z } });
    app.notice(
      'info',
      t().tools.pointSent(
        app.fixedFrame,
        `${at.x.toFixed(3)}, ${at.y.toFixed(3)}, ${at.z.toFixed(3)}`,
      ),
    );
    if (app.active.toolValue<string | number>('PublishPoint', 'Single click', 1)) this.done();
  }

  private measure(at: Vector3): void {
    if (this.points.length >= 2) this.clear();
    this.points.push(at.clone());
    const [a, b] = this.points;
    if (!a || !b) return;
    const length = a.distanceTo(b);
    this.line = { from: a.toArray(), lengthM: length };
    this.measured = `${length.toFixed(3)} m (x ${(b.x - a.x).toFixed(3)}, y ${(b.y - a.y).toFixed(3)}, z ${(b.z - a.z).toFixed(3)})`;
    this.marks.add(polyline([...a.toArray(), ...b.toArray()], new Color('#e6c229')));
    const caption = label(`${length.toFixed(3)} m`, Math.max(0.12, length * 0.05), '#ffe27a', true);
    caption.position
      .copy(a)
      .lerp(b, 0.5)
      .setZ(Math.max(a.z, b.z) + 0.15);
    this.marks.add(caption);
    this.app.stage!.invalidate();
  }

  /** Surfaces under the mouse, the nearest first. */
  private solids(event: PagePoint): Intersection[] {
    const { view, content } = this.app.stage!;
    const all: Object3D[] = [];
    content.traverseVisible((object) => {
      if (object.userData.isMark || !('isMesh' in object)) return;
      if ((object as Mesh).geometry?.getAttribute('position')) all.push(object);
    });
    return view.ray(event.clientX, event.clientY).intersectObjects(all, false);
  }

  /** First object under the mouse; a point of a cloud if it is near the mouse. */
  private hit(event: PagePoint): Intersection | undefined {
    const { view, content } = this.app.stage!;
    const caster: Raycaster = view.ray(event.clientX, event.clientY);
    caster.params.Line.threshold = 0.02;
    const solid: Object3D[] = [];
    let best: { distance: number; hit: Intersection } | undefined;
    const screen = new Vector2(event.clientX, event.clientY);
    content.traverseVisible((object) => {
      const inspect = object.userData.inspect as unknown;
      if (object.userData.isMark) return;
      if (object instanceof Points && inspect) {
        const found = this.nearestPoint(object, screen);
        if (found && (!best || found.distance < best.distance)) best = found;
      } else if ('isMesh' in object && (object as Mesh).geometry?.getAttribute('position')) {
        solid.push(object);
      }
    });
    if (best) return best.hit;
    return caster.intersectObjects(solid, false)[0];
  }

  /** Nearest point of a cloud within a few pixels of the mouse. */
  private nearestPoint(
    object: Points,
    mouse: Vector2,
  ): { distance: number; hit: Intersection } | undefined {
    const { view } = this.app.stage!;
    const words = object.geometry.getAttribute('words') as
      { data: { array: Uint32Array; stride: number }; offset: number } | undefined;
    if (!words) return undefined;
    const { array, stride } = words.data;
    const floats = new Float32Array(array.buffer, array.byteOffset, array.length);
    const count = Math.min(
      object.geometry.drawRange.count,
      Math.floor(array.length / stride),
      400_000,
    );
    const matrix = new Matrix4().multiplyMatrices(
      view.camera.projectionMatrix,
      view.camera.matrixWorldInverse,
    );
    matrix.multiply(object.matrixWorld);
    const box = this.app.stage!.renderer.domElement.getBoundingClientRect();
    const at = new Vector3();
    let best = 9;
    let found = -1;
    for (let i = 0; i < count; i++) {
      at.fromArray(floats, i * stride + words.offset).applyMatrix4(matrix);
      if (at.z > 1 || at.z < -1) continue;
      const dx = box.left + ((at.x + 1) / 2) * box.width - mouse.x;
      const dy = box.top + ((1 - at.y) / 2) * box.height - mouse.y;
      const distance = Math.hypot(dx, dy);
      if (distance < best) [best, found] = [distance, i];
    }
    if (found < 0) return undefined;
    const point = new Vector3()
      .fromArray(floats, found * stride + words.offset)
      .applyMatrix4(object.matrixWorld);
    return { distance: best, hit: { object, point, index: found, distance: best } };
  }

  private inspect(hit: Intersection | undefined, isAdded = false): void {
    if (!hit) {
      this.found = { [t().found.selection]: t().found.nothing };
      return;
    }
    let object: Object3D | null = hit.object;
    while (object && !object.userData.inspect) object = object.parent;
    const inspect = object?.userData.inspect as
      ((index: number, uv?: Vector2) => Record<string, string>) | undefined;
    const { point: p } = hit;
    const found: Record<string, string> = {
      ...(inspect?.(hit.index ?? 0, hit.uv) ?? {}),
      [t().found.inNamed(this.app.fixedFrame)]:
        `${p.x.toFixed(3)}, ${p.y.toFixed(3)}, ${p.z.toFixed(3)} m`,
    };
    this.found = found;
    const current = this.found;
    // Details that need a request arrive later.
    const inspectMore = object?.userData.inspectMore as InspectMore | undefined;
    if (hit.uv) {
      inspectMore?.(hit.uv, (more) => {
        if (this.found === current) Object.assign(current, more);
      });
    }
    this.pick(hit.object, isAdded);
  }

  /** Selects the model of an object; returns false if there is none to move. */
  private pick(object: Object3D, isAdded = false): boolean {
    let at: Object3D | null = object;
    while (at && !at.userData.entity) at = at.parent;
    const model = at?.userData.entity as string | undefined;
    if (!model) return false;
    const { app } = this;
    if (isAdded) this.editor.toggle(model);
    else if (!app.selection.includes(model)) app.selectedModel = model;
    return app.selection.includes(model) && !app.world()?.isGround(model);
  }

  // The simulation.

  private service(what: string): string {
    return `/world/${this.app.worldName}/${what}`;
  }

  private control(change: Record<string, unknown>): Promise<unknown> {
    return this.app.call(this.service('control'), { world_control: change });
  }

  play(isOn: boolean): void {
    void this.control({ pause: !isOn });
  }

  step(steps: number): void {
    void this.control({ pause: true, multi_step: steps });
  }

  reset(): void {
    void this.control({ pause: this.app.isPaused, reset: { all: true } });
  }

  /** Deletes models as one step: the selection if the model is a part of it. */
  async remove(name: string): Promise<void> {
    const { selection } = this.app;
    await this.editor.remove(selection.includes(name) ? selection : [name]);
  }

  /** Inserts the model at the next click on the floor plane. */
  prepare(name: string, sdf: string, file = ''): void {
    this.toInsert = { name, sdf, file };
    this.active = 'insert';
    this.holdCameras(true);
    this.app.notice('info', t().world.clickPosition(name));
  }

  private async insertAt(at: Vector3): Promise<void> {
    const { toInsert, app } = this;
    if (!toInsert) return;
    const world = app.world();
    const fixed: Pose = { t: [at.x, at.y, 0], q: [0, 0, 0, 1] };
    const pose = world ? multiply(inverse(world.fixedFromWorld), fixed) : fixed;
    await this.insert(toInsert.name, toInsert.sdf, toInsert.file, pose);
    this.done();
  }

  insert(name: string, sdf: string, file: string, worldFromModel: Pose): Promise<boolean> {
    return this.editor.insert(name, { sdf, file }, worldFromModel);
  }
}

function arrowOf(tool: 'pose' | 'goal', lengthM: number): Mesh {
  const length = Math.max(0.4, lengthM);
  const geometry = arrowGeometry(length - 0.2, 0.04, 0.2, 0.12);
  return new Mesh(geometry, surface(tool === 'pose' ? GREEN : PINK));
}

/** True for tools that draw an arrow while the mouse is dragged. */
function isArrowTool(tool: ToolName): boolean {
  return tool === 'pose' || tool === 'goal' || tool === 'waypoints';
}

function absolute(topic: string): string {
  return topic.startsWith('/') ? topic : `/${topic}`;
}
