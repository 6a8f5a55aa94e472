"""Rotation matrices, Euler angles and quaternions (x, y, z, w), as 4x4 matrices and arrays of numpy."""

from __future__ import annotations

from typing import Any

import numpy
from periplus.ros._transformations import *  # noqa: F403
from periplus.ros._transformations import AXES2TUPLE as _AXES2TUPLE  # noqa: F401
from periplus.ros._transformations import TUPLE2AXES as _TUPLE2AXES  # noqa: F401


def quaternion_real(quaternion: Any) -> float:
    """Real part of a quaternion."""
    return float(quaternion[3])


def quaternion_imag(quaternion: Any) -> Any:
    """Imaginary part of a quaternion."""
    return numpy.array(quaternion[:3], dtype=numpy.float64)
