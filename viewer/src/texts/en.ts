/**
 * All texts of the page, in English. A translation is a file beside this one with the same keys; a text with
 * values is a function, so that a language can order them. Names of ROS, RViz and Nav2 (topics, types, options of
 * displays, parameters) are not translated.
 */
export const en = {
  displayHelp: {
    axes: 'The axes of a frame: x red, y green, z blue',
    camera: 'A camera image overlaid with the scene as seen by the camera',
    depthCloud: 'A depth image as points, with the colours of a second image',
    grid: 'A grid of lines in a plane',
    image: 'Images, including depth images',
    laserScan: 'Points measured by a laser scanner',
    lidar: 'Rays of a laser scanner, as in Gazebo',
    map: 'Occupancy grids: maps and costmaps',
    marker: 'A shape published by a node',
    markerArray: 'Shapes published by a node',
    odometry: 'Past poses from odometry, as arrows or axes',
    particleCloud: 'Particles of AMCL: the larger the weight, the longer the arrow',
    path: 'A path as a line through its poses',
    pointCloud2: 'Point clouds, coloured by a field, by an axis, by their own colours or flat',
    polygon: "A closed line: a robot's footprint",
    pose: 'A pose, such as a goal, as an arrow or axes',
    poseArray: 'An array of poses as arrows or axes',
    poseWithCovariance: 'A pose with its covariance',
    range: 'The range of a sonar or infrared sensor, as a cone',
    robotModel: 'A robot model from a URDF, posed by TF',
    tf: 'The TF tree: axes and names of all frames, and arrows to their parents',
    voxels: 'Cells marked by the voxel layer of a costmap',
    world: 'The simulated world (ground truth)',
  },
  /** Statuses of displays. */
  displays: {
    andMore: (count: number) => ` and ${count} more`,
    cells: (count: number) => `${count} cells`,
    depthEncoding: (encoding: string) =>
      `The encoding of a depth image must be 32FC1 or 16UC1; this one is ${encoding}`,
    emptyMap: (width: number, height: number, resolutionM: number) =>
      `The map has ${width} x ${height} cells of ${resolutionM} m: it is empty`,
    estimateError: (distanceM: string, degrees: string) =>
      `Error of the estimate: ${distanceM} m, ${degrees}°`,
    frames: (count: number, lost: number, fixed: string) =>
      `${count} frames${lost ? `, ${lost} without a transform to ${fixed}` : ''}`,
    imageEncoding: (encoding: string) => `The image encoding "${encoding}" is not supported`,
    imageFormat: (format: string) => `The browser cannot decode the format "${format}"`,
    impossibleInertia: (link: string) => `The inertia of ${link} is physically impossible`,
    largeMap: (cells: number) =>
      `The map is larger than this GPU supports (${cells} cells per side)`,
    lastUpdate: (width: number, height: number) => `Last update: ${width} x ${height} cells`,
    links: (robot: string, count: number) => `${robot}: ${count} links`,
    markerType: (type: number) => `The marker type ${type} is unknown`,
    markers: (count: number) => `${count} markers`,
    meshFormat: (name: string) =>
      `the mesh format "${name}" is not supported (supported: stl, dae, obj, glb)`,
    messages: (count: number, topic: string) => `${count} messages on ${topic}`,
    newestTransform: (why: string) => `Using the newest transform: ${why}`,
    noCameraInfo: 'No camera_info received for the image yet',
    noFocalLength: 'The camera_info has no focal length',
    noMessage: (topic: string) => `No message received on ${topic} yet`,
    noPixels: 'The image has no pixels',
    noTopic: 'No topic is set',
    noTransform: (why: string) => `No transform: ${why}`,
    noTransformTo: (from: string, to: string) => `No transform from ${from} to ${to}`,
    noXyz: 'The cloud has no fields x, y and z',
    notCollada: (uri: string) => `${uri} is not a COLLADA file`,
    notUrdf: 'The description is not a URDF: it has no <robot>',
    points: (count: number, every: number) =>
      `${count.toLocaleString('en')} points${every > 1 ? `; without a GPU, one in ${every} is drawn` : ''}`,
    poseFromSimulation: 'Pose from the simulation; TF has none',
    poses: (count: number) => `${count} poses`,
    rangeNotDrawn: (rangeM: number) => `${rangeM} m: not drawn`,
    rays: (hits: number, count: number) => `${hits} of ${count} rays hit an object`,
    shapes: (count: number, models: number) => `${count} shapes of ${models} models`,
    shortMap: 'The map has fewer cells than its width and height require',
    updateOutside: 'An update of the map is outside the map',
  },
  /** Properties of the object that was selected in the scene. */
  found: {
    byInflation: 'by inflation: no layer marks it as occupied',
    cell: 'Cell',
    center: 'Center',
    cost: (cost: number) => `cost about ${cost} = 252 exp(-scaling (distance - inscribed radius))`,
    display: 'Display',
    frame: 'Frame',
    free: 'free',
    inFrame: 'In its frame',
    inNamed: (frame: string) => `In ${frame}`,
    inWorld: 'In the world',
    inscribed: "inscribed: the robot's middle here touches an obstacle (cost 253)",
    layer: (name: string) => `Layer ${name}`,
    lethal: 'lethal: an obstacle (cost 254)',
    link: 'Link',
    map: 'Map',
    markedBy: (layers: string) => `marked by ${layers}`,
    marker: 'Marker',
    mass: 'Mass',
    meaning: 'Meaning',
    model: 'Model',
    neverObserved: 'unknown: never observed',
    noNamespace: '(no namespace)',
    none: 'none',
    nothing: 'nothing under the mouse',
    occupied: (percent: number) => `occupied with a probability of ${percent} %`,
    parent: 'Parent',
    range: 'Range',
    rangeAt: (rangeM: string, degrees: string) => `${rangeM} m at ${degrees}°`,
    robot: 'Robot',
    selection: 'Selection',
    text: 'Text',
    unknown: 'unknown',
    unknownCell: '-1 (unknown)',
    unmarked: 'no layer marks it',
    value: 'Value',
    waitingForLayers: 'waiting for the layers',
    why: 'Why',
  },
  connection: {
    assetTimeout: (uri: string) => `${uri} was not received in time`,
    badAddress: (error: string) => `the address is not valid: ${error}`,
    closed: 'the connection was closed',
    encoding: (topic: string, encoding: string) =>
      `${topic} has the encoding ${encoding}; this page decodes only CDR`,
    noService: (name: string) => `no node provides the service ${name}`,
    notConnected: 'not connected',
    notJson: 'the server sent text that is not JSON',
    repairTimeout: (topic: string) => `The server did not confirm the repair of ${topic}`,
    timeout: (name: string, timeoutS: number) => `${name} did not respond within ${timeoutS} s`,
    unknownType: (type: string) => `the definition of the message type ${type} is unknown`,
    unreachable: 'the server is unreachable',
  },
  transforms: {
    apart: (to: string, from: string) => `"${to}" and "${from}" are in different transform trees`,
    newest: (frame: string, timeS: string) => `the newest transform of "${frame}" is at ${timeS} s`,
    noFrame: (frame: string) => `there is no frame "${frame}" yet`,
    oldest: (frame: string, timeS: string) => `the oldest transform of "${frame}" is at ${timeS} s`,
  },
  /** Errors of messages that cannot be decoded. */
  messages: {
    badLine: (type: string, line: string) =>
      `${type}: cannot read the line "${line}" of its definition`,
    encapsulation: (kind: number) => `unknown CDR encapsulation kind ${kind}`,
    lacksType: (type: string, missing: string) =>
      `${type}: its definition lacks the type ${missing}`,
    noHeader: 'the message is shorter than its own header',
    short: (count: number) => `the message declares ${count} elements and is shorter than that`,
    truncated: 'the message is truncated',
  },
  notices: {
    close: 'Close',
    inAll: (count: number) => `${count} in all`,
    noWebGl:
      'This browser cannot draw with WebGL 2. Enable hardware acceleration or use another browser.',
    notRviz: 'This is not an .rviz file: it has no "Visualization Manager"',
    notYaml: (error: string) => `This is not YAML: ${error}`,
    seeLog: 'See the log for the reason.',
    serviceFailed: (name: string, why: string) => `${name} failed. ${why}`,
    title: 'Messages',
    unknownDisplay: (name: string) =>
      `The display class "${name}" is unknown; the display was skipped.`,
  },
  tools: {
    goalSent: (frame: string, pose: string) => `2D goal pose in ${frame}: ${pose}`,
    noSubscriber: (topic: string, advice: string) =>
      `No node subscribes to ${topic}: the message has no effect. ${advice}`,
    noTf: 'No node publishes transforms on /tf; start one, such as robot_state_publisher.',
    notSent: (frame: string, advice: string) =>
      `Not sent: no transform names the frame "${frame}". ${advice}`,
    otherFrame: 'Choose another fixed frame in the panel Displays.',
    pointSent: (frame: string, point: string) => `Clicked point in ${frame}: ${point}`,
    poseSent: (frame: string, pose: string) => `2D pose estimate in ${frame}: ${pose}`,
    startLocalization:
      'Start localization, such as `periplus ros2 launch nav2_bringup localization_launch.py map:=MAP.yaml`.',
    startNavigator: 'Start a navigator, such as bt_navigator of Nav2 on ROS 2.',
  },
  /** Goals of Nav2 and the panel Navigate. */
  navigation: {
    errorCode: (code: number) => `error code ${code}`,
    noReason: 'it gave no reason; the panel Log may have more.',
    notCanceled: (action: string) => `${action} did not cancel its goal; see the panel Log.`,
    paused: 'The simulation is paused.',
    refused: (reason: string) => `The navigator refused the goal: ${reason}`,
    still: 'The robot does not move.',
    stillRunning: (nodes: string) => `The robot does not move; running: ${nodes}.`,
    stoppedBy: (polygon: string) =>
      `The collision monitor stops the robot: there are obstacles in the polygon ${polygon}.`,
  },
  /** The simulated world and the panel World. */
  world: {
    clickPosition: (model: string) => `Click the position for ${model}`,
    deleted: (model: string) => `${model} was deleted`,
    inserted: (model: string) => `${model} was inserted`,
    noModelName: 'The file has no <model> or <robot> with a name',
    notModelFile: 'The file is neither SDF nor URDF',
  },
  language: {
    /** Name of this language in itself. */
    name: 'English',
    choose: 'Language',
  },
};

export type Texts = typeof en;
