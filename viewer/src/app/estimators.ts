/** Nodes that estimate where a robot is: EKF, AMCL, SLAM, whatever their names are. */

interface Row {
  name: string;
  type: string;
  publishers: string[];
  subscribers: string[];
}

/** Measurements that an estimate is made of. */
const MEASUREMENTS = new Set([
  'sensor_msgs/msg/LaserScan',
  'sensor_msgs/msg/PointCloud2',
  'sensor_msgs/msg/Imu',
  'sensor_msgs/msg/Image',
  'nav_msgs/msg/Odometry',
  'geometry_msgs/msg/PoseWithCovarianceStamped',
]);

/** Nodes that publish transforms and subscribe to measurements. Drives and models do not subscribe. */
export function estimatorsOf(topics: readonly Row[]): string[] {
  const placed = topics.find((topic) => topic.name === '/tf')?.publishers ?? [];
  const measured = topics.filter((topic) => MEASUREMENTS.has(topic.type));
  const listening = new Set(measured.flatMap((topic) => topic.subscribers));
  return [...new Set(placed)].filter((node) => listening.has(node)).sort();
}
