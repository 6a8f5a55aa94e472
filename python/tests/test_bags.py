"""Bags: writing, reading, fields over time, conversion, damage."""

from __future__ import annotations

import gc
import sys
import threading
import warnings
from pathlib import Path
from typing import Any

import hypothesis.extra.numpy as hnp
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import periplus
from periplus.msgs.builtin_interfaces.msg import Time
from periplus.msgs.geometry_msgs.msg import Point, TransformStamped
from periplus.msgs.nav_msgs.msg import Odometry
from periplus.msgs.sensor_msgs.msg import Image, JointState, LaserScan
from periplus.msgs.std_msgs.msg import Header, String
from periplus.msgs.tf2_msgs.msg import TFMessage

SECOND_NS = 1_000_000_000


def odometry(step: int) -> Odometry:
    stamp = Time(sec=100 + step, nanosec=5)
    message = Odometry(header=Header(stamp=stamp, frame_id="odom"), child_frame_id=f"base_{step}")
    message.pose.pose.position.x = step * 0.5
    message.pose.covariance[0] = step
    return message


def write_run(path: Path, **options: Any) -> None:
    with periplus.BagWriter(path, **options) as writer:
        for step in range(10):
            time_ns = (100 + step) * SECOND_NS
            writer.write("/odom", odometry(step), time_ns)
            writer.write("/scan", LaserScan(ranges=np.full(4, step), intensities=np.zeros(step % 3)), time_ns + 1)
            transforms = [TransformStamped(child_frame_id=name) for name in ("a", "b")]
            transforms[1].transform.translation.z = step
            writer.write("/tf", TFMessage(transforms=transforms), time_ns + 2)
            writer.write("/joints", JointState(name=["l", "r"], position=[step, -step]), time_ns + 3)
        assert writer.message_count == 40


@pytest.fixture
def run(tmp_path: Path) -> Path:
    path = tmp_path / "run.mcap"
    write_run(path)
    return path


@pytest.mark.parametrize(
    ("name", "options", "storage"),
    [
        ("run.mcap", {}, "mcap"),
        ("run.mcap", {"compression": "lz4"}, "mcap"),
        ("run.mcap", {"compression": "none"}, "mcap"),
        ("run.db3", {}, "sqlite3"),
        ("run.bag", {}, "rosbag"),
        ("run.bag", {"compression": "bz2"}, "rosbag"),
        ("run", {}, "mcap"),
        ("run", {"storage": "sqlite3"}, "sqlite3"),
        ("run", {"storage": "sqlite3", "compression_mode": "file"}, "sqlite3"),
        ("run", {"compression_mode": "message", "compression": "lz4"}, "mcap"),
        ("run", {"max_duration_s": 3.0}, "mcap"),
    ],
)
def test_every_format_survives(tmp_path: Path, name: str, options: dict[str, Any], storage: str) -> None:
    path = tmp_path / name
    write_run(path, **options)
    bag = periplus.open_bag(path)
    assert bag.storage == storage and bag.is_complete and bag.message_count == 40
    assert bag.findings == [] and bag.path == path and bag.size_bytes > 0
    assert (bag.start_ns, bag.end_ns) == (100 * SECOND_NS, 109 * SECOND_NS + 3)
    assert bag.duration_s == pytest.approx(9.000000003)
    assert [(topic.name, topic.count) for topic in bag.topics] == [("/joints", 10), ("/odom", 10), ("/scan", 10), ("/tf", 10)]
    read = list(bag)
    assert [time for _topic, _message, time in read] == sorted(time for _topic, _message, time in read)
    assert len(read) == 40 and len(list(bag)) == 40
    assert [message for topic, message, _time in read if topic == "/odom"] == [odometry(step) for step in range(10)]
    assert type(read[0][1]) is Odometry
    assert bag.faults == []
    assert (len(bag.files) > 1) == ("max_duration_s" in options)


def test_selections(run: Path) -> None:
    bag = periplus.open_bag(run, topics=["/odom", "/tf"], start=102 * SECOND_NS, end=104 * SECOND_NS)
    assert [topic for topic, _message, _time in bag] == ["/odom", "/tf"] * 2 + ["/odom"]
    assert [time for _topic, _message, time in bag.messages("/tf")] == [102 * SECOND_NS + 2, 103 * SECOND_NS + 2]
    assert len(list(bag.messages(start=103 * SECOND_NS))) == 3
    for bad in ("/odm", ["/odom", "/odm"]):
        with pytest.raises(ValueError, match="no topic `/odm`, did you mean `/odom`"):
            periplus.open_bag(run, topics=bad)
    with pytest.raises(TypeError, match="topics"):
        periplus.open_bag(run, topics=3)  # type: ignore[arg-type]
    with pytest.raises(TypeError):
        periplus.open_bag(run, start=1.5)  # type: ignore[arg-type]


def test_raw_bytes(run: Path, tmp_path: Path) -> None:
    raw = list(periplus.open_bag(run, "/odom", raw=True))
    assert raw[3][1] == periplus.serialize(odometry(3))
    with periplus.BagWriter(tmp_path / "copy.mcap") as writer:
        for topic, data, time in raw:
            writer.write(topic, data, time, type=Odometry)
        with pytest.raises(TypeError, match="type"):
            writer.write("/odom", raw[0][1], 0)
    assert [message for _topic, message, _time in periplus.open_bag(tmp_path / "copy.mcap")][3] == odometry(3)


def test_fields_over_time(run: Path) -> None:
    bag = periplus.open_bag(run)
    columns = bag.to_numpy("/odom", ["pose.pose.position.x", "header.stamp", "header.stamp.sec", "child_frame_id", "pose.covariance[0]", "pose.covariance"])
    assert columns["time_ns"].tolist() == [(100 + step) * SECOND_NS for step in range(10)]
    assert columns["pose.pose.position.x"].tolist() == [step * 0.5 for step in range(10)]
    assert columns["header.stamp"].tolist() == [(100 + step) * SECOND_NS + 5 for step in range(10)]
    assert columns["header.stamp.sec"].dtype == np.int32
    assert columns["child_frame_id"][3] == "base_3"
    assert columns["pose.covariance[0]"].tolist() == list(range(10))
    assert columns["pose.covariance"].shape == (10, 36)
    scans = bag.to_numpy("/scan")
    assert scans["ranges"].shape == (10, 4) and scans["ranges"].dtype == np.float32
    assert [len(one) for one in scans["intensities"]] == [step % 3 for step in range(10)]
    heights = bag.to_numpy("/tf", ["transforms[1].transform.translation.z", "transforms[0].child_frame_id"])
    assert heights["transforms[1].transform.translation.z"].tolist() == list(range(10))
    assert set(heights["transforms[0].child_frame_id"]) == {"a"}
    joints = bag.to_numpy("/joints", ["name", "name[1]", "position[0]"])
    assert joints["name"][0] == ["l", "r"] and joints["name[1]"][9] == "r"
    assert joints["position[0]"].tolist() == list(range(10))


@pytest.mark.parametrize(
    ("topic", "field", "text"),
    [
        ("/odom", "pose.pose.position.q", "no field `q`"),
        ("/odom", "poes", "did you mean `pose`"),
        ("/odom", "pose", "is a message; give a field"),
        ("/odom", "pose.pose[0]", "is not a list"),
        ("/odom", "child_frame_id.x", "behind"),
        ("/odom", "pose.covariance[36]", "no element"),
        ("/odom", "pose.covariance[x]", "not a path"),
        ("/odom", "", "no field"),
        ("/tf", "transforms", "is a list"),
        ("/tf", "transforms.transform", "is a list"),
        ("/tf", "transforms[2].child_frame_id", r"message 0 of `/tf` has no element `transforms\[2\]"),
        ("/map", "x", "no topic `/map`"),
    ],
)
def test_wrong_fields(run: Path, topic: str, field: str, text: str) -> None:
    with pytest.raises(ValueError, match=text):
        periplus.open_bag(run).to_numpy(topic, [field])


def test_tables(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bag = periplus.open_bag(run)
    pandas = pytest.importorskip("pandas")
    frame = bag.to_pandas("/scan")
    assert isinstance(frame, pandas.DataFrame) and len(frame) == 10
    assert frame["ranges"][3].tolist() == [3.0] * 4
    polars = pytest.importorskip("polars")
    table = bag.to_polars("/joints", ["name", "position"])
    assert isinstance(table, polars.DataFrame) and table["name"][0].to_list() == ["l", "r"]
    assert bag.to_polars("/scan")["ranges"].dtype == polars.Array(polars.Float32, 4)
    for name in ("pandas", "polars"):
        monkeypatch.setitem(sys.modules, name, None)
        with pytest.raises(ImportError, match=f"pip install {name}"):
            getattr(bag, f"to_{name}")("/scan")


def test_qos_survives(tmp_path: Path) -> None:
    path = tmp_path / "run"
    with periplus.BagWriter(path) as writer:
        writer.write("/map", String(), 0, qos={"durability": "transient_local", "depth": 1})
        for bad in ({"durabilty": "volatile"}, {"durability": "eternal"}, 3):
            with pytest.raises((TypeError, ValueError), match="qos"):
                writer.write("/other", String(), 0, qos=bad)  # type: ignore[arg-type]
    (qos,) = periplus.open_bag(path).topics[0].qos
    assert (qos["durability"], qos["depth"], qos["reliability"]) == ("transient_local", 1, "reliable")


def test_wrong_calls_of_a_writer(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    writer = periplus.BagWriter(path)
    with pytest.raises(TypeError, match="time_ns"):
        writer.write("/a", String(), 1.5)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="negative"):
        writer.write("/a", String(), -1)
    with pytest.raises(ValueError, match="topic"):
        writer.write("a", String(), 1)
    with pytest.raises(TypeError, match="message"):
        writer.write("/a", "text", 1)  # type: ignore[arg-type]
    writer.close()
    writer.close()
    assert writer.closed
    with pytest.raises(ValueError, match="closed"):
        writer.write("/a", String(), 1)
    with pytest.raises(FileExistsError):
        periplus.BagWriter(path)
    for options in ({"storage": "tape"}, {"compression": "zip"}, {"compression_mode": "file"}, {"max_duration_s": -1}):
        with pytest.raises(ValueError):
            periplus.BagWriter(tmp_path / "other.mcap", **options)


def test_a_writer_that_is_forgotten_warns(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    writer = periplus.BagWriter(path)
    writer.write("/a", String(data="kept"), 1)
    with pytest.warns(ResourceWarning, match="was not closed"):
        del writer
        gc.collect()
    assert periplus.open_bag(path).message_count == 1


def test_damage_is_reported_and_the_rest_is_read(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with periplus.BagWriter(path, compression="none") as writer:
        for step in range(2000):
            writer.write("/image", Image(data=np.full(5000, step % 251)), step)
    data = path.read_bytes()
    path.write_bytes(data[: len(data) // 2])
    bag = periplus.open_bag(path)
    assert not bag.is_complete
    assert any(finding.code == "incomplete-bag" for finding in bag.findings)
    read = [message.data[0] for _topic, message, _time in bag]
    assert 500 < len(read) < 2000 and read == [step % 251 for step in range(len(read))]
    assert periplus.check_bag(path)


def test_no_bags(tmp_path: Path) -> None:
    for call in (periplus.open_bag, periplus.check_bag):
        with pytest.raises(FileNotFoundError):
            call(tmp_path / "none.mcap")
        (tmp_path / "text.mcap").write_text("no recording")
        with pytest.raises(periplus.FileError):
            call(tmp_path / "text.mcap")
        with pytest.raises(periplus.FileError):
            call(tmp_path)


def test_bags_convert(run: Path, tmp_path: Path) -> None:
    for name in ("run.db3", "folder", "run.bag"):
        assert periplus.convert_bag(run, tmp_path / name) == []
        same = zip(periplus.open_bag(run), periplus.open_bag(tmp_path / name), strict=True)
        assert all(a == b for a, b in same)
        assert periplus.check_bag(tmp_path / name) == []
    periplus.convert_bag([run, tmp_path / "run.bag"], tmp_path / "both.mcap", topics="/odom", end=101 * SECOND_NS)
    assert [topic for topic, _message, _time in periplus.open_bag(tmp_path / "both.mcap")] == ["/odom"] * 4
    with pytest.raises(FileExistsError):
        periplus.convert_bag(run, tmp_path / "run.bag")


def test_a_carmen_log_is_a_bag(tmp_path: Path) -> None:
    path = tmp_path / "log.clf"
    path.write_text(
        "ODOM 1.0 2.0 0.5 0 0 0 10.0 host 10.0\n"
        "FLASER 3 1.0 2.0 3.0 1.0 2.0 0.5 1.0 2.0 0.5 11.0 host 11.0\n"
    )
    bag = periplus.open_bag(path)
    assert bag.storage == "carmen" and bag.start_ns == 10 * SECOND_NS
    read = {topic: message for topic, message, _time in bag}
    assert read["/scan"].ranges.tolist() == [1.0, 2.0, 3.0]
    assert read["/odom"].pose.pose.position.y == 2.0
    assert bag.to_numpy("/odom", ["pose.pose.position.x"])["pose.pose.position.x"].tolist() == [1.0, 1.0]
    assert [topic for topic, _message, _time in bag.messages("/scan")] == ["/scan"]


def test_other_definitions_of_a_type_are_read_as_they_were_written(tmp_path: Path) -> None:
    rosbags = pytest.importorskip("rosbags.rosbag2")
    from rosbags.typesys import Stores, get_types_from_msg, get_typestore

    store = get_typestore(Stores.ROS2_JAZZY)
    store.register(get_types_from_msg("float64 volts\nstring[] cells\n", "battery_msgs/msg/Pack"))
    pack = store.types["battery_msgs/msg/Pack"]
    with rosbags.Writer(tmp_path / "theirs", version=9) as writer:
        connection = writer.add_connection("/pack", "battery_msgs/msg/Pack", typestore=store)
        writer.write(connection, 7, store.serialize_cdr(pack(volts=12.5, cells=["a", "b"]), "battery_msgs/msg/Pack"))
    ((topic, message, time),) = periplus.open_bag(tmp_path / "theirs")
    assert (topic, message.volts, message.cells, time) == ("/pack", 12.5, ["a", "b"], 7)
    assert repr(message) == "battery_msgs.msg.Pack(volts=12.5, cells=['a', 'b'])"


def test_peers_read_what_is_written(tmp_path: Path) -> None:
    highlevel = pytest.importorskip("rosbags.highlevel")
    for name in ("run.mcap", "run.bag", "run"):
        write_run(tmp_path / name)
        if name == "run.mcap":
            continue
        with highlevel.AnyReader([tmp_path / name]) as reader:
            read = [(c.topic, reader.deserialize(raw, c.msgtype)) for c, _time, raw in reader.messages()]
        assert len(read) == 40
        xs = [message.pose.pose.position.x for topic, message in read if topic == "/odom"]
        assert xs == [step * 0.5 for step in range(10)]


def test_threads_share_a_bag_and_an_iterator(run: Path) -> None:
    bag = periplus.open_bag(run)
    shared = iter(bag)
    times: list[int] = []
    counts: list[int] = []

    def read() -> None:
        for _topic, _message, time in shared:
            times.append(time)
        counts.append(len(list(bag)))

    threads = [threading.Thread(target=read) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert len(times) == len(set(times)) == 40 and counts == [40] * 4


def test_a_loop_can_stop_early(tmp_path: Path) -> None:
    path = tmp_path / "run.mcap"
    with periplus.BagWriter(path, compression="none") as writer:
        for step in range(300):
            writer.write("/image", Image(data=np.full(200_000, step % 251)), step * 1000)
    for _ in range(5):
        for _topic, message, time in periplus.open_bag(path):
            assert message.data[0] == time // 1000 % 251
            if time == 3000:
                break
    times = [time for _topic, _message, time in periplus.open_bag(path)]
    assert times == [step * 1000 for step in range(300)]


@given(steps=st.lists(st.tuples(st.sampled_from(["/a", "/b"]), st.integers(0, 2**62), hnp.arrays(np.float32, st.integers(0, 5))), max_size=20))
@settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))
def test_random_runs_survive(tmp_path_factory: pytest.TempPathFactory, steps: list[tuple[str, int, Any]]) -> None:
    path = tmp_path_factory.mktemp("bags") / "run.mcap"
    with periplus.BagWriter(path) as writer:
        for topic, time, ranges in steps:
            writer.write(topic, LaserScan(ranges=ranges), time)
    bag = periplus.open_bag(path)
    expected = sorted(steps, key=lambda step: step[1])
    read = list(bag)
    assert [(topic, time) for topic, _message, time in read] == [(topic, time) for topic, time, _ranges in expected]
    for (_topic, message, _time), (_a, _b, ranges) in zip(read, expected, strict=True):
        assert np.array_equal(message.ranges, ranges, equal_nan=True)


@given(data=st.binary(max_size=300), at=st.floats(0, 1), name=st.sampled_from(["run.mcap", "run.bag", "run.db3", "log.clf"]))
@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
def test_any_damage_gives_an_error_or_messages(tmp_path_factory: pytest.TempPathFactory, data: bytes, at: float, name: str) -> None:
    path = tmp_path_factory.mktemp("bags") / name
    if name == "log.clf":
        path.write_bytes(b"ODOM 1.0 2.0 0.5 0 0 0 10.0 host 10.0\n" + data)
    else:
        with periplus.BagWriter(path) as writer:
            for step in range(3):
                writer.write("/point", Point(x=step), step)
        whole = path.read_bytes()
        place = int(at * len(whole))
        path.write_bytes(whole[:place] + data + whole[place + len(data) :])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            bag = periplus.open_bag(path)
            for _topic, _message, _time in bag:
                pass
            periplus.check_bag(path)
        except (periplus.FileError, RuntimeError, OSError) as error:
            assert "fault of Periplus" not in str(error)
