/** State shared by all panels: connection, time, frames, displays, notices. */
import { Client, type Handler, type Socket, type State } from '../core/client';
import type { Message } from '../core/cdr';
import { Feed } from '../core/feed';
import { multiply, type Pose } from '../core/pose';
import type { Mismatch, Parameter } from '../core/protocol';
import { longName } from '../core/schema';
import { KEPT_S, TfBuffer } from '../core/tf';
import { seconds, stampOf, type TransformStamped } from '../core/types';
import type { WorldDisplay } from '../displays/world';
import type { Stage } from '../scene/stage';
import type { ViewState } from '../scene/view';
import { MeshLibrary } from '../scene/meshes';
import { SensorFrames, WORLD } from '../sim/sensor_frames';
import { Clock } from './clock';
import type { FileReceiver } from './drop';
import type { Entry } from './entry.svelte';
import { estimatorsOf } from './estimators';
import { TEXTS } from './texts';
import { Recordings } from './recordings.svelte';
import type { Replay } from './replay.svelte';
import { Robots } from './robots.svelte';
import { mapTruths, type MapTruth } from './truth';
import { Viewport } from './viewport.svelte';
import type { Workbench } from './workbench.svelte';
import { t } from '../texts/language.svelte';

export interface Notice {
  id: number;
  level: 'info' | 'warn' | 'error';
  text: string;
  topic?: string;
}

export interface LogLine {
  id: number;
  level: number;
  node: string;
  text: string;
  timeS: number;
}

export interface TopicRow {
  name: string;
  type: string;
  publishers: string[];
  subscribers: string[];
  metadata?: Record<string, string>;
}

const MOST_LOG = 1000;
const MOST_NOTICES = 4;
const FLUSH_MS = 200;

export class App {
  connection: State = $state('connecting');
  why = $state('');
  serverName = $state('');
  worldName = $state('');
  timeS = $state(0);
  factor: number | undefined = $state();
  isPaused = $state(true);
  framesPerSecond = $state(0);
  frames: string[] = $state([]);
  topics: TopicRow[] = $state.raw([]);
  mismatches: Mismatch[] = $state.raw([]);
  services: { name: string; type: string }[] = $state.raw([]);
  parameters: Record<string, Parameter> = $state({});
  notices: Notice[] = $state([]);
  log: LogLine[] = $state.raw([]);
  theme: 'dark' | 'light' = $state('dark');
  /** Replay of recordings; `undefined` while the running system is shown. */
  replay: Replay | undefined = $state.raw();
  /** All 3D views. */
  viewports: Viewport[] = $state([]);
  /** The 3D view that panels and tools act on. */
  active: Viewport = $state.raw(undefined as never);
  /** The open panels; set by the page. */
  workbench: Workbench | undefined = $state.raw();
  /** True if the simulator is in this tab: the page starts it, and shows why it has ended. */
  isWithoutServer = false;
  /** Takes dropped files that the page itself does not open; without a server the simulator in the tab does. */
  receiver: FileReceiver | undefined;
  models: string[] = $state([]);
  /** Selected models of the simulated world, in the order of their selection. */
  selection: string[] = $state.raw([]);
  /** Number of jumps of time back: resets of the simulation. */
  resets = $state(0);
  truth: { link: string; distanceM: number; yawRad: number } | undefined = $state();
  maps: MapTruth[] = $state.raw([]);
  estimators: string[] = $state.raw([]);

  readonly tf = new TfBuffer();
  readonly clock = new Clock();
  readonly client: Client;
  /** Messages of the running system, or of recordings. */
  readonly feed: Feed;
  /** Recordings of the server. */
  readonly recordings: Recordings;
  /** Meshes and textures of the server. */
  readonly meshes = new MeshLibrary({
    asset: (uri) => this.client.asset(uri),
    mesh: (uri) => this.client.mesh(uri),
  });
  /** The robots, and the one that tools and panels act on. */
  readonly robots: Robots;
  private readonly sensors = new SensorFrames();
  private worldSubscriptions: (() => void)[] = [];
  private publishers = new Map<string, (message: Message) => void>();
  private lastId = 0;
  private forgetters = new Set<() => void>();
  private newLog: LogLine[] = [];
  private framesKey = '';
  private isGraphChanged = false;
  private flushedMs = 0;

  constructor(open: () => Socket) {
    this.client = new Client(
      open,
      {
        state: (state, why) => this.connected(state, why),
        graphChanged: () => (this.isGraphChanged = true),
        parameters: (all) => {
          for (const one of all) this.parameters[one.name] = one;
        },
        time: (timeS) => this.time(timeS),
        info: (metadata) => {
          this.active.openLaunched(metadata);
          this.recordings.connected(metadata);
        },
        recordings: () => this.recordings.changed(),
        status: (level, text) => this.notice(level >= 2 ? 'error' : 'warn', text),
      },
      TEXTS,
    );
    this.feed = new Feed(this.client);
    this.recordings = new Recordings(this);
    this.robots = new Robots(this);
    this.active = this.addViewport();
    // Both sources have the same time, but one may arrive later; without this, time would jump back.
    this.feed.subscribe('/clock', (message) => {
      if (this.replay) return;
      const isToldAnyhow = this.client.capabilities.includes('time');
      if (!isToldAnyhow) this.time(seconds(message.clock as never));
    });
    for (const isStatic of [false, true]) {
      this.subscribeTransforms(isStatic ? '/tf_static' : '/tf', isStatic);
    }
    this.feed.subscribe('/rosout', (message) => this.logged(message));
  }

  /** Adds the transforms of a topic to the tree, with the names of their frames on this page. */
  subscribeTransforms(topic: string, isStatic: boolean): () => void {
    return this.feed.subscribe(topic, (message, _topic, _bytes, timeS) => {
      const now = timeS === undefined ? performance.now() : timeS * 1000;
      const renamed = this.robots.renamed(topic);
      for (const one of message.transforms as TransformStamped[]) {
        if (!renamed) this.tf.add(one, isStatic, now);
        else {
          const header = { ...one.header, frame_id: renamed(one.header.frame_id) };
          const child_frame_id = renamed(one.child_frame_id);
          this.tf.add({ ...one, header, child_frame_id }, isStatic, now);
        }
      }
    });
  }

  // Connection and time.

  private connected(state: State, why: string): void {
    this.connection = state;
    this.why = why;
    // A replay keeps what it shows: its recordings may be there again after a moment.
    if (state === 'closed') this.recordings?.disconnected();
    if (state !== 'closed' || this.replay) return;
    this.tf.clear();
    this.robots.forgetAnchors();
    this.sensors.clear();
    this.clock.forgetStats();
    // The files of another run may differ.
    this.meshes.clear();
  }

  private time(timeS: number): void {
    if (this.replay) return;
    if (!this.clock.set(timeS, performance.now())) return;
    this.resets++;
    this.tf.rewind(timeS);
    this.sensors.rewind(timeS);
    for (const viewport of this.viewports) viewport.rewound();
  }

  /** Another source, or another time of a recording: everything that was received is forgotten. */
  jumped(spanS = 0): void {
    this.tf.clear();
    this.robots.forgetAnchors();
    this.tf.keptS = KEPT_S + spanS;
    this.sensors.clear();
    this.log = [];
    this.newLog = [];
    for (const viewport of this.viewports) viewport.jumped();
    for (const forget of this.forgetters) forget();
  }

  /** Calls `forget` at each jump, before the messages of the new time; returns a function that ends this. */
  onJump(forget: () => void): () => void {
    this.forgetters.add(forget);
    return () => this.forgetters.delete(forget);
  }

  /** The log before the time of a recording that is shown. */
  showLog(messages: readonly Message[]): void {
    this.log = [];
    this.newLog = [];
    for (const message of messages) this.logged(message);
  }

  /** Topics and services of the source changed. */
  graphChanged(): void {
    this.isGraphChanged = false;
    this.offersChanged();
  }

  private logged(message: Message): void {
    this.newLog.push({
      id: ++this.lastId,
      level: Number(message.level),
      node: String(message.name),
      text: String(message.msg),
      timeS: seconds(message.stamp as never),
    });
  }

  /** Shows a message; one with the same topic as an earlier message replaces it. */
  notice(level: Notice['level'], text: string, topic?: string): void {
    if (this.notices.some((notice) => notice.text === text)) return;
    const notice = { id: ++this.lastId, level, text, topic };
    if (topic) this.notices = this.notices.filter((one) => one.topic !== topic);
    this.notices.push(notice);
    if (this.notices.length > MOST_NOTICES) this.notices.shift();
    if (level !== 'error') setTimeout(() => this.dismiss(notice.id), 6000);
  }

  dismiss(id: number): void {
    this.notices = this.notices.filter((notice) => notice.id !== id);
  }

  // The 3D views.

  addViewport(): Viewport {
    this.viewports.push(new Viewport(this));
    return this.viewports[this.viewports.length - 1]!;
  }

  removeViewport(viewport: Viewport): void {
    viewport.clear();
    this.viewports = this.viewports.filter((one) => one !== viewport);
    if (this.active === viewport) this.active = this.viewports[0] ?? this.addViewport();
  }

  fixedFromSensor(
    topic: string,
    frame: string,
    timeS: number,
    fixedFrame: string,
  ): Pose | undefined {
    const worldFromData = this.sensors.worldFromData(topic, frame, timeS);
    if (!worldFromData || fixedFrame === WORLD) return worldFromData;
    const fixedFromWorld = this.world()?.fixedFromWorld;
    return fixedFromWorld && multiply(fixedFromWorld, worldFromData);
  }

  /** Model of the simulated world whose sensors publish in a namespace. */
  modelOfNamespace(namespace: string): string | undefined {
    return this.sensors.modelOfNamespace(namespace);
  }

  /** Called by each 3D view once per frame. */
  tick(nowMs: number): void {
    if (nowMs - this.flushedMs <= FLUSH_MS) return;
    this.flushedMs = nowMs;
    this.flush(nowMs);
  }

  private flush(nowMs: number): void {
    if (this.isGraphChanged) {
      this.isGraphChanged = false;
      this.offersChanged();
    }
    this.findFrames();
    for (const viewport of this.viewports) viewport.flush();
    this.timeS = this.clock.nowS;
    this.factor = this.replay ? this.replay.rate : this.clock.factor();
    this.isPaused = this.replay ? !this.replay.isPlaying : this.clock.isPaused(nowMs);
    this.framesPerSecond = this.stage?.framesPerSecond ?? 0;
    if (this.newLog.length > 0) {
      this.log = [...this.log, ...this.newLog].slice(-MOST_LOG);
      this.newLog = [];
    }
    const world = this.world();
    const truth = world?.truth;
    if (truth?.distanceM !== this.truth?.distanceM) this.truth = truth && { ...truth };
  }

  /** Known frames; the world frame of a simulation that publishes no transforms. */
  private findFrames(): void {
    const key = `${this.tf.version} ${this.worldName}`;
    if (key === this.framesKey) return;
    this.framesKey = key;
    const known = this.tf.names();
    const names = known.length === 0 && this.worldName ? [WORLD] : known;
    if (names.join() === this.frames.join()) return;
    this.frames = names;
    this.robots.settle();
  }

  // Topics and services.

  private offersChanged(): void {
    const { source } = this.feed;
    this.serverName = this.client.serverName;
    const by = (list: { name: string }[], ids: 'publisherIds' | 'subscriberIds') =>
      new Map(list.map((e) => [e.name, (e as never as Record<string, string[]>)[ids] ?? []]));
    const publishers = by(source.ends.publishedTopics, 'publisherIds');
    const subscribers = by(source.ends.subscribedTopics, 'subscriberIds');
    const names = new Set([...source.channels.keys(), ...publishers.keys(), ...subscribers.keys()]);
    this.topics = [...names].sort().map((name) => {
      const channel = source.channels.get(name);
      return {
        name,
        type: channel ? longName(channel.schemaName) : '',
        publishers: publishers.get(name) ?? [],
        subscribers: subscribers.get(name) ?? [],
        metadata: channel?.metadata,
      };
    });
    this.services = [...source.services.values()]
      .map(({ name, type }) => ({ name, type }))
      .sort((a, b) => (a.name < b.name ? -1 : 1));
    this.mismatches = [...source.mismatches];
    this.estimators = estimatorsOf(this.topics);
    const world = this.services
      .map((service) => /^\/world\/(.+)\/control$/.exec(service.name)?.[1])
      .find(Boolean);
    this.setWorld(world ?? '');
    this.robots.settle();
    for (const viewport of this.viewports) viewport.offersChanged();
  }

  /** Subscribes to the topics of the simulated world. */
  private setWorld(name: string): void {
    if (name === this.worldName) return;
    this.worldName = name;
    this.worldSubscriptions.forEach((unsubscribe) => unsubscribe());
    this.worldSubscriptions = [];
    this.maps = [];
    this.sensors.clear();
    this.clock.forgetStats();
    if (!name) return;
    const subscribe = (what: string, handler: Handler) =>
      this.worldSubscriptions.push(this.feed.subscribe(`/world/${name}/${what}`, handler));
    subscribe('truth', (message) => (this.maps = mapTruths(message)));
    subscribe('sensors', (message) => this.sensors.setMounts(message));
    subscribe('poses', (message) => {
      this.sensors.addPoses(message);
      this.robots.anchor(message);
    });
    subscribe('stats', (message) =>
      this.clock.setStats({
        timeS: seconds(message.sim_time as never),
        realS: seconds(message.real_time as never),
        isPaused: message.paused === true || message.stepping === true,
      }),
    );
  }

  /** Makes a publisher and a subscription of a topic compatible. */
  async repair(mismatch: Mismatch): Promise<void> {
    try {
      this.notice('info', `${mismatch.topic}: ${await this.client.repair(mismatch)}`);
    } catch (error) {
      this.notice('error', `${mismatch.topic}: ${(error as Error).message}`);
    }
  }

  topicsOf(types: readonly string[]): string[] {
    return this.topics.filter((t) => types.includes(t.type)).map((t) => t.name);
  }

  /** Model that was selected last. */
  get selectedModel(): string {
    return this.selection[this.selection.length - 1] ?? '';
  }

  set selectedModel(name: string) {
    this.selection = name ? [name] : [];
  }

  // The active 3D view.

  get stage(): Stage | undefined {
    return this.active.stage;
  }

  get fixedFrame(): string {
    return this.active.fixedFrame;
  }

  get displays(): Entry[] {
    return this.active.displays;
  }

  get view(): ViewState {
    return this.active.view;
  }

  setFixedFrame(name: string): void {
    this.active.setFixedFrame(name);
  }

  setView(state: Partial<ViewState>): void {
    this.active.setView(state);
  }

  /** Display of the simulated world: of the active view, otherwise of any. */
  world(): WorldDisplay | undefined {
    const all = [this.active, ...this.viewports].map((viewport) => viewport.world());
    return all.find((display) => display !== undefined);
  }

  // Publishing and calling.

  publish(topic: string, type: string, message: Message): void {
    const key = `${topic} ${type}`;
    let publish = this.publishers.get(key);
    if (!publish) {
      try {
        publish = this.client.publisher(topic, type);
      } catch (error) {
        this.notice('error', `${topic}: ${(error as Error).message}`);
        return;
      }
      this.publishers.set(key, publish);
    }
    publish(message);
  }

  header(frame = this.fixedFrame): Message {
    return { stamp: stampOf(this.clock.nowS), frame_id: frame };
  }

  /** Calls a service and reports a failure; returns the response, or `undefined` after a failure. */
  async call(name: string, request: Message): Promise<Message | undefined> {
    try {
      const answer = await this.client.call(name, request);
      if (answer.success === false) {
        const why = answer.message ?? answer.status_message ?? this.lastComplaint();
        this.notice('error', t().notices.serviceFailed(name, String(why)));
        return undefined;
      }
      return answer;
    } catch (error) {
      this.notice('error', (error as Error).message);
      return undefined;
    }
  }

  private lastComplaint(): string {
    const line = [...this.log, ...this.newLog].reverse().find((l) => l.level >= 30);
    return line ? line.text : t().notices.seeLog;
  }
}
