"""Messages by the names of their types, and as dictionaries, YAML and CSV."""

import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

from geometry_msgs.msg import PoseArray  # noqa: E402
from rosidl_runtime_py import message_to_csv, message_to_ordereddict, message_to_yaml, set_message_fields  # noqa: E402
from rosidl_runtime_py.utilities import get_action, get_message, get_service  # noqa: E402
from sensor_msgs.msg import LaserScan  # noqa: E402
from std_msgs.msg import String  # noqa: E402


def test_types_by_name() -> None:
    assert get_message("sensor_msgs/LaserScan") is get_message("sensor_msgs/msg/LaserScan") is LaserScan
    assert get_service("std_srvs/srv/SetBool").Request(data=True).data
    assert get_action("example_interfaces/action/Fibonacci").Goal(order=1).order == 1


@pytest.mark.parametrize(
    ("name", "kind"),
    [("x", ValueError), ("std_msgs/msg/Nope", AttributeError), ("nope_msgs/msg/A", ModuleNotFoundError), ("std_srvs/srv/SetBool", ValueError)],
)
def test_unknown_types(name: str, kind: type[Exception]) -> None:
    with pytest.raises(kind):
        get_message(name)


def test_fields_from_a_dictionary() -> None:
    scan = LaserScan()
    stamps = set_message_fields(scan, {"header": "auto", "angle_min": 1, "ranges": [1, 2]}, expand_header_auto=True)
    assert stamps == [scan.header.stamp] and scan.angle_min == 1.0 and scan.ranges.tolist() == [1.0, 2.0]
    poses = PoseArray()
    set_message_fields(poses, {"poses": [{"position": {"x": 3}}]})
    assert poses.poses[0].position.x == 3.0
    with pytest.raises(AttributeError):
        set_message_fields(scan, {"angle": 1})
    with pytest.raises(TypeError, match="expected to be a dictionary"):
        set_message_fields(poses, {"header": 5})


def test_texts() -> None:
    scan = LaserScan(ranges=[1.0, 2.0, 3.0])
    assert message_to_ordereddict(scan, truncate_length=2)["ranges"] == [1.0, 2.0, "..."]
    assert message_to_yaml(String(data="a: b")) == "data: 'a: b'\n"
    assert "ranges: '<sequence type: sequence<float>, length: 3>'" in message_to_yaml(scan, no_arr=True)
    assert message_to_yaml(String(data="hi"), flow_style=True) == "{data: hi}\n"
    assert message_to_csv(scan).endswith("1.0,2.0,3.0")
