"""Scan matching: scans of a room at known poses, and wrong arguments."""

import math

import numpy as np
import periplus
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from periplus import Pose, scan_match, scan_search

ANGLES = np.radians(np.arange(0, 360))


def scan(x: float = 0.0, y: float = 0.0, yaw: float = 0.0) -> np.ndarray:
    """Scan of a room of 6 m by 4 m with a box in a corner, by rays."""
    scene = periplus.RayScene()
    for side, pose in [
        ((0.2, 5, 1), (3.1, 0)),
        ((0.2, 5, 1), (-3.1, 0)),
        ((7, 0.2, 1), (0, 2.1)),
        ((7, 0.2, 1), (0, -2.1)),
        ((0.6, 0.8, 1), (2.2, 1.2)),
    ]:
        scene.add_box(side, Pose(*pose))
    directions = np.stack([np.cos(ANGLES + yaw), np.sin(ANGLES + yaw), 0 * ANGLES], axis=1)
    ranges = scene.cast([x, y, 0], directions).distances
    return np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1) * ranges[:, None]


def test_a_small_motion_is_found() -> None:
    match = scan_match(scan(), scan(0.2, -0.1, 0.1), guess=(0.1, 0.0, 0.05))
    assert abs(match.pose.x - 0.2) < 0.01 and abs(match.pose.y + 0.1) < 0.01
    assert abs(match.pose.yaw - 0.1) < 0.003
    assert match.matched > 0.95 and match.rms_m < 0.02 and 0.5 < match.observability <= 1
    np.testing.assert_allclose(match.covariance @ match.information, np.eye(3), atol=1e-6)


def test_a_corridor_leaves_a_direction_open() -> None:
    x = np.linspace(-5, 5, 200)
    walls = np.concatenate([np.stack([x, 0 * x + 1], 1), np.stack([x[::-1], 0 * x - 1], 1)])
    assert scan_match(walls, walls).observability < 0.1


def test_settings_change_the_result() -> None:
    far = scan_match(scan(), scan(0.6), reach_m=(0.05, 0.05), steps=1)
    assert far.matched < scan_match(scan(), scan(0.6)).matched


def test_missing_returns_are_skipped() -> None:
    points = scan(0.1)
    points[::7] = np.nan
    points[3] = np.inf
    assert abs(scan_match(scan(), points).pose.x - 0.1) < 0.01
    assert abs(scan_match(np.c_[scan(), ANGLES], points).pose.x - 0.1) < 0.01


def test_a_search_needs_no_guess() -> None:
    found = scan_search(scan(), scan(1.3, -0.7, 0.5), half_m=(2, 2), half_rad=1.0)
    assert found is not None
    pose, score = found
    assert abs(pose.x - 1.3) < 0.15 and abs(pose.y + 0.7) < 0.15 and abs(pose.yaw - 0.5) < 0.05
    assert 0.5 < score <= 1.0
    refined = scan_match(scan(), scan(1.3, -0.7, 0.5), pose).pose
    assert abs(refined.x - 1.3) < 0.01 and abs(refined.yaw - 0.5) < 0.005


def test_a_search_without_a_match_returns_none() -> None:
    assert scan_search([[50.0, 50.0]], scan(), half_m=(0.1, 0.1), half_rad=0.1, min_score=0.9) is None
    assert scan_search(np.zeros((0, 2)), np.zeros((0, 2)), half_m=(1, 1), half_rad=0.1) is None


def test_empty_scans() -> None:
    match = scan_match(np.zeros((0, 2)), scan())
    assert match.matched == 0 and np.all(np.isnan(match.covariance))
    assert scan_match(scan(), np.zeros((0, 2)), (1, 2, 0)).pose == Pose(1, 2)


@pytest.mark.parametrize(
    ("run", "error", "words"),
    [
        (lambda: scan_match([1, 2], scan()), ValueError, "reference_points"),
        (lambda: scan_match(scan(), np.zeros((3, 4))), ValueError, "points"),
        (lambda: scan_match(scan(), "scan"), TypeError, "points"),
        (lambda: scan_match(scan(), scan(), (math.nan, 0, 0)), ValueError, "finite"),
        (lambda: scan_match(scan(), scan(), sigma_m=-1.0), ValueError, "sigma_m"),
        (lambda: scan_match(scan(), scan(), reach_m=(1.0, math.nan)), ValueError, "reach_m"),
        (lambda: scan_match(scan(), scan(), angle_increment=0.0), ValueError, "angle_increment"),
        (lambda: scan_match(scan(), scan(), origin=(0, math.inf)), ValueError, "origin"),
        (lambda: scan_match(scan(), scan(), sigma=1.0), TypeError, "sigma"),  # type: ignore[call-arg]
        (lambda: scan_search(scan(), scan(), half_m=(-1, 1), half_rad=1), ValueError, "half_m"),
        (lambda: scan_search(scan(), scan(), half_m=(1e9, 1), half_rad=1), ValueError, "window"),
        (lambda: scan_search(scan(), scan(), half_m=(1, 1), half_rad=math.nan), ValueError, "half_rad"),
        (lambda: scan_search(scan(), scan(), half_m=(1, 1), half_rad=1, min_score=2), ValueError, "min_score"),
    ],
)
def test_wrong_arguments(run, error, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error, match=words):
        run()


@settings(max_examples=60, deadline=None)
@given(
    hnp.arrays(st.sampled_from([np.float64, np.float32, np.int16]), hnp.array_shapes(max_dims=3, max_side=9)),
    hnp.arrays(np.float64, st.tuples(st.integers(0, 12), st.just(2))),
    st.sampled_from([1, -1]),
)
def test_any_points_end_in_a_pose_or_a_clear_error(reference: np.ndarray, points: np.ndarray, step: int) -> None:
    try:
        match = scan_match(reference[::step], points)
        found = scan_search(reference, points, half_m=(0.5, 0.5), half_rad=0.1)
    except (ValueError, TypeError):
        return
    assert np.all(np.isfinite(match.pose.position))
    assert found is None or 0 <= found[1] <= 1
