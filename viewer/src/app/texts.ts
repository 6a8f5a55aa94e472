/** Definitions of the message types that the page publishes. */

const HEADER =
  'MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n' +
  '================\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n';
const VECTOR = 'MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n';
const POINT = 'MSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n';
const POSE =
  'MSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n================\n' +
  POINT +
  '================\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\nfloat64 w\n';
const TWIST = 'Vector3 linear\nVector3 angular\n';
const join = (...parts: string[]) => parts.join('================\n');

export const TEXTS: Record<string, string> = {
  'geometry_msgs/msg/Twist': join(TWIST, VECTOR),
  'geometry_msgs/msg/TwistStamped': join(
    'std_msgs/Header header\nTwist twist\n',
    HEADER,
    `MSG: geometry_msgs/Twist\n${TWIST}`,
    VECTOR,
  ),
  'geometry_msgs/msg/PoseStamped': join('std_msgs/Header header\nPose pose\n', HEADER, POSE),
  'geometry_msgs/msg/PoseWithCovarianceStamped': join(
    'std_msgs/Header header\nPoseWithCovariance pose\n',
    HEADER,
    'MSG: geometry_msgs/PoseWithCovariance\nPose pose\nfloat64[36] covariance\n',
    POSE,
  ),
  'geometry_msgs/msg/PointStamped': join('std_msgs/Header header\nPoint point\n', HEADER, POINT),
  'visualization_msgs/msg/InteractiveMarkerFeedback': join(
    'std_msgs/Header header\nstring client_id\nstring marker_name\nstring control_name\n' +
      'uint8 event_type\ngeometry_msgs/Pose pose\nuint32 menu_entry_id\n' +
      'geometry_msgs/Point mouse_point\nbool mouse_point_valid\n',
    HEADER,
    POSE,
  ),
  'sensor_msgs/msg/JointState': join(
    'std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\nfloat64[] effort\n',
    HEADER,
  ),
  'std_msgs/msg/Float64MultiArray': join(
    'MultiArrayLayout layout\nfloat64[] data\n',
    'MSG: std_msgs/MultiArrayLayout\nMultiArrayDimension[] dim\nuint32 data_offset\n',
    'MSG: std_msgs/MultiArrayDimension\nstring label\nuint32 size\nuint32 stride\n',
  ),
  'std_msgs/msg/Int32': 'int32 data\n',
};
