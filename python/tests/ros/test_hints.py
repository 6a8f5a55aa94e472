"""Errors of users' programs name what to do."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from periplus.ros import _hints, activate
from ros_programs import environment

activate()


def advice(work: Callable[[], object]) -> str:
    """The hint for the error that `work` raises."""
    with pytest.raises(Exception) as caught:  # noqa: PT011
        work()
    return _hints.hint(caught.value) or ""


def test_a_misspelt_field_names_the_field() -> None:
    from geometry_msgs.msg import Twist

    assert advice(lambda: Twist().liner).endswith("Twist has 'linear'")
    assert advice(lambda: Twist().speed).endswith("Twist has linear, angular")


def test_a_misspelt_field_that_is_set_names_the_field() -> None:
    from geometry_msgs.msg import Twist

    assert advice(lambda: setattr(Twist().linear, "X", 1.0)).endswith("Vector3 has 'x'")
    assert advice(lambda: setattr(Twist(), "speed", 1.0)).endswith("Twist has linear, angular")


def test_a_missing_qos_names_what_it_may_be() -> None:
    from rclpy._node_entities import qos_or_depth

    def create(topic: str, qos_profile: int) -> None: ...

    for work in (lambda: qos_or_depth("best_effort"), lambda: create("scan")):  # type: ignore[call-arg]
        assert "a depth such as 10, a QoSProfile" in advice(work)
    assert "the callback comes before the QoS" in advice(lambda: qos_or_depth(test_attributes_of_other_objects_have_no_hint))


def test_a_class_in_place_of_a_message_is_named() -> None:
    from geometry_msgs.msg import Twist
    from rclpy.type_support import wrong_type
    from std_srvs.srv import SetBool

    assert wrong_type(Twist, Twist).endswith("got a class: a message is made by a call, as in Twist()")
    assert wrong_type(SetBool.Request, SetBool).endswith("as in SetBool.Request()")
    assert wrong_type(Twist, 1) == "Expected <class 'geometry_msgs.msg._twist.Twist'>, got <class 'int'>"


def test_a_timer_without_a_callback_names_its_line(tmp_path: Path) -> None:
    program = """
import rclpy
rclpy.init()
node = rclpy.create_node('clock')
def tick(): pass
node.create_timer(0.01, tick())
rclpy.spin(node)
"""
    (tmp_path / "clock.py").write_text(program)
    command = [sys.executable, "-m", "periplus.ros.run", "clock.py"]
    variables = environment(ROS_AUTOMATIC_DISCOVERY_RANGE="OFF", ROS_LOG_DIR=str(tmp_path))
    done = subprocess.run(command, cwd=tmp_path, env=variables, capture_output=True, text=True, timeout=60, check=False)
    assert "TypeError: 'NoneType' object is not callable: the timer of clock.py:6 (<module>) has no callback" in done.stderr


def test_a_misspelt_policy_names_the_policy() -> None:
    from rclpy.qos import ReliabilityPolicy

    assert advice(lambda: ReliabilityPolicy.BESTEFFORT).endswith("ReliabilityPolicy has 'BEST_EFFORT'")  # type: ignore[attr-defined]


def test_attributes_of_other_objects_have_no_hint() -> None:
    assert advice(lambda: [].push) == ""  # type: ignore[attr-defined]


def test_a_node_without_its_constructor_is_named() -> None:
    from rclpy.node import Node

    class Robot(Node):
        def __init__(self) -> None:
            self.declare_parameter("speed", 1.0)

    assert "Robot.__init__ must call super().__init__('NODE_NAME')" in advice(Robot)


def test_a_misspelt_module_names_the_module() -> None:
    assert advice(lambda: __import__("rclpy.actions")).endswith("rclpy has the module 'action'")


def test_a_wrong_policy_value_names_the_policy_and_its_values() -> None:
    from rclpy.qos import QoSProfile

    with pytest.raises(AssertionError, match=r"reliability must be a ReliabilityPolicy, not 'often': .*BEST_EFFORT"):
        QoSProfile(depth=1, reliability="often")


def test_values_of_an_array_name_their_field() -> None:
    from sensor_msgs.msg import Image, LaserScan

    with pytest.raises(TypeError, match="^LaserScan.ranges of type sequence<float>: must be real number"):
        LaserScan(ranges=["near"])
    with pytest.raises(OverflowError, match="^Image.data of type sequence<uint8>: "):
        Image().data = [256]
    with pytest.raises(TypeError, match=r"must be real number, not str \(item 1 is 'far'\)$"):
        LaserScan(ranges=[1.0, "far"])
    with pytest.raises(TypeError, match=r"a numpy array of float64 with shape \(2, 2\); ravel\(\) makes it flat"):
        Image().data = np.zeros((2, 2))


def test_a_message_in_place_of_its_class_is_refused() -> None:
    from geometry_msgs.msg import Twist
    from rclpy.type_support import check_is_valid_msg_type

    with pytest.raises(AttributeError, match="Pass the class"):
        check_is_valid_msg_type(Twist())


def test_a_missing_message_package_names_the_remedy(tmp_path: Path) -> None:
    (tmp_path / "reader.py").write_text("import rospy\nfrom wheel_state.msg import Wheel\n")
    command = [sys.executable, "-m", "periplus.ros.run", "reader.py"]
    done = subprocess.run(command, cwd=tmp_path, env=environment(), capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 1
    assert "hint: reader.py:2: no message package wheel_state is known" in done.stderr
    assert "PERIPLUS_PACKAGES" in done.stderr
