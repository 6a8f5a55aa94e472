"""Clients of the actions and services of Nav2."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rclpy
from action_msgs.msg import GoalStatus
from nav2_msgs.action import (
    AssistedTeleop,
    BackUp,
    ComputePathThroughPoses,
    ComputePathToPose,
    DockRobot,
    DriveOnHeading,
    FollowGPSWaypoints,
    FollowPath,
    FollowWaypoints,
    NavigateThroughPoses,
    NavigateToPose,
    SmoothPath,
    Spin,
    UndockRobot,
)
from nav2_msgs.srv import (
    ClearCostmapAroundPose,
    ClearCostmapAroundRobot,
    ClearCostmapExceptRegion,
    ClearEntireCostmap,
    GetCostmap,
    LoadMap,
)
from rclpy.action import ActionClient
from rclpy.node import Node

# Attributes of the action clients, with the types and names of the actions.
_ACTIONS: dict[str, tuple[Any, str]] = {
    "nav_through_poses_client": (NavigateThroughPoses, "navigate_through_poses"),
    "nav_to_pose_client": (NavigateToPose, "navigate_to_pose"),
    "follow_waypoints_client": (FollowWaypoints, "follow_waypoints"),
    "follow_gps_waypoints_client": (FollowGPSWaypoints, "follow_gps_waypoints"),
    "follow_path_client": (FollowPath, "follow_path"),
    "compute_path_to_pose_client": (ComputePathToPose, "compute_path_to_pose"),
    "compute_path_through_poses_client": (ComputePathThroughPoses, "compute_path_through_poses"),
    "smoother_client": (SmoothPath, "smooth_path"),
    "spin_client": (Spin, "spin"),
    "backup_client": (BackUp, "backup"),
    "drive_on_heading_client": (DriveOnHeading, "drive_on_heading"),
    "assisted_teleop_client": (AssistedTeleop, "assisted_teleop"),
    "docking_client": (DockRobot, "dock_robot"),
    "undocking_client": (UndockRobot, "undock_robot"),
}

# Attributes of the service clients, with the types and names of the services.
_SERVICES: dict[str, tuple[Any, str]] = {
    "change_maps_srv": (LoadMap, "map_server/load_map"),
    "clear_costmap_global_srv": (ClearEntireCostmap, "global_costmap/clear_entirely_global_costmap"),
    "clear_costmap_local_srv": (ClearEntireCostmap, "local_costmap/clear_entirely_local_costmap"),
    "clear_costmap_except_region_srv": (ClearCostmapExceptRegion, "local_costmap/clear_costmap_except_region"),
    "clear_costmap_around_robot_srv": (ClearCostmapAroundRobot, "local_costmap/clear_costmap_around_robot"),
    "clear_costmap_around_pose_srv": (ClearCostmapAroundPose, "local_costmap/clear_costmap_around_pose"),
    "get_costmap_global_srv": (GetCostmap, "global_costmap/get_costmap"),
    "get_costmap_local_srv": (GetCostmap, "local_costmap/get_costmap"),
}


class Nav2Clients(Node):
    """Node with clients of all actions and services of Nav2; its calls spin the node."""

    def __init__(self, node_name: str, namespace: str) -> None:
        super().__init__(node_name=node_name, namespace=namespace)
        self.goal_handle: Any = None
        self.result_future: Any = None
        self.feedback: Any = None
        self.status: int | None = None
        for name, (kind, action) in _ACTIONS.items():
            setattr(self, name, ActionClient(self, kind, action))
        for name, (kind, service) in _SERVICES.items():
            setattr(self, name, self.create_client(kind, service))

    def destroy_node(self) -> None:
        """Ends the node and its action clients."""
        for name in _ACTIONS:
            getattr(self, name).destroy()
        super().destroy_node()

    def _start(self, client_name: str, action: str, goal: Any, what: str) -> bool:
        client = getattr(self, client_name)
        self._wait_for(client.wait_for_server, f"'{action}' action server")
        self.feedback = None
        sent = client.send_goal_async(goal, self._on_feedback)
        rclpy.spin_until_future_complete(self, sent)
        self.goal_handle = sent.result()
        if not self.goal_handle.accepted:
            self.error(f"{what} was rejected!")
            return False
        self.result_future = self.goal_handle.get_result_async()
        return True

    def _call_action(self, client_name: str, action: str, goal: Any, what: str) -> Any:
        client = getattr(self, client_name)
        self._wait_for(client.wait_for_server, f"'{action}' action server")
        sent = client.send_goal_async(goal)
        rclpy.spin_until_future_complete(self, sent)
        self.goal_handle = sent.result()
        if not self.goal_handle.accepted:
            self.error(f"{what} was rejected!")
            self.status = GoalStatus.STATUS_UNKNOWN
            return None
        self.result_future = self.goal_handle.get_result_async()
        rclpy.spin_until_future_complete(self, self.result_future)
        outcome = self.result_future.result()
        self.status = outcome.status
        return outcome.result

    def _call(self, client_name: str, what: str, request: Any) -> Any:
        client = getattr(self, client_name)
        self._wait_for(client.wait_for_service, f"{what} service")
        return self._answer(client, request)

    def _answer(self, client: Any, request: Any) -> Any:
        future = client.call_async(request)
        rclpy.spin_until_future_complete(self, future)
        return future.result()

    def _wait_for(self, wait: Callable[..., bool], what: str) -> None:
        self.debug(f"Waiting for {what}")
        while not wait(timeout_sec=1.0):
            self.info(f"{what} not available, waiting...")

    def _on_feedback(self, msg: Any) -> None:
        self.debug("Received action feedback message")
        self.feedback = msg.feedback

    def info(self, msg: str) -> None:
        """Logs a text."""
        self.get_logger().info(msg)

    def warn(self, msg: str) -> None:
        """Logs a warning."""
        self.get_logger().warning(msg)

    def error(self, msg: str) -> None:
        """Logs an error."""
        self.get_logger().error(msg)

    def debug(self, msg: str) -> None:
        """Logs a text for the search of faults."""
        self.get_logger().debug(msg)
