"""Transformation of the stamped messages of geometry_msgs. The import registers them with tf2_ros."""

from tf2_geometry_msgs.tf2_geometry_msgs import (
    do_transform_point,
    do_transform_pose,
    do_transform_vector3,
    do_transform_wrench,
    from_msg_msg,
    to_msg_msg,
)

__all__ = [
    "do_transform_point",
    "do_transform_pose",
    "do_transform_vector3",
    "do_transform_wrench",
    "from_msg_msg",
    "to_msg_msg",
]
