"""Mapping: rooms made with numpy, real logs, and the same results as the command."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from periplus import FileError, LaserScanner, Pose, Slam

SHARED = Path(__file__).parents[2].parent / "shared" / "datasets"
ANGLES = np.radians(np.arange(360.0))
SCANNER = LaserScanner.from_angles(ANGLES, range_max=10.0)


def room(x: float, y: float = 0.0, yaw: float = 0.0) -> np.ndarray:
    """Ranges in a room of 6 m by 4 m around the origin."""
    c, s = np.cos(ANGLES + yaw), np.sin(ANGLES + yaw)
    with np.errstate(divide="ignore", invalid="ignore"):
        ranges: np.ndarray = np.fmin((3.0 * np.sign(c) - x) / c, (2.0 * np.sign(s) - y) / s)
    return ranges


def drive(slam: Slam, count: int = 11) -> list[str]:
    return [
        slam.process(room(0.1 * step), (0.1 * step, 0.0, 0.0), time_s=0.1 * step).outcome
        for step in range(count)
    ]


def log(name: str) -> Path:
    path = SHARED / name / "raw.clf"
    if not path.exists():
        pytest.skip(f"NOT TESTED: {path} is missing")
    return path


@pytest.mark.parametrize("method", ["graph", "gmapping"])
def test_a_room(method: str) -> None:
    options = {} if method == "graph" else {"particles": 5, "linearUpdate": 0.3}
    slam = Slam(method, scanner=SCANNER, **options)  # type: ignore[arg-type]
    outcomes = drive(slam)
    assert outcomes[0] == "inserted" and set(outcomes) == {"inserted", "below_motion_threshold"}
    slam.finish()
    assert slam.method == method
    assert slam.map_from_base.x == pytest.approx(1.0, abs=0.05)
    rows = slam.trajectory()
    assert rows.shape == (11, 4) and rows[:, 0] == pytest.approx(np.arange(11) * 0.1)
    assert rows[:, 1] == pytest.approx(np.arange(11) * 0.1, abs=0.05)
    assert slam.trajectory_times_ns().tolist() == [100_000_000 * step for step in range(11)]
    grid = slam.map()
    cells, resolution, origin = grid.cells, grid.resolution_m, grid.origin
    assert cells.dtype == np.int8 and set(np.unique(cells)) <= set(range(-1, 101))
    # Around the room's walls, as far apart as they are.
    rows_occupied, columns_occupied = np.nonzero(cells > 65)
    assert np.ptp(columns_occupied) * resolution == pytest.approx(6.0, abs=0.15)
    assert np.ptp(rows_occupied) * resolution == pytest.approx(4.0, abs=0.15)
    centre = round(-origin[1] / resolution), round(-origin[0] / resolution)
    assert 0 <= cells[centre] < 50


def test_updates() -> None:
    slam = Slam(scanner=SCANNER)
    update = slam.process(room(0.0), Pose(5.0, 1.0, yaw=0.0), time_s=0.0)
    assert update.is_keyframe and update.reason is None and not update.is_map_revised
    assert (update.map_from_base.x, update.map_from_base.y) == (5.0, 1.0)
    assert update.map_from_odom == Pose()
    update = slam.process(np.full(360, np.nan), (5.0, 1.0, 0.0), time_s=0.1)
    assert update.outcome == "no_match"
    assert slam.counts["scans"] == 2 and slam.counts["keyframes"] == 1


def test_throttled_scans() -> None:
    slam = Slam(scanner=SCANNER, throttle_scans=5)
    outcomes = drive(slam)
    assert [step for step, it in enumerate(outcomes) if it != "skipped"] == [0, 5, 10]
    assert slam.counts["scans"] == 3


def test_graph_and_g2o() -> None:
    slam = Slam(scanner=SCANNER)
    drive(slam, 20)
    graph = slam.graph()
    count = slam.counts["keyframes"]
    assert graph.poses.shape == (count, 3) and graph.times_s.shape == (count,)
    assert graph.edges.shape == graph.residuals.shape == (len(graph.kinds), 2)
    assert graph.kinds.count("sequential") == count - 1
    assert graph.chi2 >= 0.0
    assert slam.covariance.shape == (3, 3) and (np.diag(slam.covariance) > 0.0).all()
    lines = slam.g2o().splitlines()
    assert sum(line.startswith("VERTEX_SE2") for line in lines) == count
    # The text has all digits of the poses.
    x = [float(line.split()[2]) for line in lines if line.startswith("VERTEX_SE2")]
    assert x == graph.poses[:, 0].tolist()


def test_gmapping_has_no_graph(tmp_path: Path) -> None:
    slam = Slam("gmapping", scanner=SCANNER, particles=2)
    drive(slam, 2)
    for call in (slam.graph, slam.g2o, slam.to_bytes, lambda: slam.save(tmp_path / "x"), lambda: slam.set_pose((0, 0, 0)), lambda: slam.covariance):
        with pytest.raises(ValueError, match="gmapping has no graph"):
            call()


def test_sessions_go_on_to_the_bit(tmp_path: Path) -> None:
    whole, first = Slam(scanner=SCANNER), Slam(scanner=SCANNER)
    drive(whole, 10)
    drive(first, 10)
    first.save(tmp_path / "room.session")
    second = Slam.load(tmp_path / "room.session", scanner=SCANNER)
    third = Slam.from_bytes(first.to_bytes(), scanner=SCANNER)
    for slam in (whole, second, third):
        for step in range(10, 20):
            slam.process(room(0.1 * step), time_s=0.1 * step)
        slam.finish()
    assert whole.to_bytes() == second.to_bytes() == third.to_bytes()
    np.testing.assert_array_equal(whole.map().cells, second.map().cells)
    damaged = bytearray(first.to_bytes())
    damaged[100] ^= 1
    with pytest.raises(FileError, match="checksum"):
        Slam.from_bytes(bytes(damaged))
    with pytest.raises(FileNotFoundError):
        Slam.load(tmp_path / "none")
    with pytest.raises(FileNotFoundError):
        first.save(tmp_path / "none" / "x")


def test_a_pose_that_is_set() -> None:
    slam = Slam(scanner=SCANNER)
    slam.set_pose((2.0, 3.0, 0.5))
    slam.process(room(0.0), time_s=0.0)
    assert slam.trajectory()[0, 1:].tolist() == [2.0, 3.0, 0.5]
    with pytest.raises(ValueError, match="variances"):
        slam.set_pose((0.0, 0.0, 0.0), (0.0, 1.0, 1.0))


def test_many_scans_at_once() -> None:
    one, many = Slam(scanner=SCANNER), Slam(scanner=SCANNER)
    drive(one)
    steps = np.arange(11) * 0.1
    odometry = np.stack([steps, 0 * steps, 0 * steps], axis=1)
    updates = many.process_many(np.stack([room(x) for x in steps]), odometry, times_s=steps)
    assert len(updates) == 11 and one.to_bytes() == many.to_bytes()
    odometry[:] = np.nan
    Slam(scanner=SCANNER).process_many(np.stack([room(x) for x in steps]), odometry, times_s=steps)
    with pytest.raises(ValueError, match="1 scans and 2 times"):
        many.process_many(room(0.0)[None], times_s=[2.0, 3.0])
    with pytest.raises(ValueError, match="odom_from_base"):
        many.process_many(room(0.0)[None], [[0.0, np.nan, 0.0]], times_s=[2.0])


def test_messages_have_their_beams_and_times() -> None:
    stamp = SimpleNamespace(sec=1, nanosec=500_000_000)
    message = SimpleNamespace(
        header=SimpleNamespace(stamp=stamp),
        angle_min=0.0,
        angle_max=float(ANGLES[-1]),
        angle_increment=float(ANGLES[1]),
        time_increment=0.0,
        scan_time=0.1,
        range_min=0.1,
        range_max=10.0,
        ranges=room(0.0).astype(np.float32),
        intensities=[],
    )
    slam = Slam()
    assert slam.process(message).is_keyframe
    assert slam.trajectory_times_ns().tolist() == [1_500_000_000]
    scanner = LaserScanner.from_message(message, base_from_laser=(0.1, 0.0, 0.0))
    assert scanner.range_max == 10.0 and scanner.base_from_laser.x == 0.1


def test_scanners() -> None:
    assert LaserScanner.from_angles([0.0, 0.5, 1.0]) == LaserScanner(0.0, 0.5)
    assert "angle_increment=0.5" in repr(LaserScanner(0.0, 0.5))
    with pytest.raises(ValueError, match="evenly spaced: angle 1"):
        LaserScanner.from_angles([0.0, 0.1, 1.0])
    with pytest.raises(ValueError, match="at least 2"):
        LaserScanner.from_angles([0.0])
    with pytest.raises(ValueError, match="`angle_increment`"):
        LaserScanner(0.0, 0.0)
    with pytest.raises(ValueError, match="`angle_min` must be finite"):
        LaserScanner(np.nan, 0.1)
    with pytest.raises(ValueError, match="range_min"):
        LaserScanner(0.0, 0.1, range_min=2.0, range_max=1.0)


def test_an_upside_down_scanner_mirrors_nothing() -> None:
    over = LaserScanner.from_angles(ANGLES, range_max=10.0, base_from_laser=Pose(roll=np.pi))
    slam = Slam(scanner=over)
    for step in range(6):
        x, yaw = 0.1 * step, 0.1 * step
        ranges = np.roll(room(x, 0.2, yaw)[::-1], 1)
        slam.process(ranges, (x, 0.0, yaw), time_s=0.1 * step)
    assert slam.trajectory()[-1, 3] == pytest.approx(0.5, abs=0.01)


def test_remarks_are_data() -> None:
    slam = Slam(scanner=SCANNER)
    for step in range(3):
        slam.process(room(0.1 * step), time_s=0.1 * step)
    slam.finish()
    [remark] = slam.remarks
    assert (remark.kind, remark.is_warning, remark.values, remark.position) == ("no_odometry", True, {}, None)
    assert remark.time_s == pytest.approx(0.2) and "odometry" in remark.text == str(remark)
    # The remarks of `finish` come with the next update.
    update = slam.process(room(0.3), time_s=0.3)
    assert [it.kind for it in update.remarks] == ["no_odometry"]
    assert slam.contradictions() == [] and slam.closures() == [] and slam.mounting_correction is None


def test_wrong_parameters() -> None:
    with pytest.raises(TypeError, match="slam_toolbox has no parameter `resolutoin`; did you mean `resolution`"):
        Slam(resolutoin=0.1)
    with pytest.raises(TypeError, match='it is a parameter of method="gmapping"'):
        Slam("graph", particles=3)
    with pytest.raises(ValueError, match="0.005 to 2"):
        Slam(resolution=-1)
    with pytest.raises(ValueError, match="there are `graph` and `gmapping`"):
        Slam("gmaping")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="localization"):
        Slam(mode="localization")
    with pytest.warns(UserWarning, match="changes nothing"):
        Slam(ceres_loss_function="HuberLoss")
    assert Slam(particles=3).method == "gmapping"
    assert Slam(resolution=0.1).settings()["resolution"] == 0.1


def test_parameters_are_listed() -> None:
    rows = {row["name"]: row for row in Slam.parameters()}
    assert rows["resolution"]["default"] == 0.05 and rows["resolution"]["unit"] == "m"
    assert rows["mode"]["choices"] == ["mapping", "localization"]
    assert {row["name"] for row in Slam.parameters("gmapping")} >= {"particles", "delta", "maxUrange"}


def test_files(tmp_path: Path) -> None:
    path = tmp_path / "slam.yaml"
    path.write_text("slam_toolbox:\n  ros__parameters:\n    resolution: 0.1\n")
    assert Slam(yaml=path).settings()["resolution"] == 0.1
    assert Slam(yaml=str(path), resolution=0.2).settings()["resolution"] == 0.2
    path.write_text("slam_gmapping: {particles: 7}\n")
    assert Slam(yaml=path).settings()["particles"] == 7
    path.write_text("slam_toolbox:\n  ros__parameters:\n    resolutoin: 0.1\n")
    with pytest.raises(FileError, match="did you mean `resolution`") as error:
        Slam(yaml=path)
    assert (error.value.file, error.value.line, error.value.column) == (str(path), 3, 5)
    assert error.value.hint is not None and "resolution" in error.value.hint
    with pytest.raises(FileNotFoundError):
        Slam(yaml=tmp_path / "none.yaml")


def test_wrong_scans() -> None:
    slam = Slam(scanner=SCANNER)
    with pytest.raises(RuntimeError, match="no map"):
        slam.map()
    with pytest.raises(TypeError, match="time_s"):
        slam.process(room(0.0))
    with pytest.raises(ValueError, match="no beams"):
        slam.process([], time_s=0.0)
    with pytest.raises(ValueError, match="`ranges` must have the shape"):
        slam.process(np.ones((2, 3)), time_s=0.0)
    with pytest.raises(TypeError, match="not an array of numbers"):
        slam.process("far", time_s=0.0)
    with pytest.raises(ValueError, match="finite"):
        slam.process(room(0.0), (np.nan, 0.0, 0.0), time_s=0.0)
    with pytest.raises(TypeError, match="LaserScanner"):
        Slam().process(room(0.0), time_s=0.0)
    assert slam.counts["scans"] == 0


@pytest.mark.filterwarnings("ignore:overflow encountered in cast")
@settings(deadline=None, max_examples=50)
@given(
    hnp.arrays(
        st.sampled_from([np.float32, np.float64, np.int32, np.uint8]),
        hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=50),
    ),
    st.integers(1, 3),
    st.floats(),
)
def test_any_array_is_used_or_an_error(ranges: np.ndarray, step: int, time_s: float) -> None:
    slam = Slam(scanner=SCANNER)
    for _ in range(2):
        try:
            slam.process(ranges[::step] if ranges.ndim else ranges, time_s=time_s)
        except (TypeError, ValueError):
            return
    assert np.isfinite(slam.trajectory()[:, 1:]).all()


def test_strides_and_types_do_not_matter() -> None:
    slams = [Slam(scanner=SCANNER) for _ in range(3)]
    for step in range(4):
        ranges = room(0.1 * step).astype(np.float32)
        spread = np.repeat(ranges.astype(float), 2)[::2]
        for slam, form in zip(slams, (ranges, spread, ranges.tolist())):
            slam.process(form, time_s=0.1 * step)
    assert len({slam.to_bytes() for slam in slams}) == 1


def test_threads_share_a_map() -> None:
    slam = Slam(scanner=SCANNER)
    slam.process(room(0.0), time_s=0.0)
    stop = threading.Event()
    failures: list[BaseException] = []

    def read() -> None:
        try:
            while not stop.is_set():
                slam.map(), slam.trajectory(), slam.graph(), slam.remarks
        except BaseException as error:
            failures.append(error)

    readers = [threading.Thread(target=read) for _ in range(2)]
    for reader in readers:
        reader.start()
    drive(slam, 10)
    slam.finish()
    stop.set()
    for reader in readers:
        reader.join()
    assert not failures


def command(path: Path, out: Path, *more: str) -> None:
    subprocess.run(
        [sys.executable, "-m", "periplus", "slam", path, "-o", out, "--quiet", *more],
        check=True,
        stdout=subprocess.DEVNULL,
    )


@pytest.mark.parametrize("method", ["graph", "gmapping"])
def test_a_log_gives_what_the_command_gives(method: str, tmp_path: Path) -> None:
    path = tmp_path / "raw.clf"
    lines = log("fr101" if method == "graph" else "edmonton").read_text().splitlines()
    path.write_text("\n".join(lines if method == "graph" else lines[:1800]))
    if method == "graph":
        slam = Slam.from_log(path, finish=False)
        session = ["--save-session", str(tmp_path / "session"), "--g2o", str(tmp_path / "g2o")]
        command(path, tmp_path, *session)
        assert slam.to_bytes() == (tmp_path / "session").read_bytes()
        slam.finish()
        assert slam.g2o() == (tmp_path / "g2o").read_text()
    else:
        slam = Slam.from_log(path, "gmapping", particles=8)
        command(path, tmp_path, "--method", "gmapping", "-p", "particles:=8")
    written = np.loadtxt(tmp_path / "trajectory.txt")
    np.testing.assert_array_equal(np.char.mod("%.6f", slam.trajectory()), np.char.mod("%.6f", written))
    cells = slam.map().cells
    header, image = (tmp_path / "map.pgm").read_bytes().split(b"255\n", 1)
    width, height = (int(it) for it in header.split()[-2:])
    picture = np.frombuffer(image, np.uint8).reshape(height, width)[::-1]
    # The file has three values: occupied from 65 %, free up to 25 %, as the map saver of Nav2 writes them.
    assert cells.shape == picture.shape
    np.testing.assert_array_equal(cells >= 65, picture == 0)
    np.testing.assert_array_equal((cells >= 0) & (cells <= 25), picture == 254)


def test_scans_one_by_one_give_what_the_log_gives() -> None:
    path = log("fr101")
    whole = Slam.from_log(path, finish=False)
    times, ranges, odometry = [], [], []
    for line in path.read_text().splitlines():
        words = line.split()
        if not words or words[0] != "FLASER":
            continue
        count = int(words[1])
        numbers = [float(it) for it in words[2 : 2 + count + 6]]
        ranges.append(numbers[:count])
        odometry.append(numbers[count + 3 : count + 6])
        times.append(int(round(float(words[2 + count + 6]) * 1e6)) * 1000)
    assert len(times) == whole.counts["scans"]
    beams = len(ranges[0])
    largest = np.float32(0.99) * np.array(ranges, np.float32).max()
    increment = np.pi / (beams - beams % 2)
    scanner = LaserScanner(-np.pi / 2, increment, range_min=0.02, range_max=float(largest))
    slam = Slam(scanner=scanner)
    slam.process_many(ranges, odometry, times_ns=times)
    assert slam.to_bytes() == whole.to_bytes()


def test_logs_that_are_none(tmp_path: Path) -> None:
    path = tmp_path / "x.log"
    path.write_text("PARAM robot_width 0.5\n")
    with pytest.raises(FileError):
        Slam.from_log(path)
    with pytest.raises(FileNotFoundError):
        Slam.from_log(tmp_path / "none.log")


def interrupt_after(seconds: float) -> threading.Timer:
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_ctrl_c_ends_the_mapping_of_a_log() -> None:
    path = log("aces")
    timer = interrupt_after(0.2)
    is_mapped = False
    with pytest.raises(KeyboardInterrupt):
        Slam.from_log(path)
        is_mapped = True
        time.sleep(5.0)
    assert not is_mapped
    timer.join()


def test_ctrl_c_in_finish_leaves_the_map_as_it_was() -> None:
    slam = Slam.from_log(log("intel"), finish=False)
    before = slam.to_bytes()
    timer = interrupt_after(0.1)
    with pytest.raises(KeyboardInterrupt):
        slam.finish()
        time.sleep(5.0)
    timer.join()
    assert slam.to_bytes() == before
    slam.finish()
    assert slam.to_bytes() != before


def test_ctrl_c_in_finish_of_particles() -> None:
    slam = Slam.from_log(log("edmonton"), "gmapping", particles=3, finish=False)
    timer = interrupt_after(0.05)
    with pytest.raises(KeyboardInterrupt):
        slam.finish()
        time.sleep(5.0)
    timer.join()
    # The next call waits for the map that the thread finishes.
    assert slam.counts["keyframes"] > 10 and slam.map().cells.size > 0
