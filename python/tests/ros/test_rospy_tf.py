"""Transforms of ROS 1 programs: tf, tf2_ros, tf2_geometry_msgs and tf.transformations."""

from pathlib import Path

from rospy_programs import run_in_lockstep


def check(folder: Path, source: str, expected: str) -> None:
    assert run_in_lockstep(folder, source).splitlines() == expected.splitlines()


def test_a_listener_waits_for_what_a_broadcaster_sends(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy, tf
        from geometry_msgs.msg import PointStamped, PoseStamped
        rospy.init_node("n")
        listener = tf.TransformListener()
        broadcaster = tf.TransformBroadcaster()
        turn = tf.transformations.quaternion_from_euler(0, 0, 1.5707963267948966)
        def send(event):
            broadcaster.sendTransform((1, 2, 0), turn, rospy.Time.now(), "base", "odom")
        rospy.Timer(rospy.Duration(0.5), send)
        begin = rospy.get_time()
        try:
            listener.waitForTransform("odom", "base", rospy.Time(), rospy.Duration(0.2))
        except tf.Exception as error:
            print(round(rospy.get_time() - begin, 3), error)
        listener.waitForTransform("/odom", "/base", rospy.Time(), rospy.Duration(5))
        position, quaternion = listener.lookupTransform("/odom", "base", rospy.Time(0))
        print(round(rospy.get_time() - begin, 3), position, [round(one, 3) for one in quaternion])
        pose = PoseStamped()
        pose.header.frame_id = "base"
        pose.pose.position.x = 1
        pose.pose.orientation.w = 1
        moved = listener.transformPose("odom", pose)
        print(moved.header.frame_id, round(moved.pose.position.x, 3), round(moved.pose.position.y, 3))
        point = PointStamped()
        point.header.frame_id = "base"
        point.point.y = 1
        print(round(listener.transformPoint("odom", point).point.x, 3))
        for wrong, error in ((("odom", "cup"), tf.LookupException), (("odom", "base"), tf.ExtrapolationException)):
            try:
                listener.lookupTransform(*wrong, rospy.Time(1))
            except error as caught:
                print(type(caught).__name__)
        print(listener.frameExists("base"), listener.canTransform("odom", "base", rospy.Time()))
        """,
        "0.2 canTransform: target_frame odom does not exist. canTransform: source_frame base does not exist.\n"
        "0.5 [1.0, 2.0, 0.0] [0.0, 0.0, 0.707, 0.707]\nodom 1.0 3.0\n0.0\nLookupException\nExtrapolationException\nTrue True",
    )


def test_the_buffer_of_tf2_with_static_transforms(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy, tf2_ros, tf2_geometry_msgs
        from geometry_msgs.msg import PoseStamped, TransformStamped
        rospy.init_node("n")
        static = tf2_ros.StaticTransformBroadcaster()
        def frame(child, x):
            made = TransformStamped()
            made.header.frame_id, made.child_frame_id = "map", child
            made.header.stamp = rospy.Time.now()
            made.transform.translation.x, made.transform.rotation.w = x, 1
            return made
        static.sendTransform(frame("a", 1))
        static.sendTransform([frame("b", 2), frame("a", 3)])
        buffer = tf2_ros.Buffer()
        tf2_ros.TransformListener(buffer)
        found = buffer.lookup_transform("a", "b", rospy.Time(0), rospy.Duration(1))
        print(found.transform.translation.x, found.header.frame_id, found.child_frame_id)
        pose = PoseStamped()
        pose.header.frame_id = "b"
        pose.pose.orientation.w = 1
        print(buffer.transform(pose, "map").pose.position.x, buffer.can_transform("a", "c", rospy.Time()))
        try:
            buffer.lookup_transform("map", "c", rospy.Time(0))
        except tf2_ros.LookupException as error:
            print(error)
        """,
        '-1.0 a b\n2.0 False\n"c" passed to lookupTransform argument source_frame does not exist. ',
    )


def test_transformations_are_those_of_the_classic_module(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import numpy as np
        from tf import transformations as t
        q = t.quaternion_from_euler(0.1, 0.2, 0.3)
        print(np.allclose(t.euler_from_quaternion(q), (0.1, 0.2, 0.3)), np.round(q, 4).tolist())
        matrix = t.concatenate_matrices(t.translation_matrix((1, 2, 3)), t.rotation_matrix(0.5, (0, 0, 1)))
        print(np.allclose(t.euler_from_matrix(matrix, "sxyz"), (0, 0, 0.5)), t.translation_from_matrix(matrix).tolist())
        for axes in t._AXES2TUPLE:
            assert np.allclose(t.euler_matrix(*t.euler_from_matrix(t.euler_matrix(0.4, 0.5, 0.6, axes), axes), axes),
                               t.euler_matrix(0.4, 0.5, 0.6, axes)), axes
        half = t.quaternion_slerp(q, t.quaternion_from_euler(0.1, 0.2, 0.3), 0.5)
        print(np.allclose(half, q), np.allclose(t.quaternion_multiply(q, t.quaternion_inverse(q)), (0, 0, 0, 1)))
        point, normal = t.reflection_from_matrix(t.reflection_matrix((1, 2, 3), (0, 1, 0)))
        print(np.allclose(abs(normal), (0, 1, 0)), np.allclose(point[1], 2))
        print(np.allclose(np.linalg.det(t.orthogonalization_matrix((2, 3, 4), (90, 90, 90))), 24))
        """,
        "True [0.0343, 0.106, 0.1436, 0.9833]\nTrue [1.0, 2.0, 3.0]\nTrue True\nTrue True\nTrue",
    )


def test_frames_of_kdl_and_points_of_scans(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import math
        import numpy as np
        import PyKDL
        import sensor_msgs.point_cloud2 as points
        from laser_geometry import LaserProjection
        from sensor_msgs.msg import LaserScan
        from tf_conversions import posemath, transformations
        frame = PyKDL.Frame(PyKDL.Rotation.RPY(0.1, 0.2, 0.3), PyKDL.Vector(1, 2, 3))
        matrix = transformations.euler_matrix(0.1, 0.2, 0.3)
        matrix[:3, 3] = 1, 2, 3
        print(np.allclose(posemath.toMatrix(frame), matrix), np.allclose(frame.M.GetRPY(), (0.1, 0.2, 0.3)))
        print(np.allclose(posemath.toMatrix(posemath.fromMsg(posemath.toMsg(frame)) * frame.Inverse()), np.eye(4)))
        print([round(one, 3) for one in frame * PyKDL.Vector(1, 0, 0)], np.allclose(matrix @ (1, 0, 0, 1), [*(frame * PyKDL.Vector(1, 0, 0)), 1]))
        scan = LaserScan(angle_increment=math.pi / 2, range_min=0.1, range_max=10, ranges=[1, math.inf, 2, math.nan])
        cloud = LaserProjection().projectLaser(scan)
        print([(round(one.x, 3), one.index) for one in points.read_points_list(cloud)])
        made = points.create_cloud_xyz32(cloud.header, [(1, 2, 3), (4, 5, math.nan)])
        print(made.width, list(points.read_points(made, skip_nans=True)), list(points.read_points(made, ["y"])))
        """,
        "True True\nTrue\n[1.936, 2.29, 2.801] True\n[(1.0, 0), (-2.0, 2)]\n2 [(1.0, 2.0, 3.0)] [(2.0,), (5.0,)]",
    )
