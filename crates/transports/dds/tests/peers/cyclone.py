"""A program that knows nothing of Periplus: PyPI's cyclonedds. See fast.cpp for its words."""

import sys
import time

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration
from ros_types import (
    Header,
    Image,
    LaserScan,
    MapMetaData,
    OccupancyGrid,
    Point,
    PointCloud2,
    PointField,
    Pose,
    Quaternion,
    TFMessage,
    Time,
    Transform,
    TransformStamped,
    TriggerRequest,
    TriggerResponse,
)


KINDS = {
    "scan": LaserScan,
    "cloud": PointCloud2,
    "image": Image,
    "grid": OccupancyGrid,
    "tf": TFMessage,
    "request": TriggerRequest,
    "response": TriggerResponse,
}


def make(kind, number, side):
    header = Header(Time(number, 5), "base_" + kind)
    data = lambda size: [(i + number) % 101 for i in range(size)]
    turn = Quaternion(0.0, 0.0, 0.0, 1.0)
    if kind == "scan":
        ranges = [(i + number) * 0.25 for i in range(360)]
        return LaserScan(header, 0.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0, ranges, [])
    if kind == "cloud":
        fields = [PointField(name, at, 7, 1) for name, at in (("x", 0), ("y", 4), ("z", 8))]
        return PointCloud2(
            header, side, side, fields, False, 16, 16 * side, data(side * side * 16), True
        )
    if kind == "image":
        return Image(header, side, side, "rgb8", 0, side * 3, data(side * side * 3))
    if kind == "grid":
        pose = Pose(Point(0.0, 0.0, 0.0), turn)
        return OccupancyGrid(header, MapMetaData(header.stamp, 1.0, side, side, pose), data(side * side))
    transform = Transform(Point(number * 0.5, 0.0, 0.0), turn)
    return TFMessage([TransformStamped(header, "child", transform)])


def tell(kind, message):
    width, height, length, total = 0, 0, 0, 0
    if kind == "tf":
        one = message.transforms[0]
        header, total = one.header, int(one.transform.translation.x * 1000)
        assert (len(message.transforms), one.child_frame_id) == (1, "child"), message
    else:
        header = message.header
        data = message.ranges if kind == "scan" else message.data
        length, total = len(data), int(sum(data))
    if kind in ("cloud", "image"):
        width, height = message.width, message.height
    if kind == "grid":
        width, height = message.info.width, message.info.height
    return f"{kind} {header.stamp.sec} {header.frame_id} {width}x{height} {length} {total}"


def qos(latched):
    durability = Policy.Durability.TransientLocal if latched else Policy.Durability.Volatile
    return Qos(
        Policy.Reliability.Reliable(duration(seconds=2)),
        durability,
        Policy.History.KeepLast(1 if latched else 10),
        Policy.DataRepresentation(use_cdrv0_representation=True, use_xcdrv2_representation=False),
    )


def main(words):
    participant = DomainParticipant(int(words[0]))
    verb, latched = words[1], words[-1] == "latched"
    topic = lambda kind, name: Topic(participant, name, KINDS[kind], qos=qos(latched))
    writer = lambda kind, name: DataWriter(participant, topic(kind, name), qos=qos(latched))
    reader = lambda kind, name: DataReader(participant, topic(kind, name), qos=qos(latched))

    def take(source):
        while True:
            for sample in source.take(1):
                return sample
            time.sleep(0.001)

    def matched(*ends):
        of = lambda end: end.get_matched_subscriptions() if isinstance(end, DataWriter) else end.get_matched_publications()
        while not all(of(end) for end in ends):
            time.sleep(0.005)

    if verb == "pub":
        end = writer(words[2], words[3])
        if not latched:
            matched(end)
        time.sleep(0.5)  # The other end may find us later than we found it.
        side = 100
        if len(words) > 6 and not latched:
            side = int(words[6])
        for number in range(int(words[4])):
            end.write(make(words[2], number, side))
            time.sleep(int(words[5]) / 1000)
        print("done", flush=True)
        sys.stdin.readline()
    elif verb == "sub":
        end = reader(words[2], words[3])
        for _ in range(int(words[4])):
            print(tell(words[2], take(end)), flush=True)
    elif verb == "serve":
        requests = reader("request", f"rq{words[2]}Request")
        replies = writer("response", f"rr{words[2]}Reply")
        for _ in range(int(words[3])):
            asked = take(requests)
            matched(replies)
            replies.write(TriggerResponse(asked.caller, asked.number, True, "from cyclone"))
        print("done", flush=True)
        sys.stdin.readline()
    elif verb == "call":
        replies = reader("response", f"rr{words[2]}Reply")
        requests = writer("request", f"rq{words[2]}Request")
        matched(requests, replies)
        for number in range(int(words[3])):
            requests.write(TriggerRequest(0x1234567890ABCDEF, number + 7, 0))
            answer = take(replies)
            mine = (answer.caller, answer.number) == (0x1234567890ABCDEF, number + 7)
            print("answer", int(answer.success), answer.message + ("" if mine else " NOT MINE"), flush=True)


main(sys.argv[1:])
