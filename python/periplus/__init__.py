"""Simulate mobile robots, build maps, localize and navigate, from numpy and notebooks."""

from periplus import _native
from periplus._native import FileError, Pose, __version__

# Importing `typing` takes as long as everything else here.
TYPE_CHECKING = False
if TYPE_CHECKING:
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
    "Amcl",
    "AmclEstimate",
    "Bag",
    "BagMessages",
    "BagTopic",
    "BagWriter",
    "CellReport",
    "Contact",
    "Costmap",
    "Ekf",
    "EkfEstimate",
    "FileError",
    "Finding",
    "Frontier",
    "Image",
    "LaserScanner",
    "MapComparison",
    "Model",
    "OccupancyGrid",
    "PointCloud",
    "Pose",
    "PoseGraph",
    "RayHits",
    "RayScene",
    "Scan",
    "ScanMatch",
    "Sensor",
    "Simulation",
    "Slam",
    "SlamRemark",
    "SlamUpdate",
    "Snapshot",
    "Subscription",
    "TfBuffer",
    "TransformArgumentError",
    "TransformConnectivityError",
    "TransformError",
    "TransformExtrapolationError",
    "TransformLookupError",
    "UpdateBounds",
    "World",
    "__version__",
    "check",
    "check_bag",
    "convert",
    "convert_bag",
    "deserialize",
    "expand_xacro",
    "frontiers",
    "inflate",
    "load_robot",
    "open_bag",
    "scan_match",
    "scan_search",
    "serialize",
]


def __getattr__(name: str) -> object:
    # What works with arrays is loaded on first use, together with numpy: nodes and commands start without it.
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    _native.load_numpy()
    globals().update({other: getattr(_native, other) for other in __all__})
    return globals()[name]


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
