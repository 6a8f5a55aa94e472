"""Buffer of transforms, and the transformation of messages."""

import math
import threading

import numpy as np
import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

import tf2_ros  # noqa: E402
from geometry_msgs.msg import Point32, PointStamped, Pose, PoseStamped, PoseWithCovarianceStamped, TransformStamped  # noqa: E402
from rclpy.duration import Duration  # noqa: E402
from rclpy.time import Time  # noqa: E402


def transform(parent: str, child: str, x: float = 0.0, time_s: float = 1.0, yaw: float = 0.0) -> TransformStamped:
    made = TransformStamped(child_frame_id=child)
    made.header.frame_id = parent
    made.header.stamp = Time(seconds=time_s).to_msg()
    made.transform.translation.x = x
    made.transform.rotation.z, made.transform.rotation.w = math.sin(yaw / 2), math.cos(yaw / 2)
    return made


@pytest.fixture
def buffer() -> tf2_ros.Buffer:
    made = tf2_ros.Buffer()
    made.set_transform_static(transform("map", "odom", 10.0), "me")
    made.set_transform(transform("odom", "base", 1.0, 1.0), "me")
    made.set_transform(transform("odom", "base", 3.0, 2.0), "me")
    return made


def test_lookup_between_samples(buffer: tf2_ros.Buffer) -> None:
    made = buffer.lookup_transform("map", "base", Time(seconds=1.5))
    assert made.header.frame_id == "map" and made.child_frame_id == "base"
    assert made.transform.translation.x == pytest.approx(12.0)
    assert (made.header.stamp.sec, made.header.stamp.nanosec) == (1, 500_000_000)


@pytest.mark.parametrize("latest", [Time(), Time().to_msg()])
def test_time_0_is_the_latest(buffer: tf2_ros.Buffer, latest: object) -> None:
    made = buffer.lookup_transform("map", "base", latest)
    assert made.transform.translation.x == 13.0 and made.header.stamp.sec == 2


def test_lookup_across_times(buffer: tf2_ros.Buffer) -> None:
    made = buffer.lookup_transform_full("base", Time(seconds=2), "base", Time(seconds=1), "map")
    assert made.transform.translation.x == pytest.approx(-2.0)


@pytest.mark.parametrize(
    ("target", "source", "time_s", "text"),
    [
        ("map", "nope", 0, '"nope" passed to lookupTransform argument source_frame does not exist. '),
        (
            "odom", "base", 9,
            "Lookup would require extrapolation into the future.  Requested time 9.000000 but the latest data is at time "
            "2.000000, when looking up transform from frame [base] to frame [odom]",
        ),
    ],
)  # fmt: skip
def test_texts_of_errors(buffer: tf2_ros.Buffer, target: str, source: str, time_s: int, text: str) -> None:
    with pytest.raises(tf2_ros.TransformException) as error:
        buffer.lookup_transform(target, source, Time(seconds=time_s))
    assert str(error.value) == text


def test_can_transform_gives_1_or_0_and_the_reason(buffer: tf2_ros.Buffer) -> None:
    assert buffer.can_transform("map", "base", Time()) == 1
    assert buffer.can_transform("map", "nope", Time(), return_debug_tuple=True) == (
        0,
        "canTransform: source_frame nope does not exist.",
    )


def test_lookup_waits_for_a_transform(buffer: tf2_ros.Buffer) -> None:
    timer = threading.Timer(0.1, lambda: buffer.set_transform(transform("base", "late", 1.0, 2.0), "me"))
    timer.start()
    made = buffer.lookup_transform("map", "late", Time(), timeout=Duration(seconds=20))
    timer.join()
    assert made.transform.translation.x == 14.0


def test_future_is_done_once_the_transform_is_there(buffer: tf2_ros.Buffer) -> None:
    future = buffer.wait_for_transform_async("map", "late", Time())
    assert not future.done()
    buffer.set_transform(transform("base", "late", 1.0, 2.0), "me")
    assert future.done() and future.result().transform.translation.x == 14.0


def test_clear_keeps_static_transforms(buffer: tf2_ros.Buffer) -> None:
    buffer.clear()
    assert buffer.can_transform("map", "odom", Time()) and not buffer.can_transform("map", "base", Time())


@pytest.mark.parametrize(
    ("bad", "code"),
    [
        (transform("a", "a"), "TF_SELF_TRANSFORM"),
        (transform("", "a"), "TF_NO_FRAME_ID"),
        (transform("a", ""), "TF_NO_CHILD_FRAME_ID"),
        (transform("a", "b", math.nan), "TF_NAN_INPUT"),
        (TransformStamped(child_frame_id="b"), "TF_NO_FRAME_ID"),
    ],
)
def test_bad_transforms_are_logged_and_ignored(bad: TransformStamped, code: str, capfd: pytest.CaptureFixture[str]) -> None:
    buffer = tf2_ros.Buffer()
    buffer.set_transform(bad, "me")
    assert code in capfd.readouterr().err
    assert buffer._getFrameStrings() == []


def test_quaternion_without_length_is_ignored(capfd: pytest.CaptureFixture[str]) -> None:
    bad = transform("a", "b")
    bad.transform.rotation.w = 0.0
    tf2_ros.Buffer().set_transform(bad, "me")
    assert "TF_DENORMALIZED_QUATERNION" in capfd.readouterr().err


def test_wrong_time_is_named(buffer: tf2_ros.Buffer) -> None:
    with pytest.raises(TypeError, match="time must have sec and nanosec, or nanoseconds"):
        buffer.lookup_transform("map", "base", 5.0)


# ---- messages


def test_poses_turn_with_the_frame() -> None:
    import tf2_geometry_msgs

    turn = transform("map", "base", 1.0, yaw=math.pi / 2)
    pose = Pose()
    pose.position.x = 2.0
    made = tf2_geometry_msgs.do_transform_pose(pose, turn)
    assert (made.position.x, made.position.y) == pytest.approx((1.0, 2.0))
    assert (made.orientation.z, made.orientation.w) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)))
    with pytest.raises(TypeError, match="do_transform_pose_stamped"):
        tf2_geometry_msgs.do_transform_pose(PoseStamped(), turn)


def test_covariances_turn_with_the_frame() -> None:
    import tf2_geometry_msgs

    pose = PoseWithCovarianceStamped()
    pose.pose.covariance[0] = 4.0
    made = tf2_geometry_msgs.do_transform_pose_with_covariance_stamped(pose, transform("map", "base", yaw=math.pi / 2))
    assert made.pose.covariance[7] == pytest.approx(4.0) and made.pose.covariance[0] == pytest.approx(0.0)


def test_buffer_transforms_messages(buffer: tf2_ros.Buffer) -> None:
    import tf2_geometry_msgs  # noqa: F401
    from geometry_msgs.msg import PolygonStamped

    polygon = PolygonStamped()
    polygon.header.frame_id = "base"
    polygon.polygon.points = [Point32(x=1.0)]
    assert buffer.transform(polygon, "map").polygon.points[0].x == 14.0
    point = PointStamped()
    point.header.frame_id = "base"
    point.header.stamp = Time(seconds=1).to_msg()
    assert buffer.transform_full(point, "map", Time(seconds=2), "odom").point.x == 11.0


def test_clouds_move() -> None:
    from sensor_msgs_py import point_cloud2
    from std_msgs.msg import Header
    from tf2_sensor_msgs import do_transform_cloud

    cloud = point_cloud2.create_cloud_xyz32(Header(frame_id="base"), [[1, 0, 0], [0, 1, 0]])
    made = do_transform_cloud(cloud, transform("map", "base", 1.0, yaw=math.pi / 2))
    assert made.header.frame_id == "map"
    assert np.allclose(point_cloud2.read_points_numpy(made), [[1, 1, 0], [0, 0, 0]], atol=1e-6)


# ---- rotations


def test_euler_angles_of_all_orders() -> None:
    import tf_transformations as tf
    from periplus.ros._transformations import AXES2TUPLE

    for axes in AXES2TUPLE:
        angles = (0.4, 0.5, -0.6)
        turned = tf.euler_matrix(*angles, axes)
        assert tf.euler_from_matrix(turned, axes) == pytest.approx(angles)
        assert np.allclose(tf.quaternion_matrix(tf.quaternion_from_matrix(turned)), turned)


def test_yaw() -> None:
    import tf_transformations as tf

    x, y, z, w = tf.quaternion_from_euler(0, 0, math.pi / 2)
    assert (x, y, z, w) == pytest.approx((0, 0, math.sqrt(0.5), math.sqrt(0.5)))
    assert tf.euler_from_quaternion([x, y, z, w])[2] == pytest.approx(math.pi / 2)
