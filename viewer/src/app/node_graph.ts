/** Nodes and topics as a directed graph: publishers, their topics, and subscribers. */
import type { TopicRow } from './app.svelte';

export interface GraphVertex {
  id: string;
  kind: 'node' | 'topic';
  name: string;
}

export interface NodeGraph {
  vertices: GraphVertex[];
  edges: { from: string; to: string }[];
}

export interface GraphChoice {
  /** False: nodes are connected directly. */
  hasTopics: boolean;
  /** True: also topics without publishers or without subscribers. */
  hasDeadEnds: boolean;
  isHidden: (topic: string) => boolean;
  /** Part of a name: what matches is shown, with its neighbours. */
  search: string;
}

const TOOLS =
  /^\/(rosout|parameter_events|clock|bond|diagnostics)$|\/(bond|transition_event)$|^\/world\/|_updates$/;

/** Topics that connect every node with a tool and hide the others in a drawing. */
export const isToolTopic = (name: string): boolean => TOOLS.test(name);

export function graphOf(
  topics: readonly Pick<TopicRow, 'name' | 'publishers' | 'subscribers'>[],
  choice: GraphChoice,
): NodeGraph {
  const edges = new Map<string, { from: string; to: string }>();
  const names = new Map<string, GraphVertex>();
  const vertex = (kind: 'node' | 'topic', name: string): string => {
    const id = `${kind} ${name}`;
    names.set(id, { id, kind, name });
    return id;
  };
  const connect = (from: string, to: string) => edges.set(`${from}\n${to}`, { from, to });
  for (const { name, publishers, subscribers } of topics) {
    if (choice.isHidden(name)) continue;
    const isDeadEnd = publishers.length === 0 || subscribers.length === 0;
    if (isDeadEnd && !(choice.hasDeadEnds && choice.hasTopics)) continue;
    if (choice.hasTopics) {
      const topic = vertex('topic', name);
      for (const one of publishers) connect(vertex('node', one), topic);
      for (const one of subscribers) connect(topic, vertex('node', one));
    } else {
      for (const from of publishers) {
        for (const to of subscribers) {
          if (from !== to) connect(vertex('node', from), vertex('node', to));
        }
      }
    }
  }
  const search = choice.search.trim().toLowerCase();
  const isFound = (id: string) => names.get(id)!.name.toLowerCase().includes(search);
  const shownEdges = [...edges.values()].filter(({ from, to }) => isFound(from) || isFound(to));
  const shown = new Set([
    ...[...names.keys()].filter(isFound),
    ...shownEdges.flatMap(({ from, to }) => [from, to]),
  ]);
  const vertices = [...names.values()]
    .filter(({ id }) => shown.has(id))
    .sort((a, b) => (a.id < b.id ? -1 : 1));
  return { vertices, edges: shownEdges };
}
