"""Frontiers: rooms whose frontiers can be seen, and wrong arguments."""

import math

import numpy as np
import pytest
from periplus import OccupancyGrid, Pose, frontiers


def half_room() -> OccupancyGrid:
    cells = np.full((10, 40), -1, np.int8)
    cells[:, :20] = 0
    return OccupancyGrid(cells, 0.1, (1.0, 0.0, 0.0))


def test_the_edge_of_explored_space_is_a_frontier() -> None:
    (frontier,) = frontiers(half_room(), Pose(1.5, 0.55))
    assert frontier.cell[0] == 19
    assert abs(frontier.position[0] - 2.95) < 1e-9
    assert abs(frontier.length_m - 1.0) < 1e-9
    assert abs(frontier.cost_m - 1.4) < 1e-9
    assert frontier.path.shape == (14, 2)
    np.testing.assert_allclose(frontier.path[-1], frontier.position)
    assert "Frontier(" in repr(frontier)


def test_walls_hide_frontiers() -> None:
    cells = half_room().cells.copy()
    cells[:, 15] = 100
    assert frontiers(OccupancyGrid(cells, 0.1), (0.5, 0.5, 0)) == []


def test_narrow_gaps_need_small_robots() -> None:
    cells = np.full((20, 40), -1, np.int8)
    cells[:, :20] = 0
    cells[:, 15] = 100
    cells[8:12, 15] = 0
    grid = OccupancyGrid(cells, 0.1)
    assert frontiers(grid, (0.7, 1.0, 0), radius_m=0.3) == []
    assert len(frontiers(grid, (0.7, 1.0, 0), radius_m=0.1)) == 1
    assert frontiers(grid, (0.7, 1.0, 0), radius_m=0.1, min_length_m=5.0) == []


def test_the_cheapest_comes_first() -> None:
    cells = np.zeros((20, 40), np.int8)
    cells[:, 0] = cells[:, 39] = -1
    costs = [one.cost_m for one in frontiers(OccupancyGrid(cells, 0.1), (1.0, 1.0, 0))]
    assert len(costs) == 2 and costs == sorted(costs)


@pytest.mark.parametrize(
    ("run", "error", "words"),
    [
        (lambda: frontiers(half_room(), (99, 0, 0)), ValueError, "outside"),
        (lambda: frontiers(half_room(), (math.nan, 0, 0)), ValueError, "finite"),
        (lambda: frontiers(half_room(), (1.5, 0.5, 0), radius_m=-1.0), ValueError, "radius_m"),
        (lambda: frontiers(np.zeros((3, 3)), (0, 0, 0)), TypeError, "grid"),  # type: ignore[arg-type]
        (lambda: frontiers(half_room(), "here"), TypeError, "robot_pose"),  # type: ignore[arg-type]
    ],
)
def test_wrong_arguments(run, error, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error, match=words):
        run()
