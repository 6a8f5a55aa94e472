/** Nodes that estimate the pose of a robot (EKF, AMCL, SLAM), recognized by their topics and not by their names. */

interface Row {
  name: string;
  type: string;
  publishers: string[];
  subscribers: string[];
}

/** Types of the measurements that pose estimators subscribe to. */
const MEASUREMENTS = new Set([
  'sensor_msgs/msg/LaserScan',
  'sensor_msgs/msg/PointCloud2',
  'sensor_msgs/msg/Imu',
  'sensor_msgs/msg/Image',
  'nav_msgs/msg/Odometry',
  'geometry_msgs/msg/PoseWithCovarianceStamped',
]);

/** Nodes that publish transforms and subscribe to measurements. Drive controllers and state publishers subscribe to none. */
export function estimatorsOf(topics: readonly Row[]): string[] {
  const placed = topics.find((topic) => topic.name === '/tf')?.publishers ?? [];
  const measured = topics.filter((topic) => MEASUREMENTS.has(topic.type));
  const listening = new Set(measured.flatMap((topic) => topic.subscribers));
  return [...new Set(placed)].filter((node) => listening.has(node)).sort();
}
