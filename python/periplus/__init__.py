"""Simulate mobile robots, build maps, localize and navigate, from numpy and notebooks."""

# ---- poses
from periplus._native import FileError, Pose, __version__

# ---- rays
from periplus._native import RayHits, RayScene

# ---- maps
from periplus._native import MapComparison, OccupancyGrid, inflate

# ---- scan matching
from periplus._native import ScanMatch, scan_match, scan_search

# ---- costmap

# ---- exploration
from periplus._native import Frontier, frontiers

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
    "Frontier",
    "MapComparison",
    "OccupancyGrid",
    "Pose",
    "RayHits",
    "RayScene",
    "ScanMatch",
    "__version__",
    "frontiers",
    "inflate",
    "scan_match",
    "scan_search",
]
