"""Nodes of rospy in processes of their own, on the network."""

import signal
import subprocess
import time
from pathlib import Path

import pytest
from rospy_programs import start_live


def finish(program: "subprocess.Popen[str]", timeout_s: float = 30) -> tuple[int, str, str]:
    try:
        output, errors = program.communicate(timeout=timeout_s)
    finally:
        program.kill()
    return program.returncode, output, errors


def test_topics_services_actions_and_parameters_between_processes(tmp_path: Path) -> None:
    server = start_live(
        tmp_path,
        "server",
        """
        import actionlib, rospy
        from actionlib_tutorials.msg import FibonacciAction, FibonacciFeedback, FibonacciResult
        from rospy_tutorials.srv import AddTwoInts
        from std_msgs.msg import String
        rospy.init_node("server")
        rospy.set_param("/shared", {"a": 1})
        latched = rospy.Publisher("latched", String, queue_size=1, latch=True)
        latched.publish("from before")
        def add(request):
            if request.a < 0:
                raise ValueError("a is negative")
            return request.a + request.b
        rospy.Service("add", AddTwoInts, add)
        def execute(goal):
            actions.publish_feedback(FibonacciFeedback([0]))
            actions.set_succeeded(FibonacciResult([0, goal.order]))
        actions = actionlib.SimpleActionServer("fibonacci", FibonacciAction, execute, False)
        actions.start()
        def echo(message):
            rospy.set_param("~last", message.data)
            pub.publish(message.data + "!")
        pub = rospy.Publisher("echo", String, queue_size=5)
        rospy.Subscriber("word", String, echo)
        print("ready")
        rospy.spin()
        print("shut down")
        """,
    )
    assert server.stdout is not None and server.stdout.readline() == "ready\n"
    client = start_live(
        tmp_path,
        "client",
        """
        import actionlib, rospy
        from actionlib_tutorials.msg import FibonacciAction, FibonacciGoal
        from rospy_tutorials.srv import AddTwoInts
        from std_msgs.msg import String
        rospy.init_node("client")
        print(rospy.get_param("/shared"), rospy.get_param("/missing", "default"))
        print(rospy.wait_for_message("latched", String, 10).data)
        rospy.wait_for_service("add", 10)
        add = rospy.ServiceProxy("add", AddTwoInts)
        print(add(1, 2).sum)
        try:
            add(-1, 2)
        except rospy.ServiceException as error:
            print(error)
        actions = actionlib.SimpleActionClient("fibonacci", FibonacciAction)
        print(actions.wait_for_server(rospy.Duration(10)))
        print(actions.send_goal_and_wait(FibonacciGoal(5), rospy.Duration(10)), actions.get_result().sequence)
        got = []
        rospy.Subscriber("echo", String, lambda m: got.append(m.data))
        pub = rospy.Publisher("word", String, queue_size=5)
        while not got and not rospy.is_shutdown():
            pub.publish("hello")
            rospy.sleep(0.05)
        print(got[0], rospy.get_param("/server/last"))
        """,
    )
    code, output, errors = finish(client)
    server.send_signal(signal.SIGINT)
    server_code, server_output, server_errors = finish(server)
    assert output.splitlines() == [
        "{'a': 1} default",
        "from before",
        "3",
        "service [/add] responded with an error: b'error processing request: a is negative'",
        "True",
        "3 (0, 5)",
        "hello! hello",
    ], errors + server_errors
    assert (code, server_code, server_output) == (0, 0, "shut down\n")
    assert "ValueError: a is negative" in server_errors


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_loops_without_an_exception(tmp_path: Path, number: int) -> None:
    program = start_live(
        tmp_path,
        "loop",
        """
        import rospy
        rospy.init_node("loop", anonymous=True)
        rospy.on_shutdown(lambda: print("hook"))
        rate = rospy.Rate(20)
        print("ready")
        try:
            while not rospy.is_shutdown():
                rate.sleep()
            print("left")
        except rospy.ROSInterruptException:
            print("interrupted")
        print("end", rospy.is_shutdown())
        """,
    )
    assert program.stdout is not None and program.stdout.readline() == "ready\n"
    time.sleep(0.2)
    program.send_signal(number)
    code, output, errors = finish(program)
    assert output.splitlines()[0] == "hook" and output.splitlines()[-1] == "end True"
    assert (code, errors) == (0, "")


def test_a_node_of_rclpy_and_one_of_rospy_hear_each_other(tmp_path: Path) -> None:
    answerer = start_live(
        tmp_path,
        "answerer",
        """
        import rclpy
        from geometry_msgs.msg import PointStamped
        from std_srvs.srv import SetBool
        rclpy.init()
        node = rclpy.create_node("answerer")
        pub = node.create_publisher(PointStamped, "back", 10)
        def callback(message):
            message.point.x += 1.0
            message.header.stamp.sec += 1
            pub.publish(message)
        node.create_subscription(PointStamped, "there", callback, 10)
        def serve(request, response):
            response.success, response.message = not request.data, "from rclpy"
            return response
        node.create_service(SetBool, "flip", serve)
        print("ready")
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            pass
        """,
    )
    assert answerer.stdout is not None and answerer.stdout.readline() == "ready\n"
    asker = start_live(
        tmp_path,
        "asker",
        """
        import rospy
        from geometry_msgs.msg import PointStamped
        from std_srvs.srv import SetBool
        rospy.init_node("asker")
        rospy.wait_for_service("flip", 10)
        print(rospy.ServiceProxy("flip", SetBool)(True).message)
        got = []
        rospy.Subscriber("back", PointStamped, got.append)
        pub = rospy.Publisher("there", PointStamped, queue_size=5)
        message = PointStamped()
        message.header.stamp = rospy.Time(5, 6)
        message.point.x = 2
        while not got and not rospy.is_shutdown():
            pub.publish(message)
            rospy.sleep(0.05)
        print(got[0].point.x, got[0].header.stamp)
        """,
    )
    code, output, errors = finish(asker)
    answerer.send_signal(signal.SIGINT)
    finish(answerer)
    assert output.splitlines() == ["from rclpy", "3.0 6000000006"], errors
    assert code == 0
