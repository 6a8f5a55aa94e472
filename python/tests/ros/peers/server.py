"""The serving side of a conversation between two rclpy: topics, a service, an action, parameters."""

import rclpy
from rclpy.action import ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool
from test_msgs.action import Fibonacci


class Server(Node):
    def __init__(self):
        super().__init__("server")
        group = ReentrantCallbackGroup()
        self.declare_parameter("speed", 0.5)
        self.declare_parameter("names", ["a", "b"])
        self.pong = self.create_publisher(String, "pong", 10)
        self.scan_back = self.create_publisher(LaserScan, "scan_back", qos_profile_sensor_data)
        self.create_subscription(String, "ping", self.pong.publish, 10)
        self.create_subscription(LaserScan, "scan", self.scan_back.publish, qos_profile_sensor_data)
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.latched = self.create_publisher(String, "latched", latched)
        self.latched.publish(String(data="kept"))
        self.create_service(SetBool, "set", self.on_set)
        self.action = ActionServer(
            self, Fibonacci, "fibonacci", self.execute, callback_group=group,
            cancel_callback=lambda handle: CancelResponse.ACCEPT,
        )

    def on_set(self, request, response):
        response.success = not request.data
        response.message = f"was {request.data}"
        return response

    async def execute(self, handle):
        sequence = [0, 1]
        rate = self.create_rate(20)
        while len(sequence) <= handle.request.order:
            if handle.is_cancel_requested:
                handle.canceled()
                return Fibonacci.Result(sequence=sequence)
            sequence.append(sequence[-1] + sequence[-2])
            handle.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            rate.sleep()
        handle.succeed()
        return Fibonacci.Result(sequence=sequence)


rclpy.init()
executor = MultiThreadedExecutor(4)
executor.add_node(Server())
print("ready", flush=True)
try:
    executor.spin()
except (KeyboardInterrupt, ExternalShutdownException):
    pass
