"""Localization on rooms made with numpy, and on the map of a real log."""

import math
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any, TypeAlias

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from periplus import Amcl, FileError, LaserScanner, Pose, Slam

StrPath: TypeAlias = str | Path
SHARED = Path(__file__).parents[2].parent / "shared" / "datasets"
RESOLUTION = 0.05
ANGLES = np.radians(np.arange(0.0, 360.0, 2.0))
SCANNER = LaserScanner.from_angles(ANGLES, range_max=12.0)


def room() -> np.ndarray:
    """Cells of a room of 8 m by 5 m with a pillar, so that no two poses look alike."""
    cells = np.zeros((100, 160), np.int8)
    cells[[0, -1], :] = cells[:, [0, -1]] = 100
    cells[60:80, 30:50] = 100
    return cells


def scan(x: float, y: float, yaw: float) -> np.ndarray:
    """Ranges in the room, by steps of a fifth of a cell."""
    cells = room()
    distances = np.arange(0.0, 12.0, RESOLUTION / 5)
    columns = ((x + np.outer(np.cos(ANGLES + yaw), distances)) / RESOLUTION).astype(int)
    rows = ((y + np.outer(np.sin(ANGLES + yaw), distances)) / RESOLUTION).astype(int)
    hit = cells[rows.clip(0, 99), columns.clip(0, 159)] == 100
    ranges: np.ndarray = distances[hit.argmax(axis=1)]
    return ranges


def localizer(**parameters: Any) -> Amcl:
    return Amcl((room(), RESOLUTION, (0.0, 0.0, 0.0)), scanner=SCANNER, **parameters)


def test_tracks_a_drive() -> None:
    amcl = localizer()
    amcl.set_initial_pose((4.0, 2.0, 0.0))
    for step in range(12):
        x = 4.0 + 0.3 * step
        # The origin of odometry is elsewhere and turned.
        odom = Pose(1.0, -2.0, yaw=0.5) * Pose(x, 2.0)
        estimate = amcl.update(scan(x, 2.0, 0.0), odom, time_s=0.1 * step)
    assert estimate.is_updated and estimate.has_pose and estimate.state == "tracking"
    pose = estimate.pose
    assert pose is not None
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((7.3, 2.0, 0.0), abs=0.05)
    assert estimate.inlier_ratio is not None and estimate.inlier_ratio > 0.9
    assert "walls of the map" in estimate.reason
    covariance, both = estimate.covariance, estimate.pose_covariance
    assert covariance is not None and both is not None
    assert covariance.shape == (3, 3) and both.shape == (6, 6)
    assert covariance[2, 2] == both[5, 5] and 0.0 < covariance[0, 0] < 0.1
    assert estimate.map_from_odom is not None
    product = estimate.map_from_odom * odom
    assert (product.x, product.y) == pytest.approx((pose.x, pose.y))
    particles = amcl.particles
    assert particles.ndim == 2 and particles.shape[1] == 4
    assert particles[:, 3].sum() == pytest.approx(1.0)
    assert amcl.likelihoods(scan(7.3, 2.0, 0.0)).shape == (len(particles),)


def test_between_updates_the_pose_follows_odometry() -> None:
    amcl = localizer()
    amcl.set_initial_pose((4.0, 2.0, 0.0), [0.01, 0.01, 0.01])
    first = amcl.update(scan(4.0, 2.0, 0.0), (0.0, 0.0, 0.0))
    second = amcl.update(scan(4.05, 2.0, 0.0), (0.05, 0.0, 0.0))
    assert first.is_updated and not second.is_updated
    assert second.likelihood is None and second.random_fraction is None
    assert first.pose is not None and second.pose is not None
    assert second.pose.x - first.pose.x == pytest.approx(0.05, abs=0.02)
    amcl.request_update()
    assert amcl.update(scan(4.05, 2.0, 0.0), (0.05, 0.0, 0.0)).is_updated


def test_finds_the_robot_without_a_pose() -> None:
    amcl = localizer()
    peaks = amcl.localize_globally(scan(6.0, 1.5, 1.0))
    assert peaks.shape[1] == 4 and peaks[0, :3] == pytest.approx((6.0, 1.5, 1.0), abs=0.1)
    for step in range(8):
        x, y = 6.0 + 0.2 * step * math.cos(1.0), 1.5 + 0.2 * step * math.sin(1.0)
        estimate = amcl.update(scan(x, y, 1.0), (0.2 * step, 0.0, 0.0))
    assert estimate.has_pose and estimate.state == "tracking"
    assert estimate.pose is not None
    assert (estimate.pose.x, estimate.pose.y) == pytest.approx((x, y), abs=0.1)
    assert estimate.hypotheses.shape == (0, 4)


def test_global_localization_covers_the_free_cells() -> None:
    amcl = localizer(max_particles=1000)
    amcl.global_localization()
    particles = amcl.particles
    assert particles.shape == (1000, 4)
    assert np.ptp(particles[:, 0]) > 7.0 and np.ptp(particles[:, 1]) > 4.0
    cells = room()
    assert (cells[(particles[:, 1] / RESOLUTION).astype(int), (particles[:, 0] / RESOLUTION).astype(int)] == 0).all()


def test_the_same_calls_give_the_same_bits() -> None:
    def run() -> np.ndarray:
        amcl = localizer(random_seed=7)
        amcl.set_initial_pose((4.0, 2.0, 0.0))
        for step in range(4):
            amcl.update(scan(4.0 + 0.3 * step, 2.0, 0.0), (0.3 * step, 0.0, 0.0))
        return amcl.particles

    np.testing.assert_array_equal(run(), run())


def test_maps_of_several_forms() -> None:
    cells = room()
    forms = [
        (cells, RESOLUTION, (0.0, 0.0, 0.0)),
        (cells.astype(np.int64).tolist(), RESOLUTION, Pose()),
        SimpleNamespace(cells=cells[::1, ::1], resolution_m=RESOLUTION, origin=Pose()),
        (np.asfortranarray(cells), RESOLUTION, (0, 0, 0)),
    ]
    poses = []
    for form in forms:
        amcl = Amcl(form, scanner=SCANNER)
        amcl.set_initial_pose((4.0, 2.0, 0.0))
        pose = amcl.update(scan(4.0, 2.0, 0.0), (0.0, 0.0, 0.0)).pose
        assert pose is not None
        poses.append((pose.x, pose.y, pose.yaw))
    assert len(set(poses)) == 1


def test_wrong_maps() -> None:
    with pytest.raises(ValueError, match="without|no cell|obstacle|occupied"):
        Amcl((np.zeros((5, 5), np.int8), 0.1, (0, 0, 0)))
    with pytest.raises(ValueError, match="`cells` must have the shape"):
        Amcl((np.zeros(5, np.int8), 0.1, (0, 0, 0)))
    with pytest.raises(ValueError, match="empty"):
        Amcl((np.zeros((0, 5), np.int8), 0.1, (0, 0, 0)))
    with pytest.raises(TypeError, match="whole numbers"):
        Amcl((np.full((5, 5), 0.5), 0.1, (0, 0, 0)))
    with pytest.raises(ValueError, match="-1 .unknown"):
        Amcl((np.full((5, 5), 205, np.uint8), 0.1, (0, 0, 0)))
    with pytest.raises(ValueError):
        Amcl((room(), 0.0, (0, 0, 0)))
    with pytest.raises(TypeError, match="`map` must be"):
        Amcl("map.yaml")


def test_calls_out_of_order() -> None:
    amcl = Amcl(scanner=SCANNER)
    ranges = scan(4.0, 2.0, 0.0)
    for call in (
        lambda: amcl.update(ranges, (0, 0, 0)),
        lambda: amcl.localize_globally(ranges),
        amcl.global_localization,
        lambda: amcl.likelihoods(ranges),
    ):
        with pytest.raises(RuntimeError, match="there is no map"):
            call()
    assert amcl.particles.shape == (0, 4) and amcl.estimate.state == "unset"
    # A pose waits for the map.
    amcl.set_initial_pose((4.0, 2.0, 0.0))
    assert amcl.set_map((room(), RESOLUTION, (0, 0, 0)))
    assert amcl.update(ranges, (0, 0, 0)).has_pose
    silent = localizer(global_start=False)
    with pytest.raises(RuntimeError, match="no initial pose"):
        silent.update(ranges, (0, 0, 0))


def test_wrong_arguments() -> None:
    amcl = localizer()
    with pytest.raises(ValueError, match="outside of the map"):
        amcl.set_initial_pose((100.0, 0.0, 0.0))
    with pytest.raises(ValueError, match="covariance"):
        amcl.set_initial_pose((4.0, 2.0, 0.0), [-1.0, 1.0, 1.0])
    with pytest.raises(ValueError, match=r"\(3, 3\)"):
        amcl.set_initial_pose((4.0, 2.0, 0.0), [1.0, 1.0])
    with pytest.raises(TypeError, match="LaserScanner"):
        Amcl((room(), RESOLUTION, (0, 0, 0))).update([1.0], (0, 0, 0))
    with pytest.raises(ValueError, match="finite"):
        amcl.update(scan(4.0, 2.0, 0.0), (np.nan, 0.0, 0.0))
    with pytest.raises(RuntimeError, match="fits nowhere"):
        amcl.localize_globally(np.full(180, np.inf))
    # In the wall.
    with pytest.warns(UserWarning):
        amcl.set_initial_pose((2.0, 3.5, 0.0))


def test_parameters(tmp_path: Path) -> None:
    rows = {row["name"]: row for row in Amcl.parameters()}
    assert rows["max_particles"]["default"] == 2000 and rows["update_min_d"]["unit"] == "m"
    assert "laser_max_beams" in rows["max_beams"]["aliases"]
    assert set(rows["laser_model_type"]["choices"]) == {"beam", "likelihood_field", "likelihood_field_prob"}
    with pytest.raises(TypeError, match="did you mean `max_particles`"):
        Amcl(max_particle=10)
    with pytest.raises(ValueError, match="sigma_hit"):
        Amcl(sigma_hit=0)
    with pytest.raises(ValueError, match="laser_model_type"):
        Amcl(laser_model_type="beams")
    nested = Amcl(initial_pose={"x": 1.5, "yaw": 0.5}, set_initial_pose=True).settings()
    assert nested["initial_pose.x"] == 1.5 and nested["initial_pose.yaw"] == 0.5
    path = tmp_path / "nav2.yaml"
    path.write_text("amcl:\n  ros__parameters:\n    alpha1: 0.1\n    max_particles: 700\n")
    values = Amcl(yaml=path, alpha1=0.3).settings()
    assert (values["alpha1"], values["max_particles"]) == (0.3, 700)
    path.write_text("amcl:\n  ros__parameters:\n    alpha_1: 0.1\n")
    with pytest.raises(FileError, match="alpha1") as error:
        Amcl(yaml=path)
    assert (error.value.line, error.value.column) == (3, 5)
    path.write_text("amcl:\n  ros__parameters:\n    introspection_mode: disabled\n    alpha1: 0.4\n")
    with pytest.warns(UserWarning, match="nav2.yaml:3:5: AMCL has no parameter `introspection_mode`"):
        assert Amcl(yaml=path).settings()["alpha1"] == 0.4
    path.write_text("amcl:\n  ros__parameters:\n    max_particles: many\n")
    with pytest.raises(FileError) as error:
        Amcl(yaml=path)
    assert (error.value.line, error.value.column) == (3, 20)


@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
@settings(deadline=None, max_examples=40)
@given(
    hnp.arrays(
        st.sampled_from([np.float32, np.float64, np.int16]),
        hnp.array_shapes(min_dims=0, max_dims=2, min_side=0, max_side=200),
    )
)
def test_any_array_is_used_or_an_error(ranges: np.ndarray) -> None:
    amcl = localizer(max_particles=50, min_particles=50)
    amcl.set_initial_pose((4.0, 2.0, 0.0))
    try:
        estimate = amcl.update(ranges, (0.0, 0.0, 0.0))
    except (TypeError, ValueError):
        return
    assert estimate.pose is None or np.isfinite(estimate.pose.matrix).all()


@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
@settings(deadline=None)
@given(st.one_of(st.none(), st.text(max_size=3), st.floats(), st.lists(st.floats(), max_size=9)))
def test_anything_as_an_argument_never_crashes(anything: object) -> None:
    amcl = Amcl(scanner=SCANNER)
    for call in (
        lambda: amcl.set_map(anything),
        lambda: amcl.set_initial_pose(anything, anything),  # type: ignore[arg-type]
        lambda: amcl.update(anything, anything),  # type: ignore[arg-type]
        lambda: Amcl(alpha1=anything),
    ):
        try:
            call()
        except (TypeError, ValueError, RuntimeError):
            pass


def test_localizes_a_log_as_the_command_does(tmp_path: Path) -> None:
    log = SHARED / "fr101" / "raw.clf"
    if not log.exists():
        pytest.skip(f"NOT TESTED: {log} is missing")
    scans = [line for line in log.read_text().splitlines() if line.startswith("FLASER")][:90]
    path = tmp_path / "raw.clf"
    path.write_text("\n".join(scans))
    command: list[StrPath] = [sys.executable, "-m", "periplus"]
    mapping = [*command, "slam", path, "-o", tmp_path, "--quiet", "--no-loops"]
    subprocess.run(mapping, check=True, stdout=subprocess.DEVNULL)
    # No cell is occupied before thresholds are applied.
    grid = Slam.from_log(path, do_loop_closing=False).map()
    with pytest.raises(ValueError, match="trinary"):
        Amcl(grid)
    # The file has its origin in millimetres.
    corner = (round(grid.origin[0], 3), round(grid.origin[1], 3), 0.0)

    numbers = []
    for line in scans:
        words = line.split()
        numbers.append([float(it) for it in words[2 : 2 + int(words[1]) + 7]])
    rows = np.array(numbers)
    ranges, odometry = rows[:, :-7], rows[:, -4:-1]
    beams = ranges.shape[1]
    largest = np.float32(0.99) * ranges.astype(np.float32).max()
    scanner = LaserScanner(-np.pi / 2, np.pi / (beams - beams % 2), range_min=0.02, range_max=float(largest))

    localizing = [*command, "localize", path, "--map", tmp_path / "map.yaml", "-o", tmp_path / "out", "--quiet"]
    subprocess.run(localizing, check=True, stdout=subprocess.DEVNULL)
    written = np.loadtxt(tmp_path / "out" / "trajectory.txt")
    amcl = Amcl((grid.trinary().cells, grid.resolution_m, corner), scanner=scanner)
    poses = []
    for row, odom in zip(ranges, odometry):
        estimate = amcl.update(row, odom)
        if estimate.has_pose and estimate.pose is not None:
            poses.append([estimate.pose.x, estimate.pose.y])
    assert len(poses) > 50
    np.testing.assert_array_equal(np.char.mod("%.6f", poses), np.char.mod("%.6f", written[:, 1:3]))
