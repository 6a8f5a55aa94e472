"""Rotation matrices, Euler angles and quaternions (x, y, z, w)."""

from periplus.ros._transformations import *  # noqa: F403
from periplus.ros._transformations import AXES2TUPLE as _AXES2TUPLE, TUPLE2AXES as _TUPLE2AXES  # noqa: F401
