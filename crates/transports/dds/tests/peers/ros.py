"""Real ROS 2: rclpy on rmw_fastrtps_cpp. See fast.cpp for its words."""

import array
import os
import sys
import time

os.environ["ROS_DOMAIN_ID"] = sys.argv[1]

import rclpy
from nav_msgs.msg import OccupancyGrid
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Image, LaserScan, PointCloud2, PointField
from std_srvs.srv import Trigger

KINDS = {
    "scan": LaserScan,
    "cloud": PointCloud2,
    "image": Image,
    "grid": OccupancyGrid,
}


def make(kind, number, side):
    message = KINDS[kind]()
    message.header.stamp.sec, message.header.stamp.nanosec = number, 5
    message.header.frame_id = "base_" + kind
    turn = bytes((i + number) % 101 for i in range(101))
    data = lambda size: array.array("B", (turn * (size // 101 + 1))[:size])
    if kind == "scan":
        message.ranges = [(i + number) * 0.25 for i in range(360)]
        message.range_max = 1.0
    elif kind == "cloud":
        message.height = message.width = side
        message.fields = [
            PointField(name=name, offset=at, datatype=7, count=1)
            for name, at in (("x", 0), ("y", 4), ("z", 8))
        ]
        message.point_step, message.row_step, message.is_dense = 16, 16 * side, True
        message.data = data(side * side * 16)
    elif kind == "image":
        message.height = message.width = side
        message.encoding, message.step = "rgb8", side * 3
        message.data = data(side * side * 3)
    elif kind == "grid":
        message.info.width = message.info.height = side
        message.info.resolution = 1.0
        message.data = array.array("b", data(side * side).tobytes())
    return message


def tell(kind, message):
    width, height, header = 0, 0, message.header
    data = message.ranges if kind == "scan" else message.data
    length, total = len(data), int(sum(data))
    if kind in ("cloud", "image"):
        width, height = message.width, message.height
    if kind == "grid":
        width, height = message.info.width, message.info.height
    return f"{kind} {header.stamp.sec} {header.frame_id} {width}x{height} {length} {total}"


def qos(latched):
    return QoSProfile(
        depth=1 if latched else 10,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


def main(words):
    rclpy.init()
    node = rclpy.create_node(f"peer_{os.getpid()}")
    verb, latched = words[1], words[-1] == "latched"
    if verb == "pub":
        end = node.create_publisher(KINDS[words[2]], words[3].removeprefix("rt"), qos(latched))
        while not latched and end.get_subscription_count() == 0:
            time.sleep(0.005)
        time.sleep(0.5)  # The other end may find us later than we found it.
        side = int(words[6]) if len(words) > 6 and not latched else 4000 if latched else 100
        for number in range(int(words[4])):
            end.publish(make(words[2], number, side))
            time.sleep(int(words[5]) / 1000)
        print("done", flush=True)
        sys.stdin.readline()
    elif verb == "hasty":
        ends = [
            node.create_publisher(KINDS[words[2]], f"{words[3].removeprefix('rt')}{i}", qos(False))
            for i in range(int(words[4]))
        ]
        while ends:
            for end in [end for end in ends if end.get_subscription_count()]:
                end.publish(make(words[2], 0, 100))
                ends.remove(end)
            time.sleep(0.0005)
        sys.stdin.readline()
    elif verb == "sub":
        left, start = int(words[4]), time.monotonic()

        def hear(message):
            nonlocal left
            left -= 1
            took = f" {int((time.monotonic() - start) * 1000)}" if latched else ""
            print(tell(words[2], message) + took, flush=True)

        node.create_subscription(KINDS[words[2]], words[3].removeprefix("rt"), hear, qos(latched))
        while left > 0:
            rclpy.spin_once(node, timeout_sec=1.0)
    elif verb == "serve":
        left = int(words[3])

        def serve(_, response):
            nonlocal left
            left -= 1
            response.success, response.message = True, "from ros"
            return response

        node.create_service(Trigger, words[2], serve)
        while left > 0:
            rclpy.spin_once(node, timeout_sec=1.0)
        print("done", flush=True)
        sys.stdin.readline()
    elif verb == "call":
        client = node.create_client(Trigger, words[2])
        # As users do; without as many writers of responses as readers of requests it never ends well.
        ready = client.wait_for_service(timeout_sec=20.0)
        for _ in range(int(words[3])):
            future = client.call_async(Trigger.Request())
            rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
            answer = future.result()
            late = "" if ready else " NOT READY"
            print("answer", int(answer.success), answer.message + late, flush=True)


main(sys.argv[1:])
