/** The robots of the system, and the one that tools and panels act on. */
import type { Message } from '../core/cdr';
import type { Handler } from '../core/client';
import { frameCopier } from '../core/frame_names';
import { inverse, multiply, type Pose } from '../core/pose';
import {
  BASE_FRAMES,
  findRobots,
  frameHere,
  frameThere,
  robotName,
  robotOfTopic,
  type Robot,
} from '../core/robots';
import { seconds, type TransformStamped } from '../core/types';
import { WORLD } from '../sim/sensor_frames';
import type { App } from './app.svelte';
import { schemaOfTopic } from './schemas';

export class Robots {
  list: Robot[] = $state.raw([]);
  /** Namespace that the user chose; kept while that robot is absent. */
  private wanted: string | undefined = $state();
  private key = '';
  /** Robot of each topic with messages; they come by the thousand. */
  private owners = new Map<string, Robot | undefined>();
  /** Subscriptions to the transforms of robots that have separate topics for them. */
  private leave = new Map<string, () => void>();
  /** Roots of trees that the page has put into the simulated world. */
  private anchored = new Set<string>();

  constructor(private app: App) {}

  get chosen(): Robot | undefined {
    return this.list.find(({ namespace }) => namespace === this.wanted) ?? this.list[0];
  }

  get isMany(): boolean {
    return this.list.length > 1;
  }

  /** Choice for a saved layout; `undefined` if the user made none. */
  get saved(): string | undefined {
    return this.wanted;
  }

  restore(namespace: string | undefined): void {
    this.wanted = namespace;
  }

  /** Chooses a robot; cameras that follow the one before follow it. */
  choose(namespace: string): void {
    const before = this.chosen;
    this.wanted = namespace;
    const now = this.chosen;
    if (!before || !now || before === now) return;
    for (const viewport of this.app.viewports) {
      const { targetFrame } = viewport.stage?.view.state ?? viewport.view;
      if (!before.framePrefix || !targetFrame.startsWith(before.framePrefix)) continue;
      const frame = now.framePrefix + targetFrame.slice(before.framePrefix.length);
      if (this.app.tf.has(frame)) viewport.setView({ targetFrame: frame });
    }
  }

  /** Call it when topics, services or frames changed. */
  settle(): void {
    const { topics, services, frames } = this.app;
    const list = findRobots({ topics, services, frames });
    const key = JSON.stringify(list);
    if (key === this.key) return;
    this.key = key;
    this.list = list;
    this.owners.clear();
    this.followTransforms();
    for (const viewport of this.app.viewports) viewport.robotsChanged();
  }

  private followTransforms(): void {
    const wanted = new Set(
      this.list.filter(({ hasOwnTf }) => hasOwnTf).map(({ namespace }) => namespace),
    );
    for (const [namespace, leave] of this.leave) {
      if (wanted.has(namespace)) continue;
      this.leave.delete(namespace);
      leave();
    }
    for (const namespace of wanted) {
      if (this.leave.has(namespace)) continue;
      const leave = [false, true].map((isStatic) =>
        this.app.subscribeTransforms(`${namespace}/${isStatic ? 'tf_static' : 'tf'}`, isStatic),
      );
      this.leave.set(namespace, () => leave.forEach((one) => one()));
    }
  }

  // Frames.

  /** Names on this page of frames in messages of a topic; `undefined` where they keep their names. */
  renamed(topic: string): ((frame: string) => string) | undefined {
    if (!this.owners.has(topic)) this.owners.set(topic, robotOfTopic(this.list, topic));
    const robot = this.owners.get(topic);
    return robot?.hasOwnTf ? (frame) => frameHere(robot, frame) : undefined;
  }

  /** Handler that gets messages with the names of their frames on this page. */
  withFrames(topic: string, handler: Handler): Handler {
    return (message, name, bytes, timeS) => {
      const renamed = this.renamed(topic);
      const schema = renamed && schemaOfTopic(this.app, topic);
      const copy = schema && frameCopier(schema);
      const shown = renamed && copy ? copy(message, renamed) : message;
      handler(shown, name, bytes, timeS);
    };
  }

  /** Frame of the base of a robot, by default of the chosen one, if its transform is known. */
  baseFrame(robot = this.chosen): string | undefined {
    const prefix = robot?.framePrefix ?? '';
    return BASE_FRAMES.map((frame) => prefix + frame).find((frame) => this.app.tf.has(frame));
  }

  /** Topmost frame that the robot itself knows. */
  private rootOf(robot: Robot): string | undefined {
    let at = this.baseFrame(robot);
    for (let parent = at; parent; parent = this.app.tf.parentOf(parent)) {
      at = parent;
      if (this.anchored.has(parent)) break;
    }
    return at;
  }

  /** A pose as the chosen robot knows it: in one of its frames, by the name that it uses. */
  poseThere(frame: string, pose: Pose): { frame: string; pose: Pose } {
    const { chosen } = this;
    if (!chosen) return { frame, pose };
    const root = this.rootOf(chosen);
    const isKnown = frame.startsWith(chosen.framePrefix) && chosen.framePrefix !== '';
    if (isKnown || !root || root === frame || !chosen.hasOwnTf) {
      return { frame: frameThere(chosen, frame), pose };
    }
    const found = this.app.tf.lookup(root, frame);
    if (found.kind !== 'found') return { frame: frameThere(chosen, frame), pose };
    return { frame: frameThere(chosen, root), pose: multiply(found.pose, pose) };
  }

  /**
   * Robots whose trees have no frame in common are put into the simulated world at their first pose there, so that one
   * view shows all of them. From there on they are where their odometry has them.
   */
  anchor(message: Message): void {
    const { tf } = this.app;
    if (!this.isMany) return;
    const roots = this.list.map((robot) => {
      const base = this.baseFrame(robot);
      return base === undefined ? undefined : tf.root(base);
    });
    if (new Set(roots.filter((root) => root !== undefined)).size < 2) return;
    const poses = message.transforms as TransformStamped[];
    this.list.forEach((robot, i) => {
      const [root, base] = [roots[i], this.baseFrame(robot)];
      if (!root || !base || root === WORLD || this.anchored.has(root)) return;
      const model = this.app.modelOfNamespace(robot.namespace) ?? robotName(robot);
      const truth = `${model}/${base.slice(robot.framePrefix.length)}`;
      const found = poses.find(({ child_frame_id: name }) => name === truth);
      if (!found) return;
      const rootFromBase = tf.lookup(root, base, seconds(found.header.stamp));
      const newest = rootFromBase.kind === 'found' ? rootFromBase : tf.lookup(root, base);
      if (newest.kind !== 'found') return;
      const { translation: t, rotation: r } = found.transform;
      const worldFromBase: Pose = { t: [t.x, t.y, t.z], q: [r.x, r.y, r.z, r.w] };
      const { t: p, q } = multiply(worldFromBase, inverse(newest.pose));
      this.anchored.add(root);
      const transform = {
        translation: { x: p[0], y: p[1], z: p[2] },
        rotation: { x: q[0], y: q[1], z: q[2], w: q[3] },
      };
      const header = { stamp: { sec: 0, nanosec: 0 }, frame_id: WORLD };
      tf.add({ header, child_frame_id: root, transform }, true);
    });
  }

  /** Transforms were forgotten, or time jumped back. */
  forgetAnchors(): void {
    this.anchored.clear();
  }

  /** The robot of a topic or of a model of the simulated world. */
  find({ topic, model }: { topic?: string; model?: string }): Robot | undefined {
    if (topic) return this.list.find(({ description }) => description === topic);
    return this.list.find(
      (robot) => (this.app.modelOfNamespace(robot.namespace) ?? robotName(robot)) === model,
    );
  }
}
