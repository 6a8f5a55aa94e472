"""Real ROS 2 (rclpy on rmw_fastrtps_cpp) as a publisher, a subscriber and a client that measure.

    wire_rclpy.py pub KIND SIZE RELIABILITY HZ COUNT   prints `begin`, `done COUNT SPAN_S`
    wire_rclpy.py sub KIND TOPIC RELIABILITY           prints `ready`, `first`; at the end of its input `got ...`
    wire_rclpy.py call COUNT                           calls a `list_parameters`; prints `called COUNT SLOWEST_MS`

KIND is scan, image, camera_info or cloud; RELIABILITY is reliable or best_effort. SIZE is the number of rays,
of columns of a picture of the shape 4:3, or of bytes of a cloud. A message has its number in `frame_id` and the
time of its publication in `stamp`. `got` is followed by the number of messages, of different numbers among them,
the time from first to last, and the age of each message in ms.
"""

import array
import sys
import threading
import time

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import CameraInfo, Image, LaserScan, PointCloud2, PointField

KINDS = {"scan": LaserScan, "image": Image, "camera_info": CameraInfo, "cloud": PointCloud2}
POINT_STEP = 16


def qos(reliability):
    policies = {"reliable": ReliabilityPolicy.RELIABLE, "best_effort": ReliabilityPolicy.BEST_EFFORT}
    return QoSProfile(depth=10, reliability=policies[reliability])


def make(kind, size):
    message = KINDS[kind]()
    if kind == "scan":
        message.angle_min, message.angle_max = -3.14, 3.14
        message.angle_increment = 6.28 / size
        message.range_min, message.range_max = 0.1, 30.0
        message.ranges = array.array("f", [1.0] * size)
    elif kind == "image":
        message.width, message.height, message.step = size, size * 3 // 4, size * 3
        message.encoding, message.data = "rgb8", array.array("B", bytes(size * size * 9 // 4))
    elif kind == "camera_info":
        message.width, message.height = size, size * 3 // 4
        message.distortion_model, message.d = "plumb_bob", [0.0] * 5
    elif kind == "cloud":
        points = size // POINT_STEP
        message.width, message.height = points, 1
        message.fields = [
            PointField(name=name, offset=offset, datatype=PointField.FLOAT32, count=1)
            for name, offset in (("x", 0), ("y", 4), ("z", 8), ("intensity", 12))
        ]
        message.point_step, message.row_step, message.is_dense = POINT_STEP, points * POINT_STEP, True
        message.data = array.array("B", bytes(points * POINT_STEP))
    return message


def publish(kind, size, reliability, rate_hz, count):
    node = rclpy.create_node("publisher")
    publisher = node.create_publisher(KINDS[kind], "/measured", qos(reliability))
    message = make(kind, int(size))
    while not publisher.get_subscription_count():
        time.sleep(0.005)
    # The subscriber may find the publisher later than it was found.
    time.sleep(0.7)
    print("begin", flush=True)
    start = due = time.monotonic()
    for number in range(int(count)):
        now_ns = time.time_ns()
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(now_ns, 10**9)
        message.header.frame_id = str(number)
        publisher.publish(message)
        last = time.monotonic()
        due += 1 / float(rate_hz)
        time.sleep(max(due - time.monotonic(), 0))
    print("done", count, last - start, flush=True)
    sys.stdin.read()


def subscribe(kind, topic, reliability):
    ends = threading.Event()
    threading.Thread(target=lambda: (sys.stdin.read(), ends.set()), daemon=True).start()
    node = rclpy.create_node("subscriber")
    numbers, ages_ms, times = [], [], []

    def receive(message):
        now_ns = time.time_ns()
        stamp = message.header.stamp
        if not times:
            print("first", flush=True)
        numbers.append(message.header.frame_id)
        ages_ms.append((now_ns - stamp.sec * 10**9 - stamp.nanosec) * 1e-6)
        times.append(now_ns)

    node.create_subscription(KINDS[kind], topic, receive, qos(reliability))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    print("ready", flush=True)
    while not ends.is_set():
        executor.spin_once(timeout_sec=0.1)
    span_s = (times[-1] - times[0]) * 1e-9 if times else 0.0
    print("got", len(numbers), len(set(numbers)), span_s, *(f"{age:.3f}" for age in ages_ms), flush=True)


def call(count):
    from rcl_interfaces.srv import ListParameters

    node = rclpy.create_node("caller")
    end = time.monotonic() + 20
    names = []
    while not names and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
        names = [name for name, _ in node.get_service_names_and_types()]
        names = sorted(name for name in names if name.endswith("/list_parameters") and "/caller/" not in name)
    client = node.create_client(ListParameters, names[0])
    client.wait_for_service(timeout_sec=10.0)
    answered, slowest_s = 0, 0.0
    for _ in range(int(count)):
        start = time.monotonic()
        future = client.call_async(ListParameters.Request())
        rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
        answered += future.done()
        slowest_s = max(slowest_s, time.monotonic() - start)
    print("called", answered, slowest_s * 1000, flush=True)


rclpy.init()
{"pub": publish, "sub": subscribe, "call": call}[sys.argv[1]](*sys.argv[2:])
