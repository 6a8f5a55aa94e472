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
from periplus._native import CellReport, Costmap, UpdateBounds

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
    "CellReport",
    "Costmap",
    "FileError",
    "Frontier",
    "MapComparison",
    "OccupancyGrid",
    "Pose",
    "RayHits",
    "RayScene",
    "ScanMatch",
    "UpdateBounds",
    "__version__",
    "frontiers",
    "inflate",
    "scan_match",
    "scan_search",
]
