/**
 * Poses of sensors from the simulation itself: data of a sensor is shown even if no node publishes the
 * transforms of its robot.
 */
import type { Message } from '../core/cdr';
import { multiply, type Pose } from '../core/pose';
import { frameName, TfBuffer } from '../core/tf';
import type { TransformStamped } from '../core/types';

/** World frame of the simulation. */
export const WORLD = 'world';

interface Mount {
  /** `<model>/<link>`. */
  link: string;
  linkFromData: Pose;
}

export class SensorFrames {
  /** Mounts by topic (`/scan`) and by frame (`laser`). */
  private mounts = new Map<string, Mount>();
  private links = new Set<string>();
  private tf = new TfBuffer();

  clear(): void {
    this.mounts.clear();
    this.links.clear();
    this.tf.clear();
  }

  /** Drops poses newer than now, after time jumped back. */
  rewind(nowS: number): void {
    this.tf.rewind(nowS);
  }

  /** Applies a message of `/world/<w>/sensors`. */
  setMounts(message: Message): void {
    this.mounts.clear();
    for (const one of message.transforms as TransformStamped[]) {
      const { translation: t, rotation: r } = one.transform;
      const linkFromData: Pose = { t: [t.x, t.y, t.z], q: [r.x, r.y, r.z, r.w] };
      this.mounts.set(one.child_frame_id, { link: one.header.frame_id, linkFromData });
    }
    this.links = new Set([...this.mounts.values()].map((mount) => mount.link));
  }

  /** Applies a message of `/world/<w>/poses`. */
  addPoses(message: Message): void {
    for (const one of message.transforms as TransformStamped[]) {
      if (this.links.has(one.child_frame_id)) this.tf.add(one, false);
    }
  }

  /** Model whose sensors publish in a namespace. */
  modelOfNamespace(namespace: string): string | undefined {
    if (!namespace) return undefined;
    for (const [topic, { link }] of this.mounts) {
      if (topic.startsWith(`${namespace}/`)) return link.split('/')[0];
    }
    return undefined;
  }

  /** Pose in the world of the data on a topic; `undefined` for topics without a simulated sensor. */
  worldFromData(topic: string, frame: string, timeS: number): Pose | undefined {
    const mount = this.mounts.get(topic) ?? this.mounts.get(frameName(frame));
    if (!mount) return undefined;
    const then = this.tf.lookup(WORLD, mount.link, timeS);
    const found = then.kind === 'found' ? then : this.tf.lookup(WORLD, mount.link);
    return found.kind === 'found' ? multiply(found.pose, mount.linkFromData) : undefined;
  }
}
