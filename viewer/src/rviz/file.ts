/** Reader and writer of `.rviz` files. Unknown content is kept. */
import { dump, load } from 'js-yaml';
import type { Option, Value, Values } from '../displays/options';
import { isGroup, nestDisplays, type RvizGroup } from './groups';
import { t } from '../texts/language.svelte';

export type Tree = { [key: string]: unknown };

export interface RvizDisplay {
  class: string;
  name: string;
  isEnabled: boolean;
  values: Values;
  group?: RvizGroup;
  /** Original entry of the file; its unknown parts are written back. */
  original: Tree;
}

export interface RvizView {
  class: string;
  values: Values;
}

/** View that the user saved by a name. */
export interface SavedRvizView extends RvizView {
  name: string;
  original?: Tree;
}

/** What a file contains about the window of RViz, as far as this page has the same. */
export interface RvizWindow {
  /** Classes of the panels. */
  panels: string[];
  hidesDisplays: boolean;
}

export interface RvizTool {
  class: string;
  values: Values;
}

export interface RvizFile {
  fixedFrame: string;
  background: string;
  frameRate: number;
  displays: RvizDisplay[];
  groups: RvizGroup[];
  view?: RvizView;
  savedViews: SavedRvizView[];
  tools: RvizTool[];
  window: RvizWindow;
  original: Tree;
}

const isTree = (value: unknown): value is Tree =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const treesOf = (list: unknown): Tree[] => (Array.isArray(list) ? list.filter(isTree) : []);

/** Options between the parts of a display, which are no parts themselves. */
const NO_PARTS =
  /^(All (Links )?Enabled|Expand .*|Link Tree Style)$|\/(Alpha|Show Axes|Show Trail)$/;

/** Part of a display that is enabled by the option at a path: `Links/base_link`. */
export function partOf(path: string): { group: string; name: string } | undefined {
  const [, group, name] = /^(Namespaces|Links|Frames|Joints)\/(.+)$/.exec(path) ?? [];
  if (!group || !name || (group !== 'Namespaces' && NO_PARTS.test(name))) return undefined;
  return { group, name };
}

/** Keys of a display that are not options. */
const FRAME_KEYS = ['Class', 'Name', 'Enabled', 'Value'];

/** Flattens nested maps into paths: `{Topic: {Value: /scan}}` becomes `Topic` with "/scan". */
export function flatten(tree: Tree, prefix = '', out: Values = {}): Values {
  for (const [key, value] of Object.entries(tree)) {
    const path = prefix ? `${prefix}/${key}` : key;
    if (key === 'Value' && prefix && !isTree(value)) out[prefix] = value as Value;
    else if (isTree(value)) flatten(value, path, out);
    else if (value !== null && !Array.isArray(value)) out[path] = value as Value;
  }
  return out;
}

function displayOf(tree: Tree): RvizDisplay {
  const rest = Object.fromEntries(
    Object.entries(tree).filter(([key]) => !FRAME_KEYS.includes(key)),
  );
  const values = flatten(rest);
  // Option names of RViz for ROS 1.
  if (values.Unreliable !== undefined && values['Topic/Reliability Policy'] === undefined) {
    values['Topic/Reliability Policy'] = values.Unreliable ? 'Best Effort' : 'Reliable';
  }
  for (const [old, now] of [
    ['Marker Topic', 'Topic'],
    ['Image Topic', 'Topic'],
    ['Robot Description', 'Description Topic'],
  ] as const) {
    const value = values[old];
    if (typeof value !== 'string' || values[now] !== undefined) continue;
    // RViz for ROS 1 has a parameter where RViz for ROS 2 has a topic.
    const isParameter = old === 'Robot Description' && !value.startsWith('/');
    values[now] = isParameter ? `/${value}` : value;
  }
  return {
    class: String(tree.Class ?? ''),
    name: String(tree.Name ?? ''),
    isEnabled: tree.Enabled !== false && tree.Value !== false,
    values,
    original: tree,
  };
}

/** Displays in order, each with its group; groups are collected, outer ones first. */
function displaysOf(list: unknown, groups: RvizGroup[], parent?: RvizGroup): RvizDisplay[] {
  return treesOf(list).flatMap((tree) => {
    if (!isGroup(tree)) return [{ ...displayOf(tree), group: parent }];
    const name = String(tree.Name ?? 'Group');
    const group: RvizGroup = { name, isEnabled: tree.Enabled !== false, parent, original: tree };
    groups.push(group);
    return displaysOf(tree.Displays, groups, group);
  });
}

function windowOf(tree: Tree): RvizWindow {
  const geometry = isTree(tree['Window Geometry']) ? tree['Window Geometry'] : {};
  const displays = isTree(geometry.Displays) ? geometry.Displays : {};
  return {
    panels: treesOf(tree.Panels).map((panel) => String(panel.Class ?? '')),
    hidesDisplays: geometry['Hide Left Dock'] === true || displays.collapsed === true,
  };
}

export function readRviz(text: string): RvizFile {
  let tree: unknown;
  try {
    tree = load(text);
  } catch (error) {
    throw new Error(t().notices.notYaml((error as Error).message.split('\n')[0] ?? ''));
  }
  const manager = isTree(tree) ? tree['Visualization Manager'] : undefined;
  if (!isTree(manager)) throw new Error(t().notices.notRviz);
  const global = isTree(manager['Global Options']) ? manager['Global Options'] : {};
  const views = isTree(manager.Views) ? manager.Views : {};
  const current = isTree(views.Current) ? views.Current : undefined;
  const tools = treesOf(manager.Tools);
  const groups: RvizGroup[] = [];
  return {
    fixedFrame: String(global['Fixed Frame'] ?? 'map'),
    background: String(global['Background Color'] ?? '48; 48; 48'),
    frameRate: Number(global['Frame Rate'] ?? 30),
    displays: displaysOf(manager.Displays, groups),
    groups,
    savedViews: treesOf(views.Saved).map((view) => ({
      name: String(view.Name ?? ''),
      class: String(view.Class ?? ''),
      values: flatten(view),
      original: view,
    })),
    window: windowOf(tree as Tree),
    view: current && { class: String(current.Class ?? ''), values: flatten(current) },
    tools: tools.map((tool) => ({ class: String(tool.Class ?? ''), values: flatten(tool) })),
    original: tree as Tree,
  };
}

/** Nested maps of paths. A path that has parts below it gets its own value as `Value`. */
export function nest(values: Values): Tree {
  const out: Tree = {};
  const paths = Object.keys(values);
  for (const path of paths) {
    const parts = path.split('/');
    let at = out;
    for (const part of parts.slice(0, -1)) {
      const next = at[part];
      if (isTree(next)) at = next;
      else {
        const made: Tree = {};
        if (next !== undefined) made.Value = next;
        at[part] = made;
        at = made;
      }
    }
    const last = parts[parts.length - 1]!;
    if (isTree(at[last])) (at[last] as Tree).Value = values[path];
    else at[last] = values[path];
  }
  return out;
}

function merge(base: Tree, over: Tree): Tree {
  const out = { ...base };
  for (const [key, value] of Object.entries(over)) {
    const old = out[key];
    out[key] = isTree(old) && isTree(value) ? merge(old, value) : value;
  }
  return out;
}

export interface Saved {
  fixedFrame: string;
  background: string;
  displays: {
    class: string;
    name: string;
    isEnabled: boolean;
    values: Values;
    options: readonly Option[];
    group?: RvizGroup;
    original?: Tree;
  }[];
  groups?: readonly RvizGroup[];
  view: RvizView;
  savedViews?: readonly SavedRvizView[];
  original?: Tree;
}

const DEFAULT_TOOLS = [
  { Class: 'rviz_default_plugins/Interact', 'Hide Inactive Objects': true },
  { Class: 'rviz_default_plugins/MoveCamera' },
  { Class: 'rviz_default_plugins/Select' },
  { Class: 'rviz_default_plugins/FocusCamera' },
  { Class: 'rviz_default_plugins/Measure', 'Line color': '128; 128; 0' },
  {
    Class: 'rviz_default_plugins/SetInitialPose',
    'Covariance x': 0.25,
    'Covariance y': 0.25,
    'Covariance yaw': 0.06853891909122467,
    Topic: topicTree('initialpose'),
  },
  { Class: 'rviz_default_plugins/SetGoal', Topic: topicTree('goal_pose') },
  {
    Class: 'rviz_default_plugins/PublishPoint',
    'Single click': true,
    Topic: topicTree('clicked_point'),
  },
];

function topicTree(topic: string): Tree {
  return {
    Depth: 5,
    'Durability Policy': 'Volatile',
    'History Policy': 'Keep Last',
    'Reliability Policy': 'Reliable',
    Value: topic,
  };
}

/** Options added at runtime, with arbitrary names: namespaces, links, frames. */
function partsOf(values: Values): Tree {
  const out: Tree = {};
  for (const [path, value] of Object.entries(values)) {
    const { group, name } = partOf(path) ?? {};
    if (!group || !name || typeof value !== 'boolean') continue;
    const tree = (out[group] ??= {}) as Tree;
    tree[name] = group === 'Namespaces' ? value : { Value: value };
  }
  return out;
}

export function writeRviz(saved: Saved): string {
  const displays = saved.displays.map((display) => {
    const paths = new Set(display.options.filter((o) => o.kind !== 'note').map((o) => o.path));
    const values = Object.fromEntries(
      Object.entries(display.values).filter(([path]) => paths.has(path)),
    );
    const tree = merge(display.original ?? {}, {
      ...merge(nest(values), partsOf(display.values)),
      Class: display.class,
      Name: display.name,
      Enabled: display.isEnabled,
      Value: display.isEnabled,
    });
    return { tree, group: display.group };
  });
  const views = (saved.savedViews ?? []).map(({ class: name, values, original, name: title }) =>
    merge(original ?? {}, { Class: name, ...nest(values), Name: title }),
  );
  const base: Tree = saved.original ?? {
    Panels: [
      { Class: 'rviz_common/Displays', Name: 'Displays' },
      { Class: 'rviz_common/Tool Properties', Name: 'Tool Properties' },
      { Class: 'rviz_common/Views', Name: 'Views' },
    ],
    'Visualization Manager': {
      Class: '',
      Enabled: true,
      Name: 'root',
      Tools: DEFAULT_TOOLS,
      Transformation: { Current: { Class: 'rviz_default_plugins/TF' } },
      Value: true,
    },
  };
  const manager = merge((base['Visualization Manager'] ?? {}) as Tree, {
    'Global Options': {
      'Background Color': saved.background,
      'Fixed Frame': saved.fixedFrame,
      'Frame Rate': 30,
    },
    Views: {
      Current: { Class: saved.view.class, ...nest(saved.view.values) },
      Saved: views.length > 0 ? views : null,
    },
  });
  manager.Displays = nestDisplays(displays, saved.groups ?? []);
  return dump({ ...base, 'Visualization Manager': manager }, { sortKeys: false, lineWidth: 200 });
}
