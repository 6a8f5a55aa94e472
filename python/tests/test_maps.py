"""Maps: cells, files, distances, comparison, inflation, and wrong arguments."""

import math
import pickle
from pathlib import Path

import numpy as np
import periplus
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from periplus import OccupancyGrid, inflate

CELLS = np.array([[0, 0, 100, -1], [0, 100, 100, -1]], np.int8)


def room() -> OccupancyGrid:
    cells = np.full((60, 80), -1, np.int8)
    cells[5:50, 10:70] = 0
    cells[5, 10:70] = cells[49, 10:70] = cells[5:50, 10] = cells[5:30, 40] = 100
    return OccupancyGrid(cells, 0.1, (-1.0, 2.0, 0.0))


def test_cells_are_a_view_without_a_copy() -> None:
    grid = OccupancyGrid(CELLS, 0.5)
    cells = grid.cells
    assert cells.dtype == np.int8 and not cells.flags.writeable
    assert cells.ctypes.data == grid.cells.ctypes.data
    np.testing.assert_array_equal(cells, CELLS)
    del grid
    np.testing.assert_array_equal(cells, CELLS)


def test_properties_equality_and_pickles() -> None:
    grid = OccupancyGrid(CELLS.tolist(), 0.5, (1, 2, 0.3))
    assert (grid.height, grid.width, grid.resolution_m, grid.origin) == (2, 4, 0.5, (1.0, 2.0, 0.3))
    assert grid == OccupancyGrid(CELLS, 0.5, periplus.Pose(1, 2, yaw=0.3)) or grid.origin[2] != 0.3
    assert grid == pickle.loads(pickle.dumps(grid))
    assert grid != OccupancyGrid(CELLS, 0.25, (1, 2, 0.3))
    assert (grid == 3) is False
    with pytest.raises(TypeError):
        hash(grid)


@pytest.mark.parametrize("image_format", ["pgm", "png", "bmp"])
@pytest.mark.parametrize("distro", ["noetic", "humble", "jazzy"])
def test_files_round_trip(tmp_path: Path, image_format: str, distro: str) -> None:
    if distro == "noetic" and image_format != "pgm":
        return
    grid = OccupancyGrid(CELLS, 0.5, (-1, 2.5, 0))
    file = grid.save(tmp_path / "map.yaml", distro=distro, image_format=image_format, free_thresh=0.19)
    assert file == tmp_path / "map.yaml"
    assert (tmp_path / f"map.{image_format}").exists()
    assert OccupancyGrid.load(file, distro=distro) == grid
    assert OccupancyGrid.load(str(file), distro) == grid


def test_files_with_the_defaults_keep_the_map(tmp_path: Path) -> None:
    grid = OccupancyGrid(CELLS, 0.5)
    assert OccupancyGrid.load(grid.save(tmp_path / "map")) == grid


def test_an_image_alone_is_loaded(tmp_path: Path) -> None:
    OccupancyGrid(CELLS, 0.5).save(tmp_path / "map")
    grid = OccupancyGrid.load(tmp_path / "map.pgm", resolution_m=0.25)
    assert grid.resolution_m == 0.25 and grid.cells[0, 2] == 100


def test_broken_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        OccupancyGrid.load(tmp_path / "none.yaml")
    file = tmp_path / "map.yaml"
    file.write_text("image: map.pgm\nresolution: big\norigin: [0, 0, 0]\n")
    with pytest.raises(periplus.FileError) as error:
        OccupancyGrid.load(file)
    assert error.value.line == 2
    assert error.value.file is not None and error.value.file.endswith("map.yaml")
    with pytest.raises(OSError):
        OccupancyGrid(CELLS, 0.5).save(tmp_path / "no" / "folder")


def test_cells_and_points() -> None:
    grid = OccupancyGrid(CELLS, 0.5, (10.0, 20.0, 0.0))
    cells = [[0, 0], [3, 1]]
    points = grid.world_from_cell(cells)
    np.testing.assert_allclose(points, [[10.25, 20.25], [11.75, 20.75]])
    np.testing.assert_array_equal(grid.cell_from_world(points), cells)
    assert grid.cell_from_world([9.9, 20.0]).tolist() == [-1, -1]
    assert grid.cell_from_world([math.nan, 20.0]).tolist() == [-1, -1]
    turned = OccupancyGrid(CELLS, 1.0, (0.0, 0.0, math.pi / 2))
    np.testing.assert_allclose(turned.world_from_cell([3, 1]), [-1.5, 3.5])


def test_distances_equal_brute_force() -> None:
    random = np.random.default_rng(0)
    cells = np.where(random.random((20, 31)) < 0.05, 100, 0).astype(np.int8)
    distances = OccupancyGrid(cells, 0.1).distances()
    walls = np.argwhere(cells == 100)
    rows, columns = np.asarray(np.indices(cells.shape))
    expected = np.sqrt((rows[..., None] - walls[:, 0]) ** 2 + (columns[..., None] - walls[:, 1]) ** 2).min(-1)
    np.testing.assert_allclose(distances, 0.1 * expected)
    assert np.all(np.isinf(OccupancyGrid([[0]], 0.1).distances()))


def test_maps_are_compared() -> None:
    first = room()
    same = first.diff(first)
    assert same.walls["iou"] == same.free["iou"] == same.known["iou"] == 1.0
    assert same.first_to_other["max_m"] == 0.0
    moved = OccupancyGrid(first.cells, 0.1, (-0.7, 1.8, 0.0))
    diff = first.diff(moved)
    np.testing.assert_allclose(diff.alignment, (-0.3, 0.2, 0.0), atol=0.05)
    assert diff.score > 0.9 and diff.walls_nearby["iou"] > 0.95
    apart = first.diff(moved, align=False)
    assert math.isnan(apart.score) and apart.walls["iou"] < 0.5
    assert apart.image.shape[2] == 3 and apart.image.dtype == np.uint8
    assert (apart._repr_png_() or b"").startswith(b"\x89PNG")


def test_pictures() -> None:
    assert (room()._repr_png_() or b"").startswith(b"\x89PNG")
    assert "data:image/png;base64," in room()._repr_html_()
    assert OccupancyGrid(np.zeros((0, 4), np.int8), 0.1)._repr_png_() is None
    assert "OccupancyGrid(60 x 80" in repr(room())


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: OccupancyGrid([1, 2], 0.1), ValueError, "cells"),
        (lambda: OccupancyGrid([[0.5]], 0.1), TypeError, "integers"),
        (lambda: OccupancyGrid([[200]], 0.1), ValueError, "-128 to 127"),
        (lambda: OccupancyGrid(np.array([[255]], np.uint8), 0.1), ValueError, "255"),
        (lambda: OccupancyGrid("map", 0.1), TypeError, "integers"),
        (lambda: OccupancyGrid(CELLS, 0.0), ValueError, "resolution"),
        (lambda: OccupancyGrid(CELLS, math.nan), ValueError, "resolution"),
        (lambda: OccupancyGrid(CELLS, 0.1, (math.inf, 0, 0)), ValueError, "finite"),
        (lambda: OccupancyGrid(CELLS, 0.1, 3), TypeError, "origin"),  # type: ignore[arg-type]
        (lambda: OccupancyGrid.load("x", "gazebo"), ValueError, "distro"),
        (lambda: room().save("x", mode="nice"), ValueError, "mode"),
        (lambda: room().save("x", image_format="gif"), ValueError, "image_format"),
        (lambda: room().save("x", free_thresh=0.9), ValueError, "thresholds"),
        (lambda: room().cell_from_world([1, 2, 3]), ValueError, "points"),
        (lambda: room().distances(2.0), ValueError, "occupied_thresh"),
        (lambda: room().diff(room(), window_m=-1.0), ValueError, "window_m"),
        (lambda: inflate([[300]], 0.1, 0.1), ValueError, "costs"),
        (lambda: inflate([[0]], 0.1, math.nan), ValueError, "inscribed_radius_m"),
        (lambda: inflate([[0]], -0.1, 0.1), ValueError, "resolution"),
        (lambda: inflate([0], 0.1, 0.1), ValueError, "costs"),
    ],
)
def test_wrong_arguments(make, error, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error, match=words):
        make()


def test_inflation_is_that_of_nav2() -> None:
    costs = np.zeros((21, 21), np.uint8)
    costs[10, 10] = 254
    costs[0, 0] = 255
    inflated = inflate(costs, 0.1, 0.25, inflation_radius=0.8, cost_scaling_factor=3.0)
    rows, columns = np.indices(costs.shape)
    distance = 0.1 * np.round(100 * np.hypot(rows - 10, columns - 10)) / 100
    expected = np.where(distance <= 0.25, 253, 252 * np.exp(-3.0 * (distance - 0.25)))
    expected = np.where(distance > 0.8 + 1e-9, 0, expected).astype(np.uint8)
    expected[10, 10], expected[0, 0] = 254, 255
    np.testing.assert_array_equal(inflated, expected)
    assert costs[10, 11] == 0, "the input stays"
    assert inflate(np.zeros((0, 3), np.uint8), 0.1, 0.1).shape == (0, 3)


@settings(max_examples=60, deadline=None)
@given(
    cells=hnp.arrays(
        dtype=st.sampled_from([np.int8, np.uint8, np.int32, np.float32, np.uint64, np.bool_]),
        shape=hnp.array_shapes(min_dims=0, max_dims=3, max_side=7),
    ),
    step=st.sampled_from([1, 2, -1]),
    resolution=st.floats(allow_nan=True, allow_infinity=True),
)
def test_any_cells_end_in_a_map_or_a_clear_error(cells: np.ndarray, step: int, resolution: float) -> None:
    cells = cells[..., ::step] if cells.ndim else cells
    try:
        grid = OccupancyGrid(cells, resolution)
    except (ValueError, TypeError):
        return
    np.testing.assert_array_equal(grid.cells, cells.astype(np.int64))
    assert grid.distances().shape == cells.shape
