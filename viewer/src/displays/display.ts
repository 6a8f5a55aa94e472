/** Base of all displays: a group in the scene, options, a topic and a status. */
import { Group, type Object3D } from 'three';
import type { Message } from '../core/cdr';
import type { Handler } from '../core/client';
import type { Need } from '../core/feed';
import type { Pose } from '../core/pose';
import type { TfBuffer } from '../core/tf';
import { seconds, type Header } from '../core/types';
import type { MeshLibrary } from '../scene/meshes';
import { matrixOf } from '../scene/shapes';
import { dispose, type Stage } from '../scene/stage';
import type { Option, Value, Values } from './options';
import { t } from '../texts/language.svelte';

export type Level = 'ok' | 'warn' | 'error';

/** Services of the application that a display uses. */
export interface Context {
  stage: Stage;
  tf: TfBuffer;
  subscribe(topic: string, handler: Handler, need?: Need): () => void;
  asset(uri: string): Promise<Uint8Array>;
  /** Meshes and textures of the server, shared by all displays. */
  meshes: MeshLibrary;
  publish(topic: string, type: string, message: Message): void;
  /** Calls a service; fails with the server's reason. */
  call(service: string, request: Message): Promise<Message>;
  hasService(name: string): boolean;
  fixedFrame(): string;
  /** Time of the messages [s]. */
  nowS(): number;
  /** False if no newer transforms arrive: a recording is paused. */
  awaitsTransforms?(): boolean;
  /** Clock of the arrival of messages, for their ages [ms]. */
  arrivalMs?(): number;
  /** Pose of a simulated sensor's data by the simulation itself, for frames that TF does not know. */
  fixedFromSensor(topic: string, frame: string, timeS: number): Pose | undefined;
  /** Nodes that estimate where the robot is. */
  estimators(): readonly string[];
  /** Topics of these types. */
  topicsOfType(types: readonly string[]): string[];
}

/** Entry of a display in the list of displays. */
export interface Host {
  /** Sets the status of this name; without a text, removes it. */
  status(name: string, level: Level, text?: string): void;
  /** Removes all statuses. */
  forget(): void;
  note(path: string, value: Value): void;
  /** Shows an image beside the scene. */
  picture?(canvas: HTMLCanvasElement): void;
}

export interface Kind {
  /** Class name in `.rviz` files: "rviz_default_plugins/LaserScan". */
  class: string;
  /** Other class names of the same display. */
  also?: readonly string[];
  title: string;
  help: string;
  /** Types of the messages that it shows. */
  types: readonly string[];
  options: readonly Option[];
  /** True if it shows an image beside the scene. */
  hasPicture?: boolean;
  make(context: Context, values: Values, host: Host): Display;
}

export abstract class Display {
  readonly root = new Group();
  private unsubscribe?: () => void;
  private messageCount = 0;
  private subscribedTopic = '';
  private subscribedNeed = '';

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

  /** Messages before a time that are needed to show that time; by default the newest one. */
  protected need(): Need {
    return {};
  }

  /** Subscribes to the topic. */
  start(): void {
    this.unsubscribe?.();
    const need = this.need();
    this.subscribedNeed = JSON.stringify(need);
    this.messageCount = 0;
    const topic = this.values.Topic;
    if (typeof topic !== 'string') return;
    this.subscribedTopic = topic;
    if (!topic) {
      this.host.status('Topic', 'warn', t().displays.noTopic);
      return;
    }
    this.host.status('Topic', 'warn', t().displays.noMessage(topic));
    const handler: Handler = (message) => {
      this.messageCount++;
      this.host.status('Topic', 'ok', t().displays.messages(this.messageCount, topic));
      try {
        this.receive(message);
      } catch (error) {
        this.host.status('Message', 'error', (error as Error).message);
      }
    };
    this.unsubscribe = this.context.subscribe(topic, handler, need);
  }

  protected abstract receive(message: Message): void;

  /** Called when an option has changed. */
  changed(path: string): void {
    if (path === 'Topic' && this.values.Topic !== this.subscribedTopic) {
      this.clear();
      this.start();
    } else if (JSON.stringify(this.need()) !== this.subscribedNeed && this.unsubscribe) {
      this.start();
    }
    this.context.stage.invalidate();
  }

  /** Called once per rendered frame. */
  tick(_nowMs: number): void {}

  /** Removes everything shown: another topic, or another time. */
  clear(): void {}

  /** Time jumped in a recording: the messages of the new time follow. */
  reset(): void {
    this.messageCount = 0;
    if (this.unsubscribe) {
      // The statuses describe messages of the time before.
      this.host.forget();
      this.host.status('Topic', 'warn', t().replayTime.noMessageAtTime(this.subscribedTopic));
    }
    this.clear();
  }

  /** Called when the fixed frame has changed. */
  moved(): void {}

  stop(): void {
    this.unsubscribe?.();
    dispose(this.root);
    this.context.stage.invalidate();
  }

  /** Enables or disables all parts whose names begin with `prefix`; `all` is the switch that the user set. */
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

const TRANSFORM_TIMEOUT_MS = 700;

/**
 * Waits for the transform of each message, as RViz does. A message without one is shown at the last known pose
 * of its frame, with a status that reports this.
 */
export abstract class FramedDisplay<M extends { header: Header }> extends Display {
  private pending: { message: M; sinceMs: number }[] = [];
  protected last?: M;

  protected override receive(message: Message): void {
    const nowMs = performance.now();
    this.pending.push({ message: message as never, sinceMs: nowMs });
    const most = (this.values['Topic/Filter size'] as number | undefined) ?? 10;
    if (this.pending.length <= most) return;
    // A display of past messages gets all of them after a jump, before the next frame.
    const { historyS, count } = this.need();
    if (historyS || (count ?? 1) > 1) this.tick(nowMs);
    if (this.pending.length > most) this.pending.shift();
  }

  override tick(nowMs: number): void {
    // The newest message with a transform replaces older ones, unless a display keeps them.
    let done = -1;
    for (let i = 0; i < this.pending.length; i++) {
      const { message, sinceMs } = this.pending[i]!;
      const pose = this.fixedFromMessage(message, nowMs - sinceMs);
      if (pose) {
        this.keep(message, pose);
        done = i;
      } else if (nowMs - sinceMs > TRANSFORM_TIMEOUT_MS && this.pending.length > 1) {
        done = Math.max(done, i - 1);
      }
    }
    if (done >= 0) this.pending.splice(0, done + 1);
  }

  /** Pose of a message in the fixed frame; `undefined` if its transform is not available (yet). */
  private fixedFromMessage({ header }: M, waitedMs: number): Pose | undefined {
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
      if (pose) this.host.status('Transform', 'ok', t().displays.poseFromSimulation);
      if (pose) return pose;
    }
    const mayArrive = this.context.awaitsTransforms?.() ?? true;
    if (mayArrive && then.kind !== 'never' && waitedMs <= TRANSFORM_TIMEOUT_MS) return undefined;
    if (newest.kind === 'found') {
      // The message is newer than the last transform before the time at which a recording is paused.
      if (!mayArrive && then.kind === 'later') {
        this.host.status('Transform', 'ok');
        return newest.pose;
      }
      this.host.status('Transform', 'warn', t().displays.newestTransform(then.why));
      return newest.pose;
    }
    this.host.status('Transform', 'error', t().displays.noTransform(newest.why));
    return undefined;
  }

  private keep(message: M, fixedFromFrame: Pose): void {
    this.last = message;
    this.show(message, fixedFromFrame);
    this.context.stage.invalidate();
  }

  protected abstract show(message: M, fixedFromFrame: Pose): void;

  /** Shows the last message again, after an option changed. */
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

  override reset(): void {
    this.pending = [];
    this.last = undefined;
    super.reset();
  }

  override clear(): void {
    this.empty();
    this.context.stage.invalidate();
  }
}
