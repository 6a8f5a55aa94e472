/** Conversion between the page's arrangement of panels and the one of dockview. No DOM. */
import type { SerializedDockview } from 'dockview';
import { isSplit, type Arrangement, type Floating, type Place, type Tabs } from './layout';

type Node = SerializedDockview['grid']['root'];

let lastGroup = 0;

function groupOf(tabs: Tabs) {
  return { id: `group-${++lastGroup}`, views: tabs.tabs, activeView: tabs.active ?? tabs.tabs[0] };
}

/** `size` is the extent along the direction of the parent [px]; `cross` the extent across it [px]. */
function nodeOf(place: Place, size: number, cross: number): Node {
  if (!isSplit(place)) return { type: 'leaf', size, data: groupOf(place) as never };
  // Directions alternate from level to level.
  const data = place.children.map((child, i) => nodeOf(child, cross * place.sizes[i]!, size));
  return { type: 'branch', size, data };
}

/** A grid of this size [px]; its root is always a branch. */
function gridOf(root: Place, width: number, height: number): SerializedDockview['grid'] {
  const split = isSplit(root) ? root : { split: 'row' as const, sizes: [1], children: [root] };
  const isRow = split.split === 'row';
  return {
    root: nodeOf(split, isRow ? height : width, isRow ? width : height),
    width,
    height,
    orientation: (isRow ? 'HORIZONTAL' : 'VERTICAL') as never,
  };
}

/** Arrangement in the form of dockview, for a page of this size [px]. */
export function toDock(
  arrangement: Arrangement,
  titles: Record<string, string>,
  width: number,
  height: number,
): SerializedDockview {
  const { root, floating } = arrangement;
  const panel = (id: string) => ({ id, contentComponent: 'panel', title: titles[id] ?? id });
  return {
    grid: gridOf(root, width, height),
    panels: Object.fromEntries(Object.keys(titles).map((id) => [id, panel(id)])),
    floatingGroups: floating.map((one) => {
      const [w, h] = [one.width * width, one.height * height];
      const position = { left: one.x * width, top: one.y * height, width: w, height: h };
      return isSplit(one.root)
        ? { grid: gridOf(one.root, w, h) as never, position }
        : { data: groupOf(one.root) as never, position };
    }),
  };
}

function placeOf(node: Node, isRow: boolean): Place {
  if (node.type === 'leaf') {
    const { views, activeView } = node.data as unknown as { views: string[]; activeView?: string };
    return { tabs: views, active: activeView };
  }
  const children = node.data as Node[];
  const sum = children.reduce((total, { size }) => total + (size ?? 0), 0) || 1;
  return {
    split: isRow ? 'row' : 'column',
    sizes: children.map(({ size }) => (size ?? 0) / sum),
    children: children.map((child) => placeOf(child, !isRow)),
  };
}

/** Arrangement that dockview shows on a page of this size [px]. */
export function fromDock(dock: SerializedDockview, active?: string): Arrangement {
  const { grid } = dock;
  const rootOf = (one: SerializedDockview['grid']) =>
    placeOf(one.root, (one.orientation as string) === 'HORIZONTAL');
  const floating = (dock.floatingGroups ?? []).map(({ data, grid: own, position }): Floating => {
    const box = position as { left?: number; top?: number; right?: number; bottom?: number } & {
      width: number;
      height: number;
    };
    const left = box.left ?? grid.width - (box.right ?? 0) - box.width;
    const top = box.top ?? grid.height - (box.bottom ?? 0) - box.height;
    const [width, height] = [grid.width || 1, grid.height || 1];
    return {
      root: own
        ? rootOf(own as never)
        : { tabs: data?.views ?? [], active: data?.activeView ?? data?.views[0] },
      x: left / width,
      y: top / height,
      width: box.width / width,
      height: box.height / height,
    };
  });
  return { root: rootOf(grid), floating, active };
}
