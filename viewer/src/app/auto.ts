/** Which displays a newcomer wants to see of the topics that there are. */
import { kindForType, kindOf } from '../displays/registry';
import type { Values } from '../displays/options';

export interface Wish {
  class: string;
  name: string;
  values: Values;
  isEnabled: boolean;
  /** What it shows; one display for each. */
  key: string;
}

const HIDDEN = new Set([
  'nav_msgs/msg/Odometry',
  'visualization_msgs/msg/Marker',
  'nav2_msgs/msg/VoxelGrid',
  'geometry_msgs/msg/PoseWithCovarianceStamped',
]);

/** The wish for one topic; none if it is no sight. */
export function wishFor(topic: string, type: string): Wish | undefined {
  const name = topic.replace(/^\//, '');
  const wish = (kindClass: string, values: Values, isEnabled = true, title = name): Wish => ({
    class: kindClass,
    name: title,
    values,
    isEnabled,
    key: topic,
  });
  if (/^\/world\/.+\/scene$/.test(topic)) {
    return wish('periplus/World', { Topic: topic }, true, 'World');
  }
  if (/^\/world\//.test(topic) || type === 'tf2_msgs/msg/TFMessage') return undefined;
  if (type === 'std_msgs/msg/String' && /robot_description$/.test(topic)) {
    return wish('rviz_default_plugins/RobotModel', { 'Description Topic': topic }, true, 'Robot');
  }
  const kind = kindForType(type);
  if (!kind || !kindOf(kind.class)) return undefined;
  const values: Values = { Topic: topic };
  // What nodes show of their inner life.
  if (/visualization|_markers$/.test(topic)) return wish(kind.class, values, false);
  switch (type) {
    case 'nav_msgs/msg/OccupancyGrid': {
      const isCost = /cost/.test(topic);
      const isLocal = /local/.test(topic);
      if (/_raw$|_layer$|filter_mask|keepout|speed/.test(topic))
        return wish(kind.class, values, false);
      if (isCost) Object.assign(values, { 'Color Scheme': 'costmap', Alpha: isLocal ? 0.7 : 0.35 });
      else values.Alpha = 1;
      return wish(kind.class, values);
    }
    case 'sensor_msgs/msg/LaserScan':
      // A point of light for each beam, seen from afar.
      Object.assign(values, {
        Style: 'Points',
        'Size (Pixels)': 4,
        'Color Transformer': 'FlatColor',
      });
      Object.assign(values, { Color: '255; 70; 60', 'Reliability Policy': 'Best Effort' });
      return wish(kind.class, values);
    case 'sensor_msgs/msg/PointCloud2':
      Object.assign(values, { 'Color Transformer': 'AxisColor', Style: 'Points' });
      return wish(kind.class, values, false);
    case 'sensor_msgs/msg/Image':
      return wish(kind.class, values, !/(^|\/)depth\/|depth_image|label|segment/.test(topic));
    case 'geometry_msgs/msg/PolygonStamped':
      return wish(kind.class, values, !/raw/.test(topic));
    case 'geometry_msgs/msg/PoseArray':
      // Beside Nav2's particles AMCL tells ROS 1's: the same once more.
      return wish(kind.class, values, !/particlecloud$/.test(topic));
    default:
      return wish(kind.class, values, !HIDDEN.has(type));
  }
}

/** The frame in which a robot is best seen, of those that there are. */
export function bestFrame(names: readonly string[], rootOf: (name: string) => string): string {
  for (const wanted of ['map', 'odom', 'world']) if (names.includes(wanted)) return wanted;
  const first = names[0];
  return first === undefined ? 'map' : rootOf(first);
}
