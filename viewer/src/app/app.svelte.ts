/** State shared by all panels: connection, time, frames, displays, notices. */
import { Client, type Handler, type Socket, type State } from '../core/client';
import type { Message } from '../core/cdr';
import { SUBPROTOCOL, type Mismatch, type Parameter } from '../core/protocol';
import { longName } from '../core/schema';
import { TfBuffer } from '../core/tf';
import { seconds, stampOf, type TransformStamped } from '../core/types';
import type { Context } from '../displays/display';
import type { Values } from '../displays/options';
import { multiply, type Pose } from '../core/pose';
import { kindOf } from '../displays/registry';
import { WorldDisplay } from '../displays/world';
import { readRviz, writeRviz, type RvizTool, type Tree } from '../rviz/file';
import { viewFrom, viewTo } from '../rviz/view';
import { Stage } from '../scene/stage';
import { FIRST_VIEW, type ViewState } from '../scene/view';
import { SensorFrames, WORLD } from '../sim/sensor_frames';
import { bestFrame, suggestionFor } from './auto';
import { Clock } from './clock';
import { Entry } from './entry.svelte';
import { estimatorsOf } from './estimators';
import { TEXTS } from './texts';
import { mapTruths, type MapTruth } from './truth';

export interface Notice {
  id: number;
  level: 'info' | 'warn' | 'error';
  text: string;
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

const WORLD_CLASS = 'periplus/World';
const MOST_LOG = 1000;
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
  fixedFrame = $state('map');
  isFrameChosen = $state(false);
  frames: string[] = $state([]);
  topics: TopicRow[] = $state.raw([]);
  mismatches: Mismatch[] = $state.raw([]);
  services: { name: string; type: string }[] = $state.raw([]);
  parameters: Record<string, Parameter> = $state({});
  displays: Entry[] = $state([]);
  notices: Notice[] = $state([]);
  log: LogLine[] = $state.raw([]);
  view: ViewState = $state(structuredClone(FIRST_VIEW));
  background = $state('');
  theme: 'dark' | 'light' = $state('dark');
  /** Displays are added automatically until the user adds or removes one. */
  isAutomatic = $state(true);
  /** True after a file without a world was opened, until the simulation's world is known. */
  private awaitsWorld = false;
  models: string[] = $state([]);
  selectedModel = $state('');
  truth: { link: string; distanceM: number; yawRad: number } | undefined = $state();
  maps: MapTruth[] = $state.raw([]);
  estimators: string[] = $state.raw([]);
  rvizTools: RvizTool[] = $state([]);
  fileName = $state('');

  readonly tf = new TfBuffer();
  readonly clock = new Clock();
  readonly client: Client;
  stage?: Stage;
  private readonly sensors = new SensorFrames();
  private worldSubscriptions: (() => void)[] = [];
  private rvizOriginal?: Tree;
  private hasOpenedLaunched = false;
  private seen = new Set<string>();
  private publishers = new Map<string, (message: Message) => void>();
  private lastId = 0;
  private newLog: LogLine[] = [];
  private framesKey = '';
  private isGraphChanged = false;
  private flushedMs = 0;

  constructor(url: string) {
    this.client = new Client(
      () => new WebSocket(url, [SUBPROTOCOL]) as unknown as Socket,
      {
        state: (state, why) => this.connected(state, why),
        graphChanged: () => (this.isGraphChanged = true),
        parameters: (all) => {
          for (const one of all) this.parameters[one.name] = one;
        },
        time: (timeS) => this.time(timeS),
        info: (metadata) => this.openLaunched(metadata),
        status: (level, text) => this.notice(level >= 2 ? 'error' : 'warn', text),
      },
      TEXTS,
    );
    // Both sources have the same time, but one may arrive later; without this, time would jump back.
    this.client.subscribe('/clock', (message) => {
      const isToldAnyhow = this.client.capabilities.includes('time');
      if (!isToldAnyhow) this.time(seconds(message.clock as never));
    });
    for (const isStatic of [false, true]) {
      this.client.subscribe(isStatic ? '/tf_static' : '/tf', (message) => {
        const now = performance.now();
        for (const one of message.transforms as TransformStamped[]) this.tf.add(one, isStatic, now);
      });
    }
    this.client.subscribe('/rosout', (message) => this.logged(message));
  }

  // Connection and time.

  private connected(state: State, why: string): void {
    this.connection = state;
    this.why = why;
    if (state !== 'closed') return;
    this.tf.clear();
    this.sensors.clear();
    this.clock.forgetStats();
  }

  private time(timeS: number): void {
    if (!this.clock.set(timeS, performance.now())) return;
    this.tf.rewind(timeS);
    this.sensors.rewind(timeS);
    for (const { display } of this.displays) {
      if (display instanceof WorldDisplay) display.restarted();
      else if (display) display.moved();
    }
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

  notice(level: Notice['level'], text: string): void {
    if (this.notices.some((notice) => notice.text === text)) return;
    const notice = { id: ++this.lastId, level, text };
    this.notices.push(notice);
    if (this.notices.length > 5) this.notices.shift();
    if (level !== 'error') setTimeout(() => this.dismiss(notice.id), 6000);
  }

  dismiss(id: number): void {
    this.notices = this.notices.filter((notice) => notice.id !== id);
  }

  // The 3D view.

  attach(stage: Stage): void {
    this.stage = stage;
    stage.view.set($state.snapshot(this.view) as ViewState);
    stage.ticks.add((nowMs) => this.tick(nowMs));
    for (const entry of this.displays) entry.start(this.context());
  }

  private context(): Context {
    return {
      stage: this.stage!,
      tf: this.tf,
      subscribe: (topic, handler: Handler) => this.client.subscribe(topic, handler),
      asset: (uri) => this.client.asset(uri),
      fixedFrame: () => this.fixedFrame,
      nowS: () => this.clock.nowS,
      topicsOfType: (types) => this.topicsOf(types),
      fixedFromSensor: (topic, frame, timeS) => this.fixedFromSensor(topic, frame, timeS),
      estimators: () => this.estimators,
    };
  }

  private fixedFromSensor(topic: string, frame: string, timeS: number): Pose | undefined {
    const worldFromData = this.sensors.worldFromData(topic, frame, timeS);
    if (!worldFromData || this.fixedFrame === WORLD) return worldFromData;
    const fixedFromWorld = this.world()?.fixedFromWorld;
    return fixedFromWorld && multiply(fixedFromWorld, worldFromData);
  }

  private tick(nowMs: number): void {
    for (const { display } of this.displays) display?.tick(nowMs);
    this.follow();
    if (nowMs - this.flushedMs > FLUSH_MS) {
      this.flushedMs = nowMs;
      this.flush(nowMs);
    }
  }

  /** Moves the camera with its target frame. */
  private follow(): void {
    const { view } = this.stage!;
    const { targetFrame } = view.state;
    const isFixed = !targetFrame || targetFrame === '<Fixed Frame>';
    const found = isFixed ? undefined : this.tf.lookup(this.fixedFrame, targetFrame);
    const pose = found?.kind === 'found' ? found.pose : undefined;
    const [x, y, z] = pose?.t ?? (isFixed ? [0, 0, 0] : view.origin.toArray());
    const q = pose?.q;
    const yaw = q ? 2 * Math.atan2(q[2], q[3]) : 0;
    const { origin } = view;
    const moved =
      Math.hypot(origin.x - x!, origin.y - y!, origin.z - z!) + Math.abs(yaw - view.originYaw);
    if (moved < 1e-5) return;
    origin.set(x!, y!, z!);
    view.originYaw = yaw;
    view.update();
  }

  private flush(nowMs: number): void {
    if (this.isGraphChanged) {
      this.isGraphChanged = false;
      this.offersChanged();
    }
    for (const entry of this.displays) entry.flush();
    this.timeS = this.clock.nowS;
    this.factor = this.clock.factor();
    this.isPaused = this.clock.isPaused(nowMs);
    this.framesPerSecond = this.stage?.framesPerSecond ?? 0;
    if (this.newLog.length > 0) {
      this.log = [...this.log, ...this.newLog].slice(-MOST_LOG);
      this.newLog = [];
    }
    const world = this.world();
    const truth = world?.truth;
    if (truth?.distanceM !== this.truth?.distanceM) this.truth = truth && { ...truth };
    this.chooseFrame();
  }

  /** Known frames; the world frame of a simulation that publishes no transforms. */
  private chooseFrame(): void {
    const key = `${this.tf.version} ${this.worldName}`;
    if (key === this.framesKey) return;
    this.framesKey = key;
    const known = this.tf.names();
    const names = known.length === 0 && this.worldName ? [WORLD] : known;
    if (names.join() !== this.frames.join()) this.frames = names;
    if (!this.isFrameChosen && names.length > 0) {
      this.setFixedFrame(
        bestFrame(names, (name) => this.tf.root(name)),
        false,
      );
    }
  }

  setFixedFrame(name: string, isChosen = true): void {
    if (isChosen) this.isFrameChosen = true;
    if (name === this.fixedFrame) return;
    this.fixedFrame = name;
    for (const { display } of this.displays) display?.moved();
    this.stage?.invalidate();
  }

  setView(state: Partial<ViewState>): void {
    this.stage?.view.set(state);
    this.view = structuredClone(this.stage?.view.state ?? FIRST_VIEW);
  }

  // Topics and services.

  private offersChanged(): void {
    const { client } = this;
    this.serverName = client.serverName;
    const by = (list: { name: string }[], ids: 'publisherIds' | 'subscriberIds') =>
      new Map(list.map((e) => [e.name, (e as never as Record<string, string[]>)[ids] ?? []]));
    const publishers = by(client.ends.publishedTopics, 'publisherIds');
    const subscribers = by(client.ends.subscribedTopics, 'subscriberIds');
    const names = new Set([...client.channels.keys(), ...publishers.keys(), ...subscribers.keys()]);
    this.topics = [...names].sort().map((name) => {
      const channel = client.channels.get(name);
      return {
        name,
        type: channel ? longName(channel.schemaName) : '',
        publishers: publishers.get(name) ?? [],
        subscribers: subscribers.get(name) ?? [],
        metadata: channel?.metadata,
      };
    });
    this.services = [...client.services.values()]
      .map(({ name, type }) => ({ name, type }))
      .sort((a, b) => (a.name < b.name ? -1 : 1));
    this.mismatches = [...client.mismatches];
    this.estimators = estimatorsOf(this.topics);
    const world = this.services
      .map((service) => /^\/world\/(.+)\/control$/.exec(service.name)?.[1])
      .find(Boolean);
    this.setWorld(world ?? '');
    if (this.isAutomatic) this.addSuggested();
    else this.addAwaitedWorld();
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
      this.worldSubscriptions.push(this.client.subscribe(`/world/${name}/${what}`, handler));
    subscribe('truth', (message) => (this.maps = mapTruths(message)));
    subscribe('sensors', (message) => this.sensors.setMounts(message));
    subscribe('poses', (message) => this.sensors.addPoses(message));
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

  private addSuggested(): void {
    if (!this.stage || this.connection !== 'open') return;
    if (this.displays.length === 0) {
      const grid = this.add(
        'rviz_default_plugins/Grid',
        'Grid',
        { 'Plane Cell Count': 20 },
        true,
        true,
      );
      if (grid) grid.isAutomatic = true;
      this.add('rviz_default_plugins/TF', 'TF', { 'Marker Scale': 0.6 }, false, true);
    }
    let pictures = this.displays.filter((e) => e.kind.hasPicture && e.isEnabled).length;
    for (const { name, type } of this.topics) {
      if (!type || this.seen.has(name)) continue;
      this.seen.add(name);
      const suggestion = suggestionFor(name, type);
      if (!suggestion) continue;
      const isPicture = type.endsWith('/Image');
      const isEnabled = suggestion.isEnabled && (!isPicture || ++pictures <= 1);
      this.add(suggestion.class, suggestion.name, suggestion.values, isEnabled, true);
    }
  }

  /** Adds the simulated world to the displays of a file that was opened before the world was known. */
  private addAwaitedWorld(): void {
    if (!this.awaitsWorld) return;
    for (const { name, type } of this.topics) {
      const suggestion = type && !this.seen.has(name) ? suggestionFor(name, type) : undefined;
      if (suggestion?.class !== WORLD_CLASS) continue;
      this.seen.add(name);
      this.awaitsWorld = false;
      this.add(suggestion.class, suggestion.name, suggestion.values, suggestion.isEnabled, true);
    }
  }

  // Displays.

  add(
    kindClass: string,
    name = '',
    values: Values = {},
    isEnabled = true,
    isAutomatic = false,
  ): Entry | undefined {
    const kind = kindOf(kindClass);
    if (!kind) {
      this.notice('warn', `The display class "${kindClass}" is unknown; the display was skipped.`);
      return undefined;
    }
    if (!isAutomatic) this.isAutomatic = false;
    this.displays.push(new Entry(kind, name, values, isEnabled));
    const entry = this.displays[this.displays.length - 1]!;
    entry.isAutomatic = isAutomatic;
    if (this.stage) this.begin(entry);
    return entry;
  }

  private begin(entry: Entry): void {
    entry.start(this.context());
    if (entry.display instanceof WorldDisplay) {
      entry.display.onModels = (names) => (this.models = names);
    }
  }

  remove(entry: Entry): void {
    this.isAutomatic = false;
    entry.stop();
    this.displays = this.displays.filter((e) => e !== entry);
  }

  setEnabled(entry: Entry, isEnabled: boolean): void {
    entry.isEnabled = isEnabled;
    if (isEnabled) this.begin(entry);
    else entry.stop();
  }

  setOption(entry: Entry, path: string, value: boolean | number | string): void {
    entry.values[path] = value;
    entry.display?.changed(path);
  }

  world(): WorldDisplay | undefined {
    const entry = this.displays.find((e) => e.display instanceof WorldDisplay);
    return entry?.display as WorldDisplay | undefined;
  }

  clear(): void {
    for (const entry of this.displays) entry.stop();
    this.displays = [];
    this.models = [];
  }

  // `.rviz` files.

  /** Opens the file that the launch file names, once: a reconnection leaves the displays as they are. */
  private openLaunched(metadata: Record<string, string>): void {
    const { rviz: text, rviz_file: fileName, fixed_frame: frame } = metadata;
    if (this.hasOpenedLaunched || !(text || frame)) return;
    this.hasOpenedLaunched = true;
    try {
      if (text) this.openRviz(text, fileName);
    } catch (error) {
      this.notice('error', `${fileName}: ${(error as Error).message}`);
    }
    if (frame) this.setFixedFrame(frame);
  }

  openRviz(text: string, fileName = ''): void {
    const file = readRviz(text);
    // RViz has no display for a simulated world: the present one stays, unless the file has one.
    const isWorldKept = !file.displays.some(({ class: name }) => name === WORLD_CLASS);
    const worlds = this.displays.filter((entry) => isWorldKept && entry.kind.class === WORLD_CLASS);
    this.clear();
    this.isAutomatic = false;
    this.rvizOriginal = file.original;
    this.fileName = fileName;
    this.rvizTools = file.tools;
    for (const display of file.displays) {
      const entry = this.add(display.class, display.name, display.values, display.isEnabled);
      if (entry) entry.original = display.original;
    }
    for (const { name, values, isEnabled } of worlds) {
      this.add(WORLD_CLASS, name, $state.snapshot(values) as Values, isEnabled);
    }
    this.awaitsWorld = isWorldKept && worlds.length === 0;
    this.addAwaitedWorld();
    this.setFixedFrame(file.fixedFrame);
    this.background = file.background;
    if (file.view) this.setView(viewFrom(file.view));
  }

  rvizText(): string {
    return writeRviz({
      fixedFrame: this.fixedFrame,
      background: this.background || '48; 48; 48',
      displays: this.displays.map((entry) => ({
        class: entry.kind.class,
        name: entry.name,
        isEnabled: entry.isEnabled,
        values: $state.snapshot(entry.values) as Values,
        options: entry.kind.options,
        original: entry.original,
      })),
      view: viewTo(this.stage?.view.state ?? FIRST_VIEW),
      original: this.rvizOriginal,
    });
  }

  /** Property of a tool in the opened file; otherwise RViz's default. */
  toolValue<T extends string | number>(tool: string, path: string, otherwise: T): T {
    const found = this.rvizTools.find((t) => t.class.endsWith(`/${tool}`))?.values[path];
    return (found as T | undefined) ?? otherwise;
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
        this.notice('error', `${name} failed. ${String(why)}`);
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
    return line ? line.text : 'See the log for the reason.';
  }
}
