"""What one sees when the nodes of `own_nodes` work. A program: `own_node_checks.py NAME [together]`.

Alone, it checks a node that runs in another process. With `together`, it makes the node itself, in its own executor; so it runs in
lockstep with `lone_simulation.py`. Prints `ok` and figures.
"""

import math
import os
import sys
import threading
import time
from collections.abc import Callable
from typing import Any

TOGETHER = "together" in sys.argv
if __name__ == "__main__" and not TOGETHER:
    from periplus.ros import activate

    activate()

import rclpy
from geometry_msgs.msg import Twist
from rclpy.executors import ExternalShutdownException, MultiThreadedExecutor
from rclpy.node import Node

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "own_nodes")


def until(condition: Callable[[], Any], what: str, seconds: float = 25.0) -> Any:
    """Waits until the condition gives something true, and returns it."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.02)
    sys.exit(f"not within {seconds} s: {what}")


class Check:
    """The node of the check, its executor and the node under test."""

    def __init__(self, name: str) -> None:
        rclpy.init(args=[])
        self.node = Node("check")
        self.executor = MultiThreadedExecutor(4)
        self.executor.add_node(self.node)
        if TOGETHER:
            self.make(name)
        self.thread = threading.Thread(target=self.spin, daemon=True)
        self.thread.start()

    def make(self, name: str) -> None:
        sys.path.insert(0, os.path.join(FOLDER, "trail_nodes"))
        module = __import__(f"trail_nodes.{name}", fromlist=["main"])
        made = getattr(module, name.capitalize())
        arguments = {"beacon": [1.5], "lamp": ["lamp"]}.get(name, [])
        self.executor.add_node(made(*arguments))

    def spin(self) -> None:
        try:
            self.executor.spin()
        except ExternalShutdownException:
            pass

    def received(self, message_type: Any, topic: str) -> list[tuple[float, Any]]:
        """List that messages of a topic are appended to, with the time."""
        messages: list[tuple[float, Any]] = []
        self.node.create_subscription(message_type, topic, lambda message: messages.append((time.monotonic(), message)), 50)
        return messages

    def call(self, service_type: Any, service: str, **fields: Any) -> Any:
        client = self.node.create_client(service_type, service)
        if not client.wait_for_service(timeout_sec=25.0):
            sys.exit(f"no service {service}")
        future = client.call_async(service_type.Request(**fields))
        until(future.done, f"an answer of {service}")
        return future.result()

    def repeat(self, function: Callable[[], None], period_s: float) -> None:
        self.node.create_timer(period_s, function)


def scan(ahead: float, right: float) -> Any:
    from sensor_msgs.msg import LaserScan

    ranges = [5.0] * 360
    for number in range(360):
        angle = math.radians(number - 180)
        if abs(angle) < 0.3:
            ranges[number] = ahead
        if abs(angle + math.pi / 2) < 0.3:
            ranges[number] = right
    return LaserScan(angle_min=-math.pi, angle_increment=math.radians(1.0), range_min=0.05, range_max=10.0, ranges=ranges)


def guard(check: Check) -> None:
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import LaserScan

    received = check.received(Twist, "cmd_vel")
    scans = check.node.create_publisher(LaserScan, "scan", qos_profile_sensor_data)
    raw = check.node.create_publisher(Twist, "cmd_vel_raw", 10)
    distance, command = [3.0], Twist()
    command.linear.x, command.angular.z = 0.7, 0.25
    check.repeat(lambda: scans.publish(scan(distance[0], 1.0)), 0.1)
    check.repeat(lambda: raw.publish(command), 0.05)
    until(lambda: received and received[-1][1].linear.x == 0.7, "0.7 m/s passed on")
    distance[0] = 0.4
    until(lambda: received[-1][1].linear.x == 0.0, "a stop before the wall")
    assert received[-1][1].angular.z == 0.25
    distance[0] = 3.0
    until(lambda: received[-1][1].linear.x == 0.7, "0.7 m/s again")


def wall(check: Check) -> None:
    from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
    from rcl_interfaces.srv import SetParameters
    from sensor_msgs.msg import LaserScan

    def set_parameter(name: str, value: float) -> Any:
        made = ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
        return check.call(SetParameters, "/wall/set_parameters", parameters=[Parameter(name=name, value=made)]).results[0]

    received = check.received(Twist, "cmd_vel")
    scans = check.node.create_publisher(LaserScan, "scan", 5)
    check.repeat(lambda: scans.publish(scan(3.0, 0.4)), 0.1)
    until(lambda: len(received) > 3, "velocities")
    received.clear()
    time.sleep(3.0)
    count = len(received)
    assert 20 <= count <= 32, f"{count} velocities in 3 s"
    # 0.6 m wanted, 0.4 m away on the right: turns left.
    assert math.isclose(received[-1][1].angular.z, 1.5 * 0.2, abs_tol=1e-6), received[-1]
    refused = set_parameter("speed", 2.0)
    assert (refused.successful, refused.reason) == (False, "too fast"), refused
    assert not set_parameter("gains.p", 11.0).successful
    assert set_parameter("speed", 0.5).successful
    until(lambda: received[-1][1].linear.x == 0.5, "the new speed")
    print(count if TOGETHER else "")


def beacon(check: Check) -> None:
    from tf2_ros import Buffer, TransformListener

    buffer = Buffer()
    listener = TransformListener(buffer, check.node)
    until(lambda: buffer.can_transform("map", "kite", rclpy.time.Time()), "a transform from kite to map")
    assert listener is not None
    seen = []
    for _ in range(5):
        offset = buffer.lookup_transform("post", "kite", rclpy.time.Time()).transform.translation
        assert math.isclose(math.hypot(offset.x, offset.y), 1.5, rel_tol=1e-6), offset
        seen.append(math.atan2(offset.y, offset.x))
        time.sleep(0.3)
    assert len(set(seen)) == 5, seen
    post = buffer.lookup_transform("map", "post", rclpy.time.Time()).transform.translation
    assert (post.x, post.y) == (1.0, 0.0)
    print([round(angle, 4) for angle in seen] if TOGETHER else "")


def follower(check: Check) -> None:
    from geometry_msgs.msg import TransformStamped
    from rcl_interfaces.msg import Log
    from tf2_ros import TransformBroadcaster

    logs = check.received(Log, "/rosout")
    texts = lambda: [log.msg for _, log in logs if log.name == "follower"]  # noqa: E731
    until(lambda: any(text.startswith("no way from map to kite: ") for text in texts()), "the reason for the missing transform")
    broadcaster = TransformBroadcaster(check.node)
    circle = [0]

    def move() -> None:
        circle[0] += 1
        transform = TransformStamped()
        transform.header.stamp = check.node.get_clock().now().to_msg()
        transform.header.frame_id, transform.child_frame_id = "map", "kite"
        transform.transform.translation.x = 1.0 + 0.5 * math.cos(circle[0] / 10)
        transform.transform.rotation.w = 1.0
        broadcaster.sendTransform(transform)

    check.repeat(move, 0.05)
    found = until(lambda: len(seen := [text for text in texts() if text.startswith("kite at ")]) > 5 and seen, "distances")
    distances = [float(text.split()[2]) for text in found]
    assert all(0.5 <= distance <= 1.5 for distance in distances), distances
    assert len(set(distances)) > 2
    print(distances[:5] if TOGETHER else "")


def lamp(check: Check) -> None:
    from lifecycle_msgs.msg import Transition
    from lifecycle_msgs.srv import ChangeState
    from std_msgs.msg import Bool
    from std_srvs.srv import SetBool

    def change(number: int) -> bool:
        return bool(check.call(ChangeState, "/lamp/change_state", transition=Transition(id=number)).success)

    received = check.received(Bool, "/lamp/light")
    assert change(Transition.TRANSITION_CONFIGURE)
    answer = check.call(SetBool, "/lamp/set", data=True)
    assert (answer.success, answer.message) == (False, "not active")
    time.sleep(1.2)
    assert received == []
    assert change(Transition.TRANSITION_ACTIVATE)
    until(lambda: len(received) >= 6, "six changes of the light")
    values = [message.data for _, message in received]
    assert all(before != after for before, after in zip(values, values[1:], strict=False)), values
    period = (received[5][0] - received[0][0]) / 5
    assert 0.4 < period < 0.7, period
    assert check.call(SetBool, "/lamp/set", data=True).message == "set"
    assert change(Transition.TRANSITION_DEACTIVATE)
    count = len(received)
    time.sleep(1.2)
    assert len(received) <= count + 1
    assert change(Transition.TRANSITION_CLEANUP)
    assert not change(Transition.TRANSITION_ACTIVATE)


def square(check: Check) -> None:
    sys.path.insert(0, FOLDER)
    from nav_msgs.msg import Odometry
    from rclpy.action import ActionClient
    from trail_interfaces.action import DriveSide
    from trail_interfaces.msg import Clearance
    from trail_interfaces.srv import SetSpeed

    # A robot that is five times as fast as commanded keeps the check short.
    pose, velocity = [0.0, 0.0, 0.0], [Twist()]
    odometry = check.node.create_publisher(Odometry, "odom", 10)
    check.node.create_subscription(Twist, "cmd_vel", lambda message: velocity.__setitem__(0, message), 1)

    def move() -> None:
        pose[2] += 0.02 * 5 * velocity[0].angular.z
        pose[0] += 0.02 * 5 * velocity[0].linear.x * math.cos(pose[2])
        pose[1] += 0.02 * 5 * velocity[0].linear.x * math.sin(pose[2])
        made = Odometry()
        made.pose.pose.position.x, made.pose.pose.position.y = pose[0], pose[1]
        made.pose.pose.orientation.z, made.pose.pose.orientation.w = math.sin(pose[2] / 2), math.cos(pose[2] / 2)
        odometry.publish(made)

    check.repeat(move, 0.02)
    refused = check.call(SetSpeed, "/square/set_speed", speed=2.0)
    assert (refused.accepted, refused.previous, refused.reason) == (False, 0.3, "between 0 and 1 m/s"), refused
    assert check.call(SetSpeed, "/square/set_speed", speed=0.5).accepted
    client = ActionClient(check.node, DriveSide, "drive_side")
    assert client.wait_for_server(timeout_sec=25.0)
    time.sleep(0.3)
    sides: list[int] = []

    def send(**fields: Any) -> Any:
        future = client.send_goal_async(DriveSide.Goal(**fields), feedback_callback=lambda m: sides.append(m.feedback.side))
        until(future.done, "an answer to the goal")
        return future.result()

    def result(handle: Any) -> Any:
        future = handle.get_result_async()
        until(future.done, "the result", 60.0)
        return future.result()

    assert not send(length=-1.0).accepted
    done = result(send(length=0.3))
    assert done.status == 4, done
    assert sorted(set(sides)) == [0, 1, 2, 3]
    assert 1.2 <= done.result.driven < 1.9, done.result
    handle = send(length=50.0)
    time.sleep(0.5)
    handle.cancel_goal_async()
    cancelled = result(handle)
    assert (cancelled.status, cancelled.result.blocked) == (5, False), cancelled
    handle = send(length=50.0)
    clearance = check.node.create_publisher(Clearance, "clearance", 1)
    # More than once: the other side may discover this publisher later than the publisher its subscription.
    check.repeat(lambda: clearance.publish(Clearance(state=Clearance.BLOCKED)), 0.1)
    blocked = result(handle)
    assert (blocked.status, blocked.result.blocked) == (6, True), blocked
    print([round(value, 6) for value in pose] if TOGETHER else "")


def main() -> None:
    name = sys.argv[1]
    check = Check(name)
    globals()[name](check)
    print("ok", flush=True)
    # Threads of the executor may still wait.
    rclpy.try_shutdown()
    check.thread.join(5.0)


if __name__ == "__main__":
    main()
