"""Services, parameters and actions of rospy."""

from pathlib import Path

from rospy_programs import run_in_lockstep


def check(folder: Path, source: str, expected: str) -> None:
    assert run_in_lockstep(folder, source).splitlines() == expected.splitlines()


def test_a_handler_returns_a_response_or_its_fields(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        from rospy_tutorials.srv import AddTwoInts, AddTwoIntsRequest, AddTwoIntsResponse
        rospy.init_node("n")
        answers = {
            "response": lambda request: AddTwoIntsResponse(request.a + request.b),
            "value": lambda request: request.a + request.b,
            "list": lambda request: [request.a + request.b],
            "dict": lambda request: {"sum": request.a + request.b},
        }
        for name, handler in answers.items():
            rospy.Service(name, AddTwoInts, handler)
            rospy.wait_for_service(name, timeout=1)
            call = rospy.ServiceProxy(name, AddTwoInts)
            print(call(1, 2).sum, call(a=3, b=4).sum, call(AddTwoIntsRequest(5, 6)).sum)
        """,
        "3 7 11\n" * 4,
    )


def test_failures_of_a_service_reach_the_client(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import sys
        import rospy
        from std_srvs.srv import SetBool
        sys.stderr = open("log.txt", "w")
        rospy.init_node("n")
        def fails(request):
            raise RuntimeError("no power")
        rospy.Service("fails", SetBool, fails)
        rospy.Service("nothing", SetBool, lambda request: None)
        rospy.Service("wrong", SetBool, lambda request: (1, 2, 3))
        for name in ("fails", "nothing", "wrong", "missing"):
            try:
                rospy.ServiceProxy(name, SetBool)(True)
            except rospy.ServiceException as error:
                print(str(error)[:75].strip())
        try:
            rospy.wait_for_service("missing", 0.5)
        except rospy.ROSException as error:
            print(error)
        sys.stderr.flush()
        print("RuntimeError: no power" in open("log.txt").read())
        """,
        "service [/fails] responded with an error: b'error processing request: no po\n"
        "service [/nothing] responded with an error: b'service handler returned None\n"
        "service [/wrong] responded with an error: b\"handler returned invalid value:\n"
        "service [/missing] unavailable\n"
        "timeout exceeded while waiting for service /missing\nTrue",
    )


def test_services_run_beside_each_other(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import threading
        import rospy
        from std_srvs.srv import Empty
        rospy.init_node("n")
        inner = rospy.ServiceProxy("inner", Empty)
        def outer(request):
            rospy.sleep(1)
            return inner()
        rospy.Service("outer", Empty, outer)
        rospy.Service("inner", Empty, lambda request: {})
        begin = rospy.get_time()
        threads = [threading.Thread(target=rospy.ServiceProxy("outer", Empty)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        print(rospy.get_time() - begin)
        """,
        "1.0",
    )


def test_parameters_are_a_tree(tmp_path: Path) -> None:
    check(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        rospy.set_param("robot", {"wheels": {"left": 1, "right": 2}, "name": "kbot"})
        print(rospy.get_param("/robot/wheels"), rospy.get_param("robot/wheels/left"), rospy.has_param("robot/wheels"))
        rospy.set_param("robot/wheels", 4)
        print(rospy.get_param("robot"))
        rospy.set_param("~gain", [1.5, 2])
        print(rospy.get_param("/n/gain"), rospy.search_param("gain"), rospy.search_param("robot"), rospy.search_param("no"))
        rospy.delete_param("robot/wheels")
        print(rospy.get_param("robot"), rospy.get_param("robot/wheels", "default"), rospy.get_param_names())
        for function in (rospy.get_param, rospy.delete_param):
            try:
                function("nothing")
            except KeyError as error:
                print(repr(error))
        """,
        "{'left': 1, 'right': 2} 1 True\n"
        "{'name': 'kbot', 'wheels': 4}\n"
        "[1.5, 2] /n/gain /robot None\n"
        "{'name': 'kbot'} default ['/n/gain', '/robot/name']\n"
        "KeyError('nothing')\nKeyError('nothing')",
    )


def test_a_launch_file_gives_parameters(tmp_path: Path) -> None:
    output = run_in_lockstep(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        print(rospy.get_param("/map/size"), rospy.get_param("~rate"))
        """,
        "_rate:=20",
        PERIPLUS_ROS1_PARAMS='{"map": {"size": 5}, "n": {"rate": 10}}',
    )
    assert output == "5 20\n"
    file = tmp_path / "parameters.json"
    file.write_text('{"/global": 3, "/n/rate": 20, "/n/pid/gain": [1, 2.5]}')
    output = run_in_lockstep(
        tmp_path,
        """
        import rospy
        rospy.init_node("n")
        print(rospy.get_param("/global"), rospy.get_param("~"))
        """,
        PERIPLUS_ROS1_PARAMETERS=str(file),
    )
    assert output == "3 {'rate': 20, 'pid': {'gain': [1, 2.5]}}\n"


ACTION_SERVER = """
import rospy
import actionlib
from actionlib_tutorials.msg import FibonacciAction, FibonacciFeedback, FibonacciGoal, FibonacciResult
rospy.init_node("n")
def execute(goal):
    sequence = [0, 1]
    for _ in range(goal.order):
        if server.is_preempt_requested():
            server.set_preempted(FibonacciResult(sequence), "stopped")
            return
        sequence.append(sequence[-1] + sequence[-2])
        server.publish_feedback(FibonacciFeedback(sequence))
        rospy.sleep(1)
    if goal.order == 0:
        raise RuntimeError("order is zero")
    if goal.order > 1:
        server.set_succeeded(FibonacciResult(sequence), "done")
server = actionlib.SimpleActionServer("fibonacci", FibonacciAction, execute, auto_start=False)
server.start()
client = actionlib.SimpleActionClient("fibonacci", FibonacciAction)
print(client.wait_for_server(rospy.Duration(5)))
import sys
sys.stderr = open("log.txt", "w")
"""


def test_an_action_gives_feedback_and_a_result(tmp_path: Path) -> None:
    check(
        tmp_path,
        ACTION_SERVER
        + """
client.send_goal(
    FibonacciGoal(3),
    done_cb=lambda status, result: print("done", status, result.sequence),
    active_cb=lambda: print("active"),
    feedback_cb=lambda feedback: print("feedback", feedback.sequence[-1]),
)
print(client.wait_for_result(rospy.Duration(1.5)), client.get_state())
print(client.wait_for_result(), client.get_state(), client.get_goal_status_text(), client.get_result().sequence)
""",
        "True\nactive\nfeedback 1\nfeedback 2\nFalse 1\nfeedback 3\ndone 3 (0, 1, 1, 2, 3)\nTrue 3 done (0, 1, 1, 2, 3)",
    )


def test_a_goal_is_cancelled_replaced_or_aborted(tmp_path: Path) -> None:
    check(
        tmp_path,
        ACTION_SERVER
        + """
client.send_goal(FibonacciGoal(10))
rospy.sleep(1.5)
client.cancel_goal()
print(client.wait_for_result(), client.get_state(), client.get_goal_status_text())
other = actionlib.SimpleActionClient("fibonacci", FibonacciAction)
other.wait_for_server()
other.send_goal(FibonacciGoal(10))
rospy.sleep(0.5)
client.send_goal(FibonacciGoal(2))
print(other.wait_for_result(), other.get_state(), client.wait_for_result(), client.get_state())
print(client.send_goal_and_wait(FibonacciGoal(0)), client.get_goal_status_text())
print(client.send_goal_and_wait(FibonacciGoal(1)), client.get_goal_status_text())
print(client.send_goal_and_wait(FibonacciGoal(9), rospy.Duration(2.5), rospy.Duration(2)))
""",
        "True\nTrue 2 stopped\nTrue 2 True 3\n4 Exception in execute callback: order is zero\n4 No terminal state was set.\n2",
    )
