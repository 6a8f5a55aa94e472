"""Reads our recordings with other people's libraries, and writes recordings for us to read.

    pip install mcap mcap-ros2-support rosbags
    python3 peers.py probe                  says whether these are there
    python3 peers.py read BAG...            each message is decoded and encoded again; one JSON
    python3 peers.py write SOURCE FOLDER    the messages of one of ours in every kind of rosbags
"""

import json
import sys
from pathlib import Path

from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.rosbag1 import Reader as Reader1, Writer as Writer1
from rosbags.rosbag2 import Reader as Reader2, StoragePlugin, Writer as Writer2
from rosbags.rosbag2.enums import CompressionFormat, CompressionMode
from rosbags.typesys import Stores, get_types_from_msg, get_typestore


def store_of(connections):
    """The types as the recording itself defines them."""
    store = get_typestore(Stores.EMPTY)
    for name in ("Time", "Duration"):
        text = "int32 sec\nuint32 nanosec\n"
        store.register(get_types_from_msg(text, f"builtin_interfaces/msg/{name}"))
    for connection in connections:
        store.register(get_types_from_msg(connection.msgdef.data, connection.msgtype))
    return store


def read(path):
    is_ros1 = path.suffix == ".bag"
    with (Reader1 if is_ros1 else Reader2)(path) as reader:
        store = store_of(reader.connections)
        count, strange, last = 0, set(), 0
        for connection, time_ns, data in reader.messages():
            kind = connection.msgtype
            decode = store.deserialize_ros1 if is_ros1 else store.deserialize_cdr
            encode = store.serialize_ros1 if is_ros1 else store.serialize_cdr
            again = encode(decode(data, kind), kind)
            # The counter of headers is not kept by anybody.
            if bytes(again) != bytes(data):
                strange.add(kind)
            if time_ns < last:
                strange.add("times")
            last = time_ns
            count += 1
        if is_ros1:
            for connection in reader.connections:
                if connection.digest != store.generate_msgdef(connection.msgtype)[1]:
                    strange.add(connection.msgtype + " (sum)")
        told = reader.message_count
    return {"messages": count, "told": told, "strange": sorted(strange)}


def read_mcap(path):
    with open(path, "rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        count = sum(1 for _ in reader.iter_decoded_messages())
        told = reader.get_summary().statistics.message_count
    return {"messages": count, "told": told, "strange": []}


def write(source, folder):
    with Reader2(source) as reader:
        store = store_of(reader.connections)
        connections = list(reader.connections)
        messages = [(c.topic, t, bytes(d)) for c, t, d in reader.messages()]

    def fill(writer, encode, with_hash):
        ids = {}
        for one in connections:
            extra = {}
            if with_hash:
                extra = {"msgdef": one.msgdef.data, "rihs01": one.digest}
            ids[one.topic] = (writer.add_connection(
                one.topic, one.msgtype, typestore=None if with_hash else store, **extra
            ), one.msgtype)
        for topic, time_ns, data in messages:
            connection, kind = ids[topic]
            writer.write(connection, time_ns, encode(data, kind))

    def to_ros1(data, kind):
        return store.cdr_to_ros1(data, kind)

    for name, packing in (
        ("none", None),
        ("bz2", Writer1.CompressionFormat.BZ2),
        ("lz4", Writer1.CompressionFormat.LZ4),
    ):
        writer = Writer1(folder / f"rosbags_{name}.bag")
        if packing:
            writer.set_compression(packing)
        with writer:
            fill(writer, to_ros1, False)
    for storage, plugin in (("mcap", StoragePlugin.MCAP), ("sqlite3", StoragePlugin.SQLITE3)):
        for version in (8, 9):
            for mode in ("NONE", "FILE", "MESSAGE", "STORAGE"):
                if (storage, mode) == ("sqlite3", "STORAGE"):
                    continue
                path = folder / f"rosbags_{storage}_{version}_{mode.lower()}"
                writer = Writer2(path, version=version, storage_plugin=plugin)
                if mode != "NONE":
                    writer.set_compression(CompressionMode[mode], CompressionFormat.ZSTD)
                with writer:
                    fill(writer, lambda data, _: data, True)


def main():
    task, *paths = sys.argv[1:]
    paths = [Path(path) for path in paths]
    if task == "probe":
        return
    if task == "write":
        write(*paths)
        return
    found = {}
    for path in paths:
        found[path.name] = read_mcap(path) if path.suffix == ".mcap" else read(path)
    json.dump(found, sys.stdout)


if __name__ == "__main__":
    main()
