"""Rotation matrices, Euler angles and quaternions (x, y, z, w); most quaternions are tuples, as in ROS 2."""

from __future__ import annotations

from typing import Any

from periplus.ros import _transformations as _all
from periplus.ros._transformations import *  # noqa: F403
from periplus.ros._transformations import AXES2TUPLE as _AXES2TUPLE, TUPLE2AXES as _TUPLE2AXES  # noqa: F401

_Quaternion = tuple[float, float, float, float]


def _tuple(quaternion: Any) -> _Quaternion:
    x, y, z, w = quaternion.tolist()
    return x, y, z, w


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> _Quaternion:  # type: ignore[no-redef]
    """Quaternion (x, y, z, w) of Euler angles."""
    return _tuple(_all.quaternion_from_euler(ai, aj, ak, axes))


def quaternion_about_axis(angle: float, axis: Any) -> _Quaternion:  # type: ignore[no-redef]
    """Rotation by an angle about an axis."""
    return _tuple(_all.quaternion_about_axis(angle, axis))


def quaternion_from_matrix(matrix: Any) -> _Quaternion:  # type: ignore[no-redef]
    """Quaternion (x, y, z, w) of a rotation matrix (3 x 3 or homogeneous)."""
    return _tuple(_all.quaternion_from_matrix(matrix))


def quaternion_multiply(quaternion1: Any, quaternion0: Any) -> _Quaternion:  # type: ignore[no-redef]
    """Rotation by `quaternion0`, then by `quaternion1`."""
    return _tuple(_all.quaternion_multiply(quaternion1, quaternion0))
