/**
 * World: the ground truth of a simulation, next to the estimate of the robot.
 *
 * A simulation shares no frame with the robot's TF tree. The world is therefore anchored at the first estimated
 * pose of the robot: from there on the two diverge by the error of the estimate.
 */
import { Box3, Group, Matrix4, type Mesh, type Object3D, Vector3 } from 'three';
import type { Message } from '../core/cdr';
import { inverse, multiply, yawOf, type Pose, type Vec3 } from '../core/pose';
import { poseOf, seconds, type Marker, type TransformStamped } from '../core/types';
import { fade } from '../scene/meshes';
import { matrixOf } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { WORLD } from '../sim/sensor_frames';
import { Display, type Kind } from './display';
import { markerObject } from './marker_shapes';
import { alpha, bool, choice, topic } from './options';
import { batch, isBatch } from './world_batches';
import { t } from '../texts/language.svelte';

/** Error of the estimated pose. */
export interface Truth {
  /** Link by which estimate and truth are compared. */
  link: string;
  distanceM: number;
  yawRad: number;
}

/** Maximum number of true poses kept until an estimate of their time arrives: two seconds of them. */
const RECENT = 60;
/** Thickness of the box that represents a plane [m]. */
const GROUND_M = 0.0011;
const UNDER_M = 0.02;
/** Objects below this height never hide the view [m]. */
const TALL_M = 1.3;
/** Objects nearer to the camera than the focal point by at least this become transparent [m]. */
const NEAR_M = 0.3;
const GLASS = 0.14;

interface Part {
  marker: Marker;
  object: Group;
  /** Opacity that was set last. */
  alpha?: number;
  /** Box around it in the scene, for one pose of its link. */
  extent?: { sceneFromLink: Matrix4; box: Box3 };
}

export const modelOf = (frame: string) => frame.split(/::|\//)[0] ?? frame;
const linkOf = (frame: string) => frame.split(/::|\//).pop() ?? frame;

/** Box around a part in the scene. */
function extentOf(part: Part): Box3 {
  const sceneFromLink = part.object.parent!.matrixWorld;
  if (!part.extent?.sceneFromLink.equals(sceneFromLink)) {
    const box = new Box3().setFromObject(part.object);
    part.extent = { sceneFromLink: sceneFromLink.clone(), box };
  }
  return part.extent.box;
}

/** Link of the simulation that exists in TF as well. */
interface KnownLink {
  /** Its frame in the simulation. */
  frame: string;
  /** Its frame in TF. */
  link: string;
}

export class WorldDisplay extends Display {
  private parts = new Map<string, Part>();
  private frames = new Map<string, { holder: Group; worldFromLink: Pose; stampS: number }>();
  /** Frames with other parts than those in their batches. */
  private stale = new Set<string>();
  /** Links in the simulation and in TF, for one state of the tree of transforms. */
  private known?: { treeVersion: number; links: readonly KnownLink[] };
  private unsubscribePoses?: () => void;
  private anchor?: { fixed: string; fixedFromWorld: Pose };
  private tfVersion = -1;
  private seen = '';
  private seenParts = 0;
  /** True after time jumped back: the next estimate sets a new anchor. */
  private isAnchorOld = false;
  private recent: { frame: string; stampS: number; worldFromLink: Pose }[] = [];
  truth?: Truth;
  /** Called when models are added or removed. */
  onModels?: (names: string[]) => void;
  /** Models whose published poses are ignored while they are dragged: the poses of their links in them. */
  private held = new Map<string, Map<string, Pose>>();

  override start(): void {
    super.start();
    this.unsubscribePoses?.();
    const topic = this.get<string>('Topic');
    if (!topic) return;
    this.unsubscribePoses = this.context.subscribe(topic.replace(/\/scene$/, '/poses'), (message) =>
      this.poses(message),
    );
  }

  protected override receive(message: Message): void {
    for (const marker of message.markers as Marker[]) this.update(marker);
    this.host.status('Scene', 'ok', t().displays.shapes(this.parts.size, this.models().length));
    this.onModels?.(this.models());
    this.context.stage.invalidate();
  }

  private update(marker: Marker): void {
    const key = `${marker.ns}\n${marker.id}`;
    if (marker.action === 3) {
      for (const name of [...this.parts.keys()]) {
        if (!marker.ns || name.startsWith(`${marker.ns}\n`)) this.drop(name);
      }
      return;
    }
    this.drop(key);
    if (marker.action !== 0) return;
    const object = new Group();
    const pose = poseOf(marker.pose);
    object.position.set(...pose.t);
    object.quaternion.set(...pose.q);
    const { scale, color } = marker;
    // The floor plane is drawn a little below maps and lines on it.
    if (marker.type === 1 && scale.z <= GROUND_M) object.position.z -= UNDER_M;
    const made = markerObject(
      { ...marker, color: { ...color, a: color.a * this.get<number>('Alpha') } },
      this.context.meshes,
      (why) => {
        if (why) this.host.status('Meshes', 'warn', why);
        this.loaded(key);
      },
    );
    object.add(made);
    this.holder(marker.header.frame_id).add(object);
    this.parts.set(key, { marker, object });
    this.stale.add(marker.header.frame_id);
  }

  /** Mesh or texture of a part is there. */
  private loaded(key: string): void {
    const part = this.parts.get(key);
    if (part) {
      part.extent = part.alpha = undefined;
      this.stale.add(part.marker.header.frame_id);
    }
    this.seen = '';
    this.context.stage.invalidate();
  }

  private drop(key: string): void {
    const part = this.parts.get(key);
    if (part) {
      dispose(part.object);
      this.stale.add(part.marker.header.frame_id);
    }
    this.parts.delete(key);
  }

  private holder(frame: string): Group {
    let entry = this.frames.get(frame);
    if (!entry) {
      const holder = new Group();
      holder.matrixAutoUpdate = false;
      holder.userData.entity = modelOf(frame);
      holder.userData.inspect = () => {
        const at = this.frames.get(frame)?.worldFromLink;
        return {
          [t().found.model]: modelOf(frame),
          [t().found.link]: linkOf(frame),
          ...(at ? { [t().found.inWorld]: at.t.map((v) => v.toFixed(3)).join(', ') + ' m' } : {}),
        };
      };
      this.root.add(holder);
      entry = { holder, worldFromLink: { t: [0, 0, 0], q: [0, 0, 0, 1] }, stampS: -1 };
      this.frames.set(frame, entry);
      this.known = undefined;
    }
    return entry.holder;
  }

  private poses(message: Message): void {
    const all = message.transforms as TransformStamped[];
    const now = new Set<string>();
    for (const one of all) {
      const name = one.child_frame_id;
      now.add(name);
      this.holder(name);
      const entry = this.frames.get(name)!;
      entry.stampS = seconds(one.header.stamp);
      if (this.held.has(modelOf(name))) continue;
      const { translation: p, rotation: q } = one.transform;
      this.pose(name, { t: [p.x, p.y, p.z], q: [q.x, q.y, q.z, q.w] });
    }
    // Frames of deleted models.
    for (const [name, { holder, stampS }] of this.frames) {
      if (now.has(name) || stampS < 0 || holder.children.length > 0) continue;
      dispose(holder);
      this.frames.delete(name);
      this.known = undefined;
    }
    this.compare();
    this.context.stage.invalidate();
  }

  private pose(frame: string, worldFromLink: Pose): void {
    const entry = this.frames.get(frame)!;
    entry.worldFromLink = worldFromLink;
    entry.holder.matrix.copy(matrixOf(worldFromLink));
    entry.holder.matrixWorldNeedsUpdate = true;
  }

  /** Shows a model at a pose until it is released. */
  hold(model: string, worldFromModel: Pose): void {
    const worldFromOld = this.poseOf(model);
    if (!worldFromOld) return;
    let links = this.held.get(model);
    if (!links) {
      links = new Map();
      const oldFromWorld = inverse(worldFromOld);
      for (const [frame, { worldFromLink }] of this.frames) {
        if (modelOf(frame) === model) links.set(frame, multiply(oldFromWorld, worldFromLink));
      }
      this.held.set(model, links);
    }
    for (const [frame, modelFromLink] of links) {
      if (this.frames.has(frame)) this.pose(frame, multiply(worldFromModel, modelFromLink));
    }
    this.context.stage.invalidate();
  }

  /** Shows models at their published poses again. */
  release(models: readonly string[]): void {
    for (const model of models) this.held.delete(model);
  }

  /** True for a model that is only a floor plane. */
  isGround(model: string): boolean {
    const own = [...this.parts.values()].filter((p) => modelOf(p.marker.header.frame_id) === model);
    return own.length > 0 && own.every(({ marker: m }) => m.type === 1 && m.scale.z <= GROUND_M);
  }

  /** Corners of the box around a model, along the axes of the world frame. */
  extentOf(model: string): { min: Vec3; max: Vec3 } | undefined {
    this.root.updateMatrixWorld(true);
    const worldFromScene = this.root.matrixWorld.clone().invert();
    const worldFromPart = new Matrix4();
    const box = new Box3();
    const own = new Box3();
    for (const holder of this.holders(model)) {
      holder.traverse((part) => {
        const { geometry } = part as Mesh;
        if (!geometry?.getAttribute?.('position') || isBatch(part)) return;
        if (!geometry.boundingBox) geometry.computeBoundingBox();
        worldFromPart.multiplyMatrices(worldFromScene, part.matrixWorld);
        own.copy(geometry.boundingBox!).applyMatrix4(worldFromPart);
        box.union(own);
      });
    }
    return box.isEmpty() ? undefined : { min: box.min.toArray(), max: box.max.toArray() };
  }

  /** Names of all models, also of those without shapes. */
  names(): string[] {
    return [...new Set([...this.frames.keys()].map(modelOf))];
  }

  /** Names of the models with shapes. */
  models(): string[] {
    const withShape = [...this.parts.values()].map((p) => modelOf(p.marker.header.frame_id));
    return [...new Set(withShape)].sort();
  }

  links(model: string): string[] {
    return [...this.frames.keys()].filter((f) => f !== model && modelOf(f) === model).map(linkOf);
  }

  /** Pose of a model in the world frame. */
  poseOf(model: string): Pose | undefined {
    return this.frames.get(model)?.worldFromLink;
  }

  holders(model: string): Object3D[] {
    return [...this.frames].filter(([f]) => modelOf(f) === model).map(([, e]) => e.holder);
  }

  get fixedFromWorld(): Pose {
    return this.anchor?.fixedFromWorld ?? { t: [0, 0, 0], q: [0, 0, 0, 1] };
  }

  /** Links of the robot that exist in TF as well, the base first. */
  private common(): readonly KnownLink[] {
    const { tf } = this.context;
    if (this.known?.treeVersion !== tf.treeVersion) {
      this.known = { treeVersion: tf.treeVersion, links: this.findCommon() };
    }
    return this.known.links;
  }

  private findCommon(): KnownLink[] {
    const { tf } = this.context;
    const parts = [...this.frames.keys()].filter((frame) => frame !== modelOf(frame));
    // Frames of one of several robots have its name in front.
    const all = parts.map((frame) => ({
      frame,
      link: tf.has(linkOf(frame)) ? linkOf(frame) : frame.replace('::', '/'),
    }));
    const known = all.filter(({ link }) => tf.has(link));
    const rank = (link: string) =>
      ['base_footprint', 'base_link'].indexOf(link.split('/').pop()!) >>> 0;
    return known.sort((a, b) => rank(a.link) - rank(b.link));
  }

  /** Anchors the world at the present estimate of the robot's pose. */
  align(): void {
    this.anchor = undefined;
    this.compare();
  }

  private compare(): void {
    const { tf } = this.context;
    const fixed = this.context.fixedFrame();
    if (this.anchor && this.anchor.fixed !== fixed) {
      const found = tf.lookup(fixed, this.anchor.fixed);
      if (found.kind !== 'found') this.anchor = undefined;
      else
        this.anchor = { fixed, fixedFromWorld: multiply(found.pose, this.anchor.fixedFromWorld) };
    }
    const shared = tf.lookup(fixed, WORLD);
    if (fixed === WORLD || (tf.has(WORLD) && shared.kind === 'found')) {
      const pose = shared.kind === 'found' ? shared.pose : this.fixedFromWorld;
      this.anchor = { fixed, fixedFromWorld: pose };
    }
    const shown = this.common()[0];
    if (shown) this.measure(shown.frame, shown.link, fixed);
    this.put(this.root, this.fixedFromWorld);
    const isAligned = !!this.anchor || !shown || fixed === WORLD;
    this.host.status(
      'Alignment',
      isAligned ? 'ok' : 'warn',
      isAligned ? undefined : t().displays.noTransformTo(shown!.link, fixed),
    );
    if (!this.truth) this.host.status('Truth', 'ok');
    else {
      const { distanceM, yawRad } = this.truth;
      const degrees = Math.abs((yawRad * 180) / Math.PI).toFixed(1);
      this.host.status('Truth', 'ok', t().displays.estimateError(distanceM.toFixed(3), degrees));
    }
    this.robots();
  }

  /**
   * Estimates arrive later than the truth: both are compared at the newest time that both have.
   */
  private measure(frame: string, link: string, fixed: string): void {
    const { worldFromLink, stampS } = this.frames.get(frame)!;
    if (this.recent[0]?.frame !== frame) this.recent = [];
    this.recent.push({ frame, stampS, worldFromLink });
    if (this.recent.length > RECENT) this.recent.shift();
    for (let i = this.recent.length - 1; i >= 0; i--) {
      const then = this.recent[i]!;
      const found = this.context.tf.lookup(fixed, link, then.stampS);
      if (found.kind !== 'found') continue;
      if (!this.anchor || this.isAnchorOld) {
        this.anchor = { fixed, fixedFromWorld: multiply(found.pose, inverse(then.worldFromLink)) };
        this.isAnchorOld = false;
      }
      const really = multiply(this.anchor.fixedFromWorld, then.worldFromLink);
      const off = multiply(inverse(really), found.pose);
      // Without a pose estimator these transforms are the simulation's own: there is nothing to compare.
      const isEstimated = this.context.estimators().length > 0;
      this.truth = isEstimated
        ? { link, distanceM: Math.hypot(off.t[0], off.t[1]), yawRad: yawOf(off.q) }
        : undefined;
      this.recent.splice(0, i);
      return;
    }
    if (this.anchor) return;
    // While time is paused, an estimate of this time may never arrive: use the newest one.
    const newest = this.context.tf.lookup(fixed, link);
    if (newest.kind !== 'found') return;
    this.anchor = { fixed, fixedFromWorld: multiply(newest.pose, inverse(worldFromLink)) };
    this.isAnchorOld = true;
  }

  /** Hides the simulated robot, which RobotModel shows already, unless the option enables it. */
  private robots(): void {
    const names = new Set(this.common().map(({ frame }) => modelOf(frame)));
    const isShown = this.get<string>('Robots') !== 'Hidden';
    for (const [frame, { holder }] of this.frames) {
      const isRobot = names.has(modelOf(frame));
      holder.visible =
        this.values[`Models/${modelOf(frame)}/Value`] !== false && (!isRobot || isShown);
    }
  }

  /**
   * Makes walls between the camera and the focal point transparent: objects that are tall, and nearer to the
   * camera than the focal point.
   */
  private seeInside(): void {
    const { view } = this.context.stage;
    const { state } = view;
    const isOn =
      this.get<boolean>('See Inside') && state.kind !== 'TopDownOrtho' && state.pitch < 1.4;
    const focal = new Vector3(...state.focal).add(view.origin);
    const eye = view.camera.position.clone().sub(focal).setZ(0).normalize();
    const key = [isOn, ...focal.toArray(), ...eye.toArray()].map((v) => (+v).toFixed(2)).join();
    if (key === this.seen && this.seenParts === this.parts.size) return;
    this.seen = key;
    this.seenParts = this.parts.size;
    this.root.updateMatrixWorld(true);
    for (const part of this.parts.values()) {
      const { object, marker } = part;
      const box = extentOf(part);
      const isTall = box.max.z > TALL_M;
      const middle = box.getCenter(new Vector3()).sub(focal).setZ(0);
      const isGlass = isOn && isTall && middle.dot(eye) > NEAR_M;
      const alpha = (marker.color.a || 1) * this.get<number>('Alpha') * (isGlass ? GLASS : 1);
      if (part.alpha === alpha) continue;
      part.alpha = alpha;
      this.stale.add(marker.header.frame_id);
      object.traverse((part) => {
        for (const one of (part as Mesh).material ? [(part as Mesh).material].flat() : []) {
          fade(one, alpha);
        }
      });
    }
  }

  /** Puts parts that have changed into other batches. */
  private rebatch(): void {
    if (this.stale.size === 0) return;
    const parts = new Map<string, Group[]>();
    for (const { marker, object } of this.parts.values()) {
      const frame = marker.header.frame_id;
      if (this.stale.has(frame)) parts.set(frame, [...(parts.get(frame) ?? []), object]);
    }
    for (const frame of this.stale) {
      const entry = this.frames.get(frame);
      if (entry) batch(entry.holder, parts.get(frame) ?? []);
    }
    this.stale.clear();
    this.context.stage.invalidate();
  }

  override tick(): void {
    this.seeInside();
    this.rebatch();
    if (this.context.tf.version === this.tfVersion || this.anchor) return;
    this.tfVersion = this.context.tf.version;
    this.compare();
  }

  override moved(): void {
    this.compare();
  }

  override changed(path: string): void {
    super.changed(path);
    this.seen = '';
    if (path === 'Align') this.align();
    if (path === 'Alpha') for (const { marker } of [...this.parts.values()]) this.update(marker);
    this.robots();
  }

  override clear(): void {
    this.empty();
    this.parts.clear();
    this.stale.clear();
    this.frames.clear();
    this.known = undefined;
    this.held.clear();
    this.anchor = undefined;
    this.truth = undefined;
    this.recent = [];
  }

  /** Called when time jumped back: the robot is at its start. */
  restarted(): void {
    // The world stays at its anchor until the next estimate of the pose, which may update a while.
    this.isAnchorOld = true;
    this.recent = [];
    this.truth = undefined;
  }

  override stop(): void {
    this.unsubscribePoses?.();
    super.stop();
  }
}

const ARRAY = ['visualization_msgs/msg/MarkerArray'];

export const world: Kind = {
  class: 'periplus/World',
  title: 'World',
  get help() {
    return t().displayHelp.world;
  },
  types: [],
  options: [
    ...topic('Topic', '', ARRAY, { durability: 'Transient Local' }),
    alpha('Alpha', 1),
    choice('Robots', 'Hidden', ['Hidden', 'Solid']),
    bool('See Inside', true),
    bool('Align', false),
  ],
  make: (...all) => new WorldDisplay(...all),
};
