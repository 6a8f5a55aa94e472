"""Simulations: steps, sensors, truth, topics, and errors."""

import os
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import periplus
from periplus import Pose, Simulation, World
from periplus.msgs.geometry_msgs.msg import Twist
from periplus.msgs.std_srvs.srv import Empty, SetBool, Trigger

ROBOT = """
<sdf version='1.7'><model name='{name}'><link name='body'>
  <collision name='box'><geometry><box><size>1 1 1</size></box></geometry></collision>
  <visual name='box'><geometry><box><size>1 1 1</size></box></geometry></visual>
</link></model></sdf>
"""


@pytest.fixture
def sim() -> Simulation:
    return Simulation(World.demo(), seed=1)


def drive(sim: Simulation, speed: float) -> None:
    command = Twist()
    command.linear.x = speed
    sim.publish("/cmd_vel", command)


def test_time_advances_by_steps_and_seconds(sim: Simulation) -> None:
    assert sim.time_ns == 0
    sim.step()
    assert sim.time_ns == 1_000_000
    sim.step(9)
    assert sim.time_s == pytest.approx(0.01)
    sim.run(0.49)
    assert sim.time_ns == 500_000_000


def test_a_robot_drives_as_commanded(sim: Simulation) -> None:
    drive(sim, 0.2)
    sim.run(2.0)
    robot = sim.model("sam_bot")
    assert 0.25 < robot.pose.x < 0.45
    assert robot.linear_velocity[0] == pytest.approx(0.2, abs=0.02)
    assert set(robot.joint_velocities) == {"drivewhl_l_joint", "drivewhl_r_joint"}
    assert "base_link" in robot.links


def test_equal_seeds_give_equal_numbers_and_others_do_not() -> None:
    def ranges(seed: int) -> bytes:
        sim = Simulation(World.demo(), seed=seed)
        lidar = sim.sensor("/scan")
        drive(sim, 0.2)
        sim.run(1.0)
        return lidar.read().ranges.tobytes()

    assert ranges(1) == ranges(1)
    assert ranges(1) != ranges(2)


def test_a_reset_gives_the_numbers_of_a_new_simulation() -> None:
    def run(sim: Simulation) -> bytes:
        lidar = sim.sensor("/scan")
        drive(sim, 0.2)
        sim.run(1.0)
        return lidar.read().ranges.tobytes() + sim.model("sam_bot").pose.matrix.tobytes()

    used = Simulation(World.demo(), seed=5)
    first = run(used)
    used.reset(seed=7)
    assert used.time_ns == 0
    assert run(used) == run(Simulation(World.demo(), seed=7))
    used.reset(seed=5)
    assert run(used) == first


def test_a_restored_snapshot_gives_the_same_numbers(sim: Simulation) -> None:
    lidar = sim.sensor("/scan")
    drive(sim, 0.2)
    sim.run(0.7)
    start = sim.snapshot()
    assert start.time_s == pytest.approx(0.7)
    outcomes = set()
    for _ in range(3):
        sim.insert(ROBOT.format(name="crate"), (2.0, 1.0, 0.5, 0.0, 0.0, 0.0))
        sim.run(0.6)
        outcomes.add(lidar.read().ranges.tobytes() + sim.model("sam_bot").pose.matrix.tobytes())
        sim.restore(start)
        assert sim.time_ns == 700_000_000
        assert "crate" not in sim.models
    assert len(outcomes) == 1
    with pytest.raises(ValueError, match="another simulation"):
        Simulation(World.demo()).restore(start)


def test_readings_are_views_of_the_messages(sim: Simulation) -> None:
    depth = sim.sensor("/depth_camera/depth/image_raw")
    cloud = sim.sensor("/depth_camera/points")
    lidar = sim.sensor("scan")
    sim.run(0.5)
    image, points, scan = depth.read(), cloud.read(), lidar.read()
    assert image.pixels.shape == (480, 640) and image.pixels.dtype == np.float32
    assert image.pixels.ctypes.data == image.address
    assert len(points) >= 300_000
    assert points.points.ctypes.data == points.address
    assert points.xyz.ctypes.data == points.address
    np.testing.assert_array_equal(points.xyz[..., 2], points.points["z"])
    assert scan.ranges.ctypes.data == scan.address
    assert not scan.ranges.flags.writeable
    kept = scan.ranges
    before = kept.copy()
    del scan
    sim.run(0.5)
    np.testing.assert_array_equal(kept, before)


def test_a_reading_stays_until_there_is_a_newer_one(sim: Simulation) -> None:
    lidar = sim.sensor("/scan")
    assert lidar.read() is None
    sim.run(0.5)
    assert lidar.read() is lidar.read()
    first = lidar.read()
    sim.run(0.5)
    assert lidar.read() is not first


def test_a_scan_has_points_and_a_picture(sim: Simulation) -> None:
    lidar = sim.sensor("/scan")
    sim.run(0.5)
    scan = lidar.read()
    valid = np.isfinite(scan.ranges)
    assert scan.points.shape == (valid.sum(), 2)
    np.testing.assert_allclose(np.hypot(*scan.points.T), scan.ranges[valid], rtol=1e-6)
    assert scan._repr_png_().startswith(b"\x89PNG")


def test_the_run_is_seen_on_ros2() -> None:
    import subprocess

    sim = Simulation(World.demo(), ros2="loopback")
    command = [sys.executable, "-m", "periplus", "topic", "list"]
    found: list[str] = []
    # Discovery takes as long as the machine is busy.
    for _ in range(10):
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as other:
            while other.poll() is None:
                sim.run(0.05, real_time_factor=1.0)
            assert other.stdout is not None
            found = other.stdout.read().split()
        if "/scan" in found:
            break
    assert "/scan" in found


def test_colours_are_rgb(sim: Simulation) -> None:
    camera = sim.sensor("/depth_camera/image_raw")
    sim.run(0.5)
    image = camera.read()
    assert image.rgb.shape == (480, 640, 3)
    red, green, blue = (image.rgb[..., channel].astype(int) for channel in range(3))
    # The red cube is ahead, and nothing else is so red.
    assert ((red > 120) & (green < 80) & (blue < 80)).any()
    assert not ((blue > 120) & (red < 60) & (green < 60)).any()
    assert image._repr_png_().startswith(b"\x89PNG")


def test_a_published_message_reaches_a_subscription(sim: Simulation) -> None:
    heard: list[float] = []
    subscription = sim.subscribe("/chatter", lambda it: heard.append(it.linear.x), Twist)
    for speed in (1.0, 2.0):
        command = Twist()
        command.linear.x = speed
        sim.publish("/chatter", command)
    sim.step()
    assert heard == [1.0, 2.0]
    subscription.cancel()
    sim.publish("/chatter", Twist())
    sim.step(3)
    assert heard == [1.0, 2.0]


def test_a_callback_may_publish_and_step_times_are_those_of_the_messages(sim: Simulation) -> None:
    stamps: list[int] = []

    def on_scan(scan: object) -> None:
        stamps.append(sim.time_ns)
        drive(sim, 0.1)

    sim.subscribe("/scan", on_scan)
    sim.run(1.0)
    assert stamps == sorted(stamps) and len(stamps) >= 4
    assert sim.model("sam_bot").pose.x > 0.03


def test_an_exception_in_a_callback_names_the_topic_and_does_no_harm(sim: Simulation) -> None:
    def on_scan(scan: object) -> None:
        raise ZeroDivisionError("in user code")

    subscription = sim.subscribe("/scan", on_scan)
    with pytest.raises(ZeroDivisionError, match="in user code") as caught:
        sim.run(1.0)
    if sys.version_info >= (3, 11):
        assert caught.value.__notes__ == ["in the callback of /scan"]
    time_ns = sim.time_ns
    subscription.cancel()
    sim.run(0.5)
    assert sim.time_ns == time_ns + 500_000_000


def test_services_of_the_simulation_and_of_python(sim: Simulation) -> None:
    sim.run(0.1)
    assert isinstance(sim.call("/reset_simulation", Empty.Request()), Empty.Response)
    assert sim.time_ns == 0

    def answer(request: SetBool.Request) -> SetBool.Response:
        return SetBool.Response(success=request.data, message="heard")

    sim.create_service("/set", SetBool, answer)
    response = sim.call("/set", SetBool.Request(data=True))
    assert response.success and response.message == "heard"
    with pytest.raises(RuntimeError, match="no server for the service `/none`"):
        sim.call("/none", Trigger.Request())
    with pytest.raises(TypeError, match="must be a request"):
        sim.call("/set", Twist())


def test_parameters(sim: Simulation) -> None:
    names = sim.parameters("/gazebo")
    assert "use_sim_time" in names
    with pytest.raises(KeyError, match="/nobody/get_parameters"):
        sim.get_parameter("nobody", "x")


def test_transforms(sim: Simulation) -> None:
    with pytest.raises(LookupError):
        sim.lookup_transform("odom", "moon")
    drive(sim, 0.2)
    sim.run(1.0)
    pose = sim.lookup_transform("odom", "base_link")
    assert pose.x == pytest.approx(sim.model("sam_bot").pose.x, abs=0.03)


def test_models_are_inserted_moved_pushed_and_removed(sim: Simulation) -> None:
    name = sim.insert(ROBOT.format(name="crate"), (1.0, 1.5, 0.5, 0.0, 0.0, 0.0))
    assert name == "crate" and name in sim.models
    assert sim.insert(ROBOT.format(name="crate"), (5.0, 2.0, 0.5, 0, 0, 0)) == "crate_0"
    crate = sim.model(name)
    assert crate.pose == Pose(1.0, 1.5, 0.5)
    crate.set_pose((1.0, 1.0, 2.0, 0.0, 0.0, 0.5))
    sim.run(0.1)
    assert crate.linear_velocity[2] == pytest.approx(-0.98, abs=0.02)
    crate.set_pose((1.0, 1.5, 0.5, 0.0, 0.0, 0.0))
    crate.apply_wrench([100.0, 0.0, 0.0], duration_s=0.1)
    sim.run(0.1)
    assert crate.linear_velocity[0] > 0.5
    touching = {(it.one[0], it.two[0]) for it in sim.contacts()}
    assert ("floor", "crate") in touching
    sim.remove(name)
    with pytest.raises(KeyError, match="no model \"crate\""):
        sim.remove(name)
    with pytest.raises(KeyError):
        crate.pose


def test_pause_holds_a_run_and_not_a_step(sim: Simulation) -> None:
    sim.paused = True
    sim.step()
    assert sim.time_ns == 1_000_000
    with pytest.raises(RuntimeError, match="paused"):
        sim.run(1.0)
    sim.paused = False
    sim.run(0.01)


def test_a_recording_holds_what_was_published(sim: Simulation, tmp_path: Path) -> None:
    bag = tmp_path / "run.mcap"
    sim.record(bag)
    sim.run(0.5)
    assert sim.stop_recording() == bag
    assert bag.stat().st_size > 1000
    assert sim.stop_recording() is None
    folder = tmp_path / "taken"
    folder.mkdir()
    with pytest.raises(FileExistsError):
        sim.record(folder)


def test_the_page_is_served(sim: Simulation) -> None:
    from urllib.request import urlopen

    url = sim.view(open_browser=False, port=0)
    assert sim.view(open_browser=False) == url
    with urlopen(url, timeout=10) as page:
        assert b"<html" in page.read()
    sim.close_view()


def test_pictures(sim: Simulation) -> None:
    picture = sim.picture(width=64, height=48)
    assert picture.shape == (48, 64, 3) and picture.dtype == np.uint8
    assert sim._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(ValueError):
        sim.picture(width=0)


def test_real_time_is_kept(sim: Simulation) -> None:
    start = time.monotonic()
    sim.run(0.3, real_time_factor=1.0)
    assert time.monotonic() - start > 0.28


def test_ctrl_c_ends_a_run(sim: Simulation) -> None:
    timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        sim.run(1e6)
    timer.join()
    sim.step()


def test_threads_share_a_simulation(sim: Simulation) -> None:
    def step() -> None:
        for _ in range(200):
            sim.step()

    threads = [threading.Thread(target=step) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert sim.time_ns == 800_000_000


def test_files_that_cannot_be_used_are_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        World.load(tmp_path / "none.sdf")
    bad = tmp_path / "bad.sdf"
    bad.write_text("<sdf version='1.7'>\n  <world name='w'>\n    <model\n</sdf>")
    with pytest.raises(periplus.FileError) as caught:
        World.load(bad)
    assert caught.value.file is not None and caught.value.file.endswith("bad.sdf")
    assert caught.value.line is not None and caught.value.line >= 3
    assert isinstance(caught.value, ValueError)


def test_a_robot_is_put_on_a_plane(tmp_path: Path) -> None:
    file = tmp_path / "crate.sdf"
    file.write_text(ROBOT.format(name="crate"))
    world = World().add_robot(file, (2.0, 3.0, 0.5), name="one").add_robot(file, (5.0, 3.0, 0.0))
    sim = Simulation(world)
    assert sim.model("one").pose.position.tolist() == pytest.approx([2.0, 3.0, 0.5], abs=1e-3)
    assert sim.model("one").pose.yaw == pytest.approx(0.5)
    assert "crate" in sim.models


WRONG = st.one_of(
    st.none(), st.booleans(), st.text(max_size=3), st.floats(), st.lists(st.floats(), max_size=7)
)


@settings(deadline=None, max_examples=60)
@given(WRONG, WRONG)
def test_wrong_arguments_raise_and_never_crash(one: object, other: object) -> None:
    sim = Simulation(World(), physics="kinematic")
    robot = sim.model(sim.insert(ROBOT.format(name="crate")))
    calls = [
        lambda: robot.set_pose(one),  # type: ignore[arg-type]
        lambda: robot.set_velocity(one, other),  # type: ignore[arg-type]
        lambda: robot.apply_wrench(one, other),  # type: ignore[arg-type]
        lambda: sim.run(one) if not isinstance(one, float) or not 1 < one < 1e10 else None,  # type: ignore[arg-type]
        lambda: sim.insert(one, other),  # type: ignore[arg-type]
        lambda: sim.sensor(one),  # type: ignore[arg-type]
        lambda: sim.publish(one, other),  # type: ignore[arg-type]
        lambda: sim.subscribe(one, other),  # type: ignore[arg-type]
        lambda: sim.picture(one, width=8, height=8),  # type: ignore[arg-type]
        lambda: sim.call(one, other),  # type: ignore[arg-type]
    ]
    for call in calls:
        try:
            call()
        except (TypeError, ValueError, KeyError, OSError, RuntimeError):
            pass
