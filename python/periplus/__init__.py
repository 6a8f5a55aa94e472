"""Simulate mobile robots, build maps, localize and navigate, from numpy and notebooks."""

# ---- poses
from periplus._native import FileError, Pose, __version__

# ---- rays

# ---- maps

# ---- scan matching

# ---- costmap

# ---- exploration

# ---- transforms

# ---- ekf

# ---- slam

# ---- amcl

# ---- messages
from periplus._native import deserialize, serialize

# ---- bags

# ---- robot files

# ---- simulation

__all__ = [
    "FileError",
    "Pose",
    "__version__",
    "deserialize",
    "serialize",
]
