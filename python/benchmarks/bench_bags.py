"""Read one recording with Periplus, rosbags and mcap, in one run.

    python python/benchmarks/bench_bags.py --megabytes 2000

Makes a recording with odometry, transforms, scans, IMU data, images and clouds, as a robot with a camera and a
3D lidar does, and reads it with each library: serialized bytes, and messages. Each figure is the CPU time and the
wall time of a process of its own, the best of some runs, after the file was read once. `rosbags`, `mcap` and
`mcap-ros2-support` come from PyPI; a library that is not installed is left out.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MIXES = ("robot", "small")


def make(path: Path, megabytes: int, mix: str, compression: str) -> None:
    import numpy as np

    import periplus
    from periplus.msgs.builtin_interfaces.msg import Time
    from periplus.msgs.geometry_msgs.msg import TransformStamped
    from periplus.msgs.nav_msgs.msg import Odometry
    from periplus.msgs.sensor_msgs.msg import Image, Imu, JointState, LaserScan, PointCloud2, PointField
    from periplus.msgs.std_msgs.msg import Header
    from periplus.msgs.tf2_msgs.msg import TFMessage

    random = np.random.default_rng(1)
    fields = [PointField(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate("xyzi")]
    points = random.normal(0, 10, (30_000, 4)).astype(np.float32)
    picture = np.repeat(random.integers(0, 255, (480, 160), dtype=np.uint8), 12, axis=1).reshape(-1)
    picture = picture ^ random.integers(0, 4, picture.size, dtype=np.uint8)
    ranges = random.uniform(0.5, 10, 720).astype(np.float32)
    written = 0
    step = 0
    with periplus.BagWriter(path, compression=compression) as writer:
        while written < megabytes * 1_000_000:
            time_ns = 1_700_000_000_000_000_000 + step * 5_000_000
            stamp = Time(sec=time_ns // 1_000_000_000, nanosec=time_ns % 1_000_000_000)
            angle = step * 0.001

            def header(frame: str) -> Header:
                return Header(stamp=stamp, frame_id=frame)

            imu = Imu(header=header("imu"))
            imu.angular_velocity.z = math.sin(angle)
            writer.write("/imu", imu, time_ns)
            written += 330
            if step % 4 == 0:
                odometry = Odometry(header=header("odom"), child_frame_id="base_link")
                odometry.pose.pose.position.x = math.cos(angle)
                writer.write("/odom", odometry, time_ns)
                transform = TransformStamped(header=header("odom"), child_frame_id="base_link")
                transform.transform.translation.x = math.cos(angle)
                writer.write("/tf", TFMessage(transforms=[transform] * 3), time_ns)
                joints = JointState(header=header(""), name=["left", "right"], position=[angle, angle])
                writer.write("/joint_states", joints, time_ns)
                written += 1200
            if step % 10 == 0:
                scan = LaserScan(header=header("laser"), ranges=ranges, intensities=ranges)
                writer.write("/scan", scan, time_ns)
                written += 5900
            if mix == "robot" and step % 20 == 0:
                cloud = PointCloud2(header=header("lidar"), height=1, width=len(points), fields=fields)
                cloud.point_step, cloud.row_step = 16, 16 * len(points)
                cloud.data = (points + angle).astype(np.float32).view(np.uint8).reshape(-1)
                writer.write("/points", cloud, time_ns)
                image = Image(header=header("camera"), height=480, width=640, encoding="rgb8", step=1920)
                image.data = np.roll(picture, step * 3)
                writer.write("/image", image, time_ns)
                written += cloud.data.size + image.data.size
            step += 1


def read_periplus(path: Path, raw: bool) -> int:
    import periplus

    count = 0
    for _topic, _message, _time in periplus.open_bag(path, raw=raw):
        count += 1
    return count


def read_rosbags(path: Path, raw: bool) -> int:
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    count = 0
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as reader:
        for connection, _time, data in reader.messages():
            if not raw:
                reader.deserialize(data, connection.msgtype)
            count += 1
    return count


def read_mcap(path: Path, raw: bool) -> int:
    from mcap.reader import make_reader

    count = 0
    with path.open("rb") as stream:
        if raw:
            for _schema, _channel, _message in make_reader(stream).iter_messages():
                count += 1
        else:
            from mcap_ros2.decoder import DecoderFactory

            reader = make_reader(stream, decoder_factories=[DecoderFactory()])
            for _schema, _channel, _message, _decoded in reader.iter_decoded_messages():
                count += 1
    return count


READERS = {"periplus": read_periplus, "rosbags": read_rosbags, "mcap": read_mcap}


def child(reader: str, path: Path, raw: bool) -> None:
    begun, begun_cpu = time.perf_counter(), time.process_time()
    count = READERS[reader](path, raw)
    wall, cpu = time.perf_counter() - begun, time.process_time() - begun_cpu
    print(json.dumps({"count": count, "wall_s": wall, "cpu_s": cpu}))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--megabytes", type=int, default=2000, help="size of the messages [MB]")
    parser.add_argument("--mix", choices=MIXES, default="robot", help="robot: with images and clouds; small: without")
    parser.add_argument("--compression", default="zstd", choices=("zstd", "lz4", "none"))
    parser.add_argument("--runs", type=int, default=2, help="runs of which the best counts")
    parser.add_argument("--folder", type=Path, help="folder for the recording (default: a temporary one)")
    parser.add_argument("--child", nargs=3, metavar=("READER", "PATH", "RAW"), help=argparse.SUPPRESS)
    options = parser.parse_args()
    if options.child:
        reader, path, raw = options.child
        child(reader, Path(path), raw == "raw")
        return
    with tempfile.TemporaryDirectory(dir=options.folder) as folder:
        path = Path(folder) / "recording.mcap"
        begun = time.perf_counter()
        make(path, options.megabytes, options.mix, options.compression)
        seconds = time.perf_counter() - begun
        size = path.stat().st_size / 1e6
        print(f"recording: {options.megabytes} MB of messages ({options.mix}), {size:.0f} MB on disk, {options.compression}")
        print(f"written by BagWriter in {seconds:.1f} s ({options.megabytes / seconds:.0f} MB/s)")
        for raw in (False, True):
            print("serialized bytes" if raw else "messages")
            ours: dict[str, float] = {}
            for reader in READERS:
                best: dict[str, float] = {}
                for _ in range(options.runs):
                    command = [sys.executable, __file__, "--child", reader, str(path), "raw" if raw else "messages"]
                    done = subprocess.run(command, capture_output=True, text=True)
                    if done.returncode:
                        print(f"  {reader}: {done.stderr.strip().splitlines()[-1]}")
                        break
                    result = json.loads(done.stdout)
                    for key, value in result.items():
                        best[key] = min(best.get(key, math.inf), value)
                if not best:
                    continue
                ours = ours or best
                print(
                    f"  {reader:9} {best['count']:8.0f} messages  wall {best['wall_s']:7.2f} s"
                    f" ({best['wall_s'] / ours['wall_s']:5.1f}x)  CPU {best['cpu_s']:7.2f} s"
                    f" ({best['cpu_s'] / ours['cpu_s']:5.1f}x)"
                )


if __name__ == "__main__":
    main()
