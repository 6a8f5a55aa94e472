/**
 * World: what a simulation knows to be true, beside what the robot believes.
 *
 * A simulation has no frame in common with the robot's. So the world is laid where the robot was seen
 * first: from there on the two drift apart as far as the estimate is wrong.
 */
import { Group, type Object3D } from 'three';
import type { Message } from '../core/cdr';
import { inverse, multiply, yawOf, type Pose } from '../core/pose';
import { poseOf, seconds, type Marker, type TransformStamped } from '../core/types';
import { MeshLibrary } from '../scene/meshes';
import { matrixOf } from '../scene/shapes';
import { dispose } from '../scene/stage';
import { Display, type Kind } from './display';
import { markerObject } from './marker_shapes';
import { bool, choice, topic } from './options';

/** Where the world is in the fixed frame, and how far the estimate is from the truth. */
export interface Truth {
  /** The link by which the two are compared. */
  link: string;
  distanceM: number;
  yawRad: number;
}

interface Part {
  marker: Marker;
  object: Group;
}

export const modelOf = (frame: string) => frame.split(/::|\//)[0] ?? frame;
const linkOf = (frame: string) => frame.split(/::|\//).pop() ?? frame;

export class WorldDisplay extends Display {
  private parts = new Map<string, Part>();
  private frames = new Map<string, { holder: Group; worldFromLink: Pose; stampS: number }>();
  private library = new MeshLibrary((uri) => this.context.asset(uri));
  private leavePoses?: () => void;
  private anchor?: { fixed: string; fixedFromWorld: Pose };
  private tfVersion = -1;
  truth?: Truth;
  /** Called when models come and go. */
  onModels?: (names: string[]) => void;
  /** The one that is outlined. */
  selected = '';

  override start(): void {
    super.start();
    this.leavePoses?.();
    const topic = this.get<string>('Topic');
    if (!topic) return;
    this.leavePoses = this.context.subscribe(topic.replace(/\/scene$/, '/poses'), (message) =>
      this.poses(message),
    );
  }

  protected override receive(message: Message): void {
    for (const marker of message.markers as Marker[]) this.take(marker);
    this.host.status('Scene', 'ok', `${this.parts.size} shapes of ${this.models().length} models`);
    this.onModels?.(this.models());
    this.context.stage.invalidate();
  }

  private take(marker: Marker): void {
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
    const made = markerObject(marker, this.library, (why) => {
      if (why) this.host.status('Meshes', 'warn', why);
      this.context.stage.invalidate();
    });
    object.add(made);
    this.holder(marker.header.frame_id).add(object);
    this.parts.set(key, { marker, object });
  }

  private drop(key: string): void {
    const part = this.parts.get(key);
    if (part) dispose(part.object);
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
          Model: modelOf(frame),
          Link: linkOf(frame),
          ...(at ? { 'In the world': at.t.map((v) => v.toFixed(3)).join(', ') + ' m' } : {}),
        };
      };
      this.root.add(holder);
      entry = { holder, worldFromLink: { t: [0, 0, 0], q: [0, 0, 0, 1] }, stampS: -1 };
      this.frames.set(frame, entry);
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
      const { translation: t, rotation: q } = one.transform;
      entry.worldFromLink = { t: [t.x, t.y, t.z], q: [q.x, q.y, q.z, q.w] };
      entry.stampS = seconds(one.header.stamp);
      entry.holder.matrix.copy(matrixOf(entry.worldFromLink));
      entry.holder.matrixWorldNeedsUpdate = true;
    }
    this.compare();
    this.context.stage.invalidate();
  }

  /** Names of what stands in the world. */
  models(): string[] {
    const withShape = [...this.parts.values()].map((p) => modelOf(p.marker.header.frame_id));
    return [...new Set(withShape)].sort();
  }

  links(model: string): string[] {
    return [...this.frames.keys()].filter((f) => modelOf(f) === model).map(linkOf);
  }

  /** Where the model's first link is: for moving it by hand. */
  poseOf(model: string): { link: string; worldFromLink: Pose } | undefined {
    for (const [frame, { worldFromLink }] of this.frames) {
      if (modelOf(frame) === model) return { link: frame.replace('/', '::'), worldFromLink };
    }
    return undefined;
  }

  holders(model: string): Object3D[] {
    return [...this.frames].filter(([f]) => modelOf(f) === model).map(([, e]) => e.holder);
  }

  get fixedFromWorld(): Pose {
    return this.anchor?.fixedFromWorld ?? { t: [0, 0, 0], q: [0, 0, 0, 1] };
  }

  /** The robot's links, which TF knows too. */
  private common(): { frame: string; link: string }[] {
    const { tf } = this.context;
    const all = [...this.frames.keys()].map((frame) => ({ frame, link: linkOf(frame) }));
    const known = all.filter(({ link }) => tf.has(link));
    const rank = (link: string) => ['base_footprint', 'base_link'].indexOf(link) >>> 0;
    return known.sort((a, b) => rank(a.link) - rank(b.link));
  }

  /** Lays the world where the robot is now. */
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
    const shared = tf.lookup(fixed, 'world');
    if (fixed === 'world' || (tf.has('world') && shared.kind === 'found')) {
      const pose = shared.kind === 'found' ? shared.pose : this.fixedFromWorld;
      this.anchor = { fixed, fixedFromWorld: pose };
    }
    for (const { frame, link } of this.common()) {
      const { worldFromLink, stampS } = this.frames.get(frame)!;
      const exact = tf.lookup(fixed, link, stampS);
      const found = exact.kind === 'found' ? exact : tf.lookup(fixed, link);
      if (found.kind !== 'found') continue;
      this.anchor ??= { fixed, fixedFromWorld: multiply(found.pose, inverse(worldFromLink)) };
      const really = multiply(this.anchor.fixedFromWorld, worldFromLink);
      const off = multiply(inverse(really), found.pose);
      this.truth = { link, distanceM: Math.hypot(off.t[0], off.t[1]), yawRad: yawOf(off.q) };
      break;
    }
    this.root.visible = !!this.anchor || this.common().length === 0;
    this.put(this.root, this.fixedFromWorld);
    if (this.truth) {
      const { distanceM, yawRad } = this.truth;
      const degrees = Math.abs((yawRad * 180) / Math.PI).toFixed(1);
      this.host.status(
        'Truth',
        'ok',
        `The estimate is off by ${distanceM.toFixed(3)} m, ${degrees}°`,
      );
    }
    this.robots();
  }

  /** What RobotModel shows already is drawn again only if that is wanted. */
  private robots(): void {
    const names = new Set(this.common().map(({ frame }) => modelOf(frame)));
    const isShown = this.get<string>('Robots') !== 'Hidden';
    for (const [frame, { holder }] of this.frames) {
      const isRobot = names.has(modelOf(frame));
      holder.visible =
        this.values[`Models/${modelOf(frame)}/Value`] !== false && (!isRobot || isShown);
    }
  }

  override tick(): void {
    if (this.context.tf.version === this.tfVersion || this.anchor) return;
    this.tfVersion = this.context.tf.version;
    this.compare();
  }

  override moved(): void {
    this.compare();
  }

  override changed(path: string): void {
    super.changed(path);
    if (path === 'Align') this.align();
    this.robots();
  }

  override clear(): void {
    this.empty();
    this.parts.clear();
    this.frames.clear();
    this.anchor = undefined;
    this.truth = undefined;
  }

  /** Time went back: the robot stands where it began. */
  restarted(): void {
    this.anchor = undefined;
  }

  override stop(): void {
    this.leavePoses?.();
    super.stop();
  }
}

const ARRAY = ['visualization_msgs/msg/MarkerArray'];

export const world: Kind = {
  class: 'periplus/World',
  title: 'World',
  help: 'The simulated world as it truly is',
  types: [],
  options: [
    ...topic('Topic', '', ARRAY, { durability: 'Transient Local' }),
    choice('Robots', 'Hidden', ['Hidden', 'Solid']),
    bool('Align', false),
  ],
  make: (...all) => new WorldDisplay(...all),
};
