"""Pictures of environments from above."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from periplus._native import NavigationBatch

Picture: TypeAlias = npt.NDArray[np.uint8]

WIDTH_PX = 480
FREE_COLOUR = (245, 245, 242)
OBSTACLE_COLOUR = (70, 75, 85)
GOAL_COLOUR = (60, 160, 90)
ROBOT_COLOURS = ((40, 110, 200), (210, 110, 40), (140, 80, 180), (200, 60, 90), (60, 150, 160))


def checked_render_mode(render_mode: str | None) -> str | None:
    """The render mode, if environments have it."""
    if render_mode not in (None, "rgb_array"):
        raise ValueError(f'`render_mode` must be None or "rgb_array", not {render_mode!r}')
    return render_mode


class Painter:
    """Draws environments of a batch; the obstacles of each world are drawn once."""

    def __init__(self, batch: NavigationBatch) -> None:
        self._batch = batch
        self._worlds: dict[str, tuple[Picture, list[float], float]] = {}

    def paint(
        self,
        environment: int,
        rows: Sequence[int],
        poses: Sequence[Sequence[float]] | None = None,
        goals: Sequence[Sequence[float]] | None = None,
    ) -> Picture:
        """Picture of an environment with the robots of these rows and their goals, or with others in their stead."""
        background, low, pixel_m = self._world(environment)
        picture: Picture = background.copy()
        height, width = picture.shape[:2]
        # Centres of the pixels in the world.
        xs = low[0] + (np.arange(width) + 0.5) * pixel_m
        ys = low[1] + (np.arange(height)[::-1] + 0.5) * pixel_m
        poses = self._batch.poses().tolist() if poses is None else poses
        goals = self._batch.goals().tolist() if goals is None else goals
        footprint = self._batch.footprint
        for index, row in enumerate(rows):
            colour = ROBOT_COLOURS[index % len(ROBOT_COLOURS)]
            goal_x, goal_y = goals[row]
            ring = np.hypot(xs[None, :] - goal_x, ys[:, None] - goal_y)
            picture[ring < max(0.15, 2.0 * pixel_m)] = GOAL_COLOUR if len(rows) == 1 else colour
            x, y, yaw = poses[row]
            ahead = (xs[None, :] - x) * np.cos(yaw) + (ys[:, None] - y) * np.sin(yaw)
            left = (ys[:, None] - y) * np.cos(yaw) - (xs[None, :] - x) * np.sin(yaw)
            if isinstance(footprint, float):
                inside, reach = np.hypot(ahead, left) < footprint, footprint
            else:
                inside, reach = contains(footprint, ahead, left), float(footprint[:, 0].max())
            picture[inside] = colour
            picture[inside & (ahead > 0.0) & (ahead < reach) & (np.abs(left) < 0.75 * pixel_m)] = (255, 255, 255)
        return picture

    def _world(self, environment: int) -> tuple[Picture, list[float], float]:
        name = self._batch.world_name(environment)
        if name not in self._worlds:
            mask, low, pixel_m = self._batch.picture(environment, WIDTH_PX)
            colours = np.array([FREE_COLOUR, OBSTACLE_COLOUR], np.uint8)
            self._worlds[name] = (colours[mask], list(low), pixel_m)
        return self._worlds[name]


def contains(
    corners: npt.NDArray[np.float64], x: npt.NDArray[np.float64], y: npt.NDArray[np.float64]
) -> npt.NDArray[np.bool_]:
    """Points inside a simple polygon, by the number of sides that a ray along x crosses."""
    inside = np.zeros(np.broadcast(x, y).shape, np.bool_)
    for (ax, ay), (bx, by) in zip(corners, np.roll(corners, -1, axis=0)):
        if ay != by:
            inside ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) / (by - ay) * (bx - ax))
    return inside
