/**
 * Layered drawing of a directed graph, after Sugiyama, Tagawa and Toda (1981): cycles are broken, vertices get layers,
 * long edges get intermediate points, the order in the layers is improved by barycentres.
 */

export interface Vertex {
  id: string;
  width: number;
  height: number;
}

export interface Edge {
  from: string;
  to: string;
}

export interface Point {
  x: number;
  y: number;
}

export interface Layout {
  /** Middle of each vertex. */
  at: Map<string, Point>;
  /** Points of each edge, in the order of the edges: its ends and its intermediate points. */
  lines: Point[][];
  width: number;
  height: number;
}

const GAP_X = 56;
const GAP_Y = 14;
const SWEEPS = 12;

interface Cell {
  id: string;
  width: number;
  height: number;
  y: number;
  before: Cell[];
  after: Cell[];
}

/** Edges without those that close a cycle turned around, so that all lead forward. */
export function acyclic(ids: readonly string[], edges: readonly Edge[]): Edge[] {
  const out = new Map<string, string[]>();
  for (const { from, to } of edges) out.set(from, [...(out.get(from) ?? []), to]);
  const state = new Map<string, 'open' | 'done'>();
  const back = new Set<string>();
  for (const start of ids) {
    if (state.has(start)) continue;
    // Depth first without recursion: a graph may be deep.
    const stack: { id: string; next: number }[] = [{ id: start, next: 0 }];
    state.set(start, 'open');
    while (stack.length > 0) {
      const top = stack[stack.length - 1]!;
      const to = out.get(top.id)?.[top.next++];
      if (to === undefined) {
        state.set(top.id, 'done');
        stack.pop();
      } else if (state.get(to) === 'open') back.add(`${top.id}\n${to}`);
      else if (!state.has(to)) {
        state.set(to, 'open');
        stack.push({ id: to, next: 0 });
      }
    }
  }
  return edges.map(({ from, to }) =>
    back.has(`${from}\n${to}`) ? { from: to, to: from } : { from, to },
  );
}

/** Layer of each vertex: the longest path from a vertex without predecessors. */
export function layersOf(ids: readonly string[], edges: readonly Edge[]): Map<string, number> {
  const layer = new Map(ids.map((id) => [id, 0]));
  const missing = new Map(ids.map((id) => [id, 0]));
  const after = new Map<string, string[]>();
  for (const { from, to } of edges) {
    if (from === to) continue;
    missing.set(to, missing.get(to)! + 1);
    after.set(from, [...(after.get(from) ?? []), to]);
  }
  const ready = ids.filter((id) => missing.get(id) === 0);
  for (let id = ready.shift(); id !== undefined; id = ready.shift()) {
    for (const to of after.get(id) ?? []) {
      layer.set(to, Math.max(layer.get(to)!, layer.get(id)! + 1));
      missing.set(to, missing.get(to)! - 1);
      if (missing.get(to) === 0) ready.push(to);
    }
  }
  // Sources move next to their first successor: short edges.
  for (const id of ids) {
    const next = (after.get(id) ?? []).map((to) => layer.get(to)!);
    const hasBefore = edges.some((edge) => edge.to === id && edge.from !== id);
    if (next.length > 0 && !hasBefore) layer.set(id, Math.min(...next) - 1);
  }
  return layer;
}

export function layout(vertices: readonly Vertex[], given: readonly Edge[]): Layout {
  const ids = vertices.map((vertex) => vertex.id);
  const known = new Set(ids);
  const edges = given.filter(({ from, to }) => known.has(from) && known.has(to));
  const forward = acyclic(ids, edges);
  const layer = layersOf(ids, forward);
  const cells = new Map<string, Cell>();
  const layers: Cell[][] = [];
  const put = (cell: Cell, index: number) => {
    (layers[index] ??= []).push(cell);
    return cell;
  };
  for (const { id, width, height } of vertices) {
    const cell = { id, width, height, y: 0, before: [], after: [] };
    cells.set(id, put(cell, layer.get(id)!));
  }
  for (let i = 0; i < layers.length; i++) layers[i] ??= [];
  const chains = forward.map(({ from, to }) => {
    const chain = [cells.get(from)!];
    for (let i = layer.get(from)! + 1; i < layer.get(to)!; i++) {
      chain.push(put({ id: '', width: 0, height: 4, y: 0, before: [], after: [] }, i));
    }
    if (from !== to) chain.push(cells.get(to)!);
    for (let i = 1; i < chain.length; i++) {
      chain[i - 1]!.after.push(chain[i]!);
      chain[i]!.before.push(chain[i - 1]!);
    }
    return chain;
  });
  order(layers);
  return place(layers, chains, edges, forward, cells);
}

/** Sorts each layer by the mean position of the neighbours, to and fro. */
function order(layers: Cell[][]): void {
  for (const cells of layers) cells.forEach((cell, i) => (cell.y = i));
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    const isForward = sweep % 2 === 0;
    for (const cells of isForward ? layers : [...layers].reverse()) {
      const key = new Map(
        cells.map((cell) => {
          const near = isForward ? cell.before : cell.after;
          const sum = near.reduce((total, one) => total + one.y, 0);
          return [cell, near.length > 0 ? sum / near.length : cell.y];
        }),
      );
      cells.sort((a, b) => key.get(a)! - key.get(b)!);
      cells.forEach((cell, i) => (cell.y = i));
    }
  }
}

function place(
  layers: Cell[][],
  chains: Cell[][],
  edges: readonly Edge[],
  forward: readonly Edge[],
  cells: Map<string, Cell>,
): Layout {
  for (const layer of layers) stack(layer, (_cell, y) => y);
  // Cells move towards their neighbours, as far as the order allows.
  for (let sweep = 0; sweep < SWEEPS; sweep++) {
    for (const layer of sweep % 2 === 0 ? layers : [...layers].reverse()) {
      stack(layer, (cell) => {
        const near = [...cell.before, ...cell.after];
        return near.length > 0 ? near.reduce((sum, one) => sum + one.y, 0) / near.length : cell.y;
      });
    }
  }
  const top = Math.min(0, ...layers.flat().map((cell) => cell.y - cell.height / 2));
  const at = new Map<string, Point>();
  const x = new Map<Cell, number>();
  let left = 0;
  for (const layer of layers) {
    const width = Math.max(0, ...layer.map((cell) => cell.width));
    for (const cell of layer) {
      cell.y -= top;
      x.set(cell, left + width / 2);
    }
    left += width + GAP_X;
  }
  for (const [id, cell] of cells) at.set(id, { x: x.get(cell)!, y: cell.y });
  const lines = chains.map((chain, i) => {
    const points = chain.map((cell) => ({ x: x.get(cell)!, y: cell.y }));
    const isTurned = forward[i]!.from !== edges[i]!.from;
    return isTurned ? points.reverse() : points;
  });
  const bottom = Math.max(0, ...layers.flat().map((cell) => cell.y + cell.height / 2));
  return { at, lines, width: Math.max(0, left - GAP_X), height: bottom };
}

/** Positions near the wished ones, in the order of the layer and without overlaps. */
function stack(layer: Cell[], wish: (cell: Cell, y: number) => number): void {
  const gap = (a: Cell, b: Cell) => (a.height + b.height) / 2 + GAP_Y;
  const wished = layer.map((cell, i) => wish(cell, i));
  // From above: nothing overlaps. From below: what was pushed too far comes back.
  const down: number[] = [];
  layer.forEach((cell, i) => {
    const least = i > 0 ? down[i - 1]! + gap(layer[i - 1]!, cell) : -Infinity;
    down.push(Math.max(wished[i]!, least));
  });
  const up: number[] = [];
  for (let i = layer.length - 1; i >= 0; i--) {
    const most = i < layer.length - 1 ? up[i + 1]! - gap(layer[i]!, layer[i + 1]!) : Infinity;
    up[i] = Math.min(wished[i]!, most);
  }
  // The mean of two arrangements without overlaps has none.
  layer.forEach((cell, i) => (cell.y = (down[i]! + up[i]!) / 2));
}
