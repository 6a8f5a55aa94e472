"""Simulate mobile robots, build maps, localize and navigate, from numpy and notebooks."""

# ---- poses
from periplus._native import FileError, Pose, __version__

# ---- rays
from periplus._native import RayHits, RayScene

# ---- maps

# ---- scan matching

# ---- costmap

# ---- exploration

# ---- transforms

# ---- ekf

# ---- slam

# ---- amcl

# ---- messages

# ---- bags

# ---- robot files

# ---- simulation

__all__ = [
    "FileError",
    "Pose",
    "RayHits",
    "RayScene",
    "__version__",
]
