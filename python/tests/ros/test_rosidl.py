"""Message classes with the conventions of rosidl, and the import of message packages."""

import copy
import pickle
import subprocess
import sys
import textwrap
from array import array
from pathlib import Path

import numpy as np
import pytest

import periplus.ros

periplus.ros.activate(quiet=True)


def run(code: str, tmp_path: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    import os

    text = "import periplus.ros\nperiplus.ros.activate(quiet=True)\n" + textwrap.dedent(code)
    return subprocess.run(
        [sys.executable, "-c", text], cwd=tmp_path, env={**os.environ, **environment}, capture_output=True, text=True, check=False
    )


def package(folder: Path, name: str, depends: str = "", **files: str) -> Path:
    path = folder / name
    path.mkdir(parents=True)
    (path / "package.xml").write_text(f"<package format='3'><name>{name}</name>{depends}</package>")
    for file, text in files.items():
        kind, _, stem = file.partition("_")
        (path / kind).mkdir(exist_ok=True)
        (path / kind / f"{stem}.{kind}").write_text(text)
    return path


def test_slots_refuse_a_wrong_name() -> None:
    from geometry_msgs.msg import Twist

    with pytest.raises(AttributeError, match="'Twist' object has no attribute 'liner'"):
        Twist().liner = 1
    assert Twist.__slots__ == ["_linear", "_angular", "_check_fields"]


def test_constants_are_read_only() -> None:
    from sensor_msgs.msg import PointField

    assert PointField.FLOAT32 == PointField().FLOAT32 == 7
    with pytest.raises(AttributeError):
        PointField.FLOAT32 = 8
    with pytest.raises(AttributeError):
        PointField().FLOAT32 = 8


@pytest.mark.parametrize("copied", [copy.deepcopy, copy.copy, lambda one: pickle.loads(pickle.dumps(one))])
def test_copies_are_equal(copied) -> None:
    from sensor_msgs.msg import Imu, PointCloud2, PointField

    imu = Imu(orientation_covariance=[1.0] * 9)
    cloud = PointCloud2(fields=[PointField(name="x")], data=b"abc")
    assert copied(imu) == imu
    assert copied(cloud) == cloud


def test_deep_copies_share_nothing() -> None:
    from sensor_msgs.msg import PointCloud2, PointField

    cloud = PointCloud2(fields=[PointField(name="x")], data=b"abc")
    other = copy.deepcopy(cloud)
    other.fields[0].name, other.data[0] = "y", 0
    assert cloud.fields[0].name == "x" and cloud.data.tobytes() == b"abc"


def test_arrays_with_one_different_element_differ() -> None:
    from sensor_msgs.msg import Imu

    assert Imu(orientation_covariance=[0.0] * 8 + [1.0]) != Imu()


@pytest.mark.parametrize("values", [np.arange(3, dtype=np.float64), np.arange(3), np.arange(6, dtype=np.float32)[::2], (0, 1, 2)])
def test_numbers_become_an_array(values) -> None:
    from sensor_msgs.msg import LaserScan

    made = LaserScan(ranges=values).ranges
    assert type(made) is array and made.typecode == "f" and made.tolist() == [float(one) for one in values]


def test_integers_out_of_range_are_refused() -> None:
    from sensor_msgs.msg import Image

    with pytest.raises(OverflowError):
        Image().data = [256]
    with pytest.raises(OverflowError):
        Image().data = np.array([256])


def test_nested_messages_are_lists() -> None:
    from visualization_msgs.msg import Marker

    marker = Marker()
    marker.points.append(1)
    assert Marker().points == [] and marker.points == [1]


def test_field_types() -> None:
    from rosidl_parser.definition import Array, BasicType, BoundedSequence, NamespacedType
    from sensor_msgs.msg import Imu
    from std_srvs.srv import SetBool

    assert Imu.SLOT_TYPES[0] == NamespacedType(["std_msgs", "msg"], "Header")
    assert Imu().SLOT_TYPES[2] == Array(BasicType("double"), 9)
    assert SetBool.Event.get_fields_and_field_types()["request"] == "sequence<std_srvs/SetBool_Request, 1>"
    assert isinstance(SetBool.Event.SLOT_TYPES[1], BoundedSequence)


def test_import_forms() -> None:
    import std_msgs.msg._u_int8_multi_array
    from example_interfaces.action import Fibonacci
    from std_msgs.msg._string import String
    from std_srvs.srv import SetBool, SetBool_Request

    assert std_msgs.msg.String is String
    assert std_msgs.msg._u_int8_multi_array.UInt8MultiArray is std_msgs.msg.UInt8MultiArray
    assert SetBool.Request is SetBool_Request
    assert Fibonacci.Impl.SendGoalService.Request().goal == Fibonacci.Goal()
    with pytest.raises(ImportError):
        from std_msgs.msg import Strin  # noqa: F401


def test_checked_fields(tmp_path: Path) -> None:
    done = run(
        """
        from geometry_msgs.msg import Vector3
        from sensor_msgs.msg import Imu, LaserScan
        for make in (lambda: Vector3(x=1), lambda: Vector3(foo=1.0), lambda: LaserScan(header=5), lambda: Imu(orientation_covariance=[0.0])):
            try:
                make()
            except AssertionError as error:
                print(str(error)[:80])
        """,
        tmp_path,
        ROS_PYTHON_CHECK_FIELDS="1",
    )
    assert done.stdout.splitlines() == [
        "The 'x' field must be of type 'float'",
        "Invalid arguments passed to constructor: foo",
        "The 'header' field must be a sub message of type 'Header'",
        "The 'orientation_covariance' field must be a set or sequence with length 9 and e",
    ], done.stderr


def test_own_packages_are_read_without_a_build(tmp_path: Path) -> None:
    package(tmp_path, "wheel_msgs", msg_Wheel="float32 radius_m 0.25\nuint8 LEFT=1\nstring<=5 name\n")
    package(
        tmp_path, "drive_pkg", "<depend>wheel_msgs</depend>",
        msg_Drive="wheel_msgs/Wheel[2] wheels\n", srv_Stop="---\nbool done\n", action_Go="int32 n\n---\nint32 m\n---\nint32 k\n",
    )  # fmt: skip
    done = run(
        """
        from drive_pkg.msg import Drive
        from drive_pkg.srv import Stop
        import drive_pkg.action, wheel_msgs.msg
        print(Drive().wheels[1], Stop.Response(), drive_pkg.action.Go.Goal(n=2), wheel_msgs.msg.Wheel.LEFT)
        """,
        tmp_path,
    )
    assert done.stdout == (
        "wheel_msgs.msg.Wheel(radius_m=0.25, name='') drive_pkg.srv.Stop_Response(done=False) drive_pkg.action.Go_Goal(n=2) 1\n"
    ), done.stderr


def test_own_package_replaces_a_built_in_one(tmp_path: Path) -> None:
    package(tmp_path, "nav2_msgs", msg_Mine="int32 x\n")
    done = run("from nav2_msgs.msg import Mine\nprint(Mine())", tmp_path)
    assert done.stdout == "nav2_msgs.msg.Mine(x=0)\n", done.stderr


def test_messages_beside_a_python_module(tmp_path: Path) -> None:
    path = package(tmp_path, "both", msg_A="int32 x\n")
    (path / "both").mkdir()
    (path / "both" / "__init__.py").write_text("VALUE = 3\n")
    done = run(f"import sys; sys.path.insert(0, {str(path)!r})\nimport both\nfrom both.msg import A\nprint(both.VALUE, A())", tmp_path)
    assert done.stdout == "3 both.msg.A(x=0)\n", done.stderr


@pytest.mark.parametrize(
    ("files", "text"),
    [
        ({"msg_A": "int32 x\nflot64 y\n"}, "bad_msgs/msg/A.msg:2:1: `flot64` is not a type"),
        ({"msg_A": "B b\n", "msg_B": "\nA a\n"}, "bad_msgs/msg/B.msg:2:1: `bad_msgs/msg/B` contains itself"),
        ({"idl_A": "module bad_msgs {};\n"}, "bad_msgs/idl/A.idl:1: message package 'bad_msgs' has a definition in IDL"),
    ],
)
def test_errors_name_the_users_file_and_line(tmp_path: Path, files: dict[str, str], text: str) -> None:
    package(tmp_path, "bad_msgs", **files)
    done = run("from bad_msgs.msg import A", tmp_path)
    assert f"{tmp_path}/{text}" in done.stderr


def test_missing_package_is_explained(tmp_path: Path) -> None:
    done = run("import sensor_msg", tmp_path)
    assert "No module named 'sensor_msg'" in done.stderr
    done = run("import senser_msgs", tmp_path)
    assert "Did you mean 'sensor_msgs'?" in done.stderr


def test_users_module_with_the_name_of_a_package(tmp_path: Path) -> None:
    (tmp_path / "bond.py").write_text("VALUE = 3\n")
    done = run("import bond\nprint(bond.VALUE)", tmp_path)
    assert done.stdout == "3\n", done.stderr


def test_packages_that_come_as_files(tmp_path: Path) -> None:
    done = run(
        """
        from ackermann_msgs.msg import AckermannDriveStamped
        from example_interfaces.srv import AddTwoInts
        from nav2_msgs.action import NavigateToPose
        from nav2_msgs.srv import SetInitialPose
        print(AddTwoInts.Request(a=1), NavigateToPose.Goal().behavior_tree == "", AckermannDriveStamped().drive.speed)
        """,
        tmp_path,
    )
    assert done.stdout == "example_interfaces.srv.AddTwoInts_Request(a=1, b=0) True 0.0\n", done.stderr


def test_native_messages_are_of_these_classes() -> None:
    from periplus import deserialize, serialize
    from sensor_msgs.msg import LaserScan

    scan = LaserScan(ranges=[1.0, 2.0])
    scan.header.frame_id = "laser"
    made = deserialize(LaserScan, serialize(scan))
    assert made == scan and type(made) is LaserScan and type(made.ranges) is array
    with pytest.raises(TypeError, match="LaserScan.angle_min must be a float, not str"):
        serialize(LaserScan(angle_min="a"))
