/** One 3D view: its displays, fixed frame and camera, as in a window of RViz. */
import type { Pose } from '../core/pose';
import type { Context } from '../displays/display';
import type { Values } from '../displays/options';
import { kindOf } from '../displays/registry';
import { WorldDisplay } from '../displays/world';
import {
  readRviz,
  writeRviz,
  type RvizTool,
  type RvizWindow,
  type SavedRvizView,
  type Tree,
} from '../rviz/file';
import type { RvizGroup } from '../rviz/groups';
import { viewFrom, viewTo } from '../rviz/view';
import type { Stage } from '../scene/stage';
import { FIRST_VIEW, type ViewState } from '../scene/view';
import type { App } from './app.svelte';
import { bestFrame, prefixIn, suggestionFor } from './auto';
import { Entry } from './entry.svelte';
import { DisplayGroup } from './display_group.svelte';
import {
  groupsFrom,
  savedDisplay,
  savedGroup,
  type SavedDisplay,
  type SavedGroup,
} from './saved_display';
import { t } from '../texts/language.svelte';

/** Topic of a display. */
const topicOf = (values: Values): string =>
  String(values.Topic ?? values['Description Topic'] ?? '');

const WORLD_CLASS = 'periplus/World';
const ROBOT_CLASS = 'rviz_default_plugins/RobotModel';

/** A 3D view as it is saved with a layout. */
export interface ViewportState {
  fixedFrame: string;
  isFrameChosen: boolean;
  view: ViewState;
  background: string;
  isAutomatic: boolean;
  displays: SavedDisplay[];
  groups: SavedGroup[];
  savedViews: SavedView[];
  fileName: string;
  /** Checksum of the `.rviz` file of the launch file that was opened. */
  launched: number;
}

/** A camera that the user saved by a name. */
export interface SavedView {
  name: string;
  view: ViewState;
  /** View of the `.rviz` file that it was read from; written back while its camera is not changed. */
  original?: SavedRvizView;
}

/** FNV-1a of a text. */
function checksum(text: string): number {
  let sum = 0x811c9dc5;
  for (let i = 0; i < text.length; i++) sum = Math.imul(sum ^ text.charCodeAt(i), 0x01000193);
  return sum >>> 0;
}

let lastId = 0;

export class Viewport {
  readonly id = ++lastId;
  fixedFrame = $state('map');
  isFrameChosen = $state(false);
  displays: Entry[] = $state([]);
  groups: DisplayGroup[] = $state.raw([]);
  savedViews: SavedView[] = $state.raw([]);
  view: ViewState = $state(structuredClone(FIRST_VIEW));
  background = $state('');
  /** Displays are added automatically until the user adds or removes one. */
  isAutomatic = $state(true);
  rvizTools: RvizTool[] = $state([]);
  fileName = $state('');
  /** Prefix of the recording whose topics are added automatically; `undefined` for all topics. */
  track: string | undefined = $state();
  stage?: Stage;
  /** True after a file without a world was opened, until the simulation's world is known. */
  private awaitsWorld = false;
  private rvizOriginal?: Tree;
  private hasOpenedLaunched = false;
  private launched = 0;
  /** Automatic displays of a saved layout, which get their options back when their topics exist. */
  private awaited: SavedDisplay[] = [];
  private seen = new Set<string>();

  constructor(private app: App) {}

  // The scene.

  attach(stage: Stage): void {
    this.stage = stage;
    stage.view.set($state.snapshot(this.view) as ViewState);
    stage.ticks.add((nowMs) => this.tick(nowMs));
    for (const entry of this.displays) this.begin(entry);
    // A view that is opened later shows the topics that are there already.
    if (this.app.connection === 'open') this.offersChanged();
  }

  /** Stops all displays, which start again with the next stage. */
  detach(): void {
    for (const entry of this.displays) entry.stop();
    this.stage = undefined;
  }

  private context(): Context {
    const { app } = this;
    return {
      stage: this.stage!,
      tf: app.tf,
      subscribe: (topic, handler, need) =>
        app.feed.subscribe(topic, app.robots.withFrames(topic, handler), need),
      asset: (uri) => app.client.asset(uri),
      meshes: app.meshes,
      publish: (topic, type, message) => app.publish(topic, type, message),
      call: (service, request) => app.client.call(service, request),
      hasService: (name) => app.feed.source.services.has(name),
      fixedFrame: () => this.fixedFrame,
      nowS: () => app.clock.nowS,
      topicsOfType: (types) => app.topicsOf(types),
      fixedFromSensor: (topic, frame, timeS) =>
        app.fixedFromSensor(topic, frame, timeS, this.fixedFrame),
      estimators: () => app.estimators,
      awaitsTransforms: () => app.replay?.awaitsTransforms() ?? true,
      arrivalMs: () => app.replay?.arrivalMs() ?? performance.now(),
    };
  }

  /** For an image in its own panel: without a scene. */
  imageContext(): Context {
    const stage = { add: () => {}, remove: () => {}, invalidate: () => {} };
    return { ...this.context(), stage: stage as unknown as Stage };
  }

  private tick(nowMs: number): void {
    for (const { display } of this.displays) display?.tick(nowMs);
    this.follow();
    this.app.tick(nowMs);
  }

  /** Moves the camera with its target frame. */
  private follow(): void {
    const { view } = this.stage!;
    const { targetFrame } = view.state;
    const isFixed = !targetFrame || targetFrame === '<Fixed Frame>';
    const found = isFixed ? undefined : this.app.tf.lookup(this.fixedFrame, targetFrame);
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

  /** Time jumped: the displays start from the present messages. */
  rewound(): void {
    for (const { display } of this.displays) {
      if (display instanceof WorldDisplay) display.restarted();
      else if (display) display.moved();
    }
  }

  /** Time jumped in a recording: the displays wait for the messages of the new time. */
  jumped(): void {
    for (const { display } of this.displays) display?.reset();
  }

  private isShown(topicOrFrame: string): boolean {
    return this.track === undefined || prefixIn(topicOrFrame) === this.track;
  }

  /** Removes automatic displays of topics that are gone, or that another view shows. */
  dropMissing(): void {
    const names = new Set(this.app.topics.map((topic) => topic.name));
    for (const entry of [...this.displays]) {
      const topic = topicOf(entry.values);
      if (!entry.isAutomatic || !topic || (names.has(topic) && this.isShown(topic))) continue;
      entry.stop();
      this.displays = this.displays.filter((one) => one !== entry);
      this.seen.delete(topic);
    }
  }

  /** Topics or services changed. */
  offersChanged(): void {
    if (this.isAutomatic) this.addSuggested();
    else this.addAwaitedWorld();
  }

  /** Robots were found: their models get the prefixes of their frames. */
  robotsChanged(): void {
    for (const entry of this.displays) {
      if (!entry.isAutomatic || entry.kind.class !== ROBOT_CLASS) continue;
      const robot = this.app.robots.find({ topic: topicOf(entry.values) });
      const prefix = robot?.framePrefix.slice(0, -1);
      if (prefix !== undefined && prefix !== entry.values['TF Prefix']) {
        this.setOption(entry, 'TF Prefix', prefix);
      }
    }
  }

  flush(): void {
    for (const entry of this.displays) entry.flush();
    const { tf, robots } = this.app;
    // The robot that is chosen decides if its frames are not connected to the others.
    const base = robots.isMany ? robots.baseFrame() : undefined;
    const frames = base ? [base, ...this.app.frames] : this.app.frames;
    if (this.isFrameChosen || frames.length === 0) return;
    const own = frames.filter((name) => prefixIn(name) === (this.track ?? ''));
    const best = bestFrame(
      own.map((name) => name.slice(this.track?.length ?? 0)),
      (name) => tf.root((this.track ?? '') + name).slice(this.track?.length ?? 0),
    );
    this.setFixedFrame((this.track ?? '') + best, false);
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

  private addSuggested(): void {
    if (!this.stage || this.app.connection !== 'open') return;
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
    for (const { name, type } of this.app.topics) {
      if (!type || this.seen.has(name) || !this.isShown(name)) continue;
      this.seen.add(name);
      const suggestion = suggestionFor(name, type);
      if (!suggestion) continue;
      const isPicture = type.endsWith('/Image');
      const isEnabled = suggestion.isEnabled && (!isPicture || ++pictures <= 1);
      this.add(suggestion.class, suggestion.name, suggestion.values, isEnabled, true);
    }
    this.robotsChanged();
  }

  /** Adds the simulated world to the displays of a file that was opened before the world was known. */
  private addAwaitedWorld(): void {
    if (!this.awaitsWorld) return;
    for (const { name, type } of this.app.topics) {
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
    group?: DisplayGroup,
  ): Entry | undefined {
    const kind = kindOf(kindClass);
    if (!kind) {
      this.app.notice('warn', t().notices.unknownDisplay(kindClass));
      return undefined;
    }
    if (!isAutomatic) this.isAutomatic = false;
    const saved = isAutomatic ? this.awaitedFor(kind.class, values) : undefined;
    this.displays.push(
      saved
        ? new Entry(kind, saved.name, { ...values, ...saved.values }, saved.isEnabled)
        : new Entry(kind, name, values, isEnabled),
    );
    const entry = this.displays[this.displays.length - 1]!;
    entry.isAutomatic = isAutomatic;
    entry.group = group;
    if (this.stage) this.begin(entry);
    return entry;
  }

  private begin(entry: Entry): void {
    entry.start(this.context());
    if (entry.display instanceof WorldDisplay) {
      entry.display.onModels = (names) => (this.app.models = names);
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

  setGroupEnabled(group: DisplayGroup, isEnabled: boolean): void {
    group.isEnabled = isEnabled;
    for (const entry of this.displays) {
      if (!group.holds(entry.group)) continue;
      if (entry.isShown && this.stage) this.begin(entry);
      else if (!entry.isShown) entry.stop();
    }
  }

  /** Adds an empty group; `move` puts displays into it. */
  addGroup(name: string): DisplayGroup {
    this.isAutomatic = false;
    const group = new DisplayGroup(name, true);
    this.groups = [...this.groups, group];
    return group;
  }

  /** Removes a group; its displays and groups go to the group around it. */
  removeGroup(group: DisplayGroup): void {
    for (const entry of this.displays) if (entry.group === group) this.move(entry, group.parent);
    this.groups = this.groups.filter((one) => one !== group);
  }

  /** Puts a display into a group, after the others in it. */
  move(entry: Entry, group: DisplayGroup | undefined): void {
    const rest = this.displays.filter((one) => one !== entry);
    const last = rest.findLastIndex((one) => (group ? group.holds(one.group) : !one.group));
    entry.group = group;
    this.displays = rest.toSpliced(last + 1, 0, entry);
    if (entry.isShown && this.stage) this.begin(entry);
    else if (!entry.isShown) entry.stop();
  }

  // Saved views.

  saveView(name: string): void {
    const view = structuredClone(
      this.stage?.view.state ?? ($state.snapshot(this.view) as ViewState),
    );
    this.savedViews = [...this.savedViews.filter((one) => one.name !== name), { name, view }];
  }

  removeView(name: string): void {
    this.savedViews = this.savedViews.filter((one) => one.name !== name);
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
    this.groups = [];
    this.app.models = [];
  }

  /** Takes the saved options of an automatic display. */
  private awaitedFor(kindClass: string, values: Values): SavedDisplay | undefined {
    const at = this.awaited.findIndex(
      (one) => one.class === kindClass && (one.values.Topic ?? '') === (values.Topic ?? ''),
    );
    return at < 0 ? undefined : this.awaited.splice(at, 1)[0];
  }

  // Layouts.

  snapshot(): ViewportState {
    return {
      fixedFrame: this.fixedFrame,
      isFrameChosen: this.isFrameChosen,
      view: structuredClone(this.stage?.view.state ?? ($state.snapshot(this.view) as ViewState)),
      background: this.background,
      isAutomatic: this.isAutomatic,
      displays: [
        ...this.displays.map((entry) => savedDisplay(entry, this.groups)),
        ...this.awaited,
      ],
      groups: this.groups.map(savedGroup),
      savedViews: this.savedViews,
      fileName: this.fileName,
      launched: this.launched,
    };
  }

  /** Shows a saved 3D view. One that `isAskedFor` is not replaced by the file of a launch file. */
  restore(state: Partial<ViewportState>, isAskedFor = false): void {
    this.clear();
    this.seen.clear();
    this.awaited = [];
    this.isAutomatic = state.isAutomatic !== false;
    this.savedViews = state.savedViews ?? [];
    if (this.isAutomatic) this.awaited = [...(state.displays ?? [])];
    else {
      this.groups = groupsFrom(state.groups ?? []);
      for (const one of state.displays ?? []) {
        const group = this.groups[one.group ?? -1];
        this.add(one.class, one.name, { ...one.values }, one.isEnabled, false, group);
      }
    }
    this.background = state.background ?? '';
    this.fileName = state.fileName ?? '';
    this.launched = state.launched ?? 0;
    if (isAskedFor) this.hasOpenedLaunched = true;
    this.isFrameChosen = state.isFrameChosen === true;
    if (state.fixedFrame) this.setFixedFrame(state.fixedFrame, this.isFrameChosen);
    if (state.view) {
      this.view = { ...structuredClone(FIRST_VIEW), ...state.view };
      this.stage?.view.set($state.snapshot(this.view) as ViewState);
    }
    this.offersChanged();
  }

  // `.rviz` files.

  /** Opens the file that the launch file names, once: a reconnection leaves the displays as they are. */
  openLaunched(metadata: Record<string, string>): void {
    const { rviz: text, rviz_file: fileName, fixed_frame: frame } = metadata;
    if (this.hasOpenedLaunched || !(text || frame)) return;
    this.hasOpenedLaunched = true;
    // A reloaded page keeps what the user made of the file.
    const sum = checksum(text ?? '');
    if (text && sum === this.launched) return;
    this.launched = sum;
    try {
      if (text) this.openRviz(text, fileName);
    } catch (error) {
      this.app.notice('error', `${fileName}: ${(error as Error).message}`);
    }
    if (frame) this.setFixedFrame(frame);
  }

  /** Opens a file; returns what it contains about the window. */
  openRviz(text: string, fileName = ''): RvizWindow {
    const file = readRviz(text);
    // RViz has no display for a simulated world: the present one stays, unless the file has one.
    const isWorldKept = !file.displays.some(({ class: name }) => name === WORLD_CLASS);
    const worlds = this.displays.filter((entry) => isWorldKept && entry.kind.class === WORLD_CLASS);
    this.clear();
    this.isAutomatic = false;
    this.rvizOriginal = file.original;
    this.fileName = fileName;
    this.rvizTools = file.tools;
    const groups = new Map<RvizGroup, DisplayGroup>();
    for (const group of file.groups) {
      const parent = group.parent && groups.get(group.parent);
      groups.set(group, new DisplayGroup(group.name, group.isEnabled, parent, group.original));
    }
    this.groups = [...groups.values()];
    for (const display of file.displays) {
      const { class: name, values, isEnabled } = display;
      const group = display.group && groups.get(display.group);
      const entry = this.add(name, display.name, values, isEnabled, false, group);
      if (entry) entry.original = display.original;
    }
    this.savedViews = file.savedViews.map((saved) => ({
      name: saved.name,
      view: { ...structuredClone(FIRST_VIEW), ...viewFrom(saved) },
      original: saved,
    }));
    for (const { name, values, isEnabled } of worlds) {
      this.add(WORLD_CLASS, name, $state.snapshot(values) as Values, isEnabled);
    }
    this.awaitsWorld = isWorldKept && worlds.length === 0;
    this.addAwaitedWorld();
    this.setFixedFrame(file.fixedFrame);
    this.background = file.background;
    if (file.view) this.setView(viewFrom(file.view));
    return file.window;
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
        group: entry.group,
        original: entry.original,
      })),
      groups: this.groups,
      savedViews: this.savedViews.map(
        ({ name, view, original }) => original ?? { name, ...viewTo(view) },
      ),
      view: viewTo(this.stage?.view.state ?? FIRST_VIEW),
      original: this.rvizOriginal,
    });
  }

  /** Property of a tool in the opened file; otherwise RViz's default. */
  toolValue<T extends string | number>(tool: string, path: string, otherwise: T): T {
    const found = this.rvizTools.find((t) => t.class.endsWith(`/${tool}`))?.values[path];
    return (found as T | undefined) ?? otherwise;
  }
}
