"""Reading and writing of recordings."""

from pathlib import Path

import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

import rosbag2_py  # noqa: E402
from periplus import deserialize, serialize  # noqa: E402
from std_msgs.msg import Int32, String  # noqa: E402


def write(folder: Path, storage: str = "mcap") -> str:
    uri = str(folder / "bag")
    writer = rosbag2_py.SequentialWriter()
    writer.open(rosbag2_py.StorageOptions(uri=uri, storage_id=storage), rosbag2_py.ConverterOptions("", ""))
    writer.create_topic(rosbag2_py.TopicMetadata(id=0, name="/a", type="std_msgs/msg/String", serialization_format="cdr"))
    writer.create_topic(rosbag2_py.TopicMetadata("/b", "std_msgs/msg/Int32", "cdr"))
    for index in range(3):
        writer.write("/a", serialize(String(data=str(index))), index * 100)
        writer.write("/b", serialize(Int32(data=index)), index * 100 + 50)
    writer.close()
    return uri


def reader(uri: str) -> rosbag2_py.SequentialReader:
    made = rosbag2_py.SequentialReader()
    made.open(rosbag2_py.StorageOptions(uri=uri, storage_id=""), rosbag2_py.ConverterOptions("cdr", "cdr"))
    return made


def rest(one: rosbag2_py.SequentialReader) -> list[tuple[str, int]]:
    found = []
    while one.has_next():
        topic, _, time_ns = one.read_next()
        found.append((topic, time_ns))
    return found


@pytest.mark.parametrize("storage", ["mcap", "sqlite3"])
def test_round_trip(tmp_path: Path, storage: str) -> None:
    one = reader(write(tmp_path, storage))
    topic, data, time_ns = one.read_next()
    assert (topic, time_ns, deserialize(String, data)) == ("/a", 0, String(data="0"))
    assert rest(one)[-1] == ("/b", 250)
    with pytest.raises(RuntimeError, match="at end"):
        one.read_next()


def test_filter_and_seek(tmp_path: Path) -> None:
    one = reader(write(tmp_path))
    one.set_filter(rosbag2_py.StorageFilter(topics=["/b"]))
    assert rest(one) == [("/b", 50), ("/b", 150), ("/b", 250)]
    one.seek(140)
    assert rest(one) == [("/b", 150), ("/b", 250)]
    one.reset_filter()
    one.seek(200)
    assert rest(one) == [("/a", 200), ("/b", 250)]


def test_reverse_order(tmp_path: Path) -> None:
    one = reader(write(tmp_path))
    one.set_read_order(rosbag2_py.ReadOrder(reverse=True))
    assert [time_ns for _, time_ns in rest(one)] == [250, 200, 150, 100, 50, 0]


def test_descriptions(tmp_path: Path) -> None:
    uri = write(tmp_path)
    made = rosbag2_py.Info().read_metadata(uri, "")
    assert made.message_count == 6 and made.duration.nanoseconds == 250 and made.starting_time.nanoseconds == 0
    assert [(one.topic_metadata.name, one.message_count) for one in made.topics_with_message_count] == [("/a", 3), ("/b", 3)]
    types = {topic.name: topic.type for topic in reader(uri).get_all_topics_and_types()}
    assert types == {"/a": "std_msgs/msg/String", "/b": "std_msgs/msg/Int32"}


def test_errors_say_what_to_do(tmp_path: Path) -> None:
    uri = write(tmp_path)
    writer = rosbag2_py.SequentialWriter()
    with pytest.raises(RuntimeError, match="can't overwrite existing bag"):
        writer.open(rosbag2_py.StorageOptions(uri=uri), rosbag2_py.ConverterOptions())
    with pytest.raises(RuntimeError, match="no such file or folder"):
        reader(str(tmp_path / "nope"))
    writer.open(rosbag2_py.StorageOptions(uri=str(tmp_path / "other")), rosbag2_py.ConverterOptions())
    with pytest.raises(RuntimeError, match="without creating it first"):
        writer.write("/x", b"", 0)
