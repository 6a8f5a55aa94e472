"""What the environments of one robot have in common."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import numpy.typing as npt

from periplus import LaserScanner, OccupancyGrid
from periplus._native import NavigationBatch
from periplus.gym.settings import grid_of


class SingleEnv(gymnasium.Env[Any, Any]):
    """Environment of one robot with a lidar: base of :class:`NavigateEnv` and :class:`NavigateSimulationEnv`.

    >>> from periplus.gym import NavigateEnv
    >>> env = NavigateEnv(world="rooms", robot={"radius": 0.25, "lidar_max_range": 8.0})
    >>> env.footprint, env.laser_scanner.range_max
    (0.25, 8.0)
    """

    _batch: NavigationBatch
    _scanner: LaserScanner
    _normalizes: bool

    @property
    def laser_scanner(self) -> LaserScanner:
        """Geometry of the lidar."""
        return self._scanner

    @property
    def is_normalized(self) -> bool:
        """True if observations are scaled to -1..1."""
        return self._normalizes

    @property
    def step_period(self) -> float:
        """Time between two actions [s]."""
        return self._batch.step_period

    @property
    def footprint(self) -> npt.NDArray[np.float64] | float:
        """Corners of the footprint in the base frame [m], shape (N, 2), or the radius of a circle [m]."""
        return self._batch.footprint

    def map(self, resolution: float = 0.05) -> OccupancyGrid:
        """Map of the obstacles of this episode's world; the inside of obstacles is unknown."""
        return grid_of(self._batch, 0, resolution)
