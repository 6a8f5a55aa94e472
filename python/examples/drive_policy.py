"""Drives a robot to goals with a policy of ``train_navigation.py``: a node of ROS 2.

    pip install onnxruntime
    periplus run drive_policy.py --ros-args -p policy:=policy.onnx -r odom:=demo/odom -p use_sim_time:=true

Subscribes to ``scan`` (LaserScan), ``odom`` (Odometry) and ``goal_pose`` (PoseStamped, which RViz and the page publish);
publishes ``cmd_vel`` (Twist), and true on ``goal_reached`` (Bool) at the goal. The parameter ``goal`` is a first goal in
the frame of the odometry, x and y [m]. Transforms from the lidar to the robot, and from the frame of the goal to that of
the odometry, come from tf; ``lidar_pose`` (x, y, yaw) replaces the first, and a goal in the frame of the odometry needs no
second. The limits of the velocity, the period of the commands and the sectors of the lidar are those of the training, from
the metadata of the policy. It runs with the ``rclpy`` of Periplus and with that of ROS 2.
"""

from __future__ import annotations

import json
import math
from typing import Any, TypeAlias

import numpy as np
import onnxruntime
import rclpy
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool

Pose2: TypeAlias = tuple[float, float, float]
"""x [m], y [m], yaw [rad]."""
MAX_AGE_S = 0.6
"""Age of a scan or of the odometry beyond which the robot stops [s]."""


def yaw_of(turn: Any) -> float:
    """Heading of a quaternion [rad]."""
    return math.atan2(2.0 * (turn.w * turn.z + turn.x * turn.y), 1.0 - 2.0 * (turn.y**2 + turn.z**2))


class Transforms:
    """Poses of frames in each other from tf, which is imported when the first is asked for."""

    def __init__(self, node: Node) -> None:
        self.node = node
        self.buffer: Any = None

    def lookup(self, target: str, source: str) -> Pose2 | None:
        """Pose of a frame in another; none as long as it is unknown."""
        from tf2_ros import Buffer, TransformException, TransformListener

        if self.buffer is None:
            self.buffer = Buffer()
            self.listener = TransformListener(self.buffer, self.node)
        try:
            found = self.buffer.lookup_transform(target, source, Time()).transform
        except TransformException as error:
            self.node.get_logger().warning(f"stopped: {error}", throttle_duration_sec=5.0)
            return None
        return found.translation.x, found.translation.y, yaw_of(found.rotation)


class PolicyDriver(Node):
    """Commands the velocity that a policy chooses."""

    def __init__(self) -> None:
        super().__init__("policy_driver")
        path = str(self.declare_parameter("policy", "policy.onnx").value)
        self.base_frame = str(self.declare_parameter("base_frame", "base_link").value)
        self.session = onnxruntime.InferenceSession(path)
        metadata = self.session.get_modelmeta().custom_metadata_map
        if "robot" not in metadata or "task" not in metadata:
            raise SystemExit(f"{path} has no metadata `robot` and `task`: write it by train_navigation.py")
        self.robot, self.task = json.loads(metadata["robot"]), json.loads(metadata["task"])
        self.scan: LaserScan | None = None
        self.odometry: Odometry | None = None
        self.goal: tuple[float, float] | None = None
        self.asked: PoseStamped | None = None
        first = self.declare_parameter("goal", [math.nan, math.nan]).value
        if len(first) == 2 and all(math.isfinite(part) for part in first):
            self.asked = PoseStamped()
            self.asked.pose.position.x, self.asked.pose.position.y = (float(part) for part in first)
        pose = list(self.declare_parameter("lidar_pose", [math.nan] * 3).value)
        self.lidar_pose: Pose2 | None = (pose[0], pose[1], pose[2]) if math.isfinite(sum(pose)) else None
        self.transforms = Transforms(self)
        self.commands = self.create_publisher(Twist, "cmd_vel", 10)
        self.reached = self.create_publisher(Bool, "goal_reached", 10)
        self.create_subscription(LaserScan, "scan", self.on_scan, qos_profile_sensor_data)
        self.create_subscription(Odometry, "odom", self.on_odometry, 10)
        self.create_subscription(PoseStamped, "goal_pose", self.on_goal, 10)
        self.create_timer(float(self.task["step_period"]), self.drive)

    def on_scan(self, scan: LaserScan) -> None:
        self.scan = scan

    def on_odometry(self, odometry: Odometry) -> None:
        self.odometry = odometry

    def on_goal(self, goal: PoseStamped) -> None:
        self.asked, self.goal = goal, None

    def drive(self) -> None:
        """Commands the next velocity, or a stop where something is missing."""
        if self.asked is None:
            return
        problem = self.missing()
        observation = None if problem else self.observation()
        if observation is None:
            if problem:
                self.get_logger().warning(f"stopped: {problem}", throttle_duration_sec=5.0)
            self.commands.publish(Twist())
            return
        if self.distance() <= float(self.task["goal_tolerance"]):
            self.commands.publish(Twist())
            self.asked = self.goal = None
            self.reached.publish(Bool(data=True))
            self.get_logger().info("reached the goal")
            return
        (action,) = self.session.run(["action"], {"observation": observation[None]})[0]
        slowest, fastest = float(self.robot["min_speed"]), float(self.robot["max_speed"])
        command = Twist()
        command.linear.x = slowest + (fastest - slowest) * (float(action[0]) + 1.0) / 2.0
        command.angular.z = float(action[1]) * float(self.robot["max_turn_rate"])
        self.commands.publish(command)

    def missing(self) -> str | None:
        """What a command needs and is not there."""
        now = self.get_clock().now()
        for name, message in (("scan", self.scan), ("odom", self.odometry)):
            if message is None:
                return f"nothing on {self.resolve_topic_name(name)} yet"
            age_s = (now - Time.from_msg(message.header.stamp)).nanoseconds * 1e-9
            if age_s > MAX_AGE_S:
                return f"the last message on {self.resolve_topic_name(name)} is {age_s:.1f} s old"
        return None

    def observation(self) -> np.ndarray[Any, np.dtype[np.float32]] | None:
        """Sectors, goal and velocity as in the training, scaled; none without the transforms."""
        assert self.scan is not None and self.odometry is not None and self.asked is not None
        mount = self.lidar_pose or self.transforms.lookup(self.base_frame, self.scan.header.frame_id)
        if self.goal is None:
            self.goal = self.goal_in(self.odometry.header.frame_id, self.asked)
        if mount is None or self.goal is None:
            return None
        sectors = self.sectors(self.scan, mount) / float(self.robot["lidar_max_range"])
        pose, velocity = self.odometry.pose.pose, self.odometry.twist.twist
        bearing = math.atan2(self.goal[1] - pose.position.y, self.goal[0] - pose.position.x) - yaw_of(pose.orientation)
        fastest = max(float(self.robot["max_speed"]), abs(float(self.robot["min_speed"])))
        rest = [
            min(self.distance() / 10.0, 1.0), math.cos(bearing), math.sin(bearing),
            velocity.linear.x / fastest, velocity.angular.z / float(self.robot["max_turn_rate"]),
        ]  # fmt: skip
        return np.concatenate([sectors, np.clip(rest, -1.0, 1.0)]).astype(np.float32)

    def goal_in(self, frame: str, goal: PoseStamped) -> tuple[float, float] | None:
        """Goal in a frame; none as long as the transform is unknown."""
        at = goal.pose.position
        source = goal.header.frame_id or frame
        if source == frame:
            return at.x, at.y
        moved = self.transforms.lookup(frame, source)
        if moved is None:
            return None
        cosine, sine = math.cos(moved[2]), math.sin(moved[2])
        return moved[0] + cosine * at.x - sine * at.y, moved[1] + sine * at.x + cosine * at.y

    def sectors(self, scan: LaserScan, mount: Pose2) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Distance of the nearest point in each sector about the robot [m]."""
        count, first = int(self.task["lidar_sectors"]), float(self.robot["lidar_min_angle"])
        farthest = float(self.robot["lidar_max_range"])
        ranges = np.asarray(scan.ranges, float)
        angles = scan.angle_min + scan.angle_increment * np.arange(len(ranges)) + mount[2]
        is_hit = np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)
        ranges, angles = ranges[is_hit], angles[is_hit]
        x, y = mount[0] + ranges * np.cos(angles), mount[1] + ranges * np.sin(angles)
        at = np.floor((np.arctan2(y, x) - first) % math.tau / math.tau * count).astype(int) % count
        found = np.full(count, farthest)
        np.minimum.at(found, at, np.hypot(x, y))
        return found

    def distance(self) -> float:
        """Distance to the goal [m]."""
        assert self.odometry is not None and self.goal is not None
        at = self.odometry.pose.pose.position
        return math.hypot(self.goal[0] - at.x, self.goal[1] - at.y)


def main() -> None:
    rclpy.init()
    node = PolicyDriver()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    node.destroy_node()
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
