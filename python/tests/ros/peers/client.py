"""The asking side of a conversation between two rclpy; prints what it hears."""

import time

import rclpy
from rcl_interfaces.msg import Parameter, ParameterValue
from rcl_interfaces.srv import GetParameters, ListParameters, SetParameters
from rclpy.action import ActionClient
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from sensor_msgs.msg import LaserScan
from std_msgs.msg import String
from std_srvs.srv import SetBool
from test_msgs.action import Fibonacci

rclpy.init()
node = rclpy.create_node("client")


def until(done, seconds=20.0):
    end = time.monotonic() + seconds
    while not done() and time.monotonic() < end:
        rclpy.spin_once(node, timeout_sec=0.05)


def call(kind, name, request):
    client = node.create_client(kind, name)
    assert client.wait_for_service(timeout_sec=20.0), name
    future = client.call_async(request)
    rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
    return future.result()


heard = []
node.create_subscription(String, "latched", lambda m: heard.append(m.data), QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
until(lambda: heard)
print("latched", heard)

pongs, scans = [], []
pings = node.create_publisher(String, "ping", 10)
scan = node.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
node.create_subscription(String, "pong", lambda m: pongs.append(m.data), 10)
node.create_subscription(LaserScan, "scan_back", scans.append, qos_profile_sensor_data)
until(lambda: pings.get_subscription_count() and node.count_publishers("pong") and scan.get_subscription_count())
time.sleep(0.5)
for index in range(5):
    pings.publish(String(data=f"é{index}"))
until(lambda: len(pongs) == 5)
print("pongs", pongs)
message = LaserScan(angle_min=-1.5, ranges=[1.0, float("inf"), 2.5], intensities=[0.5])
message.header.frame_id = "laser"
while not scans:
    scan.publish(message)
    until(lambda: scans, 0.3)
print("scan", scans[0] == message, scans[0].ranges.tolist())

response = call(SetBool, "set", SetBool.Request(data=True))
print("service", response.success, response.message)

names = call(ListParameters, "server/list_parameters", ListParameters.Request()).result.names
print("parameters", sorted(name for name in names if name in ("speed", "names", "use_sim_time")))
values = call(GetParameters, "server/get_parameters", GetParameters.Request(names=["speed", "names"])).values
print("values", values[0].double_value, values[1].string_array_value)
new = [Parameter(name="speed", value=ParameterValue(type=3, double_value=0.75)), Parameter(name="names", value=ParameterValue(type=2, integer_value=1))]
results = call(SetParameters, "server/set_parameters", SetParameters.Request(parameters=new)).results
print("set", [result.successful for result in results], results[1].reason)
print("speed", call(GetParameters, "server/get_parameters", GetParameters.Request(names=["speed"])).values[0].double_value)

client = ActionClient(node, Fibonacci, "fibonacci")
assert client.wait_for_server(timeout_sec=20.0)
feedback = []
future = client.send_goal_async(Fibonacci.Goal(order=5), feedback_callback=lambda m: feedback.append(len(m.feedback.sequence)))
rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
handle = future.result()
result = handle.get_result_async()
rclpy.spin_until_future_complete(node, result, timeout_sec=20.0)
print("action", handle.accepted, result.result().status, result.result().result.sequence.tolist(), feedback[-1])
future = client.send_goal_async(Fibonacci.Goal(order=400))
rclpy.spin_until_future_complete(node, future, timeout_sec=20.0)
handle = future.result()
result = handle.get_result_async()
cancelled = handle.cancel_goal_async()
rclpy.spin_until_future_complete(node, cancelled, timeout_sec=20.0)
rclpy.spin_until_future_complete(node, result, timeout_sec=20.0)
print("cancelled", len(cancelled.result().goals_canceling), result.result().status)
print("node", ("server", "/") in node.get_node_names_and_namespaces())
rclpy.shutdown()
