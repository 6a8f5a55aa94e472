"""Types of arguments."""

from os import PathLike
from typing import TypeAlias, Union

from periplus._native import Pose

StrPath: TypeAlias = Union[str, "PathLike[str]"]
"""Path of a file."""

PoseLike: TypeAlias = Union[
    Pose, tuple[float, float, float], tuple[float, float, float, float, float, float]
]
"""A pose, ``(x, y, yaw)``, or ``(x, y, z, roll, pitch, yaw)`` [m, rad]."""

ParameterValue: TypeAlias = Union[
    bool, int, float, str, bytes, list[bool], list[int], list[float], list[str], None
]
"""Value of a parameter of a node; None if it is not set."""
