/** Layout of the page as plain data: panels with their state, in tabs and splits. No DOM. */
import type { JsonObject } from './panel.svelte';

/** Tabs of one group; ids of panels. */
export interface Tabs {
  tabs: string[];
  active?: string;
}

/** Children side by side (`row`) or one below the other (`column`); sizes are fractions of their sum. */
export interface Split {
  split: 'row' | 'column';
  sizes: number[];
  children: Place[];
}

export type Place = Tabs | Split;

/** A window above the others; in fractions of the page. */
export interface Floating {
  root: Place;
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface SavedPanel {
  kind: string;
  title?: string;
  state: JsonObject;
}

export interface Arrangement {
  root: Place;
  floating: Floating[];
  /** Panel that has the focus. */
  active?: string;
}

export interface Layout extends Arrangement {
  panels: Record<string, SavedPanel>;
  /** Kinds that appeared by themselves; those that the user closed stay closed. */
  offered?: string[];
  /** Namespace of the robot that was chosen where there are several. */
  robot?: string;
}

/** Version of layout files. A reader refuses newer ones. */
export const LAYOUT_VERSION = 1;
const FORMAT = 'periplus-layout';
/** Limits of a layout that is read, against hostile files. */
const MAX_PANELS = 100;
const MAX_DEPTH = 20;

export const isSplit = (place: Place): place is Split => 'split' in place;

/** All panels of a part of the layout, in order. */
export function panelsOf(place: Place): string[] {
  return isSplit(place) ? place.children.flatMap(panelsOf) : place.tabs;
}

/** Groups of tabs of a part of the layout, from left to right and top to bottom. */
export function tabsOf(place: Place): Tabs[] {
  return isSplit(place) ? place.children.flatMap(tabsOf) : [place];
}

/** Removes panels that `isKept` rejects, empty tabs and splits with one child, and joins splits of one direction. */
export function tidy(place: Place, isKept: (id: string) => boolean): Place | undefined {
  if (!isSplit(place)) {
    const tabs = place.tabs.filter(isKept);
    if (tabs.length === 0) return undefined;
    return { tabs, active: tabs.includes(place.active ?? '') ? place.active : tabs[0] };
  }
  const sum = place.sizes.reduce((a, b) => a + b, 0) || 1;
  const parts = place.children.flatMap((child, i): { place: Place; size: number }[] => {
    const kept = tidy(child, isKept);
    const size = (place.sizes[i] ?? 0) / sum;
    if (!kept) return [];
    if (!isSplit(kept) || kept.split !== place.split) return [{ place: kept, size }];
    const inner = kept.sizes.reduce((a, b) => a + b, 0) || 1;
    return kept.children.map((one, k) => ({ place: one, size: (size * kept.sizes[k]!) / inner }));
  });
  if (parts.length <= 1) return parts[0]?.place;
  const all = parts.reduce((a, b) => a + b.size, 0) || 1;
  const sizes = parts.map(({ size }) => size / all);
  return { split: place.split, sizes, children: parts.map((part) => part.place) };
}

const isTree = (value: unknown): value is JsonObject =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

const isFraction = (value: unknown): value is number =>
  typeof value === 'number' && Number.isFinite(value) && value >= 0;

function readPlace(value: unknown, depth = 0): Place {
  if (depth > MAX_DEPTH) throw new Error(`The layout is nested more than ${MAX_DEPTH} deep`);
  if (!isTree(value)) throw new Error('A part of the layout is not an object');
  if (Array.isArray(value.tabs)) {
    const tabs = value.tabs.filter((id) => typeof id === 'string');
    return { tabs, active: typeof value.active === 'string' ? value.active : tabs[0] };
  }
  const { split, children } = value;
  if ((split !== 'row' && split !== 'column') || !Array.isArray(children)) {
    throw new Error('A part of the layout has neither "tabs" nor "split" with "children"');
  }
  const sizes = Array.isArray(value.sizes) ? value.sizes : [];
  return {
    split,
    children: children.map((child) => readPlace(child, depth + 1)),
    sizes: children.map((_, i) => (isFraction(sizes[i]) ? sizes[i] : 1 / children.length)),
  };
}

function readFloating(value: unknown): Floating | undefined {
  if (!isTree(value)) return undefined;
  const number = (key: string, otherwise: number) =>
    isFraction(value[key]) ? Math.min(1, value[key]) : otherwise;
  return {
    root: readPlace(value.root),
    x: number('x', 0.2),
    y: number('y', 0.2),
    width: Math.max(0.1, number('width', 0.4)),
    height: Math.max(0.1, number('height', 0.4)),
  };
}

/** Reads a layout from JSON. Throws an error with the reason if it is none. */
export function readLayout(value: unknown): Layout {
  if (!isTree(value) || value.format !== FORMAT) {
    throw new Error(`This is no layout: it has no "format": "${FORMAT}"`);
  }
  if (typeof value.version !== 'number' || value.version > LAYOUT_VERSION) {
    throw new Error(
      `The layout has version ${String(value.version)}; this page reads up to ${LAYOUT_VERSION}. Update Periplus.`,
    );
  }
  if (!isTree(value.panels)) throw new Error('The layout has no "panels"');
  const entries = Object.entries(value.panels);
  if (entries.length > MAX_PANELS) throw new Error(`The layout has more than ${MAX_PANELS} panels`);
  const panels: Record<string, SavedPanel> = {};
  for (const [id, panel] of entries) {
    if (!isTree(panel) || typeof panel.kind !== 'string') {
      throw new Error(`The panel "${id}" of the layout has no "kind"`);
    }
    panels[id] = {
      kind: panel.kind,
      title: typeof panel.title === 'string' ? panel.title : '',
      state: isTree(panel.state) ? panel.state : {},
    };
  }
  // Each panel is in one group; panels without a group are put beside the first tabs.
  const left = new Set(Object.keys(panels));
  const take = (id: string) => left.delete(id);
  const root = tidy(readPlace(value.root), take);
  const floating = (Array.isArray(value.floating) ? value.floating : [])
    .map(readFloating)
    .flatMap((one) => {
      const kept = one && tidy(one.root, take);
      return one && kept ? [{ ...one, root: kept }] : [];
    });
  const first = root && tabsOf(root)[0];
  if (first) first.tabs.push(...left);
  const whole = root ?? { tabs: [...left] };
  if (panelsOf(whole).length === 0) throw new Error('The layout has no panels');
  const active = typeof value.active === 'string' ? value.active : undefined;
  const offered = (Array.isArray(value.offered) ? value.offered : []).filter(
    (kind) => typeof kind === 'string',
  );
  const robot = typeof value.robot === 'string' ? value.robot : undefined;
  return { panels, root: whole, floating, active, offered, robot };
}

export function writeLayout(layout: Layout): JsonObject {
  return { format: FORMAT, version: LAYOUT_VERSION, ...layout };
}

/** Places a panel beside another one: in its tabs, or in its own split. */
export function insert(
  root: Place,
  id: string,
  beside: string,
  side: 'center' | 'left' | 'right' | 'top' | 'bottom',
): Place {
  if (!isSplit(root)) {
    if (!root.tabs.includes(beside)) return root;
    if (side === 'center') return { tabs: [...root.tabs, id], active: id };
    const own: Tabs = { tabs: [id], active: id };
    const isBefore = side === 'left' || side === 'top';
    return {
      split: side === 'left' || side === 'right' ? 'row' : 'column',
      sizes: [0.5, 0.5],
      children: isBefore ? [own, root] : [root, own],
    };
  }
  const children = root.children.map((child) => insert(child, id, beside, side));
  return tidy({ ...root, children }, () => true)!;
}
