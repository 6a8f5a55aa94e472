#!/usr/bin/env python3
"""Reads our recordings with other people's libraries, and writes recordings for us to read.

    pip install mcap mcap-ros2-support rosbags
    cargo run -p periplus-bags --example samples -- FOLDER
    python3 bags_oracle.py read FOLDER       each library opens, lists and decodes every message
    python3 bags_oracle.py write FOLDER      small files of PyPI `mcap`, as the tests have them
"""

import sys
from pathlib import Path

from mcap.reader import make_reader, NonSeekingReader
from mcap.writer import CompressionType, Writer


def read_with_mcap(path):
    """Indexed and from front to back, all sums checked, every message decoded."""
    from mcap_ros2.decoder import DecoderFactory

    counts = []
    for make in (make_reader, NonSeekingReader):
        with open(path, "rb") as file:
            reader = make(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
            times, topics = [], set()
            for schema, channel, message, decoded in reader.iter_decoded_messages():
                assert schema.encoding == "ros2msg" and channel.message_encoding == "cdr"
                assert channel.metadata["topic_type_hash"].startswith("RIHS01_"), channel
                times.append(message.log_time)
                topics.add(channel.topic)
            assert times == sorted(times)
            counts.append(len(times))
    with open(path, "rb") as file:
        reader = make_reader(file)
        assert reader.get_header().profile == "ros2"
        statistics = reader.get_summary().statistics
        assert statistics.message_count == counts[0] == counts[1], (statistics, counts)
        assert statistics.channel_count == len(topics)
        names = [record.name for record in reader.iter_metadata()]
        assert names == ["rosbag2", "rosbag2"], names
    return counts


def read_with_rosbags(folder):
    """As a rosbag2 folder: metadata.yaml, profiles, hashes, every message decoded, and the same
    values written again give the same bytes."""
    from rosbags.rosbag2 import Reader
    from rosbags.typesys import Stores, get_typestore, get_types_from_msg

    count, strange = 0, set()
    with Reader(folder) as reader:
        store = get_typestore(Stores.EMPTY)
        for connection in reader.connections:
            store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
        for connection in reader.connections:
            qos = connection.ext.offered_qos_profiles
            assert len(qos) == 1 and qos[0].depth in (1, 5, 10), qos
            # Version 5 of the metadata has no hashes. These two rosbags computes otherwise than ROS.
            known = connection.msgtype in ("service_msgs/msg/ServiceEventInfo", "std_msgs/msg/Char")
            ours, theirs = connection.digest, store.hash_rihs01(connection.msgtype)
            if ours not in (theirs, "") and not known:
                strange.add(connection.msgtype)
        for connection, time_ns, data in reader.messages():
            message = store.deserialize_cdr(data, connection.msgtype)
            again = store.serialize_cdr(message, connection.msgtype)
            if bytes(again) != bytes(data):
                strange.add(connection.msgtype + " (bytes)")
            count += 1
        assert count == reader.message_count
        assert reader.duration > 0
    return count, sorted(strange)


def write_with_mcap(folder):
    """Chunked and not, with and without a summary, in each packing."""
    folder.mkdir(parents=True, exist_ok=True)
    text = b"uint32 data\n"
    variants = {
        "plain": dict(compression=CompressionType.NONE),
        "lz4": dict(compression=CompressionType.LZ4),
        "zstd": dict(compression=CompressionType.ZSTD),
        "unchunked": dict(use_chunking=False),
        "no_summary": dict(use_summary_offsets=False, use_statistics=False, repeat_channels=False,
                           repeat_schemas=False),
    }
    for name, options in variants.items():
        path = folder / f"mcap_{name}.mcap"
        with open(path, "wb") as file:
            writer = Writer(file, chunk_size=400, **options)
            writer.start("ros2", library="oracle")
            schema = writer.register_schema("std_msgs/msg/UInt32", "ros2msg", text)
            even = writer.register_channel("/even", "cdr", schema, {"offered_qos_profiles": ""})
            odd = writer.register_channel("/odd", "cdr", schema)
            for number in range(40):
                # Each pair in the wrong order.
                time_ns = (number ^ 1) * 1_000
                data = bytes([0, 1, 0, 0]) + number.to_bytes(4, "little")
                writer.add_message(odd if number % 2 else even, time_ns, data, time_ns + 1, number)
            writer.add_attachment(5, 6, "note.txt", "text/plain", b"hello")
            writer.add_metadata("place", {"city": "Nidau"})
            writer.finish()
        print(path.name, path.stat().st_size, "bytes")


def main():
    task, folder = sys.argv[1], Path(sys.argv[2])
    if task == "write":
        return write_with_mcap(folder)
    for bag in sorted(path for path in folder.iterdir() if path.is_dir()):
        for path in bag.glob("*.mcap"):
            print(path.name, "mcap:", read_with_mcap(path))
        print(bag.name, "rosbags:", *read_with_rosbags(bag))


if __name__ == "__main__":
    main()
