"""Errors of users' programs name what to do."""

from collections.abc import Callable

import pytest
from periplus.ros import _hints, activate

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


def test_a_message_in_place_of_its_class_is_refused() -> None:
    from geometry_msgs.msg import Twist
    from rclpy.type_support import check_is_valid_msg_type

    with pytest.raises(AttributeError, match="Pass the class"):
        check_is_valid_msg_type(Twist())
