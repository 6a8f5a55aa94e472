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
    "CellReport",
    "Contact",
    "Costmap",
    "FileError",
    "Frontier",
    "Image",
    "MapComparison",
    "Model",
    "OccupancyGrid",
    "PointCloud",
    "Pose",
    "RayHits",
    "RayScene",
    "Scan",
    "ScanMatch",
    "Sensor",
    "Simulation",
    "Snapshot",
    "Subscription",
    "UpdateBounds",
    "World",
    "__version__",
    "deserialize",
    "frontiers",
    "inflate",
    "scan_match",
    "scan_search",
    "serialize",
]
