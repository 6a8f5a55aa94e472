// Content of docs/displays.md: for each display screenshots of running examples, and a description.
//
// `showroom` runs a robot with every sensor that localizes on a map of the demo's room; `demo` is
// `periplus demo --explore`. The last display of a shot is the one that the shot documents.

const SEEN = { kind: 'Orbit', distance: 4.4, yaw: 3.75, pitch: 0.62, focal: [0.7, 0, 0.15] };
const NEAR = { ...SEEN, distance: 1.9, focal: [0.1, 0, 0.2] };
const FAR = { ...SEEN, distance: 6 };
const ROOM = { ...SEEN, distance: 9, focal: [2, 0, 0] };
const ABOVE = { kind: 'TopDownOrtho', scale: 42, angle: 0, x: 2, y: 0 };
const rviz = (name) => `rviz_default_plugins/${name}`;
const GRID = [rviz('Grid'), { 'Plane Cell Count': 20, Alpha: 0.35 }];
const ROBOT = [rviz('RobotModel'), { 'Description Topic': '/robot_description' }];
const WORLD = ['periplus/World', { Topic: '/world/demo_room/scene' }];
const MAP = [rviz('Map'), { Topic: '/map', Alpha: 1 }];
const scan = (more) => [rviz('LaserScan'), { Topic: '/scan', ...more }];
const RED = { 'Color Transformer': 'FlatColor', Color: '255; 70; 60' };
const rows = (more) => [
  rviz('PointCloud2'),
  { Topic: '/rows/points', 'Color Transformer': 'AxisColor', ...more },
];
const colored = (more) => [
  rviz('PointCloud2'),
  { Topic: '/depth_camera/points', 'Color Transformer': 'RGB8', ...more },
];
const costs = (more) => [
  rviz('Map'),
  { Topic: '/global_costmap/costmap', 'Color Scheme': 'costmap', Alpha: 1, ...more },
];
const goal = {
  'Shaft Length': 0.35,
  'Head Length': 0.12,
  'Shaft Radius': 0.025,
  'Head Radius': 0.06,
};
const lidar = (more) => ['periplus/VisualizeLidar', { Topic: '/scan', ...more }];

export const DISPLAYS = [
  {
    kind: rviz('RobotModel'),
    text: 'The robot of a URDF at the poses of its frames; meshes are read from the packages of the robot. Optional: collision shapes, masses as spheres of lead, inertias as equivalent boxes.',
    shots: {
      robot: { with: [GRID, ROBOT], view: { ...NEAR, distance: 1.6 } },
      robot_inertia: {
        with: [
          GRID,
          [
            rviz('RobotModel'),
            {
              ...ROBOT[1],
              Alpha: 0.4,
              'Mass Properties/Mass': true,
              'Mass Properties/Inertia': true,
            },
          ],
        ],
        view: { ...NEAR, distance: 1.6 },
      },
    },
  },
  {
    kind: rviz('TF'),
    text: 'The TF tree: axes and names of all frames, and arrows to their parents. Stale frames fade out and are then removed.',
    shots: {
      tf: {
        with: [
          GRID,
          ROBOT,
          [
            rviz('TF'),
            {
              'Show Names': true,
              'Marker Scale': 0.7,
              'Filter (whitelist)': 'base_link|lidar|camera_link|drivewhl|rows|sonar_l',
            },
          ],
        ],
        view: { ...NEAR, distance: 1.5 },
      },
    },
  },
  {
    kind: rviz('LaserScan'),
    text: 'The points of a laser scan, in every style and colour of a point cloud. According to REP 117 only beams with a hit are drawn.',
    shots: {
      laserscan: {
        with: [GRID, ROBOT, WORLD, scan({ ...RED, Style: 'Points', 'Size (Pixels)': 4 })],
        view: SEEN,
      },
      laserscan_axis: {
        with: [
          GRID,
          ROBOT,
          scan({ Style: 'Boxes', 'Size (m)': 0.05, 'Color Transformer': 'AxisColor', Axis: 'X' }),
        ],
        view: SEEN,
      },
    },
  },
  {
    kind: 'periplus/VisualizeLidar',
    text: "Gazebo's Visualize Lidar: triangles, rays or points, in its colours. Beams without a hit are drawn up to the maximum range; the dead zone below the minimum range is black.",
    shots: {
      visualize_lidar: { with: [GRID, ROBOT, WORLD, lidar()], view: SEEN },
      visualize_lidar_points: {
        with: [GRID, ROBOT, WORLD, lidar({ 'Visual Type': 'Points', 'Point Size': 4 })],
        view: SEEN,
      },
    },
  },
  {
    kind: rviz('PointCloud2'),
    text: 'Point clouds in all six styles, coloured by an axis, by a field, by their own colours, or in one colour. The bytes of a message are uploaded to the GPU unchanged.',
    shots: {
      cloud_axis: {
        isDense: true,
        with: [ROBOT, rows({ Style: 'Points', 'Size (Pixels)': 2 })],
        view: FAR,
      },
      cloud_rgb: { with: [ROBOT, colored({ 'Size (m)': 0.012 })], view: SEEN },
      cloud_field: {
        isDense: true,
        with: [
          ROBOT,
          rows({
            Style: 'Points',
            'Size (Pixels)': 2,
            'Color Transformer': 'Intensity',
            'Channel Name': 'x',
          }),
        ],
        view: FAR,
      },
      cloud_spheres: {
        isDense: true,
        with: [ROBOT, rows({ Style: 'Spheres', 'Size (m)': 0.07, Axis: 'X' })],
        view: FAR,
      },
      cloud_boxes: {
        isDense: true,
        with: [ROBOT, rows({ Style: 'Boxes', 'Size (m)': 0.06 })],
        view: FAR,
      },
      cloud_tiles: {
        with: [ROBOT, rows({ ...RED, Style: 'Tiles', 'Size (m)': 0.06, Color: '120; 190; 255' })],
        view: FAR,
      },
    },
  },
  {
    kind: rviz('DepthCloud'),
    text: 'A depth image as points (REP 118: metres or millimetres), with the colours of another image.',
    shots: {
      depthcloud: {
        with: [
          ROBOT,
          [
            rviz('DepthCloud'),
            {
              'Depth Map Topic': '/depth_camera/depth/image_raw',
              'Color Image Topic': '/depth_camera/image_raw',
              'Size (m)': 0.012,
            },
          ],
        ],
        view: SEEN,
      },
    },
  },
  {
    kind: rviz('Image'),
    text: 'Images beside the scene, in every raw encoding and every compressed one that the browser decodes. Depth is grey between the minimum and the maximum, as the median of the last images, or between the values you set.',
    shots: {
      image: { with: [[rviz('Image'), { Topic: '/depth_camera/image_raw' }]], isPicture: true },
      image_depth: {
        with: [[rviz('Image'), { Topic: '/depth_camera/depth/image_raw' }]],
        isPicture: true,
      },
    },
  },
  {
    kind: rviz('Camera'),
    text: 'A camera image with the scene drawn over it from the pose of the camera: scan, costmap and frames appear at their positions.',
    shots: {
      camera: {
        with: [
          costs(),
          scan({ ...RED, Style: 'Points', 'Size (Pixels)': 6, Color: '255; 255; 0' }),
          [rviz('Camera'), { Topic: '/depth_camera/image_raw', 'Overlay Alpha': 0.35 }],
        ],
        isPicture: true,
      },
    },
  },
  {
    kind: rviz('Map'),
    text: "Maps and costmaps in RViz's three palettes, or in two colours. Only changed cells are transferred and redrawn. Select (`s`) shows the value of a cell, its meaning, and the layer of a costmap that marked it.",
    shots: {
      map: { with: [ROBOT, MAP], view: ABOVE },
      map_costmap: { with: [ROBOT, costs()], view: ABOVE },
      map_raw: { with: [ROBOT, costs({ 'Color Scheme': 'raw' })], view: ABOVE },
      map_over: {
        with: [
          ROBOT,
          MAP,
          costs({ Alpha: 0.35 }),
          costs({ Topic: '/local_costmap/costmap', Alpha: 0.7 }),
        ],
        view: FAR,
      },
    },
  },
  {
    kind: 'periplus/VoxelGrid',
    text: "Marked or unknown voxels of Nav2's voxel layer.",
    shots: {
      voxelgrid: {
        with: [MAP, ROBOT, ['periplus/VoxelGrid', { Topic: '/local_costmap/voxel_grid' }]],
        view: SEEN,
      },
    },
  },
  {
    kind: rviz('Marker'),
    text: 'All twelve marker types; here the voxels that `nav2_costmap_2d_markers` publishes.',
    shots: {
      marker: {
        with: [MAP, ROBOT, [rviz('Marker'), { Topic: '/local_costmap/visualization_marker' }]],
        view: SEEN,
      },
    },
  },
  {
    kind: rviz('MarkerArray'),
    text: 'Many markers at once, switched on and off by namespace; here the pose graph of `slam_toolbox`.',
    run: 'demo',
    shots: {
      markerarray: {
        with: [MAP, [rviz('MarkerArray'), { Topic: '/slam_toolbox/graph_visualization' }]],
        view: ROOM,
      },
    },
  },
  {
    kind: rviz('Odometry'),
    text: 'Odometry poses with their covariance.',
    run: 'demo',
    shots: {
      odometry: {
        with: [
          ROBOT,
          MAP,
          [
            rviz('Odometry'),
            {
              Topic: '/demo/odom',
              'Position Tolerance': 0.15,
              Keep: 400,
              'Shape/Shaft Length': 0.12,
              'Shape/Shaft Radius': 0.015,
              'Shape/Head Length': 0.06,
              'Shape/Head Radius': 0.04,
              Covariance: false,
            },
          ],
        ],
        view: ROOM,
        isEarly: true,
      },
    },
  },
  {
    kind: rviz('Path'),
    text: 'A line through poses, optionally with axes or arrows at each; here the path to a frontier of the exploration.',
    run: 'demo',
    shots: {
      path: {
        with: [
          ROBOT,
          MAP,
          [
            rviz('Path'),
            {
              Topic: '/plan',
              'Line Style': 'Billboards',
              'Line Width': 0.06,
              Color: '255; 0; 160',
            },
          ],
        ],
        view: { ...ROOM, distance: 7 },
        waitsFor: 'parseInt(periplus.displays.at(-1).statuses.Path?.text) > 20',
      },
    },
  },
  {
    kind: rviz('Pose'),
    text: 'One pose, such as a goal.',
    shots: {
      pose: {
        with: [MAP, ROBOT, [rviz('Pose'), { Topic: '/goal_pose', ...goal, Color: '255; 85; 255' }]],
        view: NEAR,
        says: 'goal',
      },
    },
  },
  {
    kind: rviz('PoseWithCovariance'),
    text: 'A pose with its covariance: an ellipse of one standard deviation, and a sector for the heading. Components with the huge variance by which drivers mark unmeasured values are not drawn.',
    shots: {
      covariance: {
        with: [MAP, [rviz('PoseWithCovariance'), { Topic: '/amcl_pose', ...goal }]],
        view: NEAR,
        says: 'estimate',
      },
    },
  },
  {
    kind: 'nav2_rviz_plugins/ParticleCloud',
    text: 'The particles of AMCL; the length of an arrow shows the weight.',
    shots: {
      particles: {
        with: [MAP, ROBOT, ['nav2_rviz_plugins/ParticleCloud', { Topic: '/particle_cloud' }]],
        view: NEAR,
        says: 'estimate',
      },
    },
  },
  {
    kind: rviz('PoseArray'),
    text: 'Many poses, as flat arrows, solid arrows or axes.',
    shots: {
      posearray: {
        with: [
          MAP,
          ROBOT,
          [
            rviz('PoseArray'),
            {
              Topic: '/particlecloud',
              Shape: 'Arrow (3D)',
              'Shaft Length': 0.1,
              'Head Length': 0.04,
            },
          ],
        ],
        view: NEAR,
        says: 'estimate',
      },
    },
  },
  {
    kind: rviz('Polygon'),
    text: 'A closed polygon, such as the footprint of a robot.',
    shots: {
      polygon: {
        with: [MAP, ROBOT, [rviz('Polygon'), { Topic: '/local_costmap/published_footprint' }]],
        view: NEAR,
      },
    },
  },
  {
    kind: rviz('Range'),
    text: 'The cone of a sonar or infrared sensor, up to the measured range.',
    shots: {
      range: {
        with: [
          GRID,
          ROBOT,
          WORLD,
          [rviz('Range'), { Topic: '/sonar/right', Color: '90; 200; 255' }],
          [rviz('Range'), { Topic: '/sonar/left' }],
        ],
        view: SEEN,
      },
    },
  },
  {
    kind: 'periplus/World',
    text: 'The true simulated world. It is aligned with the first estimated pose of the robot; from then on the page shows the distance between estimate and truth. Walls in front of the focus are transparent.',
    shots: { world: { with: [ROBOT, WORLD], view: ROOM } },
  },
  {
    kind: rviz('Grid'),
    text: 'Grid lines on the floor, or in space.',
    shots: {
      grid: {
        with: [
          ROBOT,
          [
            rviz('Grid'),
            { 'Plane Cell Count': 6, Color: '47; 196; 178', 'Cell Size': 0.5, Alpha: 0.8 },
          ],
        ],
        view: { ...NEAR, distance: 3 },
      },
    },
  },
  {
    kind: rviz('Axes'),
    text: 'Red, green and blue along x, y and z of one frame.',
    shots: {
      axes: {
        with: [
          GRID,
          ROBOT,
          [rviz('Axes'), { 'Reference Frame': 'base_link', Length: 0.6, Radius: 0.015 }],
        ],
        view: NEAR,
      },
    },
  },
];

/** Programs to run; the map is one made by the demo. */
/** Displays of messages that no example of ours publishes: described without a picture. */
export const WITHOUT_PICTURE = [
  {
    kind: rviz('InteractiveMarkers'),
    text: 'Handles that a node offers, such as those of the pose graph of `slam_toolbox` in its interactive mode: moved along axes and in planes, turned, clicked, with menus (right button), or by keys in the panel Interactive markers. Ctrl turns a handle of all six degrees of freedom. The markers are requested with the service `get_interactive_markers`.',
  },
  {
    kind: 'periplus/MapDifference',
    text: 'Cells of two maps that are occupied in the first, in the second, or in both, in three colours; the status has their numbers. The comparison of two recordings adds it, and any two topics of maps can be chosen.',
  },
  { kind: rviz('GridCells'), text: 'The cells of a grid as flat tiles.' },
  { kind: rviz('PointStamped'), text: 'A point as a ball, and those before it.' },
  { kind: rviz('Wrench'), text: 'A force and a torque as arrows, the torque with a circle.' },
  { kind: rviz('TwistStamped'), text: 'Linear and angular velocity as arrows.' },
  { kind: rviz('AccelStamped'), text: 'Linear and angular acceleration as arrows.' },
  {
    kind: rviz('Effort'),
    text: 'Efforts of revolute joints as rings around their axes. Size and colour show the part of the limit of the URDF, the arrow head the direction.',
  },
  { kind: rviz('FluidPressure'), text: 'A pressure as a point with a colour of the rainbow.' },
  { kind: rviz('Illuminance'), text: 'An illuminance as a point with a colour of the rainbow.' },
  { kind: rviz('RelativeHumidity'), text: 'A humidity as a point with a colour of the rainbow.' },
  { kind: rviz('Temperature'), text: 'A temperature as a point with a colour of the rainbow.' },
].map((one) => ({ ...one, shots: {} }));

export const SHOWROOM = (map) => [
  ...['sim', 'worlds/demo_room.sdf', '--robot', 'viewer/e2e/show/showbot.urdf.xacro'],
  ...['--resource-path', 'robots', '--localize', map, '--costmap', 'viewer/e2e/show/costmaps.yaml'],
  ...['--rtf', '1', '--ros2', 'off'],
];
