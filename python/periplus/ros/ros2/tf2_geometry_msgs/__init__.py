"""Transformation of `geometry_msgs`; importing this module registers the types for `Buffer.transform`."""

from tf2_geometry_msgs.tf2_geometry_msgs import (
    do_transform_point as do_transform_point,
    do_transform_polygon_stamped as do_transform_polygon_stamped,
    do_transform_pose as do_transform_pose,
    do_transform_pose_stamped as do_transform_pose_stamped,
    do_transform_pose_with_covariance_stamped as do_transform_pose_with_covariance_stamped,
    do_transform_vector3 as do_transform_vector3,
    do_transform_wrench as do_transform_wrench,
    from_msg_msg as from_msg_msg,
    to_msg_msg as to_msg_msg,
    transform_covariance as transform_covariance,
)
from tf2_ros.buffer_interface import (
    ConvertRegistration as ConvertRegistration,
    Stamped as Stamped,
    TransformRegistration as TransformRegistration,
)
from geometry_msgs.msg import (
    PointStamped as PointStamped,
    PoseStamped as PoseStamped,
    PoseWithCovarianceStamped as PoseWithCovarianceStamped,
    TransformStamped as TransformStamped,
    Vector3Stamped as Vector3Stamped,
)
