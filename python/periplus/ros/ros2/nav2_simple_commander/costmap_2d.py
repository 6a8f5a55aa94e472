"""Costmap of an occupancy grid message."""

from __future__ import annotations

from typing import Any

import numpy as np


class PyCostmap2D:
    """Costs of an `OccupancyGrid` message, by cell or by position."""

    def __init__(self, occupancy_map: Any) -> None:
        info = occupancy_map.info
        self.size_x: int = info.width
        self.size_y: int = info.height
        self.resolution: float = info.resolution
        self.origin_x: float = info.origin.position.x
        self.origin_y: float = info.origin.position.y
        self.global_frame_id: str = occupancy_map.header.frame_id
        self.costmap_timestamp = occupancy_map.header.stamp
        # -1 (unknown) becomes 255.
        self.costmap = np.array(occupancy_map.data).astype(np.uint8)

    def getSizeInCellsX(self) -> int:  # noqa: N802
        """Width [cells]."""
        return self.size_x

    def getSizeInCellsY(self) -> int:  # noqa: N802
        """Height [cells]."""
        return self.size_y

    def getSizeInMetersX(self) -> float:  # noqa: N802
        """Width between the origin and the centre of the last cell [m]."""
        return (self.size_x - 0.5) * self.resolution

    def getSizeInMetersY(self) -> float:  # noqa: N802
        """Height between the origin and the centre of the last cell [m]."""
        return (self.size_y - 0.5) * self.resolution

    def getOriginX(self) -> float:  # noqa: N802
        """Position of the first cell's corner [m]."""
        return self.origin_x

    def getOriginY(self) -> float:  # noqa: N802
        """Position of the first cell's corner [m]."""
        return self.origin_y

    def getResolution(self) -> float:  # noqa: N802
        """Size of a cell [m]."""
        return self.resolution

    def getGlobalFrameID(self) -> str:  # noqa: N802
        """Frame of the costmap."""
        return self.global_frame_id

    def getCostmapTimestamp(self) -> Any:  # noqa: N802
        """Time of the costmap."""
        return self.costmap_timestamp

    def getCostXY(self, mx: int, my: int) -> np.uint8:  # noqa: N802
        """Cost of a cell."""
        return self.costmap[self.getIndex(mx, my)]  # type: ignore[no-any-return]

    def getCostIdx(self, index: int) -> np.uint8:  # noqa: N802
        """Cost of a cell by its index."""
        return self.costmap[index]  # type: ignore[no-any-return]

    def setCost(self, mx: int, my: int, cost: int) -> None:  # noqa: N802
        """Sets the cost of a cell."""
        self.costmap[self.getIndex(mx, my)] = cost

    def mapToWorld(self, mx: int, my: int) -> tuple[float, float]:  # noqa: N802
        """Position of the centre of a cell [m]."""
        return self.origin_x + (mx + 0.5) * self.resolution, self.origin_y + (my + 0.5) * self.resolution

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:  # noqa: N802
        """Cell of a position [m]; (None, None) outside of the costmap."""
        if wx < self.origin_x or wy < self.origin_y:
            return None, None
        mx, my = int((wx - self.origin_x) / self.resolution), int((wy - self.origin_y) / self.resolution)
        return (mx, my) if mx < self.size_x and my < self.size_y else (None, None)

    def getIndex(self, mx: int, my: int) -> int:  # noqa: N802
        """Index of a cell."""
        return my * self.size_x + mx
