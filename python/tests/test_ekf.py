"""The extended Kalman filter: answers by hand, and errors of arguments and files."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from periplus import Ekf, FileError, Pose

SMALL = [1e-4] * 6


def use(*names: str) -> list[bool]:
    return [name in names for name in Ekf.VARIABLES]


def test_variables() -> None:
    assert Ekf.VARIABLES[:6] == ("x", "y", "z", "roll", "pitch", "yaw") and len(Ekf.VARIABLES) == 15


def test_two_equal_measurements_meet_in_the_middle() -> None:
    ekf = Ekf()
    ekf.set_state(np.zeros(15), np.full(15, 0.5), time_s=1.0)
    ekf.add_measurement({"x": 2.0}, 0.5, time_s=1.0)
    assert ekf.update(1.0)
    assert ekf.state[0] == pytest.approx(1.0)
    assert ekf.covariance.shape == (15, 15)
    assert ekf.covariance[0, 0] == pytest.approx(0.25) and ekf.covariance[1, 1] == pytest.approx(0.5)


def test_wheels_drive_an_arc() -> None:
    # A quarter of a circle of radius 1 m in pi/2 s ends at (1, 1).
    ekf = Ekf(two_d_mode=True, odom0_config=use("vx", "vy", "vyaw"))
    assert ekf.inputs == ["odom0"]
    for step in range(101):
        ekf.add_twist("odom0", (1.0, 0, 0), (0, 0, 1.0), SMALL, time_s=step * math.pi / 200)
    assert ekf.update(math.pi / 2)
    pose = ekf.pose
    assert (pose.x, pose.y, pose.yaw) == pytest.approx((1.0, 1.0, math.pi / 2), abs=0.02)
    estimate = ekf.estimate
    assert estimate is not None and estimate.time_s == pytest.approx(math.pi / 2)
    assert estimate.linear_velocity[0] == pytest.approx(1.0, abs=1e-3)
    assert estimate.angular_velocity[2] == pytest.approx(1.0, abs=1e-3)
    np.testing.assert_array_equal(estimate.covariance, estimate.covariance.T)
    np.testing.assert_array_equal(estimate.pose_covariance, estimate.covariance[:6, :6])
    np.testing.assert_array_equal(estimate.twist_covariance, estimate.covariance[6:12, 6:12])


def test_prediction_changes_nothing() -> None:
    ekf = Ekf()
    ekf.add_measurement({"x": 0.0, "vx": 2.0}, [1e-6, 1e-6], time_s=0.0)
    ekf.update(0.0)
    assert ekf.predict(0.5).pose.x == pytest.approx(1.0)
    assert ekf.pose.x == pytest.approx(0.0) and ekf.predict(time_ns=-5).time_ns == 0


def test_order_of_arrival_does_not_matter() -> None:
    states = []
    for order in ([0, 1, 2], [2, 0, 1]):
        ekf = Ekf()
        for tick in order:
            ekf.add_measurement({"vx": float(tick)}, 0.1, time_s=0.01 * tick)
        ekf.update(0.02)
        states.append(ekf.state)
    np.testing.assert_array_equal(states[0], states[1])


def test_imu_upside_down_with_gravity() -> None:
    ekf = Ekf(imu0_config=use("vyaw", "ax"), imu0_remove_gravitational_acceleration=True)
    over = Pose(roll=math.pi)
    assert ekf.add_imu(
        "imu0",
        orientation=over.quaternion,
        orientation_covariance=np.eye(3) * 0.01,
        angular_velocity=(0, 0, -0.3),
        angular_velocity_covariance=np.eye(3) * 1e-4,
        linear_acceleration=(0, 0, -9.80665),
        linear_acceleration_covariance=[1e-4] * 3,
        time_s=0.0,
        base_from_sensor=over,
    )
    ekf.update(0.0)
    assert ekf.state[11] == pytest.approx(0.3) and ekf.state[12] == pytest.approx(0.0, abs=1e-9)


def test_missing_parts_of_an_imu() -> None:
    ekf = Ekf(imu0_config=use("yaw", "vyaw"))
    rates: dict[str, Any] = {"angular_velocity": (0, 0, 1), "angular_velocity_covariance": [1e-4] * 3, "time_s": 0.0}
    with pytest.raises(ValueError, match="selects the orientation, which is missing"):
        ekf.add_imu("imu0", **rates)
    with pytest.raises(ValueError, match="orientation, which is missing"):
        ekf.add_imu("imu0", orientation=(0, 0, 0, 1), orientation_covariance=[-1.0] + [0.0] * 8, **rates)
    with pytest.raises(TypeError, match="needs `orientation_covariance`"):
        ekf.add_imu("imu0", orientation=(0, 0, 0, 1), **rates)


def test_differential_poses_are_velocities() -> None:
    ekf = Ekf(pose0_config=use("x", "y"), pose0_differential=True)
    assert not ekf.add_pose("pose0", (5.0, 0.0, 0.0), SMALL, 0.0)
    assert ekf.add_pose("pose0", (6.0, 0.0, 0.0), SMALL, 0.5)
    ekf.update(0.5)
    assert ekf.state[6] == pytest.approx(2.0)


def test_odometry_has_both() -> None:
    ekf = Ekf(odom0_config=use("x", "y", "yaw", "vx"), initial_estimate_covariance=[10.0] * 15)
    assert ekf.add_odometry("odom0", (1.0, 2.0, 0.5), SMALL, (0.25, 0, 0), (0, 0, 0), SMALL, 0.0)
    ekf.update(0.0)
    assert ekf.state[[0, 1, 5, 6]] == pytest.approx([1.0, 2.0, 0.5, 0.25], abs=1e-4)


def test_rejected_measurements_are_listed() -> None:
    ekf = Ekf()
    ekf.add_measurement({"x": 0.0}, 0.01, time_s=0.0)
    ekf.add_measurement({"x": 100.0}, 0.01, time_s=0.0, rejection_threshold=5.0)
    ekf.update(0.0)
    [rejection] = ekf.take_rejections()
    assert rejection["reason"] == "too_far" and rejection["mahalanobis_distance"] > 5.0
    assert ekf.take_rejections() == []


def test_reset() -> None:
    ekf = Ekf()
    ekf.add_measurement({"x": 1.0}, 0.01, time_s=0.0)
    ekf.update(0.0)
    ekf.reset()
    assert ekf.estimate is None
    with pytest.raises(RuntimeError, match="before the first measurement"):
        ekf.state
    with pytest.raises(RuntimeError):
        ekf.predict(1.0)


def test_a_full_queue_is_an_error() -> None:
    ekf = Ekf()
    with pytest.raises(RuntimeError, match="10000 measurements wait"):
        for step in range(10_001):
            ekf.add_measurement({"x": 0.0}, 0.01, time_s=1e-3 * step)
    ekf.update(20.0)
    ekf.add_measurement({"x": 0.0}, 0.01, time_s=20.0)


def test_parameters_are_listed() -> None:
    rows = {row["name"]: row for row in Ekf.parameters()}
    assert rows["frequency"]["default"] == 30.0 and rows["frequency"]["unit"] == "Hz"
    assert rows["odom0_queue_size"]["minimum"] == 1.0 and rows["odom0_config"]["type"] == "list[str]"
    assert all(row["doc"] for row in rows.values())


def test_wrong_parameters() -> None:
    with pytest.raises(TypeError, match="did you mean `frequency`"):
        Ekf(frequenzy=3)
    with pytest.raises(TypeError, match="did you mean `config`"):
        Ekf(odom0_confg=[True])
    with pytest.raises(ValueError, match="15 times true or false"):
        Ekf(odom0_config=[True, False])
    with pytest.raises(ValueError, match="process_noise_covariance"):
        Ekf(process_noise_covariance=[1.0, 2.0])
    with pytest.raises(ValueError, match="out of range"):
        Ekf(frequency=-1.0)
    with pytest.raises(TypeError, match="cannot be of the type"):
        Ekf(frequency=object())
    with pytest.warns(UserWarning, match="use_control"):
        Ekf(use_control=True)


def test_files(tmp_path: Path) -> None:
    good = tmp_path / "ekf.yaml"
    config = ", ".join("true" if it else "false" for it in use("vx"))
    good.write_text(
        "ekf_filter_node:\n  ros__parameters:\n    two_d_mode: true\n    odom0: /odom\n"
        f"    odom0_config: [{config}]\n"
    )
    assert Ekf(good).inputs == ["odom0"]
    assert Ekf(str(good), odom1_config=use("x")).inputs == ["odom0", "odom1"]
    bad = tmp_path / "bad.yaml"
    bad.write_text("ekf_filter_node:\n  ros__parameters:\n    two_d_modus: true\n")
    with pytest.raises(FileError, match="two_d_mode") as error:
        Ekf(bad)
    assert (error.value.line, error.value.column) == (3, 5) and error.value.file == str(bad)
    bad.write_text("ekf_filter_node:\n  ros__parameters:\n    frequency: fast\n")
    with pytest.raises(FileError) as error:
        Ekf(bad)
    assert (error.value.line, error.value.column) == (3, 16)
    bad.write_text("a: [\n")
    with pytest.raises(FileError):
        Ekf(bad)
    with pytest.raises(FileNotFoundError):
        Ekf(tmp_path / "none.yaml")


def test_wrong_readings() -> None:
    ekf = Ekf(odom0_config=use("vx"), imu0_config=use("vyaw"))
    with pytest.raises(ValueError, match="there is no input `odom1`; the inputs are odom0, imu0"):
        ekf.add_twist("odom1", (0, 0, 0), (0, 0, 0), SMALL, 0.0)
    with pytest.raises(ValueError, match="takes no such readings"):
        ekf.add_twist("imu0", (0, 0, 0), (0, 0, 0), SMALL, 0.0)
    with pytest.raises(ValueError, match="`linear` must be finite"):
        ekf.add_twist("odom0", (math.nan, 0, 0), (0, 0, 0), SMALL, 0.0)
    with pytest.raises(ValueError, match="`linear` must have the shape"):
        ekf.add_twist("odom0", (0, 0), (0, 0, 0), SMALL, 0.0)
    with pytest.raises(ValueError, match="variance 0 of `covariance` is negative"):
        ekf.add_twist("odom0", (0, 0, 0), (0, 0, 0), [-1.0] * 6, 0.0)
    skew = np.eye(6)
    skew[0, 1] = 0.5
    with pytest.raises(ValueError, match="symmetric"):
        ekf.add_twist("odom0", (0, 0, 0), (0, 0, 0), skew, 0.0)
    with pytest.raises(TypeError, match="time_s"):
        ekf.add_twist("odom0", (0, 0, 0), (0, 0, 0), SMALL)
    with pytest.raises(ValueError, match="did you mean `yaw`"):
        ekf.add_measurement({"yau": 1.0}, 0.1, time_s=0.0)
    with pytest.raises(ValueError, match="empty"):
        ekf.add_measurement({}, 0.1, time_s=0.0)


@given(hnp.arrays(st.sampled_from([np.float32, np.float64, np.int16]), (6, 6), elements=st.integers(0, 3)))
def test_any_covariance_ends_in_a_state_or_an_error(covariance: np.ndarray) -> None:
    ekf = Ekf(odom0_config=use("vx", "vy", "vyaw"))
    try:
        ekf.add_twist("odom0", (1, 0, 0), (0, 0, 0), covariance.T, 0.0)
        ekf.add_twist("odom0", (1, 0, 0), (0, 0, 0), covariance.T, 0.1)
    except ValueError as error:
        assert "symmetric" in str(error)
        return
    ekf.update(0.1)
    assert np.isfinite(ekf.state).all()


@given(st.one_of(st.none(), st.text(max_size=3), st.floats(), st.lists(st.floats(), max_size=16)))
def test_anything_as_an_argument_never_crashes(anything: object) -> None:
    ekf = Ekf(odom0_config=use("x", "vx"), imu0_config=use("vyaw"))
    for call in (
        lambda: ekf.add_pose("odom0", anything, anything, 0.0),  # type: ignore[arg-type]
        lambda: ekf.add_twist("odom0", anything, anything, anything, 0.0),  # type: ignore[arg-type]
        lambda: ekf.add_imu("imu0", anything, anything, anything, anything, time_s=0.0),  # type: ignore[arg-type]
        lambda: ekf.set_state(anything, anything, 0.0),  # type: ignore[arg-type]
        lambda: ekf.update(anything),  # type: ignore[arg-type]
        lambda: Ekf(process_noise_covariance=anything),
    ):
        try:
            call()
        except (TypeError, ValueError, RuntimeError):
            pass
