"""Poses between messages, transforms and the frames of KDL."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import Point, Pose, Quaternion
from PyKDL import Frame, Rotation, Vector


def fromTf(tf: Any) -> Frame:  # noqa: N802
    """Frame of a position and a quaternion, as `lookupTransform` returns them."""
    position, quaternion = tf
    return Frame(Rotation.Quaternion(*quaternion), Vector(*position))


def toTf(f: Frame) -> tuple[tuple[float, ...], tuple[float, ...]]:  # noqa: N802
    """Position and quaternion of a frame."""
    return tuple(f.p), f.M.GetQuaternion()


def fromMsg(p: Any) -> Frame:  # noqa: N802
    """Frame of a `Pose`."""
    turn, place = p.orientation, p.position
    return Frame(Rotation.Quaternion(turn.x, turn.y, turn.z, turn.w), Vector(place.x, place.y, place.z))


def toMsg(f: Frame) -> Any:  # noqa: N802
    """`Pose` of a frame."""
    x, y, z, w = f.M.GetQuaternion()
    return Pose(position=Point(x=f.p[0], y=f.p[1], z=f.p[2]), orientation=Quaternion(x=x, y=y, z=z, w=w))


def fromMatrix(m: Any) -> Frame:  # noqa: N802
    """Frame of a 4x4 matrix."""
    turn = Rotation(*(m[row][column] for row in range(3) for column in range(3)))
    return Frame(turn, Vector(*(m[row][3] for row in range(3))))


def toMatrix(f: Frame) -> Any:  # noqa: N802
    """4x4 matrix of a frame."""
    import numpy as np

    rows = [[f[row, column] for column in range(4)] for row in range(3)]
    return np.array([*rows, [0.0, 0.0, 0.0, 1.0]])
