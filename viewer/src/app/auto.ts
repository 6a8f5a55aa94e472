/** Displays that are added automatically for the topics of a new connection. */
import { kindForType, kindOf } from '../displays/registry';
import type { Values } from '../displays/options';

export interface Suggestion {
  class: string;
  name: string;
  values: Values;
  isEnabled: boolean;
  /** Topic of the display; at most one display per topic. */
  key: string;
}

const HIDDEN = new Set([
  'nav_msgs/msg/Odometry',
  'visualization_msgs/msg/Marker',
  'nav2_msgs/msg/VoxelGrid',
  'geometry_msgs/msg/PoseWithCovarianceStamped',
  // Efforts of joints, and commands of drives.
  'sensor_msgs/msg/JointState',
  'geometry_msgs/msg/TwistStamped',
  'geometry_msgs/msg/AccelStamped',
]);

/**
 * Paths that repeat others: the path before it is smoothed, the one a controller received, and the optimal
 * trajectory of MPPI, which is also one of its markers.
 */
const HIDDEN_PATHS =
  /(unsmoothed_plan|received_global_plan|optimal_trajectory|optimal_path|lookahead_collision_arc)$/;

/** Prefix of a topic or frame of a second recording: `B:` of `B:/scan`; otherwise empty. */
export const prefixIn = (name: string): string => /^[A-Z]:/.exec(name)?.[0] ?? '';

/** Colours of a second recording over the first one. */
const SECOND: Record<string, Values> = {
  'rviz_default_plugins/LaserScan': { Color: '64; 160; 255' },
  'rviz_default_plugins/Path': { Color: '255; 170; 0' },
  'rviz_default_plugins/Odometry': { 'Shape/Color': '255; 170; 0' },
  'rviz_default_plugins/Polygon': { Color: '255; 170; 0' },
  'rviz_default_plugins/PoseArray': { Color: '64; 160; 255' },
  'nav2_rviz_plugins/ParticleCloud': { Color: '64; 160; 255' },
  'rviz_default_plugins/PointCloud2': { 'Color Transformer': 'FlatColor', Color: '64; 160; 255' },
  'rviz_default_plugins/Map': { Alpha: 0.5 },
  'rviz_default_plugins/RobotModel': { Alpha: 0.6 },
};

/** Display for a topic of a second recording: that of the first one, in its own colours. */
function secondSuggestion(prefix: string, topic: string, type: string): Suggestion | undefined {
  const first = suggestionFor(topic.slice(prefix.length), type);
  if (!first) return undefined;
  const values: Values = { ...first.values, ...SECOND[first.class] };
  for (const path of ['Topic', 'Description Topic']) if (values[path]) values[path] = topic;
  if (first.class === 'rviz_default_plugins/RobotModel') values['TF Prefix'] = prefix;
  return { ...first, values, name: `${prefix} ${first.name}`, key: topic };
}

/** Display for a topic; `undefined` for topics without one. */
export function suggestionFor(topic: string, type: string): Suggestion | undefined {
  const prefix = prefixIn(topic);
  if (prefix) return secondSuggestion(prefix, topic, type);
  const name = topic.replace(/^\//, '');
  const suggestion = (
    kindClass: string,
    values: Values,
    isEnabled = true,
    title = name,
  ): Suggestion => ({
    class: kindClass,
    name: title,
    values,
    isEnabled,
    key: topic,
  });
  if (/^\/world\/.+\/scene$/.test(topic)) {
    return suggestion('periplus/World', { Topic: topic }, true, 'World');
  }
  if (/^\/world\//.test(topic) || type === 'tf2_msgs/msg/TFMessage') return undefined;
  if (type === 'std_msgs/msg/String' && /robot_description$/.test(topic)) {
    return suggestion(
      'rviz_default_plugins/RobotModel',
      { 'Description Topic': topic },
      true,
      `Robot ${topic.slice(1, -'/robot_description'.length)}`.trim(),
    );
  }
  const kind = kindForType(type);
  if (!kind || !kindOf(kind.class)) return undefined;
  const values: Values = { Topic: topic };
  // Debug visualization of nodes.
  if (/visualization|_markers$/.test(topic)) return suggestion(kind.class, values, false);
  switch (type) {
    case 'nav_msgs/msg/OccupancyGrid': {
      const isCost = /cost/.test(topic);
      const isLocal = /local/.test(topic);
      if (/_raw$|_layer$|filter_mask|keepout|speed/.test(topic))
        return suggestion(kind.class, values, false);
      if (isCost) Object.assign(values, { 'Color Scheme': 'costmap', Alpha: isLocal ? 0.7 : 0.35 });
      else values.Alpha = 1;
      return suggestion(kind.class, values);
    }
    case 'nav_msgs/msg/Path': {
      // Plans of Nav2, as lines that are visible from afar: the local one over the global one.
      const isLocal = /local_plan$|transformed_global_plan$/.test(topic);
      const isGlobal = /(^|\/)plan$/.test(topic);
      // Trajectories that are compared: thick, above maps.
      if (/^\/compare\/trajectory$/.test(topic)) {
        Object.assign(values, { 'Line Style': 'Billboards', 'Line Width': 0.05, 'Offset/Z': 0.04 });
        Object.assign(values, { Color: '47; 196; 178' });
      }
      if (isLocal) Object.assign(values, { Color: '0; 170; 255', 'Offset/Z': 0.02 });
      if (isLocal || isGlobal)
        Object.assign(values, { 'Line Style': 'Billboards', 'Line Width': 0.04 });
      return suggestion(kind.class, values, !HIDDEN_PATHS.test(topic));
    }
    case 'sensor_msgs/msg/LaserScan':
      // One flat-coloured point per beam, visible from afar.
      Object.assign(values, {
        Style: 'Points',
        'Size (Pixels)': 4,
        'Color Transformer': 'FlatColor',
      });
      Object.assign(values, { Color: '255; 70; 60', 'Reliability Policy': 'Best Effort' });
      return suggestion(kind.class, values);
    case 'sensor_msgs/msg/PointCloud2':
      Object.assign(values, { 'Color Transformer': 'AxisColor', Style: 'Points' });
      return suggestion(kind.class, values, false);
    case 'sensor_msgs/msg/Image':
      return suggestion(kind.class, values, !/(^|\/)depth\/|depth_image|label|segment/.test(topic));
    case 'geometry_msgs/msg/PolygonStamped':
      return suggestion(kind.class, values, !/raw/.test(topic));
    case 'geometry_msgs/msg/PoseArray':
      // AMCL publishes Nav2's particles and the same as a PoseArray for ROS 1.
      return suggestion(kind.class, values, !/particlecloud$/.test(topic));
    default:
      return suggestion(kind.class, values, !HIDDEN.has(type));
  }
}

/** Best fixed frame of those that exist. */
export function bestFrame(names: readonly string[], rootOf: (name: string) => string): string {
  for (const wanted of ['map', 'odom', 'world']) if (names.includes(wanted)) return wanted;
  const first = names[0];
  return first === undefined ? 'map' : rootOf(first);
}
