import { describe, expect, test } from 'vitest';
import { actionsOf, mergedGoals } from '../src/app/action_client.svelte';
import { withFrames } from '../src/app/goal_frames';
import { graphOf, isToolTopic } from '../src/app/node_graph';
import { template } from '../src/app/template';
import { acyclic, layersOf, layout } from '../src/core/graph_layout';
import { parseSchema } from '../src/core/schema';

const edges = (text: string) => text.split(' ').map((pair) => ({ from: pair[0]!, to: pair[1]! }));

describe('layers of a graph', () => {
  test('a chain', () =>
    expect([...layersOf(['a', 'b', 'c'], edges('ab bc ac')).values()]).toEqual([0, 1, 2]));
  test('a late source stands beside its successor', () =>
    expect(layersOf(['a', 'b', 'c', 'd'], edges('ab bc dc')).get('d')).toBe(1));
  test('a cycle is broken once', () =>
    expect(acyclic(['a', 'b', 'c'], edges('ab bc ca'))).toEqual(edges('ab bc ac')));
  test('an edge to itself', () => {
    const { at, lines } = layout([{ id: 'a', width: 10, height: 10 }], edges('aa'));
    expect([at.size, lines.length]).toEqual([1, 1]);
  });
  test('no vertices overlap, for 40 nodes', () => {
    const vertices = Array.from({ length: 40 }, (_, i) => ({ id: `n${i}`, width: 80, height: 20 }));
    const all = Array.from({ length: 90 }, (_, i) => ({
      from: `n${(i * 7) % 40}`,
      to: `n${(i * 13 + 5) % 40}`,
    }));
    const { at, lines } = layout(vertices, all);
    const places = [...at.values()];
    for (let i = 0; i < places.length; i++) {
      for (let j = 0; j < i; j++) {
        const [a, b] = [places[i]!, places[j]!];
        const isApart = Math.abs(a.x - b.x) >= 79 || Math.abs(a.y - b.y) >= 20;
        expect(isApart, `${i} ${j}`).toBe(true);
      }
    }
    lines.forEach((line, i) => {
      expect(line[0]).toEqual(at.get(all[i]!.from));
      expect(line[line.length - 1]).toEqual(at.get(all[i]!.to));
    });
  });
});

describe('the graph of nodes', () => {
  const topics = [
    { name: '/scan', publishers: ['lidar'], subscribers: ['slam'] },
    { name: '/map', publishers: ['slam'], subscribers: [] },
    { name: '/rosout', publishers: ['slam'], subscribers: ['log'] },
  ];
  const graph = (more: Partial<Parameters<typeof graphOf>[1]> = {}) =>
    graphOf(topics, {
      hasTopics: true,
      hasDeadEnds: false,
      isHidden: isToolTopic,
      search: '',
      ...more,
    });
  test('topics between nodes', () =>
    expect(graph().edges).toEqual([
      { from: 'node lidar', to: 'topic /scan' },
      { from: 'topic /scan', to: 'node slam' },
    ]));
  test('nodes only', () =>
    expect(graph({ hasTopics: false }).edges).toEqual([{ from: 'node lidar', to: 'node slam' }]));
  test('topics without subscribers', () =>
    expect(graph({ hasDeadEnds: true }).vertices.map((one) => one.name)).toContain('/map'));
  test('a search shows neighbours', () =>
    expect(graph({ search: 'lidar' }).vertices.map((one) => one.name)).toEqual(['lidar', '/scan']));
});

describe('actions', () => {
  test('names', () =>
    expect(actionsOf([{ name: '/spin/_action/send_goal' }, { name: '/spin' }])).toEqual(['/spin']));
  test('goals of others and own goals', () => {
    const uuid = new Uint8Array([1, 2]);
    const own = { id: '0102', uuid, state: 1, isOwn: true, acceptedS: 5 };
    const status = (byte: number, state: number, sec: number) => ({
      goal_info: { goal_id: { uuid: new Uint8Array([1, byte]) }, stamp: { sec, nanosec: 0 } },
      status: state,
    });
    const goals = mergedGoals([own], { status_list: [status(2, 4, 5), status(3, 2, 9)] });
    expect(goals.map(({ id, state, isOwn }) => [id, state, isOwn])).toEqual([
      ['0103', 2, false],
      ['0102', 4, true],
    ]);
  });
  test('the frame of a goal', () =>
    expect(withFrames({ pose: { header: { frame_id: '' } }, x: [1] }, 'map')).toEqual({
      pose: { header: { frame_id: 'map' } },
      x: [1],
    }));
  test('defaults of a definition', () =>
    expect(
      template(parseSchema('a/B', 'float32 speed 0.5\nbool on true\nstring name "x y"\nint8 n')),
    ).toEqual({ speed: 0.5, on: true, name: 'x y', n: 0 }));
});
