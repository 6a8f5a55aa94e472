"""Sweeps: points, tables that other programs read, Ray, SLURM, Optuna."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from periplus.sweeps import Sweep, SweepFailed, sweep

ROOT = Path(__file__).parents[2]


@pytest.fixture
def scenario(tmp_path: Path) -> Path:
    """Two seconds straight ahead, with losses of scans."""
    file = tmp_path / "drive.scenario.yaml"
    values = {
        "world": str(ROOT / "worlds" / "demo_room.sdf"),
        "robot": {"file": str(ROOT / "robots" / "sam_bot" / "urdf" / "sam_bot.urdf.xacro"), "pose": [0, 0, 0]},
        "physics": "kinematic",
        "timeout": 2.5,
        "variables": {"loss": 0, "speed": 0.3},
        "nodes": ["slam"],
        "faults": [{"dropout": {"topic": "/scan", "probability": "$(loss)"}}],
        "drive": [{"at": 0, "until": 2, "linear": "$(speed)"}, {"at": 2}],
        "assertions": [{"rate": {"topic": "/scan", "hz": 5}}, "no_collision"],
    }
    # A text in quotes stays a text.
    file.write_text(json.dumps(values).replace('"$(', "$(").replace(')"', ")"))
    return file


def shares(result: Sweep) -> list[float]:
    return [point.metrics["passed"].mean for point in result.points]


def test_a_sweep_has_points_and_statistics(scenario: Path, tmp_path: Path) -> None:
    result = sweep(scenario, {"loss": [0, 0.9]}, seeds=2, out=tmp_path / "out")
    assert [point.values for point in result.points] == [{"loss": "0"}, {"loss": "0.9"}]
    assert shares(result) == [1.0, 0.0]
    assert result.points[0].metrics["length_m"].median == pytest.approx(0.6, abs=0.03)
    assert (result.values["ran"], result.values["reused"]) == (4, 0)
    assert len(list((tmp_path / "out" / "failures").glob("*/run.mcap"))) == 2
    again = sweep(scenario, {"loss": "0,0.9"}, seeds=2, out=tmp_path / "out")
    assert (again.values["ran"], again.values["reused"]) == (0, 4)


@pytest.mark.parametrize("reader", ["pyarrow.parquet", "polars", "pandas"])
def test_other_programs_read_the_table(scenario: Path, tmp_path: Path, reader: str) -> None:
    module = pytest.importorskip(reader)
    if reader == "pandas":
        pytest.importorskip("pyarrow")
    result = sweep(scenario, {"loss": [0, 0.9]}, out=tmp_path / "out", artifacts=False)
    read = module.read_table if reader == "pyarrow.parquet" else module.read_parquet
    table = read(result.table)
    columns = table.to_pydict() if hasattr(table, "to_pydict") else {
        name: list(table[name]) for name in ("run", "loss", "passed", "failure", "assert2_no_collision_passed")
    }
    assert list(columns["run"]) == [0, 1]
    assert list(columns["loss"]) == [0.0, 0.9]
    assert list(columns["passed"]) == [True, False]
    assert not isinstance(columns["failure"][0], str) and "rate" in columns["failure"][1]
    assert list(columns["assert2_no_collision_passed"]) == [True, True]


def test_an_unknown_name_is_explained(scenario: Path, tmp_path: Path) -> None:
    with pytest.raises(SweepFailed, match="did you mean `speed`"):
        sweep(scenario, {"sped": [1]}, out=tmp_path / "out")


def test_points_are_in_place_of_a_grid(scenario: Path, tmp_path: Path) -> None:
    points = [{"loss": 0, "speed": 0.2}, {"loss": 0.9, "speed": 0.3}]
    result = sweep(scenario, points=points, out=tmp_path / "out")
    assert shares(result) == [1.0, 0.0]


def test_tasks_of_slurm_make_the_same_table(scenario: Path, tmp_path: Path) -> None:
    local = sweep(scenario, {"loss": [0, 0.9]}, seeds=2, out=tmp_path / "local")
    script, out = tmp_path / "array.sbatch", tmp_path / "slurm"
    words = [sys.executable, "-m", "periplus", "sweep", str(scenario), "--param", "loss=0,0.9", "--seeds", "2"]
    words += ["--out", str(out)]
    subprocess.run([*words, "--slurm", str(script)], check=True)
    assert "#SBATCH --array=0-3\n" in script.read_text()
    assert subprocess.run([*words, "--collect"], check=False).returncode == 1, "no run has a result yet"
    for task in range(4):
        environment = {**os.environ, "SLURM_ARRAY_TASK_ID": str(task)}
        subprocess.run(["bash", str(script)], env=environment, check=True)
    subprocess.run([*words, "--collect"], check=True)
    assert (out / "sweep.parquet").read_bytes() == local.table.read_bytes()


@pytest.fixture(scope="module")
def cluster() -> Iterator[str]:
    """Address of a Ray cluster of two nodes on this machine."""
    pytest.importorskip("ray")
    from ray.cluster_utils import Cluster

    made = Cluster(initialize_head=True, head_node_args={"num_cpus": 1})
    made.add_node(num_cpus=1)
    yield made.address
    made.shutdown()


def test_ray_makes_the_same_table(scenario: Path, tmp_path: Path, cluster: str) -> None:
    local = sweep(scenario, {"loss": [0, 0.9]}, seeds=2, out=tmp_path / "local")
    remote = sweep(scenario, {"loss": [0, 0.9]}, seeds=2, out=tmp_path / "ray", ray=cluster)
    assert (remote.values["ran"], remote.values["started"]) == (4, 4)
    assert remote.table.read_bytes() == local.table.read_bytes()
    kept = sorted(path.relative_to(tmp_path / "ray") for path in (tmp_path / "ray" / "failures").rglob("run.*"))
    assert kept == sorted(path.relative_to(tmp_path / "local") for path in (tmp_path / "local" / "failures").rglob("run.*"))


def test_a_missing_cluster_is_explained(scenario: Path, tmp_path: Path) -> None:
    pytest.importorskip("ray")
    with pytest.raises(SweepFailed, match="there is no Ray cluster at `127.0.0.1:1`"):
        sweep(scenario, {"loss": [0, 0.9]}, out=tmp_path / "out", ray="127.0.0.1:1")


def search(scenario: Path, out: Path, *options: str) -> dict[str, object]:
    words = [sys.executable, "-m", "periplus", "sweep", str(scenario), "--param", "speed=0.1:0.5", "--out", str(out)]
    done = subprocess.run([*words, *options, "--json"], stdout=subprocess.PIPE, check=True)
    values: dict[str, object] = json.loads(done.stdout)
    return values


def test_a_search_finds_the_best_point_and_repeats_itself(scenario: Path, tmp_path: Path) -> None:
    pytest.importorskip("optuna")
    options = ("--search", "length_m:max", "--trials", "6", "--no-artifacts")
    one = search(scenario, tmp_path / "a", *options, "--workers", "1")
    two = search(scenario, tmp_path / "b", *options, "--workers", "2")
    assert one["best"] == two["best"] and one["points"] == two["points"]
    best, points = one["best"], one["points"]
    assert isinstance(best, dict) and isinstance(points, list) and len(points) == 6
    speeds = [float(point["values"]["speed"]) for point in points]
    # Two seconds at the speed: the fastest drives the longest way.
    assert float(best["values"]["speed"]) == max(speeds)
    assert best["value"] == pytest.approx(2 * max(speeds), abs=0.1)
