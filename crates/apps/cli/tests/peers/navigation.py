"""A client of navigation with rclpy of ROS 2: sends goals on `goal_pose`, follows them, preempts one and cancels one.

PyPI's ROS 2 has no nav2_msgs, so the client uses the parts of the action that have common types: its status, and its service
that cancels. Prints a line for each step, and `FAILED ...` with a reason.
"""

import math
import sys
import time

import rclpy
from action_msgs.msg import GoalStatus, GoalStatusArray
from action_msgs.srv import CancelGoal
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry, Path
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

LONG_S = 60.0
ENDED = {GoalStatus.STATUS_SUCCEEDED: "succeeded", GoalStatus.STATUS_CANCELED: "canceled", GoalStatus.STATUS_ABORTED: "aborted"}


def main(odometry_topic):
    rclpy.init()
    node = rclpy.create_node("navigation_client")
    statuses, plans, speeds = {}, [], [math.inf]

    def on_status(message):
        for one in message.status_list:
            statuses[bytes(one.goal_info.goal_id.uuid)] = one.status

    def on_odometry(message):
        twist = message.twist.twist
        speeds.append(math.hypot(twist.linear.x, twist.linear.y) + abs(twist.angular.z))

    latched = QoSProfile(depth=1, reliability=ReliabilityPolicy.RELIABLE, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(GoalStatusArray, "navigate_to_pose/_action/status", on_status, latched)
    node.create_subscription(Path, "plan", plans.append, 10)
    node.create_subscription(Odometry, odometry_topic, on_odometry, 10)
    goals = node.create_publisher(PoseStamped, "goal_pose", 10)
    cancel = node.create_client(CancelGoal, "navigate_to_pose/_action/cancel_goal")

    def wait(what, is_there):
        end = time.monotonic() + LONG_S
        while not is_there():
            if time.monotonic() > end:
                print(f"FAILED {what}; statuses {sorted(statuses.values())}, {len(plans)} plans", flush=True)
                sys.exit(1)
            rclpy.spin_once(node, timeout_sec=0.1)
        print(what, flush=True)

    def send(x, y):
        goal = PoseStamped()
        goal.header.frame_id = "map"
        goal.pose.position.x, goal.pose.position.y, goal.pose.orientation.w = x, y, 1.0
        goals.publish(goal)

    def is_planned(x, y):
        ends = [plan.poses[-1].pose.position for plan in plans[-1:] if plan.poses]
        return any(math.hypot(end.x - x, end.y - y) < 0.3 for end in ends)

    def count(status):
        return sum(value == status for value in statuses.values())

    wait("ready", lambda: goals.get_subscription_count() > 0 and cancel.service_is_ready())
    # Goals are rejected while the map is not there yet.
    end = time.monotonic() + LONG_S
    while count(GoalStatus.STATUS_EXECUTING) == 0 and time.monotonic() < end:
        send(1.5, 0.0)
        for _ in range(10):
            rclpy.spin_once(node, timeout_sec=0.1)
    wait("executing", lambda: count(GoalStatus.STATUS_EXECUTING) == 1)
    wait("planned", lambda: is_planned(1.5, 0.0))
    wait("moving", lambda: speeds[-1] > 0.05)
    send(-1.0, 1.0)
    wait("preempted", lambda: is_planned(-1.0, 1.0))
    request = CancelGoal.Request()
    answer = cancel.call_async(request)
    wait("cancel accepted", lambda: answer.done() and answer.result().return_code == 0)
    wait("canceled", lambda: count(GoalStatus.STATUS_CANCELED) >= 1)
    wait("stopped", lambda: speeds[-1] < 0.01)
    send(1.2, 0.0)
    wait("reached", lambda: count(GoalStatus.STATUS_SUCCEEDED) >= 1)
    print("done", flush=True)


main(sys.argv[1])
