# mypy: disable-error-code="arg-type,list-item"
"""Messages: classes, checks of values, and conversions."""

from __future__ import annotations

import copy
import importlib
import json
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import periplus
from periplus import msgs
from periplus.msgs.builtin_interfaces.msg import Time
from periplus.msgs.diagnostic_msgs.msg import DiagnosticStatus
from periplus.msgs.geometry_msgs.msg import Point, PoseWithCovariance, Twist, Vector3
from periplus.msgs.nav_msgs.msg import OccupancyGrid, Odometry
from periplus.msgs.sensor_msgs.msg import Image, JointState, LaserScan, NavSatStatus, PointCloud2
from periplus.msgs.std_msgs.msg import Bool, Float32, Float64, Int8, String
from periplus.msgs.std_srvs.srv import SetBool, Trigger
from periplus.msgs.tf2_msgs.action import LookupTransform


def test_repr_is_that_of_rclpy() -> None:
    assert repr(Point(x=1)) == "geometry_msgs.msg.Point(x=1.0, y=0.0, z=0.0)"
    assert repr(Trigger.Response()) == "std_srvs.srv.Trigger_Response(success=False, message='')"


def test_a_wrong_field_is_refused() -> None:
    twist = Twist()
    with pytest.raises(AttributeError, match="'Twist' object has no attribute 'liner'"):
        twist.liner = Vector3()  # type: ignore[attr-defined]
    with pytest.raises(TypeError, match="Twist has no field `liner`, did you mean `linear`"):
        Twist(liner=Vector3())  # type: ignore[call-arg]


def test_slots_are_those_of_rclpy() -> None:
    assert Twist.__slots__ == ("_linear", "_angular")
    assert not hasattr(Twist(), "__dict__")


@pytest.mark.parametrize(
    ("make", "error", "text"),
    [
        (lambda: LaserScan(ranges="near"), TypeError, "LaserScan.ranges must be an array of float32, not str"),
        (lambda: LaserScan(ranges=[[1.0], [2.0, 3.0]]), TypeError, "LaserScan.ranges"),
        (lambda: LaserScan(ranges=[None]), TypeError, "LaserScan.ranges"),
        (lambda: LaserScan(ranges=[1e300]), ValueError, "LaserScan.ranges has values that are out of the range"),
        (lambda: LaserScan(ranges=[1j]), TypeError, "LaserScan.ranges"),
        (lambda: LaserScan(ranges=3.0), TypeError, "LaserScan.ranges"),
        (lambda: LaserScan(range_max="far"), TypeError, "LaserScan.range_max must be a float, not str"),
        (lambda: LaserScan(range_max=1e300), ValueError, "LaserScan.range_max"),
        (lambda: LaserScan(range_max=True), TypeError, "LaserScan.range_max"),
        (lambda: LaserScan(header=Point()), TypeError, "LaserScan.header must be a message std_msgs.msg.Header"),
        (lambda: Image(data=[1, 2, 300]), ValueError, "Image.data has the value 300"),
        (lambda: Image(data=[1.5]), TypeError, "Image.data must be an array of uint8, not float64"),
        (lambda: Image(height=-1), ValueError, "Image.height must be from 0 to 4294967295, not -1"),
        (lambda: Image(height=2.0), TypeError, "Image.height must be an int, not float"),
        (lambda: Image(height=10**40), ValueError, "Image.height"),
        (lambda: OccupancyGrid(data=[128]), ValueError, "OccupancyGrid.data"),
        (lambda: PoseWithCovariance(covariance=[1, 2]), ValueError, "must have 36 elements, not 2"),
        (lambda: String(data=5), TypeError, "String.data must be a str, not int"),
        (lambda: String(data="\ud800"), ValueError, "String.data must be valid Unicode"),
        (lambda: Bool(data=1), TypeError, "Bool.data must be a bool, not int"),
        (lambda: JointState(name="wheel"), TypeError, "JointState.name must be a list of str, not str"),
        (lambda: JointState(name=["a", 1]), TypeError, r"JointState.name\[1\] must be a str"),
        (lambda: DiagnosticStatus(level=b"ab"), ValueError, "DiagnosticStatus.level"),
        (lambda: Float64(data=2**53 + 1), ValueError, "Float64.data"),
        (lambda: Float64(data=np.zeros(1)), TypeError, "Float64.data"),
    ],
)
def test_a_wrong_value_names_its_field(make: Any, error: type[Exception], text: str) -> None:
    with pytest.raises(error, match=text):
        make()


def test_a_value_that_became_wrong_is_found_when_it_is_written() -> None:
    odometry = Odometry()
    odometry.pose.pose.position._x = "far"  # type: ignore[attr-defined]
    with pytest.raises(TypeError, match=r"Odometry.pose.pose.position.x must be a float, not str"):
        periplus.serialize(odometry)


@pytest.mark.parametrize(
    "ranges",
    [
        [1, 2, 3],
        (1.0, 2.0, 3.0),
        range(1, 4),
        np.array([1, 2, 3], dtype=np.int64),
        np.array([1, 2, 3], dtype=np.float64),
        np.array([1, 9, 2, 9, 3, 9], dtype=np.float32)[::2],
        np.array([1, 2, 3], dtype=">f4"),
        memoryview(np.array([1, 2, 3], dtype=np.float32)),
    ],
)
def test_arrays_of_all_kinds_become_numpy(ranges: Any) -> None:
    scan = LaserScan(ranges=ranges)
    assert scan.ranges.dtype == np.float32 and scan.ranges.dtype.isnative
    assert scan.ranges.tolist() == [1.0, 2.0, 3.0]


def test_an_array_of_the_right_type_is_not_copied() -> None:
    ranges = np.zeros(5, dtype=np.float32)
    assert LaserScan(ranges=ranges).ranges is ranges


def test_bytes_become_arrays() -> None:
    assert Image(data=b"\x01\x02").data.tolist() == [1, 2]
    assert Image(data=bytearray(b"\x01\x02")).data.tolist() == [1, 2]
    picture = np.arange(12, dtype=np.uint8).reshape(2, 2, 3)
    assert Image(data=picture).data.tolist() == list(range(12))


def test_numbers_of_numpy_and_ints_convert() -> None:
    assert Point(x=1).x == 1.0 and isinstance(Point(x=1).x, float)
    assert isinstance(Point(x=np.float32(0.5)).x, float)
    assert isinstance(Image(height=np.uint8(3)).height, int)
    assert Bool(data=np.bool_(True)).data is True
    assert DiagnosticStatus(level=2).level == DiagnosticStatus.ERROR == b"\x02"


def test_constants_and_defaults() -> None:
    assert NavSatStatus.STATUS_NO_FIX == -1
    with pytest.raises(AttributeError, match="constant"):
        NavSatStatus.STATUS_NO_FIX = 3
    assert Time().sec == 0
    assert LaserScan.get_fields_and_field_types()["ranges"] == "sequence<float>"
    assert PoseWithCovariance.get_fields_and_field_types() == {
        "pose": "geometry_msgs/Pose",
        "covariance": "double[36]",
    }


def test_known_bytes() -> None:
    # CDR: header, length with the final zero, text.
    assert periplus.serialize(String(data="hi")) == b"\0\1\0\0\3\0\0\0hi\0"
    assert periplus.serialize(Vector3(x=1.0)) == b"\0\1\0\0" + np.array([1.0, 0, 0]).tobytes()
    big = b"\0\0\0\0" + np.array([1.0, 0, 0], dtype=">f8").tobytes()
    assert periplus.deserialize(Vector3, big) == Vector3(x=1)


@pytest.mark.parametrize("data", [b"", b"\0\1\0", b"\0\1\0\0\xff\xff\xff\xffhi", b"\0\1\0\0\3\0\0\0hi\0tail of nine"])
def test_bad_bytes_are_refused(data: bytes) -> None:
    with pytest.raises(ValueError, match="std_msgs/msg/String"):
        periplus.deserialize(String, data)


@given(data=st.binary(max_size=200), name=st.sampled_from(msgs.type_names()))
@settings(max_examples=200, deadline=None)
def test_any_bytes_are_a_message_or_a_value_error(data: bytes, name: str) -> None:
    for body in (data, b"\0\1\0\0" + data):
        try:
            periplus.deserialize(name, body)
        except ValueError:
            pass


def test_unknown_types() -> None:
    with pytest.raises(KeyError, match="did you mean `std_msgs/msg/String`"):
        periplus.deserialize("std_msgs/msg/Strin", b"")
    with pytest.raises(TypeError, match="expected a message"):
        periplus.serialize(3)
    with pytest.raises(AttributeError, match="did you mean 'String'"):
        importlib.import_module("periplus.msgs.std_msgs.msg").Strin
    with pytest.raises(ImportError):
        importlib.import_module("periplus.msgs.no_such_msgs.msg")


def test_services_and_actions() -> None:
    assert SetBool.Request(data=True).data is True
    assert LookupTransform.Goal(target_frame="map").target_frame == "map"
    assert LookupTransform.Impl.SendGoalService.Request().goal == LookupTransform.Goal()
    with pytest.raises(NotImplementedError):
        Trigger()
    with pytest.raises(NotImplementedError):
        LookupTransform()


def test_copies_and_pickles() -> None:
    odometry = Odometry(child_frame_id="base")
    odometry.pose.covariance[0] = 2.0
    assert pickle.loads(pickle.dumps(odometry)) == odometry
    deep = copy.deepcopy(odometry)
    deep.pose.covariance[0] = 3.0
    assert odometry.pose.covariance[0] == 2.0
    assert copy.copy(odometry).pose is odometry.pose
    assert odometry != deep and odometry != "odometry"
    with pytest.raises(TypeError):
        hash(odometry)


def test_dictionaries_json_and_yaml() -> None:
    scan = LaserScan(ranges=[1.0, float("inf")])
    assert msgs.to_dict(scan)["header"]["stamp"] == {"sec": 0, "nanosec": 0}
    assert msgs.from_dict(LaserScan, msgs.to_dict(scan)) == scan
    assert json.loads(msgs.to_json(scan))["ranges"] == [1.0, "Infinity"]
    assert msgs.from_json(LaserScan, msgs.to_json(scan, indent=True)) == scan
    assert msgs.to_yaml(Point(x=1)) == "x: 1.0\ny: 0.0\nz: 0.0\n"
    with pytest.raises(ValueError, match="rangs"):
        msgs.from_json(LaserScan, '{"rangs": []}')
    with pytest.raises(ValueError):
        msgs.from_json(LaserScan, "{")


def test_types_of_a_user(tmp_path: Path) -> None:
    package = tmp_path / "gear_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>gear_msgs</name></package>")
    (package / "msg" / "Gear.msg").write_text("uint8 MAX=200\nuint8 teeth 12\ngeometry_msgs/Point[] at\n")
    assert msgs.load(package) == ["gear_msgs"]
    from periplus.msgs.gear_msgs.msg import Gear  # type: ignore[import-not-found]

    gear = Gear(at=[Point(x=1)])
    assert gear.teeth == 12 and Gear.MAX == 200
    assert periplus.deserialize(Gear, periplus.serialize(gear)) == gear
    assert Point is msgs.get_message("geometry_msgs/msg/Point")
    (package / "msg" / "Gear.msg").write_text("uint8 teeth\nuint99 bad\n")
    with pytest.raises(periplus.FileError) as caught:
        msgs.load(tmp_path)
    assert caught.value.line == 2
    with pytest.raises(FileNotFoundError):
        msgs.load(tmp_path / "missing")
    with pytest.raises(periplus.FileError):
        msgs.load(package / "msg" / "Gear.msg")


DTYPES = {"boolean": "bool", "float": "float32", "double": "float64", "octet": "uint8"}


def values(text: str) -> st.SearchStrategy[Any]:
    """Values of a field by the name of its type."""
    if text.startswith("sequence<"):
        element, _, bound = text[9:-1].partition(", ")
        return lists(element, 0, min(int(bound), 4) if bound else 4)
    if text.endswith("]"):
        element, _, length = text[:-1].partition("[")
        return lists(element, int(length), int(length))
    if text.startswith(("string", "wstring")):
        limit = int(text[:-1].split("<")[1]) if "<" in text else 20
        return st.text(st.characters(codec="ascii"), max_size=min(limit, 20))
    if text == "octet":
        return st.binary(min_size=1, max_size=1)
    if text == "boolean":
        return st.booleans()
    if text in ("float", "double"):
        return st.floats(allow_nan=False, width=32 if text == "float" else 64)
    if text.startswith(("int", "uint")) and text.strip("uint").isdigit():
        info = np.iinfo(text)
        return st.integers(int(info.min), int(info.max))
    name = text if text.count("/") == 2 else text.replace("/", "/msg/")
    return messages(name)


def lists(element: str, low: int, high: int) -> st.SearchStrategy[Any]:
    dtype = DTYPES.get(element, element)
    if dtype in ("bool", "float32", "float64") or dtype.startswith(("int", "uint")):
        elements = {"allow_nan": False} if dtype.startswith("float") else None
        return st.integers(low, high).flatmap(lambda n: hnp.arrays(dtype, n, elements=elements))
    return st.lists(values(element), min_size=low, max_size=high)


def messages(name: str) -> st.SearchStrategy[Any]:
    cls = msgs.get_message(name)
    fields = {field: values(text) for field, text in cls.get_fields_and_field_types().items()}
    return st.builds(lambda **given: cls(**given), **fields) if fields else st.builds(cls)


@given(data=st.data())
@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
def test_random_messages_of_all_types_survive(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(msgs.type_names()))
    message = data.draw(messages(name))
    raw = periplus.serialize(message)
    assert periplus.deserialize(name, raw) == message
    assert periplus.deserialize(type(message), bytearray(raw)) == message
    assert pickle.loads(pickle.dumps(message)) == message
    assert copy.deepcopy(message) == message
    assert msgs.from_json(name, msgs.to_json(message)) == message


def test_default_messages_of_all_types_survive() -> None:
    for name in msgs.type_names():
        message = msgs.get_message(name)()
        assert periplus.deserialize(name, periplus.serialize(message)) == message, name
        assert isinstance(repr(message), str) and isinstance(msgs.to_yaml(message), str)


@given(
    array=hnp.arrays(
        st.sampled_from([np.bool_, np.int8, np.uint16, np.int64, np.uint64, np.float16, np.float64, np.complex64, "U2", "O"]),
        hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
    )
)
@settings(max_examples=150, deadline=None)
def test_any_array_is_taken_without_loss_or_refused(array: Any) -> None:
    for cls, field in ((LaserScan, "ranges"), (Image, "data"), (OccupancyGrid, "data"), (PoseWithCovariance, "covariance")):
        try:
            taken = getattr(cls(**{field: array}), field)
        except (TypeError, ValueError) as error:
            assert f"{cls.__name__}.{field}" in str(error)
            continue
        assert taken.ndim == 1 and taken.size == array.size
        if array.size:
            rounded = array.reshape(-1).astype(taken.dtype)
            assert np.array_equal(taken, rounded, equal_nan=taken.dtype.kind == "f")


@given(value=st.one_of(st.integers(), st.floats(), st.booleans(), st.text(), st.none(), st.binary(), st.lists(st.integers())))
@settings(max_examples=200, deadline=None)
def test_any_value_is_taken_or_refused(value: Any) -> None:
    for cls in (Float32, Float64, Int8, Bool, String, Time, LaserScan, PointCloud2):
        for field in cls.get_fields_and_field_types():
            try:
                message = cls(**{field: value})
            except (TypeError, ValueError) as error:
                assert f"{cls.__name__}.{field}" in str(error)
                continue
            periplus.deserialize(cls, periplus.serialize(message))


def test_an_import_makes_no_messages() -> None:
    code = (
        "import sys; import periplus; "
        "print(any(name.startswith('periplus.msgs') for name in sys.modules))"
    )
    assert subprocess.check_output([sys.executable, "-c", code], text=True) == "False\n"


def test_stubs_are_up_to_date() -> None:
    tools = Path(__file__).parent.parent / "tools" / "make_msgs_stubs.py"
    code = f"import runpy; names = runpy.run_path({str(tools)!r}); import json; print(json.dumps(names['stubs']()))"
    texts = json.loads(subprocess.check_output([sys.executable, "-c", code], text=True))
    folder = Path(msgs.__file__).parent
    for path, text in texts.items():
        assert (folder / path).read_text() == text, f"run {tools.name}: {path} has changed"
    found = {str(path.relative_to(folder)) for path in folder.glob("*/*.pyi")}
    assert found == set(texts)
