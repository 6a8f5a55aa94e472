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
from periplus._native import (
    Bag,
    BagMessages,
    BagTopic,
    BagWriter,
    check_bag,
    convert_bag,
    open_bag,
)

# ---- robot files
from periplus._native import Finding, check, convert, expand_xacro, load_robot

# ---- simulation

__all__ = [
    "Bag",
    "BagMessages",
    "BagTopic",
    "BagWriter",
    "FileError",
    "Finding",
    "Pose",
    "__version__",
    "check",
    "check_bag",
    "convert",
    "convert_bag",
    "deserialize",
    "expand_xacro",
    "load_robot",
    "open_bag",
    "serialize",
]
