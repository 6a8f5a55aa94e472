/**
 * Layout files of Foxglove and Lichtblick. Facts: `LayoutData` and the panels' settings in Lichtblick's source
 * (`configById`; `layout` is a panel id or two halves with a direction), and Foxglove's documentation of panels.
 */
import type { Values } from '../displays/options';
import { longName } from '../core/schema';
import { FIRST_VIEW, type ViewState } from '../scene/view';
import { t } from '../texts/language.svelte';
import { isSplit, panelsOf, tidy, type Layout, type Place, type SavedPanel } from './layout';
import type { JsonObject } from './panel.svelte';
import type { SavedDisplay } from './saved_display';

/** What the page knows and the file does not. */
export interface Knowledge {
  /** Type of the messages of a topic that exists. */
  typeOf(topic: string): string | undefined;
  /** Class of the display for a type of messages. */
  displayOf(type: string): string | undefined;
  /** `undefined` if this version has no such panel. */
  panel(kind: string): { isMany: boolean } | undefined;
}

export interface Imported {
  layout: Layout;
  /** What could not be shown, each with the reason. */
  leftOut: string[];
}

const MAX_DEPTH = 30;
/** Height for which the scale of a view from above is computed; a file names the visible metres [px]. */
const VIEW_HEIGHT_PX = 600;

const isTree = (value: unknown): value is JsonObject =>
  typeof value === 'object' && value !== null && !Array.isArray(value);
const textOf = (value: unknown): string => (typeof value === 'string' ? value : '');
const numberOf = (value: unknown, otherwise: number): number =>
  typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
const tree = (value: unknown): JsonObject => (isTree(value) ? value : {});
const listOf = (value: unknown): unknown[] => (Array.isArray(value) ? value : []);

/** True for a file of Foxglove or Lichtblick. */
export const isFoxglove = (json: unknown): boolean => isTree(json) && isTree(json.configById);

/** Message path `/odom.pose.pose.position.x`: the topic ends at the first dot. */
export function splitPath(text: string): { topic: string; path: string; isPlain: boolean } {
  const quoted = /^"([^"]*)"\.?(.*)$/.exec(text);
  const dot = text.search(/[.[{]/);
  const topic = quoted ? quoted[1]! : dot < 0 ? text : text.slice(0, dot);
  const path = quoted ? quoted[2]! : dot < 0 ? '' : text.slice(dot).replace(/^\./, '');
  // Filters, slices, variables and functions of Foxglove.
  const isPlain = !/[{}$@:]/.test(path);
  const plain = path.replace(/\{[^}]*\}/g, '').replace(/\.?@.*$/, '');
  return { topic, path: plain, isPlain };
}

/** Panel here for each kind of panel there. */
const PANELS: Record<string, string> = {
  '3D': '3d',
  '3D Panel': '3d',
  Image: 'image',
  ImageViewPanel: 'image',
  Plot: 'plot',
  RawMessages: 'messages',
  RawMessagesVirtual: 'messages',
  RosOut: 'log',
  Log: 'log',
  DiagnosticSummary: 'diagnostics',
  DiagnosticStatusPanel: 'diagnostics',
  Teleop: 'drive',
  Parameters: 'parameters',
  StateTransitions: 'states',
  Table: 'table',
  TopicGraph: 'graph',
  SourceInfo: 'topics',
  CallService: 'services',
  Publish: 'publish',
};

class Importer {
  readonly panels: Record<string, SavedPanel> = {};
  readonly leftOut: string[] = [];

  constructor(
    private configs: JsonObject,
    private know: Knowledge,
  ) {}

  place(node: unknown, depth = 0): Place | undefined {
    if (depth > MAX_DEPTH) throw new Error(t().foxglove.tooDeep);
    if (typeof node === 'string') return this.panel(node, depth);
    if (!isTree(node)) return undefined;
    const first = this.place(node.first, depth + 1);
    const second = this.place(node.second, depth + 1);
    if (!first || !second) return first ?? second;
    const part = Math.min(0.95, Math.max(0.05, numberOf(node.splitPercentage, 50) / 100));
    return {
      split: node.direction === 'column' ? 'column' : 'row',
      sizes: [part, 1 - part],
      children: [first, second],
    };
  }

  private panel(id: string, depth: number): Place | undefined {
    const type = id.split('!')[0]!;
    const config = tree(this.configs[id]);
    if (type === 'Tab') return this.tabs(config, depth);
    const kind = PANELS[type];
    const facts = kind ? this.know.panel(kind) : undefined;
    if (!kind || !facts) {
      this.leftOut.push(t().foxglove.noPanel(type));
      return undefined;
    }
    const old = Object.values(this.panels).filter((panel) => panel.kind === kind).length;
    if (old > 0 && !facts.isMany) {
      this.leftOut.push(t().foxglove.onlyOne(type));
      return undefined;
    }
    const own = old === 0 ? kind : `${kind}-${old + 1}`;
    this.panels[own] = {
      kind,
      title: textOf(config.foxglovePanelTitle),
      state: this.state(kind, config),
    };
    return { tabs: [own], active: own };
  }

  /** Tabs there hold splits, here panels. */
  private tabs(config: JsonObject, depth: number): Place | undefined {
    const all = listOf(config.tabs).filter(isTree);
    const places = all.map((tab) => this.place(tab.layout, depth + 1));
    places.forEach((place, i) => {
      if (place && isSplit(place))
        this.leftOut.push(t().foxglove.splitInTab(textOf(all[i]!.title)));
    });
    const tabs = places.flatMap((place) => (place ? panelsOf(place) : []));
    const active = places[numberOf(config.activeTabIdx, 0)];
    return tabs.length > 0 ? { tabs, active: active && panelsOf(active)[0] } : undefined;
  }

  private state(kind: string, config: JsonObject): JsonObject {
    switch (kind) {
      case '3d':
        return this.view(config);
      case 'image': {
        const mode = tree(config.imageMode);
        return { topic: textOf(mode.imageTopic) || textOf(config.cameraTopic) };
      }
      case 'plot':
      case 'states':
        return { series: this.series(listOf(config.paths)) };
      case 'publish':
        return { rows: [this.publication(config)] };
      case 'messages':
      case 'table': {
        const { topic, path } = this.path(textOf(config.topicPath));
        return { topic, path };
      }
      default:
        return {};
    }
  }

  private path(text: string): { topic: string; path: string } {
    const { topic, path, isPlain } = splitPath(text);
    if (!isPlain) this.leftOut.push(t().foxglove.filter(text));
    return { topic, path };
  }

  /** Row of the panel that publishes; the message there is JSON. */
  private publication(config: JsonObject): JsonObject {
    const [topic, text] = [textOf(config.topicName), textOf(config.value)];
    let value: unknown = {};
    try {
      value = text.trim() ? JSON.parse(text) : {};
    } catch (error) {
      this.leftOut.push(t().publish.notImported(topic, (error as Error).message));
    }
    return { topic, type: longName(textOf(config.datatype)), value: tree(value) };
  }

  private series(paths: unknown[]): { topic: string; path: string }[] {
    return paths
      .filter(isTree)
      .filter((one) => one.enabled !== false && textOf(one.value))
      .map((one) => this.path(textOf(one.value)));
  }

  private view(config: JsonObject): JsonObject {
    const frame = textOf(config.followTf);
    const displays: SavedDisplay[] = [];
    const add = (name: string, title: string, isEnabled: boolean, values: Values) =>
      displays.push({ class: name, name: title, isEnabled, values });
    for (const layer of Object.values(tree(config.layers)).filter(isTree)) {
      const isVisible = layer.visible !== false;
      const label = textOf(layer.label);
      if (layer.layerId === 'foxglove.Grid') {
        const count = Math.max(1, Math.round(numberOf(layer.divisions, 10)));
        add('rviz_default_plugins/Grid', label || 'Grid', isVisible, {
          'Plane Cell Count': count,
          'Cell Size': numberOf(layer.size, 10) / count,
        });
      } else if (layer.layerId === 'foxglove.Urdf' && textOf(layer.topic)) {
        add('rviz_default_plugins/RobotModel', label || 'Robot', isVisible, {
          'Description Topic': textOf(layer.topic),
        });
      } else this.leftOut.push(t().foxglove.noLayer(label || textOf(layer.layerId)));
    }
    const unknown: string[] = [];
    for (const [topic, settings] of Object.entries(tree(config.topics))) {
      const isVisible = tree(settings).visible === true;
      const type = this.know.typeOf(topic);
      const display = type && this.know.displayOf(type);
      if (display)
        add(display, topic.replace(/^\//, ''), isVisible, valuesOf(topic, tree(settings)));
      else if (isVisible && !type) unknown.push(topic);
      else if (isVisible) this.leftOut.push(t().foxglove.noDisplay(topic, type!));
    }
    if (unknown.length > 0) this.leftOut.push(t().foxglove.unknownTopics(unknown.join(', ')));
    const frames = Object.values(tree(config.transforms)).filter(isTree);
    const showsFrames = frames.some((one) => one.visible === true);
    add('rviz_default_plugins/TF', 'TF', showsFrames, {});
    return {
      fixedFrame: frame,
      isFrameChosen: frame !== '' && config.followMode === 'follow-none',
      isAutomatic: false,
      background: colorOf(textOf(tree(config.scene).backgroundColor)),
      displays,
      view: cameraOf(config, frame),
    };
  }
}

/** `#rrggbb` as RViz writes colors. */
function colorOf(hex: string): string {
  const found = /^#([0-9a-f]{2})([0-9a-f]{2})([0-9a-f]{2})/i.exec(hex);
  return found
    ? found
        .slice(1, 4)
        .map((part) => parseInt(part, 16))
        .join('; ')
    : '';
}

/** Appearance of a topic, as far as displays have the same. */
function valuesOf(topic: string, settings: JsonObject): Values {
  const values: Values = { Topic: topic };
  const set = (path: string, value: number | string | undefined) => {
    if (value !== undefined && value !== '') values[path] = value;
  };
  if (typeof settings.decayTime === 'number') set('Decay Time', settings.decayTime);
  if (typeof settings.pointSize === 'number') {
    set('Style', 'Points');
    set('Size (Pixels)', settings.pointSize);
  }
  if (settings.colorMode === 'flat') {
    set('Color Transformer', 'FlatColor');
    set('Color', colorOf(textOf(settings.flatColor)));
  }
  return values;
}

/**
 * `phi` is the angle from the vertical [deg]; `thetaOffset` turns the camera, which looks along +y at 0, to the
 * right [deg]; the target is relative to the frame that is followed.
 */
function cameraOf(config: JsonObject, frame: string): ViewState {
  const camera = tree(config.cameraState);
  const [x, y, z] = [0, 1, 2].map((i) => numberOf(listOf(camera.targetOffset)[i], 0)) as [
    number,
    number,
    number,
  ];
  const radians = Math.PI / 180;
  const distance = numberOf(camera.distance, FIRST_VIEW.distance);
  const turn = numberOf(camera.thetaOffset, 45) * radians;
  const isTop = camera.perspective === false;
  const isPose = config.followMode === 'follow-pose' || config.followMode === undefined;
  const follows = frame !== '' && config.followMode !== 'follow-none';
  return {
    ...structuredClone(FIRST_VIEW),
    kind: isTop ? 'TopDownOrtho' : isPose && follows ? 'ThirdPersonFollower' : 'Orbit',
    distance,
    focal: [x, y, z],
    pitch: (90 - numberOf(camera.phi, 60)) * radians,
    yaw: -turn - Math.PI / 2,
    scale: VIEW_HEIGHT_PX / Math.max(0.01, distance),
    angle: -turn,
    x,
    y,
    targetFrame: follows ? frame : '<Fixed Frame>',
  };
}

/** Reads a layout file. Throws an error with the reason if nothing of it can be shown. */
export function importFoxglove(json: unknown, know: Knowledge): Imported {
  const file = tree(json);
  const importer = new Importer(tree(file.configById), know);
  const place = importer.place(file.layout);
  const root = place && tidy(place, () => true);
  if (!root) throw new Error([t().foxglove.nothing, ...importer.leftOut].join(' '));
  if (Object.keys(tree(file.userNodes)).length > 0) importer.leftOut.push(t().foxglove.scripts);
  const variables = Object.keys(tree(file.globalVariables));
  if (variables.length > 0) importer.leftOut.push(t().foxglove.variables(variables.join(', ')));
  return {
    layout: { panels: importer.panels, root, floating: [] },
    leftOut: [...new Set(importer.leftOut)],
  };
}
