"""Publishers, subscribers and messages of rospy."""

from pathlib import Path

from rospy_programs import run_in_lockstep


def check(folder: Path, source: str, expected: str) -> None:
    assert run_in_lockstep(folder, source).splitlines() == expected.splitlines()


def test_publish_takes_a_message_its_fields_or_keywords(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import String
        pub = rospy.Publisher("chatter", String, queue_size=10)
        rospy.init_node("n")
        rospy.Subscriber("/chatter", String, lambda m, extra: print(m.data, extra), callback_args="extra")
        pub.publish(String("a"))
        pub.publish("b")
        pub.publish(data="c")
        rospy.sleep(0.1)
        """,
        "a extra\nb extra\nc extra",
    )


def test_a_latched_message_reaches_a_later_subscriber_once(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n")
        pub = rospy.Publisher("number", Int32, queue_size=1, latch=True)
        pub.publish(1)
        pub.publish(2)
        rospy.sleep(0.1)
        rospy.Subscriber("number", Int32, lambda m: print(m.data))
        rospy.sleep(0.1)
        pub.publish(3)
        rospy.sleep(0.1)
        """,
        "2\n3",
    )


def test_a_best_effort_publisher_is_heard(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n")
        rospy.Subscriber("number", Int32, lambda m: print(m.data))
        qos = ("keep_last", 5, "best_effort", "volatile", None, None, "automatic", None)
        pub = rospy.core.state.node.publisher("/number", "std_msgs/msg/Int32", qos)
        rospy.sleep(0.1)
        pub.publish(Int32(7))
        rospy.sleep(0.1)
        """,
        "7",
    )


def test_callbacks_of_one_topic_run_one_at_a_time_and_others_beside_them(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n")
        begin = rospy.get_time()
        def slow(m):
            print("slow", m.data, round(rospy.get_time() - begin, 3))
            rospy.sleep(0.5)
        def fast(m):
            print("fast", m.data, round(rospy.get_time() - begin, 3))
        rospy.Subscriber("slow", Int32, slow)
        rospy.Subscriber("fast", Int32, fast)
        one = rospy.Publisher("slow", Int32, queue_size=5)
        two = rospy.Publisher("fast", Int32, queue_size=5)
        for i in range(2):
            one.publish(i)
            two.publish(i)
            rospy.sleep(0.1)
        rospy.sleep(1)
        """,
        "slow 0 0.0\nfast 0 0.0\nfast 1 0.1\nslow 1 0.5",
    )


def test_a_queue_keeps_the_newest_messages(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n")
        def slow(m):
            print(m.data)
            rospy.sleep(1)
        rospy.Subscriber("number", Int32, slow, queue_size=1)
        pub = rospy.Publisher("number", Int32, queue_size=100)
        for i in range(5):
            pub.publish(i)
            rospy.sleep(0.1)
        rospy.sleep(3)
        """,
        "0\n4",
    )


def test_an_error_in_a_callback_names_the_topic_and_the_next_call_comes(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import sys
        import rospy
        from std_msgs.msg import Int32
        sys.stderr = sys.stdout
        rospy.init_node("n")
        def callback(m):
            return 1 / m.data
        rospy.Subscriber("number", Int32, lambda m: print("got", 1 / m.data))
        pub = rospy.Publisher("number", Int32, queue_size=5)
        import io, contextlib
        text = io.StringIO()
        with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
            pub.publish(0)
            rospy.sleep(0.1)
        print("ZeroDivisionError" in text.getvalue(), "subscription /number of node /n at 1000.000 s" in text.getvalue())
        pub.publish(2)
        rospy.sleep(0.1)
        """,
        "True True\ngot 0.5",
    )


def test_a_wrong_field_is_named_at_publish(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from geometry_msgs.msg import Twist
        from std_msgs.msg import Int8, String
        rospy.init_node("n")
        def refused(cls, message):
            try:
                rospy.Publisher("topic_" + cls.__name__.lower(), cls, queue_size=1).publish(message)
            except rospy.ROSSerializationException as error:
                print(error)
        wrong = Twist()
        wrong.linear.x = "fast"
        refused(Twist, wrong)
        refused(String, String(5))
        refused(Int8, Int8(300))
        wrong.linear.x = 1
        refused(Twist, wrong)
        """,
        "/topic_twist: field linear.x must be float type, not str\n"
        "/topic_string: field data must be of type str, not int\n"
        "/topic_int8: field data exceeds specified width [int8]",
    )


def test_arrays_arrive_as_tuples_and_bytes(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import numpy as np
        import rospy
        from rospy.numpy_msg import numpy_msg
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import CameraInfo, Image, LaserScan
        rospy.init_node("n")
        def show(cls, read):
            def callback(m):
                print(cls.__name__, read(m))
            rospy.Subscriber(cls.__name__.lower(), cls, callback)
            return rospy.Publisher(cls.__name__.lower(), cls, queue_size=1).publish
        show(LaserScan, lambda m: m.ranges[:1] + m.ranges[1:])(LaserScan(ranges=np.array([1.5, 2.0])))
        show(Image, lambda m: m.data)(Image(data=[1, 2, 3], header=None))
        odometry = Odometry()
        odometry.pose.covariance[0] = 2
        show(Odometry, lambda m: (m.pose.covariance[:2], len(m.pose.covariance), m.header.seq))(odometry)
        show(CameraInfo, lambda m: m.K[:2])(CameraInfo(K=np.arange(9.0).reshape(3, 3).ravel()))
        rospy.sleep(0.1)
        kept = []
        rospy.Subscriber("floats", numpy_msg(LaserScan), kept.append)
        rospy.Publisher("floats", LaserScan, queue_size=1).publish(LaserScan(ranges=[1, 2]))
        rospy.sleep(0.1)
        print(type(kept[0].ranges).__name__, kept[0].ranges.dtype, kept[0].ranges * 2)
        """,
        "LaserScan (1.5, 2.0)\nImage b'\\x01\\x02\\x03'\nOdometry ((2.0, 0.0), 36, 0)\nCameraInfo (0.0, 1.0)\n"
        "ndarray float32 [2. 4.]",
    )


def test_any_msg_has_the_bytes_of_ros_1(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import String
        rospy.init_node("n")
        def callback(m):
            print(m._connection_header["type"], m._buff)
        rospy.Subscriber("chatter", rospy.AnyMsg, callback)
        pub = rospy.Publisher("chatter", String, queue_size=1)
        rospy.sleep(0.5)
        pub.publish("hi")
        rospy.sleep(0.5)
        """,
        "std_msgs/String b'\\x02\\x00\\x00\\x00hi'",
    )


def test_wait_for_message(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n")
        pub = rospy.Publisher("number", Int32, queue_size=1)
        count = iter(range(100))
        timer = rospy.Timer(rospy.Duration(0.5), lambda event: pub.publish(next(count)))
        begin = rospy.get_time()
        for _ in range(3):
            print(rospy.wait_for_message("number", Int32).data, round(rospy.get_time() - begin, 3))
        try:
            rospy.wait_for_message("nothing", Int32, timeout=1)
        except rospy.ROSException as error:
            print(error.message)
        """,
        "0 0.5\n1 1.0\n2 1.5\ntimeout exceeded while waiting for message on topic /nothing",
    )


def test_names_are_remapped_and_resolved(tmp_path: Path) -> None:
    output = run_in_lockstep(
        tmp_path,
        """
        import sys
        import rospy
        from std_msgs.msg import Int32
        rospy.init_node("n", anonymous=True)
        print(rospy.get_name(), rospy.get_namespace(), rospy.myargv(sys.argv)[1:])
        print(rospy.Publisher("scan", Int32, queue_size=1).resolved_name, rospy.Publisher("~x", Int32, queue_size=1).name)
        print(rospy.resolve_name("a/b"), rospy.resolve_name("/a"), rospy.resolve_name("~a"))
        print(rospy.get_param("~speed"), rospy.get_param("/robot/other/names"))
        """,
        "scan:=/front/scan",
        "__name:=other",
        "__ns:=robot",
        "_speed:=1.5",
        "_names:=[a, b]",
        "word",
    )
    assert output.splitlines() == [
        "/robot/other /robot/ ['word']",
        "/front/scan /robot/other/x",
        "/robot/a/b /a /robot/other/a",
        "1.5 ['a', 'b']",
    ]


def test_functions_before_init_node_say_so(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from std_msgs.msg import Int32
        def refused(function):
            try:
                function()
            except (rospy.ROSException, ValueError) as error:
                print(type(error).__name__, error)
        pub = rospy.Publisher("x", Int32, queue_size=1)
        refused(lambda: pub.publish(1))
        refused(rospy.Time.now)
        refused(rospy.spin)
        refused(lambda: rospy.init_node("a/b"))
        rospy.init_node("n")
        refused(lambda: rospy.init_node("m"))
        rospy.init_node("n")
        pub.unregister()
        refused(lambda: pub.publish(1))
        """,
        "ROSException ROS node has not been initialized yet. Please call init_node() first\n"
        "ROSInitException time is not initialized. Have you called init_node()?\n"
        "ROSInitException client code must call rospy.init_node() first\n"
        "ValueError namespaces are not allowed in node names\n"
        "ROSException rospy.init_node() has already been called with different arguments: "
        "('n', (), False, None, False, False)\n"
        "ROSException publish() to a closed topic",
    )
