/** What all displays have in common: a place in the scene, options, a topic, and words about how it is. */
import { Group, type Object3D } from 'three';
import type { Message } from '../core/cdr';
import type { Handler } from '../core/client';
import type { Pose } from '../core/pose';
import type { TfBuffer } from '../core/tf';
import { seconds, type Header } from '../core/types';
import { matrixOf } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import type { Option, Value, Values } from './options';

export type Level = 'ok' | 'warn' | 'error';

/** What a display may use. */
export interface Context {
  stage: Stage;
  tf: TfBuffer;
  subscribe(topic: string, handler: Handler): () => void;
  asset(uri: string): Promise<Uint8Array>;
  fixedFrame(): string;
  /** Time of the messages [s]. */
  nowS(): number;
  /** Pose of a simulated sensor's data by the simulation itself, for frames that TF does not know. */
  fixedFromSensor(topic: string, frame: string, timeS: number): Pose | undefined;
  /** Nodes that estimate where the robot is. */
  estimators(): readonly string[];
  /** Texts that were published once: the robot's description. */
  topicsOfType(types: readonly string[]): string[];
}

/** What a user sees of a display besides the scene. */
export interface Host {
  /** Says under a name how something is; without a text, it is no longer worth words. */
  status(name: string, level: Level, text?: string): void;
  note(path: string, value: Value): void;
  /** A picture to be shown beside the scene. */
  picture?(canvas: HTMLCanvasElement): void;
}

export interface Kind {
  /** As `.rviz` files name it: "rviz_default_plugins/LaserScan". */
  class: string;
  /** Other names for the same. */
  also?: readonly string[];
  title: string;
  help: string;
  /** Messages that it shows. */
  types: readonly string[];
  options: readonly Option[];
  /** Has a picture beside the scene. */
  hasPicture?: boolean;
  make(context: Context, values: Values, host: Host): Display;
}

export abstract class Display {
  readonly root = new Group();
  private leave?: () => void;
  private heard = 0;
  private heardTopic = '';

  constructor(
    protected context: Context,
    protected values: Values,
    protected host: Host,
  ) {
    context.stage.add(this.root);
  }

  protected get<T extends Value>(path: string): T {
    return this.values[path] as T;
  }

  /** Begins to hear its topic. */
  start(): void {
    this.leave?.();
    this.heard = 0;
    const topic = this.values.Topic;
    if (typeof topic !== 'string') return;
    this.heardTopic = topic;
    if (!topic) {
      this.host.status('Topic', 'warn', 'No topic is chosen');
      return;
    }
    this.host.status('Topic', 'warn', `Nothing came on ${topic} yet`);
    this.leave = this.context.subscribe(topic, (message) => {
      this.heard++;
      this.host.status('Topic', 'ok', `${this.heard} messages on ${topic}`);
      try {
        this.receive(message);
      } catch (error) {
        this.host.status('Message', 'error', (error as Error).message);
      }
    });
  }

  protected abstract receive(message: Message): void;

  /** An option has another value. */
  changed(path: string): void {
    if (path === 'Topic' && this.values.Topic !== this.heardTopic) {
      this.clear();
      this.start();
    }
    this.context.stage.invalidate();
  }

  /** Called for each picture. */
  tick(_nowMs: number): void {}

  /** Shows nothing any more: another topic, another time. */
  clear(): void {}

  /** The fixed frame is another one. */
  moved(): void {}

  stop(): void {
    this.leave?.();
    dispose(this.root);
    this.context.stage.invalidate();
  }

  /** Turns all parts on or off whose names begin so; `all` is what was just set. */
  protected toggleAll(prefix: string, all: string): void {
    for (const path of Object.keys(this.values)) {
      const isPart = path.startsWith(prefix) && path !== all;
      if (isPart && typeof this.values[path] === 'boolean') this.host.note(path, this.get(all));
    }
  }

  protected empty(): void {
    for (const child of [...this.root.children]) dispose(child);
  }

  protected put(object: Object3D, pose: Pose): void {
    object.matrixAutoUpdate = false;
    object.matrix.copy(matrixOf(pose));
    object.matrixWorldNeedsUpdate = true;
    this.context.stage.invalidate();
  }
}

const PATIENCE_MS = 700;

/**
 * Waits for the transform of each message, as RViz does. What nobody can transform is shown where its
 * frame was last, with a word about it.
 */
export abstract class FramedDisplay<M extends { header: Header }> extends Display {
  private pending: { message: M; sinceMs: number }[] = [];
  protected last?: M;

  protected override receive(message: Message): void {
    this.pending.push({ message: message as never, sinceMs: performance.now() });
    const most = (this.values['Topic/Filter size'] as number | undefined) ?? 10;
    if (this.pending.length > most) this.pending.shift();
  }

  override tick(nowMs: number): void {
    // The newest that can be placed makes older ones needless, unless a display keeps them.
    let done = -1;
    for (let i = 0; i < this.pending.length; i++) {
      const { message, sinceMs } = this.pending[i]!;
      const pose = this.placeOf(message, nowMs - sinceMs);
      if (pose) {
        this.keep(message, pose);
        done = i;
      } else if (nowMs - sinceMs > PATIENCE_MS && this.pending.length > 1) {
        done = Math.max(done, i - 1);
      }
    }
    if (done >= 0) this.pending.splice(0, done + 1);
  }

  /** Pose of a message in the fixed frame; none as long as it may still come, or cannot. */
  private placeOf({ header }: M, waitedMs: number): Pose | undefined {
    const { tf } = this.context;
    const fixed = this.context.fixedFrame();
    const stampS = seconds(header.stamp);
    const then = tf.lookup(fixed, header.frame_id, stampS);
    if (then.kind === 'found') {
      this.host.status('Transform', 'ok');
      return then.pose;
    }
    const newest = tf.lookup(fixed, header.frame_id);
    if (newest.kind !== 'found') {
      const topic = String(this.values.Topic ?? '');
      const pose = this.context.fixedFromSensor(topic, header.frame_id, stampS);
      if (pose) this.host.status('Transform', 'ok', 'Pose from the simulation; TF has none');
      if (pose) return pose;
    }
    if (then.kind !== 'never' && waitedMs <= PATIENCE_MS) return undefined;
    if (newest.kind === 'found') {
      this.host.status('Transform', 'warn', `Shown by the newest transform: ${then.why}`);
      return newest.pose;
    }
    this.host.status('Transform', 'error', `Cannot be placed: ${newest.why}`);
    return undefined;
  }

  private keep(message: M, fixedFromFrame: Pose): void {
    this.last = message;
    this.show(message, fixedFromFrame);
    this.context.stage.invalidate();
  }

  protected abstract show(message: M, fixedFromFrame: Pose): void;

  /** Shows the last message again: an option changed. */
  protected again(): void {
    if (this.last && !this.pending.some((p) => p.message === this.last)) {
      this.pending.unshift({ message: this.last, sinceMs: 0 });
    }
  }

  override changed(path: string): void {
    super.changed(path);
    if (!path.startsWith('Topic')) this.again();
  }

  override moved(): void {
    this.clear();
    this.again();
  }

  override clear(): void {
    this.empty();
    this.context.stage.invalidate();
  }
}
