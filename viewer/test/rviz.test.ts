import { describe, expect, test } from 'vitest';
import { nest, partOf, readRviz, writeRviz } from '../src/rviz/file';
import { viewFrom, viewTo } from '../src/rviz/view';
import { palette } from '../src/displays/palette';
import { kindOf } from '../src/displays/registry';

const FILE = `
Panels:
  - Class: rviz_common/Displays
    Name: Displays
Visualization Manager:
  Class: ""
  Displays:
    - Class: rviz_default_plugins/LaserScan
      Name: Scan
      Enabled: true
      Value: true
      Size (m): 0.05
      Autocompute Value Bounds:
        Max Value: 3
        Min Value: -3
        Value: false
      Topic:
        Depth: 5
        Reliability Policy: Best Effort
        Value: /scan
      Something New: 7
    - Class: rviz_common/Group
      Name: Costs
      Enabled: false
      Displays:
        - Class: rviz_default_plugins/Map
          Name: Costmap
          Enabled: true
          Color Scheme: costmap
          Topic: {Value: /costmap}
  Global Options:
    Background Color: 10; 20; 30
    Fixed Frame: odom
    Frame Rate: 30
  Tools:
    - Class: rviz_default_plugins/SetInitialPose
      Covariance x: 0.5
      Topic: {Value: /start}
  Views:
    Current:
      Class: rviz_default_plugins/TopDownOrtho
      Angle: 0.5
      Scale: 40
      X: 1
      Y: 2
Window Geometry:
  QMainWindow State: 000000ff
`;

describe('.rviz files', () => {
  test('RViz for ROS 1 names the parameter of the robot description', () => {
    const file = readRviz(`Visualization Manager:
  Displays:
    - {Class: rviz/RobotModel, Name: Robot, Robot Description: robot_description}
    - {Class: rviz/RobotModel, Name: Other, Robot Description: /a/robot_description}
`);
    const topics = file.displays.map((d) => d.values['Description Topic']);
    expect(topics).toEqual(['/robot_description', '/a/robot_description']);
  });

  test('displays, groups, nested options, tools, views', () => {
    const file = readRviz(FILE);
    expect(file.fixedFrame).toBe('odom');
    expect(file.displays.map((d) => [d.name, d.isEnabled])).toEqual([
      ['Scan', true],
      ['Costmap', true],
    ]);
    expect(file.displays.map((d) => d.group?.name)).toEqual([undefined, 'Costs']);
    expect(file.groups[0]!.isEnabled).toBe(false);
    expect(file.displays[0]!.values).toMatchObject({
      'Size (m)': 0.05,
      Topic: '/scan',
      'Topic/Reliability Policy': 'Best Effort',
      'Autocompute Value Bounds': false,
      'Autocompute Value Bounds/Max Value': 3,
    });
    expect(file.tools[0]!.values).toMatchObject({ 'Covariance x': 0.5, Topic: '/start' });
    expect(viewFrom(file.view!)).toMatchObject({ kind: 'TopDownOrtho', scale: 40, x: 1, y: 2 });
  });

  test('unknown entries are written back', () => {
    const file = readRviz(FILE);
    const scan = file.displays[0]!;
    const text = writeRviz({
      fixedFrame: 'map',
      background: file.background,
      displays: [
        {
          ...scan,
          values: { ...scan.values, 'Size (m)': 0.1 },
          options: [{ path: 'Size (m)', kind: 'number', default: 0.01 }],
        },
      ],
      view: viewTo({
        kind: 'Orbit',
        distance: 3,
        focal: [1, 2, 3],
        pitch: 1,
        yaw: 2,
        scale: 1,
        angle: 0,
        x: 0,
        y: 0,
        targetFrame: 'base_link',
      }),
      original: file.original,
    });
    expect(text).toContain('Something New: 7');
    expect(text).toContain('QMainWindow State');
    const again = readRviz(text);
    expect(again.fixedFrame).toBe('map');
    expect(again.displays[0]!.values['Size (m)']).toBe(0.1);
    expect(viewFrom(again.view!)).toMatchObject({
      kind: 'Orbit',
      distance: 3,
      focal: [1, 2, 3],
      targetFrame: 'base_link',
    });
  });

  test('groups, saved views, panels and the window are read and written back', () => {
    const nested = `
Panels:
  - {Class: rviz_common/Displays, Name: Displays}
  - {Class: nav2_rviz_plugins/Navigation 2, Name: Navigation 2}
Visualization Manager:
  Displays:
    - {Class: rviz_default_plugins/Grid, Name: Grid, Enabled: true}
    - Class: rviz_common/Group
      Name: Controller
      Enabled: false
      Note: kept
      Displays:
        - Class: rviz_common/Group
          Name: Inner
          Enabled: true
          Displays: [{Class: rviz_default_plugins/Path, Name: Plan, Enabled: true}]
        - {Class: rviz_default_plugins/Map, Name: Local, Enabled: true}
    - {Class: rviz_common/Group, Name: Empty, Enabled: true, Displays: ~}
  Views:
    Current: {Class: rviz_default_plugins/Orbit}
    Saved:
      - {Class: rviz_default_plugins/TopDownOrtho, Name: From above, Scale: 70, Odd: 3}
Window Geometry: {Hide Left Dock: true, Height: 900}
`;
    const check = (file: ReturnType<typeof readRviz>) => {
      const path = (group?: { name: string; parent?: unknown }): string =>
        group ? `${path(group.parent as never)}/${group.name}` : '';
      expect(file.displays.map((d) => `${path(d.group)}/${d.name}`)).toEqual([
        '/Grid',
        '/Controller/Inner/Plan',
        '/Controller/Local',
      ]);
      expect(file.groups.map((g) => [g.name, g.isEnabled])).toEqual([
        ['Controller', false],
        ['Inner', true],
        ['Empty', true],
      ]);
      expect(file.savedViews.map((view) => [view.name, view.values.Scale])).toEqual([
        ['From above', 70],
      ]);
      expect(file.window).toEqual({
        panels: ['rviz_common/Displays', 'nav2_rviz_plugins/Navigation 2'],
        hidesDisplays: true,
      });
    };
    const file = readRviz(nested);
    check(file);
    const text = writeRviz({
      ...file,
      displays: file.displays.map((one) => ({ ...one, options: [] })),
      view: file.view!,
    });
    check(readRviz(text));
    for (const kept of ['Note: kept', 'Odd: 3', 'Height: 900']) expect(text).toContain(kept);
  });

  test('option names of RViz for ROS 1', () => {
    const file = readRviz(
      'Visualization Manager: {Displays: [{Class: rviz/Marker, Marker Topic: /m, Queue Size: 100}, {Class: rviz/LaserScan, Topic: /scan, Unreliable: true}]}',
    );
    expect(file.displays[0]!.values.Topic).toBe('/m');
    expect(file.displays[1]!.values['Topic/Reliability Policy']).toBe('Best Effort');
  });

  test('a file of another format is refused', () => {
    expect(() => readRviz('a: [')).toThrow('not YAML');
    expect(() => readRviz('a: 1')).toThrow('not an .rviz file');
  });

  test('paths are converted back to nested maps', () => {
    expect(nest({ Shape: 'Arrow', 'Shape/Color': 'red', 'Offset/X': 1 })).toEqual({
      Shape: { Value: 'Arrow', Color: 'red' },
      Offset: { X: 1 },
    });
  });
});

describe('palettes', () => {
  const at = (colors: Uint8Array, i: number) => [...colors.subarray(i * 4, i * 4 + 4)];

  test('map: free is white, occupied is black, unknown is green grey', () => {
    const map = palette('map');
    expect([0, 50, 100, 101, 128, 254, 255].map((i) => at(map, i))).toEqual([
      [255, 255, 255, 255],
      [128, 128, 128, 255],
      [0, 0, 0, 255],
      [0, 255, 0, 255],
      [255, 0, 0, 255],
      [255, 255, 0, 255],
      [0x70, 0x89, 0x86, 255],
    ]);
  });

  test('costmap: free is transparent, costs are blue to red, inscribed is cyan, lethal is magenta', () => {
    const cost = palette('costmap');
    expect([0, 1, 98, 99, 100].map((i) => at(cost, i))).toEqual([
      [0, 0, 0, 0],
      [2, 0, 253, 255],
      [249, 0, 6, 255],
      [0, 255, 255, 255],
      [255, 0, 255, 255],
    ]);
  });

  test('raw, and binary palettes', () => {
    expect(at(palette('raw'), 77)).toEqual([77, 77, 77, 255]);
    const binary = palette('map', 65);
    expect([64, 65].map((i) => at(binary, i))).toEqual([
      [255, 255, 255, 255],
      [0, 0, 0, 255],
    ]);
  });
});

test('links, frames and namespaces are enabled by name, for any characters in it', () => {
  const file = readRviz(`
Visualization Manager:
  Displays:
    - Class: rviz_default_plugins/RobotModel
      Links:
        All Links Enabled: true
        base_link: {Alpha: 0.5, Show Axes: true, Value: false}
    - Class: rviz_default_plugins/TF
      Frames:
        All Enabled: false
        robot/base: {Value: true}
    - Class: rviz_default_plugins/MarkerArray
      Namespaces: {a/b: false}
`);
  const [robot, tf, markers] = file.displays;
  expect(robot!.values['Links/base_link']).toBe(false);
  expect(tf!.values['Frames/robot/base']).toBe(true);
  expect(partOf('Links/base_link/Show Axes')).toBeUndefined();
  expect(partOf('Frames/robot/base')).toEqual({ group: 'Frames', name: 'robot/base' });
  tf!.values['Frames/robot/base'] = false;
  const displays = [robot, tf, markers].map((d) => ({ ...d!, options: [] }));
  const view = { class: 'rviz_default_plugins/Orbit', values: {} };
  const again = readRviz(writeRviz({ fixedFrame: 'map', background: '0; 0; 0', displays, view }));
  expect(again.displays.map((d) => d.original)).toMatchObject([
    { Links: { base_link: { Alpha: 0.5, 'Show Axes': true, Value: false } } },
    { Frames: { 'All Enabled': false, 'robot/base': { Value: false } } },
    { Namespaces: { 'a/b': false } },
  ]);
});

test('options that RViz nests below a checkbox are read', () => {
  const cloud = kindOf('rviz_default_plugins/PointCloud2')!;
  const names = new Set(cloud.options.map((option) => option.path));
  const { values } = readRviz(FILE).displays[0]!;
  expect(values['Autocompute Value Bounds']).toBe(false);
  expect(values['Autocompute Value Bounds/Max Value']).toBe(3);
  for (const path of ['Autocompute Value Bounds', 'Autocompute Value Bounds/Max Value']) {
    expect(names.has(path)).toBe(true);
  }
});
