"""The buffer of transforms: answers by hand, and the errors of tf2."""

import math
import threading
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from periplus import (
    Pose,
    TfBuffer,
    TransformArgumentError,
    TransformConnectivityError,
    TransformError,
    TransformExtrapolationError,
    TransformLookupError,
)


@pytest.fixture
def buffer() -> TfBuffer:
    """A robot that drives along x at 1 m/s from 1 s to 3 s, with a laser 0.25 m ahead."""
    tf = TfBuffer()
    for second in (1.0, 2.0, 3.0):
        tf.set_transform("odom", "base_link", (second, 0.0, 0.0), time_s=second)
    tf.set_transform("base_link", "laser", (0.25, 0.0, math.pi / 2), is_static=True)
    return tf


def test_interpolates_and_follows_chains(buffer: TfBuffer) -> None:
    pose = buffer.lookup("odom", "laser", time_s=1.5)
    assert (pose.x, pose.y) == (1.75, 0.0)
    assert pose.yaw == pytest.approx(math.pi / 2)
    assert buffer.lookup("laser", "odom", 1.5).y == pytest.approx(1.75)
    assert buffer.lookup("odom", "laser").x == 3.25
    assert buffer.latest_time("odom", "laser") == 3.0
    assert buffer.latest_time_ns("odom", "laser") == 3_000_000_000
    assert buffer.lookup("odom", "laser", time_ns=1_500_000_001).x == pytest.approx(1.750000001, abs=1e-12)


def test_many_times_are_rows(buffer: TfBuffer) -> None:
    rows = buffer.lookup_many("odom", "base_link", [1.0, 1.25, 3.0])
    assert rows.shape == (3, 7) and rows.dtype == np.float64
    assert rows[:, 0].tolist() == [1.0, 1.25, 3.0]
    assert rows[:, 3:].tolist() == [[0.0, 0.0, 0.0, 1.0]] * 3
    assert buffer.lookup_many("odom", "base_link", []).shape == (0, 7)
    times = np.arange(1_000_000_000, 3_000_000_000, 250_000_000)
    np.testing.assert_allclose(buffer.lookup_many("odom", "base_link", times_ns=times)[:, 0], times / 1e9)


def test_rows_without_a_transform(buffer: TfBuffer) -> None:
    with pytest.raises(TransformExtrapolationError):
        buffer.lookup_many("odom", "base_link", [2.0, 9.0])
    rows = buffer.lookup_many("odom", "base_link", [2.0, 9.0], missing="nan")
    assert rows[0, 0] == 2.0 and np.isnan(rows[1]).all()
    with pytest.raises(TransformLookupError):
        buffer.lookup_many("odom", "nowhere", [2.0], missing="nan")
    with pytest.raises(ValueError, match="missing"):
        buffer.lookup_many("odom", "base_link", [2.0], missing="no")  # type: ignore[arg-type]


def test_errors_have_the_texts_of_tf2(buffer: TfBuffer) -> None:
    with pytest.raises(TransformLookupError, match='^"arm" passed to lookupTransform argument source_frame does not exist'):
        buffer.lookup("odom", "arm")
    with pytest.raises(TransformExtrapolationError, match="^Lookup would require extrapolation into the future"):
        buffer.lookup("odom", "base_link", 4.0)
    with pytest.raises(TransformExtrapolationError, match="extrapolation into the past"):
        buffer.lookup("odom", "base_link", 0.5)
    buffer.set_transform("a", "b", Pose(), is_static=True)
    with pytest.raises(TransformConnectivityError, match="not part of the same tree"):
        buffer.lookup("odom", "a")
    with pytest.raises(TransformArgumentError, match="cannot start with a '/'"):
        buffer.lookup("/odom", "laser")
    for error in (TransformLookupError, TransformExtrapolationError, TransformConnectivityError):
        assert issubclass(error, TransformError) and issubclass(error, LookupError)
    assert buffer.can_transform("odom", "laser") and not buffer.can_transform("odom", "laser", 4.0)


def test_rejected_transforms(buffer: TfBuffer) -> None:
    with pytest.raises(ValueError, match="TF_SELF_TRANSFORM"):
        buffer.set_transform("a", "a", Pose())
    with pytest.raises(ValueError, match="TF_NO_CHILD_FRAME_ID"):
        buffer.set_transform("a", "", Pose())
    buffer.set_transform("odom", "base_link", Pose(), time_s=100.0)
    with pytest.raises(ValueError, match="TF_OLD_DATA"):
        buffer.set_transform("odom", "base_link", Pose(), time_s=1.0)
    with pytest.raises(ValueError, match="row 1: TF_DENORMALIZED"):
        buffer.set_transforms("p", "q", [[0, 0, 0, 0, 0, 0, 1], [0, 0, 0, 0, 0, 0, 2]], [1.0, 2.0])


def test_wrong_arguments(buffer: TfBuffer) -> None:
    with pytest.raises(TypeError, match="not both"):
        buffer.lookup("odom", "laser", 1.0, time_ns=1)
    with pytest.raises(TypeError, match="times_ns"):
        buffer.lookup_many("odom", "laser", times_ns=[1.5])
    with pytest.raises(TypeError):
        buffer.lookup_many("odom", "laser")
    with pytest.raises(ValueError, match="time_s"):
        buffer.lookup("odom", "laser", math.nan)
    with pytest.raises(ValueError, match="cache_time_s"):
        TfBuffer(-1.0)
    with pytest.raises(ValueError, match=r"\(N, 7\) or \(N, 3\)"):
        buffer.set_transforms("p", "q", [[1.0, 2.0]], [1.0])
    with pytest.raises(ValueError, match="2 poses and 1 times"):
        buffer.set_transforms("p", "q", np.zeros((2, 3)), [1.0])
    with pytest.raises(ValueError, match="finite"):
        buffer.set_transforms("p", "q", [[math.nan, 0, 0]], [1.0])


def test_tree_and_status(buffer: TfBuffer) -> None:
    assert buffer.tree() == "odom\n  base_link\n    laser (static)\n"
    assert buffer.frames() == ["base_link", "odom", "laser"]
    assert (buffer.parent("laser"), buffer.parent("odom")) == ("base_link", None)
    assert buffer.chain("odom", "laser") == ["laser", "base_link", "odom"]
    status = {row["frame"]: row for row in buffer.frame_status()}
    assert status["base_link"]["sample_count"] == 3 and status["laser"]["is_static"]
    assert "broadcaster: 'python'" in buffer.frames_yaml()
    buffer.clear()
    assert not buffer.can_transform("odom", "laser") and buffer.can_transform("base_link", "laser")


def test_a_loop_is_an_error_not_a_hang() -> None:
    tf = TfBuffer()
    tf.set_transform("a", "b", Pose(), 1.0)
    tf.set_transform("b", "a", Pose(), 1.0)
    tf.set_transform("c", "d", Pose(), 1.0)
    with pytest.raises(TransformError):
        tf.lookup("d", "a", 1.0)
    assert "a" in tf.tree()


def test_old_samples_leave() -> None:
    tf = TfBuffer(cache_time_s=1.0)
    for second in range(5):
        tf.set_transform("odom", "base", (float(second), 0.0, 0.0), float(second + 1))
    with pytest.raises(TransformExtrapolationError):
        tf.lookup("odom", "base", 2.0)


def test_late_times_keep_their_digits() -> None:
    tf = TfBuffer()
    late_ns = 1_700_000_000_123_456_789
    tf.set_transform("odom", "base", (1.0, 0.0, 0.0), time_ns=late_ns)
    assert tf.latest_time_ns("odom", "base") == late_ns
    assert tf.latest_time("odom", "base") == pytest.approx(late_ns * 1e-9)


def test_threads_share_a_buffer() -> None:
    tf = TfBuffer()
    tf.set_transform("odom", "base", (1.0, 0.0, 0.0), 1.0)

    def write() -> None:
        for step in range(2000):
            tf.set_transform("odom", "base", (1.0, 0.0, 0.0), 1.0 + 1e-3 * step)
            tf.frame_status()

    writers = [threading.Thread(target=write) for _ in range(3)]
    for writer in writers:
        writer.start()
    for _ in range(200):
        assert (tf.lookup_many("odom", "base", np.full(50, 1.0))[:, 0] == 1.0).all()
    for writer in writers:
        writer.join()


finite = st.floats(-1e6, 1e6)


@given(
    poses=st.lists(st.tuples(finite, finite, st.floats(-math.pi, math.pi)), min_size=1, max_size=20),
    dtype=st.sampled_from([np.float64, np.float32]),
    step=st.sampled_from([1, 2]),
)
def test_rows_come_back(poses: list[tuple[float, float, float]], dtype: Any, step: int) -> None:
    array: np.ndarray[Any, Any] = np.repeat(np.array(poses, dtype), step, axis=0)[::step]
    times = np.arange(1, len(poses) + 1) * 0.1
    tf = TfBuffer()
    tf.set_transforms("odom", "base", array, times)
    rows = tf.lookup_many("odom", "base", times)
    np.testing.assert_array_equal(rows[:, :2], array[:, :2].astype(float))
    yaw = 2 * np.arctan2(rows[:, 5], rows[:, 6])
    np.testing.assert_allclose(np.cos(yaw - array[:, 2]), 1.0, atol=1e-9)


@given(st.one_of(st.none(), st.text(max_size=3), st.floats(), st.integers(), st.lists(st.floats(), max_size=9)))
def test_anything_as_an_argument_never_crashes(anything: object) -> None:
    tf = TfBuffer()
    for call in (
        lambda: tf.set_transform("a", "b", anything),  # type: ignore[arg-type]
        lambda: tf.set_transforms("a", "b", anything, anything),  # type: ignore[arg-type]
        lambda: tf.lookup_many("a", "b", anything),  # type: ignore[arg-type]
        lambda: tf.lookup_many("a", "b", times_ns=anything),  # type: ignore[arg-type]
        lambda: tf.lookup("a", "b", anything),  # type: ignore[arg-type]
    ):
        try:
            call()
        except (TypeError, ValueError, OverflowError, TransformError):
            pass
