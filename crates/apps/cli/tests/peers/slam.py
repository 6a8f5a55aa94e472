"""Writes the same drive as bags of all kinds, with PyPI's `rosbags`.

    pip install rosbags
    python3 slam.py probe
    python3 slam.py write DRIVE.json FOLDER

DRIVE.json is a list of [stamp_ns, [x, y, yaw], [ranges]]; it says where odometry has the robot and
what the laser measured, 0.1 m ahead of the robot's middle.
"""

import json
import math
import sys
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin, Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore


TRANSFORMS = "tf2_msgs/msg/TFMessage"


def store_of(name):
    """The types of a distribution, with those of tf2, which not all have."""
    store = get_typestore(name)
    if TRANSFORMS not in store.types:
        text = "geometry_msgs/TransformStamped[] transforms\n"
        store.register(get_types_from_msg(text, TRANSFORMS))
    return store


def messages(store, drive, is_ros1):
    types = store.types

    def make(name, **fields):
        return types[name](**fields)

    def header(stamp_ns, frame):
        time = make("builtin_interfaces/msg/Time", sec=stamp_ns // 10**9, nanosec=stamp_ns % 10**9)
        fields = {"stamp": time, "frame_id": frame}
        if is_ros1:
            fields["seq"] = 0
        return make("std_msgs/msg/Header", **fields)

    def transform(stamp_ns, parent, child, x, y, z, yaw):
        return make(
            TRANSFORMS,
            transforms=[make(
                "geometry_msgs/msg/TransformStamped",
                header=header(stamp_ns, parent),
                child_frame_id=child,
                transform=make(
                    "geometry_msgs/msg/Transform",
                    translation=make("geometry_msgs/msg/Vector3", x=x, y=y, z=z),
                    rotation=make(
                        "geometry_msgs/msg/Quaternion",
                        x=0.0, y=0.0, z=math.sin(yaw / 2), w=math.cos(yaw / 2),
                    ),
                ),
            )],
        )

    yield "/tf_static", TRANSFORMS, drive[0][0], transform(
        drive[0][0], "base_link", "laser", 0.1, 0.0, 0.2, 0.0
    )
    for stamp_ns, (x, y, yaw), ranges in drive:
        yield "/tf", TRANSFORMS, stamp_ns, transform(
            stamp_ns, "odom", "base_link", x, y, 0.0, yaw
        )
        step = math.pi / (len(ranges) - 1)
        yield "/scan", "sensor_msgs/msg/LaserScan", stamp_ns, make(
            "sensor_msgs/msg/LaserScan",
            header=header(stamp_ns, "laser"),
            angle_min=-math.pi / 2,
            angle_max=math.pi / 2,
            angle_increment=step,
            time_increment=0.0,
            scan_time=0.1,
            range_min=0.05,
            range_max=20.0,
            ranges=np.array(ranges, dtype=np.float32),
            intensities=np.array([], dtype=np.float32),
        )


def fill(writer, store, drive, is_ros1):
    connections = {}
    for topic, kind, stamp_ns, message in messages(store, drive, is_ros1):
        if topic not in connections:
            connections[topic] = writer.add_connection(topic, kind, typestore=store)
        encode = store.serialize_ros1 if is_ros1 else store.serialize_cdr
        writer.write(connections[topic], stamp_ns, encode(message, kind))


def main():
    task, *paths = sys.argv[1:]
    if task == "probe":
        return
    drive = json.loads(Path(paths[0]).read_text())
    folder = Path(paths[1])
    with Writer1(folder / "ros1.bag") as writer:
        fill(writer, store_of(Stores.ROS1_NOETIC), drive, True)
    for name, plugin in (("sqlite3", StoragePlugin.SQLITE3), ("mcap", StoragePlugin.MCAP)):
        with Writer2(folder / name, version=9, storage_plugin=plugin) as writer:
            fill(writer, store_of(Stores.ROS2_HUMBLE), drive, False)


if __name__ == "__main__":
    main()
