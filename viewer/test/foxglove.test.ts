import { expect, test } from 'vitest';
import { importFoxglove, isFoxglove, splitPath, type Knowledge } from '../src/app/layout_foxglove';

const KNOW: Knowledge = {
  typeOf: (topic) => ({ '/scan': 'sensor_msgs/msg/LaserScan', '/odd': 'a/msg/B' })[topic],
  displayOf: (type) =>
    type === 'sensor_msgs/msg/LaserScan' ? 'rviz_default_plugins/LaserScan' : undefined,
  panel: (kind) =>
    ['3d', 'plot', 'log', 'image'].includes(kind) ? { isMany: kind !== 'log' } : undefined,
};

const FILE = {
  configById: {
    '3D!a': {
      followTf: 'base_link',
      followMode: 'follow-position',
      cameraState: {
        distance: 8,
        perspective: true,
        phi: 30,
        thetaOffset: 90,
        targetOffset: [1, 2, 0],
      },
      layers: {
        g: { layerId: 'foxglove.Grid', size: 10, divisions: 5 },
        t: { layerId: 'foxglove.TiledMap', label: 'Street' },
      },
      topics: {
        '/scan': { visible: true, pointSize: 5, colorMode: 'flat', flatColor: '#ff8000ff' },
        '/odd': { visible: true },
        '/gone': { visible: true },
        '/hidden': { visible: false },
      },
    },
    'Plot!b': {
      paths: [
        { value: '/odom.twist.twist.linear.x', enabled: true },
        { value: '/a.b{c==1}.d.@abs' },
      ],
    },
    'Tab!t': {
      activeTabIdx: 1,
      tabs: [
        { title: 'One', layout: 'RosOut!c' },
        {
          title: 'Two',
          layout: {
            first: 'Image!d',
            second: { first: 'RosOut!e', second: 'Image!g', direction: 'row' },
            direction: 'row',
          },
        },
      ],
    },
    'Image!d': { imageMode: { imageTopic: '/camera' } },
  },
  globalVariables: { robot: 1 },
  layout: {
    direction: 'row',
    splitPercentage: 75,
    first: '3D!a',
    second: {
      direction: 'column',
      first: 'Plot!b',
      second: { direction: 'column', first: 'Tab!t', second: 'Gauge!f' },
    },
  },
};

test('a layout of Foxglove: panels, splits, tabs, camera and displays', () => {
  expect(isFoxglove(FILE)).toBe(true);
  const { layout, leftOut } = importFoxglove(FILE, KNOW);
  expect(layout.root).toEqual({
    split: 'row',
    sizes: [0.75, 0.25],
    children: [
      { tabs: ['3d'], active: '3d' },
      {
        split: 'column',
        sizes: [0.5, 0.5],
        children: [
          { tabs: ['plot'], active: 'plot' },
          { tabs: ['log', 'image', 'image-2'], active: 'image' },
        ],
      },
    ],
  });
  expect(layout.panels.image!.state).toEqual({ topic: '/camera' });
  expect(layout.panels.plot!.state.series).toEqual([
    { topic: '/odom', path: 'twist.twist.linear.x' },
    { topic: '/a', path: 'b.d' },
  ]);
  const state = layout.panels['3d']!.state as never as {
    displays: { class: string; values: unknown }[];
    view: Record<string, unknown>;
  };
  expect(state.displays.map((one) => [one.class.split('/')[1], one.values])).toEqual([
    ['Grid', { 'Plane Cell Count': 5, 'Cell Size': 2 }],
    [
      'LaserScan',
      {
        Topic: '/scan',
        Style: 'Points',
        'Size (Pixels)': 5,
        'Color Transformer': 'FlatColor',
        Color: '255; 128; 0',
      },
    ],
    ['TF', {}],
  ]);
  // 30 degrees from the vertical are a pitch of 60; a turn of 90 to the right puts the camera at -180.
  expect(state.view).toMatchObject({
    kind: 'Orbit',
    distance: 8,
    focal: [1, 2, 0],
    targetFrame: 'base_link',
  });
  expect(state.view.pitch).toBeCloseTo(Math.PI / 3);
  expect(state.view.yaw).toBeCloseTo(-Math.PI);
  for (const part of [
    'Street',
    '/odd',
    '/gone',
    'Gauge',
    'Another panel RosOut',
    '"Two"',
    '/a.b{c',
    'robot',
  ]) {
    expect(leftOut.join('\n')).toContain(part);
  }
  expect(leftOut.join('\n')).not.toContain('/hidden');
});

test('a layout without any known panel is refused with the reasons', () => {
  const file = { configById: {}, layout: 'Gauge!x' };
  expect(() => importFoxglove(file, KNOW)).toThrow('Gauge');
  expect(isFoxglove({ panels: {} })).toBe(false);
});

test('topics end at the first dot, bracket or filter', () => {
  expect(splitPath('/a/b.c[0].d')).toEqual({ topic: '/a/b', path: 'c[0].d', isPlain: true });
  expect(splitPath('"/a.b".c')).toEqual({ topic: '/a.b', path: 'c', isPlain: true });
  expect(splitPath('/a')).toEqual({ topic: '/a', path: '', isPlain: true });
  expect(splitPath('/a.b.@derivative')).toEqual({ topic: '/a', path: 'b', isPlain: false });
});
