"""Message classes with the conventions of ROS 1, from the registry and from source trees."""

from pathlib import Path

import pytest
from rospy_programs import run_in_lockstep


def check(folder: Path, source: str, expected: str) -> None:
    assert run_in_lockstep(folder, source).splitlines() == expected.splitlines()


def test_constructors_text_and_equality(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import copy, pickle
        from geometry_msgs.msg import Point, PointStamped
        from std_msgs.msg import Header, String
        print(Point(1, 2, 3) == Point(x=1, y=2.0, z=3), Point.__slots__, Point._type)
        print(PointStamped(header=Header(frame_id="map")))
        for wrong in (lambda: Point(1), lambda: Point(w=1), lambda: Point(1, y=2)):
            try:
                wrong()
            except (TypeError, AttributeError) as error:
                print(error)
        try:
            Point().w = 1
        except AttributeError:
            print("no w")
        stamped = PointStamped(point=Point(1, 2, 3))
        other = copy.deepcopy(stamped)
        other.point.x = 5
        print(stamped.point.x, pickle.loads(pickle.dumps(stamped)) == stamped, other == stamped)
        """,
        "True ['x', 'y', 'z'] geometry_msgs/Point\n"
        "header: \n  seq: 0\n  stamp: \n    secs: 0\n    nsecs:         0\n  frame_id: \"map\"\n"
        "point: \n  x: 0.0\n  y: 0.0\n  z: 0.0\n"
        "Invalid number of arguments, args should be ['x', 'y', 'z'] args are(1,)\nw is not an attribute of Point\n"
        "Message constructor may only use args OR keywords, not both\nno w\n1 True False",
    )


def test_checksums_are_those_of_ros_1(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        from actionlib_msgs.msg import GoalStatusArray
        from geometry_msgs.msg import Twist
        from move_base_msgs.msg import MoveBaseAction
        from nav_msgs.msg import Odometry
        from rospy_tutorials.srv import AddTwoInts
        from sensor_msgs.msg import CameraInfo, LaserScan
        from std_msgs.msg import Header, String, Time
        from std_srvs.srv import SetBool
        for one in (String, Header, Time, Twist, LaserScan, CameraInfo, Odometry, GoalStatusArray, MoveBaseAction, SetBool, AddTwoInts):
            print(one._md5sum, one._type)
        """,
        "992ce8a1687cec8c8bd883ec73ca41d1 std_msgs/String\n2176decaecbce78abc3b96ef049fabed std_msgs/Header\n"
        "cd7166c74c552c311fbcc2fe5a7bc289 std_msgs/Time\n9f195f881246fdfa2798d1d3eebca84a geometry_msgs/Twist\n"
        "90c7ef2dc6895d81024acba2ac42f369 sensor_msgs/LaserScan\nc9a58c1b0b154e0e6da7578cb991d214 sensor_msgs/CameraInfo\n"
        "cd5e73d190d741a2f92e81eda573aca7 nav_msgs/Odometry\n8b2b82f13216d0a8ea88bd3af735e619 actionlib_msgs/GoalStatusArray\n"
        "70b6aca7c7f7746d8d1609ad94c80bb8 move_base_msgs/MoveBaseAction\n09fb03525b03e7ea1fd3992bafd87e16 std_srvs/SetBool\n"
        "6a2e34150c00229791cc89ff309fff21 rospy_tutorials/AddTwoInts",
    )


def test_serialization_in_the_format_of_ros_1(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import io
        import genpy
        from sensor_msgs.msg import LaserScan
        from std_msgs.msg import String, UInt8MultiArray
        from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
        def data(message):
            buffer = io.BytesIO()
            message.serialize(buffer)
            return buffer.getvalue()
        print(data(String("hi")), DiagnosticStatus(level=2).level)
        scan = LaserScan(ranges=[1, 2], range_max=5)
        scan.header.seq, scan.header.stamp = 7, genpy.Time(1, 2)
        back = LaserScan().deserialize(data(scan))
        print(back.header.seq, back.header.stamp.nsecs, back.ranges, back.range_max, back.intensities)
        status = DiagnosticStatus(level=DiagnosticStatus.ERROR, values=[KeyValue("a", "b")])
        print(DiagnosticStatus().deserialize(data(status)) == status)
        for wrong in (lambda: data(String(5)), lambda: String().deserialize(b"\\xff\\0\\0\\0a")):
            try:
                wrong()
            except (genpy.SerializationError, genpy.DeserializationError) as error:
                print(type(error).__name__, error)
        """,
        "b'\\x02\\x00\\x00\\x00hi' 2\n7 2 (1.0, 2.0) 5.0 ()\nTrue\n"
        "SerializationError field data must be of type str, not int\n"
        "DeserializationError std_msgs/String: a string ends behind the last byte",
    )


def package(folder: Path, name: str, files: dict[str, str]) -> None:
    for path, text in {"package.xml": f"<package><name>{name}</name></package>", **files}.items():
        file = folder / "src" / name / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)


def test_types_of_a_source_tree_need_no_build(tmp_path: Path) -> None:
    package(
        tmp_path,
        "my_robot",
        {
            "msg/Wheel.msg": "# a wheel\nuint8 LEFT=0\nstring NAME=left wheel\nHeader header\ntime last\nfloat32[2] speedLimits\nbyte b\n",
            "msg/wheel_list.msg": "Wheel[] wheels\n",
            "srv/Turn.srv": "float64 angle\n---\nbool ok\n",
            "action/Drive.action": "float64 distance\n---\n---\nduration left\n",
            "cfg/Gains.cfg": "from dynamic_reconfigure.parameter_generator_catkin import *\n"
            "gen = ParameterGenerator()\ngen.add('p', double_t, 1, 'gain', 1.5, 0, 2)\n"
            "gen.add('on', bool_t, 0, 'switch', True)\nexit(gen.generate('my_robot', 'n', 'Gains'))\n",
            "src/my_robot/__init__.py": "",
            "src/my_robot/tools.py": "word = 'tool'\n",
        },
    )
    check(
        tmp_path,
        """
        import rospy
        from my_robot.msg import *
        from my_robot.msg import Wheel, wheel_list, DriveAction, DriveGoal, DriveActionFeedback
        from my_robot.srv import Turn, TurnRequest, TurnResponse
        from my_robot.cfg import GainsConfig
        from my_robot import tools
        rospy.init_node("n")
        print(Wheel.LEFT, Wheel.NAME, Wheel.__slots__, Wheel._type, wheel_list._type, Turn._type, tools.word)
        rospy.Subscriber("wheels", wheel_list, lambda m: print(m.wheels[0].speedLimits, m.wheels[0].b, m.wheels[0].last.secs))
        wheel = Wheel(speedLimits=[1, 2], b=-3)
        wheel.last = rospy.Time(5)
        rospy.Publisher("wheels", wheel_list, queue_size=1).publish([wheel])
        rospy.sleep(0.1)
        rospy.Service("turn", Turn, lambda request: request.angle > 0)
        print(rospy.ServiceProxy("turn", Turn)(angle=1).ok, DriveAction().action_goal.goal.distance)
        print(GainsConfig.defaults, GainsConfig.max["p"], GainsConfig.level["p"])
        from dynamic_reconfigure.server import Server
        import dynamic_reconfigure.client
        server = Server(GainsConfig, lambda config, level: (print(config["p"], config.on, level), config)[1])
        client = dynamic_reconfigure.client.Client("n", timeout=5)
        print(client.update_configuration({"p": 5, "on": False})["p"], rospy.get_param("~p"))
        try:
            client.update_configuration({"q": 1})
        except dynamic_reconfigure.DynamicReconfigureParameterException as error:
            print(error)
        import rospkg
        print(rospkg.RosPack().get_path("my_robot").endswith("src/my_robot"))
        """,
        "0 left wheel ['header', 'last', 'speedLimits', 'b'] my_robot/Wheel my_robot/wheel_list my_robot/Turn tool\n"
        "(1.0, 2.0) -3 5\nTrue 0.0\n{'p': 1.5, 'on': True} 2.0 1\n1.5 True 1\n2.0 False 1\n2.0 2.0\n"
        "don't know parameter: q. The parameters of n: on, p\nTrue",
    )


def test_a_wrong_definition_is_named_with_its_line(tmp_path: Path) -> None:
    package(tmp_path, "bad_msgs", {"msg/A.msg": "float64 x\nfloat64\n", "msg/B.msg": "\n"})
    check(
        tmp_path,
        """
        try:
            from bad_msgs.msg import A
        except ImportError as error:
            print(str(error).split("src/")[1])
        try:
            from std_msgs.msg import Strin
        except ImportError as error:
            print(str(error)[:60])
        """,
        "bad_msgs/msg/A.msg:2: `float64` is neither `type name` nor `type NAME=value`\n"
        "cannot import name 'Strin' from 'std_msgs.msg' (unknown loca",
    )


@pytest.mark.parametrize(
    ("files", "text"),
    [
        ({"msg/A.msg": "B b\n", "msg/B.msg": "# back\nA a\n"}, "msg/B.msg:2: `bad_msgs/A` contains itself through the field `a`"),
        ({"msg/A.msg": "A[] all\n"}, "msg/A.msg:1: `bad_msgs/A` contains itself through the field `all`"),
        ({"msg/A.msg": "\nfloat65 y\n"}, "msg/A.msg:2: the type `float65` is unknown: did you mean `float64`?"),
        ({"msg/A.msg": "nav_msgs/Odometri o\n"}, "msg/A.msg:1: the type `nav_msgs/Odometri` is unknown: did you mean `nav_msgs/Odometry`?"),
        ({"msg/A.msg": "geo_msgs/Point p\n"}, "msg/A.msg:1: the type `geo_msgs/Point` is unknown: there is no message package 'geo_msgs'"),
        ({"msg/A.msg": "int8 x\nint8 x\n"}, "msg/A.msg:2: `x` is already defined"),
        ({"msg/A.msg": "uint8 K=300\n"}, "msg/A.msg:1: `300` is not a value of uint8: it has 0 to 255"),
    ],
)
def test_types_that_cannot_be_are_named_with_their_line(tmp_path: Path, files: dict[str, str], text: str) -> None:
    package(tmp_path, "bad_msgs", files)
    program = """
    try:
        from bad_msgs.msg import A
    except ImportError as error:
        print(str(error).split("bad_msgs/", 1)[1])
    """
    check(tmp_path, program, text + "\n")


def test_bags_are_written_and_read(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rosbag, rospy
        from nav_msgs.msg import Odometry
        from std_msgs.msg import String
        for name in ("run.bag", "run.mcap"):
            with rosbag.Bag(name, "w") as bag:
                for i in range(3):
                    bag.write("/chatter", String(f"m{i}"), rospy.Time(i + 1))
                bag.write("/odom", Odometry(), rospy.Time(2))
            with rosbag.Bag(name) as bag:
                for topic, message, stamp in bag.read_messages(topics=["/chatter"], start_time=rospy.Time(2)):
                    print(topic, message.data, stamp.to_sec())
                info = bag.get_type_and_topic_info()
                print(info.topics["/chatter"].msg_type, info.topics["/chatter"].message_count, bag.get_end_time())
                print(len(next(bag.read_messages("/odom")).message.pose.covariance), bag.get_message_count())
        """,
        ("/chatter m1 2.0\n/chatter m2 3.0\nstd_msgs/String 3 3.0\n36 4\n") * 2,
    )


def test_synchronized_messages(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import message_filters, rospy
        from geometry_msgs.msg import PointStamped
        rospy.init_node("n")
        subscribers = [message_filters.Subscriber(name, PointStamped) for name in "ab"]
        def callback(kind):
            return lambda one, two: print(kind, one.header.stamp.to_sec(), two.header.stamp.to_sec())
        exact = message_filters.TimeSynchronizer(subscribers, 5)
        exact.registerCallback(callback("exact"))
        near = message_filters.ApproximateTimeSynchronizer(subscribers, 5, 0.1)
        near.registerCallback(callback("near"))
        cache = message_filters.Cache(subscribers[0], 10)
        publishers = [rospy.Publisher(name, PointStamped, queue_size=1) for name in "ab"]
        for publisher, stamp in ((0, 1.0), (1, 1.0), (0, 2.0), (1, 2.0625), (0, 3.0), (1, 3.1)):
            message = PointStamped()
            message.header.stamp = rospy.Time(stamp)
            publishers[publisher].publish(message)
            rospy.sleep(0.01)
        print(cache.getLatestTime().to_sec(), len(cache.getInterval(rospy.Time(2), rospy.Time(3))))
        """,
        "exact 1.0 1.0\nnear 1.0 1.0\nnear 2.0 2.0625\n3.0 2",
    )


def test_a_state_machine(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import smach
        smach.set_loggers(*[lambda text: None] * 4)
        class Count(smach.State):
            def __init__(self):
                smach.State.__init__(self, outcomes=["more", "end"], input_keys=["number"], output_keys=["number"])
            def execute(self, userdata):
                userdata.number = userdata.number + 1
                return "end" if userdata.number == 3 else "more"
        class Wrong(smach.State):
            def __init__(self):
                smach.State.__init__(self, outcomes=["ok"])
            def execute(self, userdata):
                return "else"
        machine = smach.StateMachine(outcomes=["done"])
        machine.userdata.n = 0
        with machine:
            smach.StateMachine.add("COUNT", Count(), transitions={"more": "COUNT", "end": "BOTH"}, remapping={"number": "n"})
            both = smach.Concurrence(outcomes=["done", "half"], default_outcome="half", outcome_map={"done": {"A": "x", "B": "x"}})
            with both:
                for label in "AB":
                    smach.Concurrence.add(label, smach.CBState(lambda userdata: "x", outcomes=["x"]))
            smach.StateMachine.add("BOTH", both, transitions={"half": "COUNT"})
        print(machine.execute(), machine.userdata.n)
        wrong = smach.StateMachine(outcomes=["ok"])
        with wrong:
            smach.StateMachine.add("W", Wrong())
        try:
            wrong.execute()
        except smach.InvalidTransitionError as error:
            print(str(error)[:40])
        """,
        "done 3\nAttempted to return outcome 'else' preem",
    )
