"""Transformation of `geometry_msgs`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PolygonStamped,
    Pose,
    PoseStamped,
    PoseWithCovarianceStamped,
    TransformStamped,
    Vector3Stamped,
    WrenchStamped,
)
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration

_Quaternion = tuple[float, float, float, float]
_Vector = tuple[float, float, float]


def to_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def from_msg_msg(msg: Any) -> Any:
    """The message itself."""
    return msg


def _parts(transform: Any) -> tuple[_Quaternion, _Vector]:
    rotation, translation = transform.transform.rotation, transform.transform.translation
    return (rotation.x, rotation.y, rotation.z, rotation.w), (translation.x, translation.y, translation.z)


def _rotate(q: _Quaternion, v: _Vector) -> _Vector:
    """Vector rotated by a unit quaternion."""
    x, y, z, w = q
    tx, ty, tz = 2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]), 2 * (x * v[1] - y * v[0])
    return (
        v[0] + w * tx + y * tz - z * ty,
        v[1] + w * ty + z * tx - x * tz,
        v[2] + w * tz + x * ty - y * tx,
    )


def _move(q: _Quaternion, t: _Vector, point: Any) -> _Vector:
    x, y, z = _rotate(q, (point.x, point.y, point.z))
    return x + t[0], y + t[1], z + t[2]


def _multiply(a: _Quaternion, b: _Quaternion) -> _Quaternion:
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def do_transform_point(point: PointStamped, transform: TransformStamped) -> PointStamped:
    """Point in the frame of the transform."""
    made = PointStamped(header=transform.header)
    made.point.x, made.point.y, made.point.z = _move(*_parts(transform), point.point)
    return made


def do_transform_vector3(vector3: Vector3Stamped, transform: TransformStamped) -> Vector3Stamped:
    """Vector in the frame of the transform: rotated, but not moved."""
    vector = vector3.vector
    made = Vector3Stamped(header=transform.header)
    rotated = _rotate(_parts(transform)[0], (vector.x, vector.y, vector.z))
    made.vector.x, made.vector.y, made.vector.z = rotated
    return made


def do_transform_pose(pose: Pose, transform: TransformStamped) -> Pose:
    """Pose (without a header) in the frame of the transform."""
    if hasattr(pose, "header"):
        raise TypeError(
            f"do_transform_pose takes a geometry_msgs.msg.Pose, not a {type(pose).__name__}: "
            "use do_transform_pose_stamped for a PoseStamped"
        )
    rotation, translation = _parts(transform)
    made = Pose()
    made.position.x, made.position.y, made.position.z = _move(rotation, translation, pose.position)
    given = pose.orientation
    turned = _multiply(rotation, (given.x, given.y, given.z, given.w))
    if turned[3] < 0.0:
        turned = (-turned[0], -turned[1], -turned[2], -turned[3])
    made.orientation.x, made.orientation.y, made.orientation.z, made.orientation.w = turned
    return made


def do_transform_pose_stamped(pose: PoseStamped, transform: TransformStamped) -> PoseStamped:
    """Pose in the frame of the transform."""
    return PoseStamped(header=transform.header, pose=do_transform_pose(pose.pose, transform))


def transform_covariance(cov_in: Sequence[float], transform: TransformStamped) -> Any:
    """Covariance (6 x 6, row by row) of a pose in the frame of the transform."""
    import numpy as np

    rotation = _parts(transform)[0]
    columns = [_rotate(rotation, axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    both = np.zeros((6, 6))
    both[:3, :3] = both[3:, 3:] = np.array(columns).T
    covariance = np.asarray(cov_in, dtype=np.float64).reshape(6, 6)
    return (both @ covariance @ both.T).reshape(36)


def do_transform_pose_with_covariance_stamped(
    pose: PoseWithCovarianceStamped, transform: TransformStamped
) -> PoseWithCovarianceStamped:
    """Pose with its covariance in the frame of the transform."""
    made = PoseWithCovarianceStamped(header=transform.header)
    made.pose.pose = do_transform_pose(pose.pose.pose, transform)
    made.pose.covariance = transform_covariance(pose.pose.covariance, transform)
    return made


def do_transform_polygon_stamped(polygon: PolygonStamped, transform: TransformStamped) -> PolygonStamped:
    """Polygon in the frame of the transform."""
    parts = _parts(transform)
    made = PolygonStamped(header=transform.header)
    for point in polygon.polygon.points:
        x, y, z = _move(*parts, point)
        made.polygon.points.append(Point32(x=x, y=y, z=z))
    return made


def do_transform_wrench(wrench: WrenchStamped, transform: TransformStamped) -> WrenchStamped:
    """Force and torque in the frame of the transform: rotated, but not moved."""
    rotation = _parts(transform)[0]
    made = WrenchStamped(header=transform.header)
    for name in ("force", "torque"):
        given, target = getattr(wrench.wrench, name), getattr(made.wrench, name)
        target.x, target.y, target.z = _rotate(rotation, (given.x, given.y, given.z))
    return made


for _type, _function in (
    (PointStamped, do_transform_point),
    (Vector3Stamped, do_transform_vector3),
    (PoseStamped, do_transform_pose_stamped),
    (PoseWithCovarianceStamped, do_transform_pose_with_covariance_stamped),
    (PolygonStamped, do_transform_polygon_stamped),
    (WrenchStamped, do_transform_wrench),
):
    TransformRegistration().add(_type, _function)
    ConvertRegistration().add_to_msg(_type, to_msg_msg)
    ConvertRegistration().add_from_msg(_type, from_msg_msg)
