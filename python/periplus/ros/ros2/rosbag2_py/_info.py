"""Descriptions of recordings."""

from __future__ import annotations

import os
from typing import Any

from periplus import _native

from rosbag2_py._options import BagMetadata, FileInformation, TopicInformation, TopicMetadata


def open_bag(uri: str) -> Any:
    """Recording; RuntimeError if there is none or it cannot be read."""
    path = uri.removeprefix("file://")
    try:
        return _native.open_bag(path, raw=True)
    except FileNotFoundError:
        raise RuntimeError(f"No storage could be initialized for {uri!r}: there is no such file or folder") from None
    except (ValueError, OSError) as error:
        raise RuntimeError(f"No storage could be initialized for {uri!r}: {error}") from None


def qos_profiles(topic: Any) -> list[Any]:
    """QoS of the publishers of a topic, as objects of `rclpy`."""
    from rclpy import qos

    made = []
    for one in topic.qos:
        profile = qos.QoSProfile(
            history=_policy(qos.HistoryPolicy, one["history"]),
            depth=one.get("depth", 0),
            reliability=_policy(qos.ReliabilityPolicy, one["reliability"]),
            durability=_policy(qos.DurabilityPolicy, one["durability"]),
            liveliness=_policy(qos.LivelinessPolicy, one["liveliness"]),
        )
        made.append(profile)
    return made


def _policy(kind: Any, name: str) -> Any:
    return getattr(kind, name.upper(), kind.SYSTEM_DEFAULT)


def topic_metadata(topic: Any, number: int) -> TopicMetadata:
    """Description of a topic of a recording."""
    return TopicMetadata(
        id=number,
        name=topic.name,
        type=topic.type_name,
        serialization_format=topic.encoding,
        offered_qos_profiles=qos_profiles(topic),
        type_description_hash=topic.metadata.get("topic_type_hash", ""),
    )


def metadata(bag: Any) -> BagMetadata:
    """Description of a recording."""
    from rclpy.clock import ClockType
    from rclpy.duration import Duration
    from rclpy.time import Time

    start_ns, end_ns = bag.start_ns or 0, bag.end_ns or 0
    start, duration = Time(nanoseconds=start_ns, clock_type=ClockType.SYSTEM_TIME), Duration(nanoseconds=end_ns - start_ns)
    topics = [
        TopicInformation(topic_metadata=topic_metadata(topic, index + 1), message_count=topic.count)
        for index, topic in enumerate(bag.topics)
    ]
    paths = [os.path.basename(path) for path in bag.files]
    files = [FileInformation(path=path) for path in paths]
    if len(files) == 1:
        files = [FileInformation(path=paths[0], starting_time=start, duration=duration, message_count=bag.message_count)]
    return BagMetadata(
        bag_size=bag.size_bytes,
        storage_identifier=bag.storage,
        relative_file_paths=paths,
        files=files,
        duration=duration,
        starting_time=start,
        message_count=bag.message_count,
        topics_with_message_count=topics,
    )


class Info:
    """Reads the description of a recording."""

    def read_metadata(self, uri: str, storage_id: str = "") -> BagMetadata:
        """Description of a recording."""
        return metadata(open_bag(uri))


class MetadataIo:
    """Reads the description of a recording in a folder."""

    def read_metadata(self, uri: str) -> BagMetadata:
        """Description of a recording."""
        return metadata(open_bag(uri))

    def metadata_file_exists(self, uri: str) -> bool:
        """True if the folder has a description."""
        return os.path.isfile(os.path.join(uri, "metadata.yaml"))
