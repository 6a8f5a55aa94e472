"""Real ROS 2 (rclpy on rmw_fastrtps_cpp), for the tests of the command.

    rclpy_peer.py nodes COUNT PREFIX     nodes, each in a participant of its own; says `ready`
    rclpy_peer.py call COUNT             waits for services, calls each once and the first COUNT times;
                                         says how long that took
    rclpy_peer.py robot                  a node with a topic, a service, parameters and an action
    rclpy_peer.py describe NODE          compares the type descriptions of a node with those of ROS
    rclpy_peer.py bytes                  a node `bytes` with a byte array as a parameter
    rclpy_peer.py meet HEARD SAID        prints the Strings of one topic, publishes to another
"""

import importlib
import json
import sys
import threading
import time

import rclpy
from rcl_interfaces.msg import ParameterDescriptor
from nav_msgs.msg import OccupancyGrid
from rclpy.action import ActionServer, GoalResponse
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci
from type_description_interfaces.srv import GetTypeDescription


def trigger(_, response):
    response.success, response.message = True, "from ros"
    return response


def spin(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.spin()


def nodes(count, prefix):
    for number in range(int(count)):
        context = Context()
        rclpy.init(context=context)
        node = rclpy.create_node(f"{prefix}{number}", context=context)
        node.declare_parameter("number", number)
        node.create_publisher(String, "/chatter", 10)
        node.create_service(Trigger, "~/trigger", trigger)
        threading.Thread(target=spin, args=(context, node), daemon=True).start()
    print("ready", flush=True)
    sys.stdin.readline()


def call(count):
    rclpy.init()
    node = rclpy.create_node("caller")
    end = time.monotonic() + 20
    known, same = [], 0
    # Until ten looks in a row show nothing new.
    while same < 10 and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.05)
        before = known
        known = [one for one in node.get_service_names_and_types() if not one[0].startswith("/caller/")]
        same = same + 1 if known and known == before else 0
    slowest, first = 0.0, None
    for name, types in sorted(known):
        package, kind, service = types[0].split("/")
        try:
            service = getattr(importlib.import_module(f"{package}.{kind}"), service)
        except ModuleNotFoundError:
            continue
        start = time.monotonic()
        client = node.create_client(service, name)
        ready = client.wait_for_service(timeout_sec=5.0)
        future = client.call_async(service.Request())
        rclpy.spin_until_future_complete(node, future, timeout_sec=5.0)
        print("called" if ready and future.done() else "FAILED", name, flush=True)
        slowest = max(slowest, time.monotonic() - start)
        first = first or (client, service)
    for _ in range(int(count)):
        rclpy.spin_until_future_complete(node, first[0].call_async(first[1].Request()), timeout_sec=5.0)
    print(f"slowest {slowest * 1000:.0f}", flush=True)


def robot():
    rclpy.init()
    node = rclpy.create_node("robot")
    node.declare_parameter("speed", 0.5)
    node.declare_parameter("fixed", 1, ParameterDescriptor(read_only=True))
    node.create_service(Trigger, "/trigger", trigger)
    chatter = node.create_publisher(String, "/chatter", 10)
    node.create_timer(0.05, lambda: chatter.publish(String(data="hello")))
    node.create_subscription(String, "/commands", lambda heard: print("heard", heard.data, flush=True), 10)

    def compute(goal):
        sequence = [0, 1]
        while len(sequence) <= goal.request.order:
            sequence.append(sequence[-1] + sequence[-2])
            goal.publish_feedback(Fibonacci.Feedback(sequence=sequence))
        goal.succeed()
        return Fibonacci.Result(sequence=sequence)

    def goal(request):
        return GoalResponse.REJECT if request.order > 40 else GoalResponse.ACCEPT

    server = ActionServer(node, Fibonacci, "/fibonacci", compute, goal_callback=goal)
    print("ready", flush=True)
    rclpy.spin(node)
    server.destroy()


def meet(heard, said):
    rclpy.init()
    node = rclpy.create_node("meet")
    publisher = node.create_publisher(String, said, 10)
    node.create_timer(0.05, lambda: publisher.publish(String(data="hello")))
    node.create_subscription(String, heard, lambda message: print("heard", message.data, flush=True), 10)
    print("ready", flush=True)
    rclpy.spin(node)


def type_hash(path):
    with open(f"{sys.prefix}/share/{path}.json") as file:
        names = {one["type_name"]: one["hash_string"] for one in json.load(file)["type_hashes"]}
    return names[path]


def describe(name):
    """Compares the descriptions of types that a node gives with those of a node of ROS."""
    rclpy.init()
    node = rclpy.create_node("describer")
    node.create_publisher(OccupancyGrid, "/unused", 1)
    context = Context()
    rclpy.init(context=context)
    reference = rclpy.create_node("reference", context=context)
    reference.create_publisher(OccupancyGrid, "/unused", 1)
    threading.Thread(target=spin, args=(context, reference), daemon=True).start()

    def ask(of, hash, kind=""):
        client = node.create_client(GetTypeDescription, f"{of}/get_type_description")
        assert client.wait_for_service(timeout_sec=10.0), of
        request = GetTypeDescription.Request(type_name=kind, type_hash=hash, include_type_sources=True)
        future = client.call_async(request)
        rclpy.spin_until_future_complete(node, future, timeout_sec=10.0)
        return future.result()

    for kind in (
        "nav_msgs/msg/OccupancyGrid",
        "rcl_interfaces/msg/ParameterEvent",
        "rcl_interfaces/srv/SetParameters",
        "type_description_interfaces/srv/GetTypeDescription",
    ):
        ours, theirs = (ask(of, type_hash(kind), kind) for of in (name, "/reference"))
        same = ours.successful and theirs.successful and ours.type_description == theirs.type_description
        sources = [[(one.type_name, one.encoding) for one in of.type_sources] for of in (ours, theirs)]
        if not same:
            print(ours.failure_reason, theirs.failure_reason, ours.type_description, theirs.type_description)
        if sources[0] != sources[1]:
            print(sources)
        print(kind, "same" if same and sources[0] == sources[1] else "DIFFERENT", flush=True)
    print("other", ask(name, type_hash("sensor_msgs/msg/LaserScan")).failure_reason, flush=True)
    print("nonsense", ask(name, "RIHS01_xyz").failure_reason, flush=True)


def byte_array():
    rclpy.init()
    node = rclpy.create_node("bytes")
    node.declare_parameter("key", [b"\x01", b"\xff"])
    print("ready", flush=True)
    rclpy.spin(node)


{"bytes": byte_array, "describe": describe, "nodes": nodes, "call": call, "robot": robot, "meet": meet}[sys.argv[1]](*sys.argv[2:])
