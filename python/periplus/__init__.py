"""Simulate mobile robots, build maps, localize and navigate, from numpy and notebooks."""

# ---- poses
from periplus._native import FileError, Pose, __version__

# ---- rays

# ---- maps

# ---- scan matching

# ---- costmap

# ---- exploration

# ---- transforms
from periplus._native import (
    TfBuffer,
    TransformArgumentError,
    TransformConnectivityError,
    TransformError,
    TransformExtrapolationError,
    TransformLookupError,
)

# ---- ekf
from periplus._native import Ekf, EkfEstimate

# ---- slam
from periplus._native import LaserScanner, PoseGraph, Slam, SlamRemark, SlamUpdate

# ---- amcl
from periplus._native import Amcl, AmclEstimate

# ---- messages

# ---- bags

# ---- robot files

# ---- simulation

__all__ = [
    "Amcl",
    "AmclEstimate",
    "Ekf",
    "EkfEstimate",
    "FileError",
    "LaserScanner",
    "Pose",
    "PoseGraph",
    "Slam",
    "SlamRemark",
    "SlamUpdate",
    "TfBuffer",
    "TransformArgumentError",
    "TransformConnectivityError",
    "TransformError",
    "TransformExtrapolationError",
    "TransformLookupError",
    "__version__",
]
