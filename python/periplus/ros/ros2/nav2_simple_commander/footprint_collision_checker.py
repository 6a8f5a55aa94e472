"""Costs under a robot's footprint."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Point32, Polygon

from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.line_iterator import LineIterator

NO_INFORMATION = 255
LETHAL_OBSTACLE = 254
INSCRIBED_INFLATED_OBSTACLE = 253
MAX_NON_OBSTACLE = 252
FREE_SPACE = 0


class FootprintCollisionChecker:
    """Looks up the highest cost on the border of a footprint."""

    def __init__(self) -> None:
        self.costmap_: PyCostmap2D | None = None

    def _costmap(self) -> PyCostmap2D:
        if self.costmap_ is None:
            raise ValueError("Costmap not specified, use setCostmap to specify the costmap first")
        return self.costmap_

    def setCostmap(self, costmap: PyCostmap2D) -> None:  # noqa: N802
        """Sets the costmap."""
        self.costmap_ = costmap

    def footprintCost(self, footprint: Polygon) -> float:  # noqa: N802
        """Highest cost on the border of a polygon; lethal if it leaves the costmap."""
        cells: list[Any] = [self.worldToMapValidated(point.x, point.y) for point in footprint.points]
        if any(cell[0] is None or cell[1] is None for cell in cells):
            return float(LETHAL_OBSTACLE)
        cost = 0.0
        for (x0, y0), (x1, y1) in zip(cells, cells[1:] + cells[:1]):
            cost = max(self.lineCost(x0, x1, y0, y1), cost)
            if cost == LETHAL_OBSTACLE:
                break
        return cost

    def lineCost(self, x0: float, x1: float, y0: float, y1: float, step_size: float = 0.5) -> float:  # noqa: N802
        """Highest cost on a line between cells."""
        if x0 == x1 and y0 == y1:
            return self.pointCost(int(x0), int(y0))
        cost = 0.0
        line = LineIterator(x0, y0, x1, y1, step_size)
        while line.isValid():
            cost = max(self.pointCost(int(line.getX()), int(line.getY())), cost)
            if cost == LETHAL_OBSTACLE:
                break
            line.advance()
        return cost

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:  # noqa: N802
        """Cell of a position [m]; (None, None) outside of the costmap."""
        return self._costmap().worldToMapValidated(wx, wy)

    def pointCost(self, x: int, y: int) -> float:  # noqa: N802
        """Cost of a cell."""
        return float(self._costmap().getCostXY(x, y))

    def footprintCostAtPose(self, x: float, y: float, theta: float, footprint: Polygon) -> float:  # noqa: N802
        """Highest cost on the border of a footprint at a pose [m, rad]."""
        cosine, sine = math.cos(theta), math.sin(theta)
        moved = Polygon(
            points=[
                Point32(x=x + point.x * cosine - point.y * sine, y=y + point.x * sine + point.y * cosine)
                for point in footprint.points
            ]
        )
        return self.footprintCost(moved)
