"""Cyclone DDS of PyPI as a publisher and a subscriber that measure. See crates/transports/dds/examples/race/peer.rs.

wire_cyclone.py DOMAIN pub TOPIC TYPE DEPTH TEMPLATE COUNT PERIOD_US
wire_cyclone.py DOMAIN sub TOPIC TYPE DEPTH [announce]

With `announce` a subscriber prints `first` when the first message comes.

Samples go as bytes, without what Python would make of them; Cyclone itself sees that they are valid.
"""

import struct
import sys
import threading
import time
from pathlib import Path

from cyclonedds._clayer import ddspy_take, ddspy_write
from cyclonedds.core import InstanceState, Policy, Qos, ReadCondition, SampleState, ViewState, WaitSet
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

sys.path.insert(0, str(Path(__file__).parents[2] / "crates/transports/dds/tests/peers"))

from ros_types import LaserScan, PointCloud2, PointStamped

DOMAIN, VERB, TOPIC, TYPE, DEPTH = sys.argv[1:6]
ANY = SampleState.Any | ViewState.Any | InstanceState.Any


KIND = {"PointStamped_": PointStamped, "LaserScan_": LaserScan, "PointCloud2_": PointCloud2}[TYPE.split("::")[-1]]

qos = Qos(
    Policy.Reliability.Reliable(duration(milliseconds=100)),
    Policy.Durability.Volatile,
    Policy.History.KeepLast(int(DEPTH)),
    Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
)
participant = DomainParticipant(int(DOMAIN))
topic = Topic(participant, TOPIC, KIND, qos=qos)


def publish(template, count, period_us):
    writer = DataWriter(participant, topic, qos=qos)
    with open(template, "rb") as file:
        data = bytearray(file.read())
    while not writer.get_matched_subscriptions():
        time.sleep(0.005)
    time.sleep(0.7)  # The other end may find us later than we found it.
    print("begin", flush=True)
    period_ns, due = int(period_us) * 1000, time.monotonic_ns()
    for _ in range(int(count)):
        now = time.time_ns()
        struct.pack_into("<iI", data, 4, now // 1_000_000_000, now % 1_000_000_000)
        ddspy_write(writer._ref, bytes(data))
        due += period_ns
        time.sleep(max(due - time.monotonic_ns(), 0) * 1e-9)
    print("done", count, flush=True)
    sys.stdin.readline()


def subscribe():
    reader = DataReader(participant, topic, qos=qos)
    condition = ReadCondition(reader, SampleState.NotRead | ViewState.Any | InstanceState.Any)
    waitset = WaitSet(participant)
    waitset.attach(condition)
    ends = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.readline(), ends.set()), daemon=True).start()
    latencies, times = [], []
    print("ready", flush=True)
    while not ends.is_set():
        waitset.wait(duration(milliseconds=100))
        for data, info in ddspy_take(reader._ref, ANY, 64):
            now = time.time_ns()
            if info.valid_data:
                if not times and "announce" in sys.argv[6:]:
                    print("first", flush=True)
                sec, nanosec = struct.unpack_from("<iI", data, 4)
                latencies.append((now - sec * 1_000_000_000 - nanosec) * 1e-3)
                times.append(now)
    span = (times[-1] - times[0]) * 1e-9 if times else 0.0
    print("got", span, *(f"{latency:.1f}" for latency in latencies), flush=True)


if VERB == "pub":
    publish(*sys.argv[6:9])
else:
    subscribe()
