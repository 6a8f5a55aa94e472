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
from periplus._native import (
    Contact,
    Image,
    Model,
    PointCloud,
    Scan,
    Sensor,
    Simulation,
    Snapshot,
    Subscription,
    World,
)

__all__ = [
    "Contact",
    "FileError",
    "Image",
    "Model",
    "PointCloud",
    "Pose",
    "Scan",
    "Sensor",
    "Simulation",
    "Snapshot",
    "Subscription",
    "World",
    "__version__",
    "deserialize",
    "serialize",
]
