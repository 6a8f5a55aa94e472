"""Transformation of stamped points, poses, vectors and wrenches."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

from geometry_msgs.msg import PointStamped, PoseStamped, Vector3Stamped, WrenchStamped
from periplus import Pose
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration


def to_msg_msg(msg: Any) -> Any:
    return msg


def from_msg_msg(msg: Any) -> Any:
    return msg


def _pose_of(position: Any, rotation: Any) -> Pose:
    return Pose.from_quaternion(
        (position.x, position.y, position.z), (rotation.x, rotation.y, rotation.z, rotation.w)
    )


def _transform_of(transform: Any) -> Pose:
    return _pose_of(transform.transform.translation, transform.transform.rotation)


def _set(target: Any, values: Any) -> None:
    for name, value in zip("xyzw", values):
        setattr(target, name, float(value))


def _rotated(transform: Any, vector: Any) -> Any:
    rotation = Pose.from_quaternion((0.0, 0.0, 0.0), _transform_of(transform).quaternion)
    return rotation.transform([vector.x, vector.y, vector.z])


def do_transform_point(point: Any, transform: Any) -> Any:
    """`PointStamped` in the frame of the transform."""
    made = PointStamped()
    _set(made.point, _transform_of(transform).transform([point.point.x, point.point.y, point.point.z]))
    made.header = deepcopy(transform.header)
    return made


def do_transform_vector3(vector3: Any, transform: Any) -> Any:
    """`Vector3Stamped` in the frame of the transform; only the rotation counts."""
    made = Vector3Stamped()
    _set(made.vector, _rotated(transform, vector3.vector))
    made.header = deepcopy(transform.header)
    return made


def do_transform_pose(pose: Any, transform: Any) -> Any:
    """`PoseStamped` in the frame of the transform."""
    found = _transform_of(transform) * _pose_of(pose.pose.position, pose.pose.orientation)
    made = PoseStamped()
    _set(made.pose.position, found.position)
    _set(made.pose.orientation, found.quaternion)
    made.header = deepcopy(transform.header)
    return made


def do_transform_wrench(wrench: Any, transform: Any) -> Any:
    """`WrenchStamped` with its vectors turned into the frame of the transform."""
    made = WrenchStamped()
    _set(made.wrench.force, _rotated(transform, wrench.wrench.force))
    _set(made.wrench.torque, _rotated(transform, wrench.wrench.torque))
    made.header = deepcopy(transform.header)
    return made


for _type, _function in (
    (PointStamped, do_transform_point),
    (Vector3Stamped, do_transform_vector3),
    (PoseStamped, do_transform_pose),
    (WrenchStamped, do_transform_wrench),
):
    TransformRegistration().add(_type, _function)
    ConvertRegistration().add_to_msg(_type, to_msg_msg)
    ConvertRegistration().add_from_msg(_type, from_msg_msg)
