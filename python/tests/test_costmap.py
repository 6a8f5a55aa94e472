"""Costmaps: layers of Nav2 and layers written in Python, parameters, errors."""

import math
import threading
import traceback
from pathlib import Path
from typing import Any

import numpy as np
import periplus
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from periplus import Costmap, OccupancyGrid, Pose

OBSTACLES = {
    "plugin": "nav2_costmap_2d::ObstacleLayer",
    "observation_sources": "scan",
    "scan": {"max_obstacle_height": 2.0, "clearing": True},
}
INFLATION = {"plugin": "nav2_costmap_2d::InflationLayer", "inflation_radius": 0.6, "cost_scaling_factor": 3.0}
STATIC = {"plugin": "nav2_costmap_2d::StaticLayer"}

YAML = """
local_costmap:
  local_costmap:
    ros__parameters:
      rolling_window: true
      width: 4
      height: 4
      resolution: 0.05
      robot_radius: 0.2
      plugins: [obstacle_layer, inflation_layer]
      obstacle_layer:
        plugin: 'nav2_costmap_2d::ObstacleLayer'
        observation_sources: scan
        scan: {max_obstacle_height: 2.0, clearing: true}
      inflation_layer:
        plugin: 'nav2_costmap_2d::InflationLayer'
        inflation_radius: 0.6
        cost_scaling_factor: 3.0
"""


def local(**more: Any) -> Costmap:
    settings: dict[str, Any] = {
        "width": 4,
        "height": 4,
        "resolution": 0.05,
        "rolling_window": True,
        "robot_radius": 0.2,
        "plugins": ["obstacle_layer", "inflation_layer"],
        "obstacle_layer": OBSTACLES,
        "inflation_layer": INFLATION,
    }
    return Costmap(**(settings | more))


def see(costmap: Costmap) -> None:
    costmap.observe("obstacle_layer", "scan", [[1.0, 0.0, 0.0]], (0, 0, 0.2, 0, 0, 0), 1.0)
    costmap.update(1.0, (0, 0, 0))


def test_an_obstacle_is_marked_inflated_and_explained() -> None:
    costmap = local()
    see(costmap)
    costs = costmap.cost_at([[1.0, 0.0], [0.9, 0.0], [0.6, 0.0], [0.2, 0.0], [9.0, 0.0]])
    assert costs[[0, 1, 3, 4]].tolist() == [254, 253, 0, 254] and 0 < costs[2] < 253
    assert costmap.costs.shape == (80, 80) and costmap.costs.dtype == np.uint8
    report = costmap.explain(1.0, 0.0)
    assert report.cost == 254 and "scan" in str(report)
    cause = report.layers[0]["cause"]
    assert cause["source"] == "scan" and cause["is_mark"] and cause["time_s"] == 1.0
    assert costmap.cost_at([0.8, 0.0, 0.0], footprint=True) == 254
    assert costmap.cost_at([0.0, 0.0, 0.5], footprint=True) == 0


def test_yaml_and_code_give_the_same(tmp_path: Path) -> None:
    file = tmp_path / "nav2.yaml"
    file.write_text(YAML)
    of_code = local()
    see(of_code)
    for costmap in (Costmap.from_yaml(file, "local_costmap"), Costmap.from_text(YAML)):
        see(costmap)
        np.testing.assert_array_equal(costmap.costs, of_code.costs)
        assert costmap.parameters == of_code.parameters
        assert costmap.layers == ["obstacle_layer", "inflation_layer"]


def test_scans_and_ranges() -> None:
    costmap = local(plugins=["obstacle_layer"])
    ranges = np.full(4, 1.02, np.float32)
    ranges[2] = np.nan
    costmap.observe_scan("obstacle_layer", "scan", ranges, 0.0, math.pi / 2, 0.1, 10.0, Pose(0, 0, 0.2))
    costmap.update(0.0, (0, 0, 0))
    assert (costmap.costs == 254).sum() == 3
    sonar = {"plugin": "nav2_costmap_2d::RangeSensorLayer", "topics": ["/sonar"]}
    costmap = local(plugins=["sonar"], sonar=sonar)
    for _ in range(5):
        costmap.observe_range("sonar", 1.0, 0.1, 3.0, 0.3, (0, 0, 0))
        costmap.update(0.0, (0, 0, 0))
    assert costmap.cost_at([1.0, 0.0]) > 200


def test_a_static_map_sets_the_size() -> None:
    costmap = Costmap(plugins=["static_layer"], static_layer=STATIC, track_unknown_space=True)
    costmap.set_map(OccupancyGrid([[0, 100, -1]], 0.5, (3, 4, 0)))
    assert costmap.update() == (0, 0, 3, 1)
    assert costmap.costs.tolist() == [[0, 254, 255]]
    assert (costmap.resolution_m, costmap.origin) == (0.5, (3.0, 4.0))
    assert costmap.to_grid() == OccupancyGrid([[0, 100, -1]], 0.5, (3, 4, 0))
    with pytest.raises(KeyError, match="no static layer"):
        local().set_map(OccupancyGrid([[0]], 0.5))


def test_costs_are_kept_by_their_array() -> None:
    costmap = local()
    see(costmap)
    before = costmap.costs
    assert before.ctypes.data == costmap.costs.ctypes.data and not before.flags.writeable
    copy = before.copy()
    costmap.reset()
    assert not costmap.costs.any()
    del costmap
    np.testing.assert_array_equal(before, copy)


def test_clearing() -> None:
    costmap = local()
    see(costmap)
    costmap.clear(around=(-1.0, 0.0, 0.5))
    costmap.update(1.0, (0, 0, 0))
    assert costmap.cost_at([1.0, 0.0]) == 254
    costmap.clear(["obstacle_layer"])
    costmap.update(1.0, (0, 0, 0))
    with pytest.raises(ValueError, match="no layer"):
        costmap.clear(["walls"])
    with pytest.raises(ValueError, match="either"):
        costmap.clear(around=(0, 0, 1), outside=(0, 0, 1))


def test_parameters_by_name() -> None:
    costmap = local()
    assert costmap.get_parameter("inflation_layer.inflation_radius") == 0.6
    assert costmap.get_parameter("obstacle_layer.scan.clearing") is True
    costmap.set_parameter("inflation_layer.inflation_radius", 0.3)
    costmap.set_parameter("obstacle_layer.scan.max_obstacle_height", 0.1)
    assert costmap.get_parameter("obstacle_layer.scan.max_obstacle_height") == 0.1
    see(costmap)
    assert not (costmap.costs == 254).any(), "the point is at 0.2 m"
    costmap.set_parameter("robot_radius", 0.3)
    assert abs(costmap.radii_m[1] - 0.32) < 0.02
    with pytest.raises(KeyError, match="did you mean `inflation_layer.inflation_radius`"):
        costmap.set_parameter("inflation_layer.inflation_radus", 1.0)
    with pytest.raises(ValueError, match="inflation_radius"):
        costmap.set_parameter("inflation_layer.inflation_radius", "wide")
    with pytest.raises(ValueError, match="inflation_radius"):
        costmap.set_parameter("inflation_layer.inflation_radius", -1.0)
    with pytest.raises(ValueError, match="rolling_window"):
        costmap.set_parameter("rolling_window", False)
    with pytest.raises(KeyError):
        costmap.get_parameter("width.")


def test_footprints() -> None:
    costmap = local(footprint=[[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]], footprint_padding=0.0)
    np.testing.assert_allclose(costmap.footprint, [[0.3, 0.2], [0.3, -0.2], [-0.3, -0.2], [-0.3, 0.2]], atol=1e-6)
    costmap.set_footprint([[1, 1], [1, -1], [-1, 0]])
    assert costmap.footprint.shape == (3, 2)


class Ramp:
    """Costs that grow with x; counts its calls."""

    name = "ramp"

    def __init__(self) -> None:
        self.calls: list[Any] = []

    def update_bounds(self, robot_x: float, robot_y: float, robot_yaw: float, bounds: periplus.UpdateBounds) -> None:
        self.calls.append((robot_x, robot_y, robot_yaw))
        bounds.touch(-10.0, -10.0)
        bounds.touch(10.0, 10.0)

    def update_costs(self, costs: np.ndarray, min_i: int, min_j: int, max_i: int, max_j: int) -> None:
        window = costs[min_j:max_j, min_i:max_i]
        np.maximum(window, np.arange(min_i, max_i, dtype=np.uint8), out=window)

    def reset(self) -> None:
        self.calls.append("reset")


def test_a_layer_in_python_between_layers_of_nav2() -> None:
    ramp = Ramp()
    costmap = local(plugins=["obstacle_layer", ramp, "inflation_layer"])
    assert costmap.layers == ["obstacle_layer", "ramp", "inflation_layer"]
    see(costmap)
    assert ramp.calls == [(0.0, 0.0, 0.0)]
    expected = local()
    see(expected)
    np.testing.assert_array_equal(costmap.costs, np.maximum(expected.costs, np.arange(80, dtype=np.uint8)))
    costmap.reset()
    assert ramp.calls[-1] == "reset"
    assert "Python" in str(costmap.explain(0, 0))


def test_only_the_window_of_a_layer_is_used() -> None:
    class Corner:
        def update_bounds(self, x: float, y: float, yaw: float, bounds: periplus.UpdateBounds) -> None:
            bounds.touch(0.0, 0.0)
            bounds.touch(0.4, 0.4)

        def update_costs(self, costs: np.ndarray, *window: int) -> None:
            costs[:] = 9
            self.window = window

    layer = Corner()
    costmap = Costmap(width=2, height=1, resolution=0.5, plugins=[layer])
    assert costmap.update() == layer.window == (0, 0, 1, 1)
    assert costmap.costs.tolist() == [[9, 0, 0, 0], [0, 0, 0, 0]]


def test_layers_can_be_switched_off_and_added() -> None:
    class Nine:
        enabled = True

        def update_costs(self, costs: np.ndarray, *window: int) -> None:
            costs[:] = 9

    layer = Nine()
    costmap = Costmap(width=1, height=1, resolution=0.5, plugins=[])
    costmap.add_layer(layer)
    costmap.update()
    assert (costmap.costs == 9).all()
    layer.enabled = False
    costmap.add_layer(Ramp())
    costmap.update()
    assert costmap.costs.tolist() == [[0, 1], [0, 1]]


def test_an_exception_of_a_layer_names_it() -> None:
    class Broken:
        name = "broken_layer"

        def update_costs(self, costs: np.ndarray, *window: int) -> None:
            costs[99, 99, 99] = 1

    after = Ramp()
    costmap = Costmap(width=1, height=1, plugins=[Broken(), after])
    with pytest.raises(IndexError) as error:
        costmap.update()
    text = "".join(traceback.format_exception(error.value))
    assert "update_costs" in text and "costs[99, 99, 99] = 1" in text
    assert any("broken_layer" in note for note in getattr(error.value, "__notes__", ["broken_layer"]))
    with pytest.raises(IndexError):
        costmap.update()


def test_a_layer_must_not_use_its_costmap() -> None:
    class Nosy:
        costmap: Costmap

        def update_costs(self, costs: np.ndarray, *window: int) -> None:
            self.costmap.update()

    layer = Nosy()
    layer.costmap = Costmap(width=1, height=1, plugins=[layer])
    with pytest.raises(RuntimeError, match="cannot use its costmap"):
        layer.costmap.update()


def test_interrupts_leave_a_layer() -> None:
    class Stopped:
        def update_costs(self, costs: np.ndarray, *window: int) -> None:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Costmap(width=1, height=1, plugins=[Stopped()]).update()


def test_threads() -> None:
    costmap = local(plugins=["obstacle_layer", Ramp(), "inflation_layer"])
    failures: list[BaseException] = []

    def work(number: int) -> None:
        try:
            for turn in range(30):
                costmap.observe("obstacle_layer", "scan", np.random.rand(50, 3), Pose(0, 0, 0.2), turn * 0.1)
                costmap.update(turn * 0.1, (0.1 * number, 0, 0))
                assert costmap.costs.shape == (80, 80)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=work, args=(number,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures


def test_pictures() -> None:
    costmap = local()
    see(costmap)
    picture = costmap._repr_png_()
    assert picture is not None and picture.startswith(b"\x89PNG")
    assert "image/png" in costmap._repr_html_()
    assert "obstacle_layer" in repr(costmap)


@pytest.mark.parametrize(
    ("make", "error", "words"),
    [
        (lambda: Costmap(widht=3), TypeError, "did you mean `width`|width"),
        (lambda: Costmap({"resolution": "fine"}), ValueError, "resolution"),
        (lambda: Costmap(resolution=-1.0), ValueError, "resolution"),
        (lambda: Costmap(width=1000000, height=1000000), ValueError, "too many cells"),
        (lambda: Costmap(plugins=["x"], x={"plugin": "nav2_costmap_2d::StaticLayr"}), ValueError, "plugin"),
        (lambda: Costmap(plugins=["x"]), ValueError, "plugin"),
        (lambda: Costmap(plugins="static_layer"), TypeError, "plugins"),
        (lambda: Costmap(plugins=[3]), TypeError, "update_costs"),  # type: ignore[list-item]
        (lambda: Costmap(plugins=[Ramp]), TypeError, "update_costs"),  # type: ignore[list-item]
        (lambda: Costmap(footprint="[[1, 2]"), ValueError, "footprint"),
        (lambda: Costmap(width=None), TypeError, "width"),
        (lambda: Costmap({3: 4}), TypeError, "names"),  # type: ignore[dict-item]
        (lambda: local().observe("obstacle_layer", "laser", [[0, 0, 0]], (0, 0, 0)), KeyError, "obstacle_layer.scan"),
        (lambda: local().observe("obstacle_layer", "scan", [0, 0, 0], (0, 0, 0)), ValueError, "points"),
        (lambda: local().observe("obstacle_layer", "scan", [[0, 0, 0]], (0, 0)), TypeError, "sensor_pose"),  # type: ignore[arg-type]
        (lambda: local().update(math.nan), ValueError, "time_s"),
        (lambda: local().update(1e30), ValueError, "time_s"),
        (lambda: local().update(0.0, (math.inf, 0, 0)), ValueError, "finite"),
        (lambda: local().cost_at([1]), ValueError, "poses"),
        (lambda: local().cost_at([math.nan, 1]), ValueError, "poses"),
        (lambda: local().explain(99, 0), ValueError, "outside"),
        (lambda: local().explain(math.nan, 0), ValueError, "outside"),
        (lambda: local().set_footprint([[0, 0]]), ValueError, "three"),
        (lambda: local().observe_range("walls", 1, 0, 2, 1, (0, 0, 0)), KeyError, "walls"),
    ],
)
def test_wrong_arguments(make, error, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error, match=words):
        make()


def test_broken_files(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        Costmap.from_yaml(tmp_path / "none.yaml")
    file = tmp_path / "nav2.yaml"
    file.write_text(YAML.replace("resolution: 0.05", "resolution: fine"))
    with pytest.raises(periplus.FileError) as error:
        Costmap.from_yaml(file)
    assert error.value.line == 8 and error.value.file == str(file)
    with pytest.raises(KeyError, match="global_costmap"):
        Costmap.from_text(YAML, "global_costmap")
    with pytest.raises(periplus.FileError):
        Costmap.from_text("a: [1")
    doubtful = Costmap.from_text(YAML.replace("robot_radius", "robot_radus"))
    assert local(plugins=["obstacle_layer"]).warnings, "of the inflation layer that is not used"
    assert any("robot_radus" in warning for warning in doubtful.warnings)


@settings(max_examples=50, deadline=None)
@given(
    points=hnp.arrays(
        st.sampled_from([np.float64, np.float32, np.int16, np.bool_]), hnp.array_shapes(max_dims=3, max_side=5)
    ),
    poses=hnp.arrays(np.float64, hnp.array_shapes(max_dims=3, max_side=4)),
    step=st.sampled_from([1, -1]),
)
def test_any_arrays_end_in_costs_or_clear_errors(points: np.ndarray, poses: np.ndarray, step: int) -> None:
    costmap = local()
    try:
        costmap.observe("obstacle_layer", "scan", points[::step], (0, 0, 0))
    except (ValueError, TypeError):
        pass
    costmap.update()
    try:
        assert costmap.cost_at(poses).shape == poses.shape[:-1]
        assert costmap.cost_at(poses, footprint=True).dtype == np.uint8
    except ValueError:
        pass
