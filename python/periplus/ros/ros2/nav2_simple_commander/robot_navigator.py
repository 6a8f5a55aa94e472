"""Node that sends goals to Nav2."""

from __future__ import annotations

from enum import Enum
from typing import Any

import rclpy
from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import Point, PoseStamped, PoseWithCovarianceStamped
from lifecycle_msgs.srv import GetState
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
    ManageLifecycleNodes,
)
from periplus.ros import _waiting
from rclpy.qos import QoSDurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy

from nav2_simple_commander._clients import Nav2Clients

# Interval at which the state of a node is asked for [ns].
_STATE_POLL_NS = 2_000_000_000


class TaskResult(Enum):
    """Outcome of a task."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3


_RESULTS = {
    GoalStatus.STATUS_SUCCEEDED: TaskResult.SUCCEEDED,
    GoalStatus.STATUS_ABORTED: TaskResult.FAILED,
    GoalStatus.STATUS_CANCELED: TaskResult.CANCELED,
}

class BasicNavigator(Nav2Clients):
    """Sends goals to Nav2 and follows them.

    A task (`goToPose`, `followWaypoints`, `spin`, ...) returns True once it is accepted. Poll `isTaskComplete`, then ask
    `getResult`. The methods spin this node themselves.
    """

    def __init__(self, node_name: str = "basic_navigator", namespace: str = "") -> None:
        super().__init__(node_name, namespace)
        self.initial_pose = PoseStamped()
        self.initial_pose.header.frame_id = "map"
        self.initial_pose_received = False
        latched = QoSProfile(
            durability=QoSDurabilityPolicy.TRANSIENT_LOCAL,
            reliability=QoSReliabilityPolicy.RELIABLE,
            history=QoSHistoryPolicy.KEEP_LAST,
            depth=1,
        )
        self.localization_pose_sub = self.create_subscription(
            PoseWithCovarianceStamped, "amcl_pose", self._on_pose, latched
        )
        self.initial_pose_pub = self.create_publisher(PoseWithCovarianceStamped, "initialpose", 10)

    def destroyNode(self) -> None:  # noqa: N802
        """Ends the node."""
        self.destroy_node()

    # ---- tasks

    def goToPose(self, pose: PoseStamped, behavior_tree: str = "") -> bool:  # noqa: N802
        """Drives to a pose."""
        position = pose.pose.position
        goal = NavigateToPose.Goal(pose=pose, behavior_tree=behavior_tree)
        what = f"Goal to {position.x} {position.y}"
        self.info(f"Navigating to goal: {position.x} {position.y}...")
        return self._start("nav_to_pose_client", "NavigateToPose", goal, what)

    def goThroughPoses(self, poses: list[PoseStamped], behavior_tree: str = "") -> bool:  # noqa: N802
        """Drives through poses without a stop."""
        goal = NavigateThroughPoses.Goal(poses=poses, behavior_tree=behavior_tree)
        self.info(f"Navigating with {len(poses)} goals....")
        return self._start("nav_through_poses_client", "NavigateThroughPoses", goal, f"Goal with {len(poses)} poses")

    def followWaypoints(self, poses: list[PoseStamped]) -> bool:  # noqa: N802
        """Drives to waypoints, one after another."""
        goal = FollowWaypoints.Goal(poses=poses)
        self.info(f"Following {len(poses)} goals....")
        return self._start("follow_waypoints_client", "FollowWaypoints", goal, f"Following {len(poses)} waypoints request")

    def followGpsWaypoints(self, gps_poses: list[Any]) -> bool:  # noqa: N802
        """Drives to waypoints given by latitude and longitude."""
        goal = FollowGPSWaypoints.Goal(gps_poses=gps_poses)
        self.info(f"Following {len(gps_poses)} gps goals....")
        what = f"Following {len(gps_poses)} gps waypoints request"
        return self._start("follow_gps_waypoints_client", "FollowGPSWaypoints", goal, what)

    def spin(self, spin_dist: float = 1.57, time_allowance: int = 10) -> bool:
        """Turns on the spot [rad]."""
        goal = Spin.Goal(target_yaw=float(spin_dist), time_allowance=_seconds(time_allowance))
        self.info(f"Spinning to angle {spin_dist}....")
        return self._start("spin_client", "Spin", goal, "Spin request")

    def backup(self, backup_dist: float = 0.15, backup_speed: float = 0.025, time_allowance: int = 10) -> bool:
        """Drives back [m, m/s]."""
        goal = BackUp.Goal(
            target=Point(x=float(backup_dist)), speed=float(backup_speed), time_allowance=_seconds(time_allowance)
        )
        self.info(f"Backing up {backup_dist} m at {backup_speed} m/s....")
        return self._start("backup_client", "Backup", goal, "Backup request")

    def driveOnHeading(self, dist: float = 0.15, speed: float = 0.025, time_allowance: int = 10) -> bool:  # noqa: N802
        """Drives straight on [m, m/s]."""
        goal = DriveOnHeading.Goal(target=Point(x=float(dist)), speed=float(speed), time_allowance=_seconds(time_allowance))
        self.info(f"Drive {dist} m on heading at {speed} m/s....")
        return self._start("drive_on_heading_client", "DriveOnHeading", goal, "Drive On Heading request")

    def assistedTeleop(self, time_allowance: int = 30) -> bool:  # noqa: N802
        """Lets a person drive, with collision avoidance."""
        goal = AssistedTeleop.Goal(time_allowance=_seconds(time_allowance))
        self.info("Running 'assisted_teleop'....")
        return self._start("assisted_teleop_client", "assisted_teleop", goal, "Assisted Teleop request")

    def followPath(self, path: Any, controller_id: str = "", goal_checker_id: str = "") -> bool:  # noqa: N802
        """Drives along a path."""
        goal = FollowPath.Goal(path=path, controller_id=controller_id, goal_checker_id=goal_checker_id)
        self.info("Executing path...")
        return self._start("follow_path_client", "FollowPath", goal, "FollowPath goal")

    def dockRobotByPose(self, dock_pose: PoseStamped, dock_type: str, nav_to_dock: bool = True) -> bool:  # noqa: N802
        """Docks at a pose."""
        goal = DockRobot.Goal(
            use_dock_id=False, dock_pose=dock_pose, dock_type=dock_type, navigate_to_staging_pose=nav_to_dock
        )
        self.info(f"Docking at pose: {dock_pose}...")
        return self._start("docking_client", "DockRobot", goal, "Docking request")

    def dockRobotByID(self, dock_id: str, nav_to_dock: bool = True) -> bool:  # noqa: N802
        """Docks at a dock of this name."""
        goal = DockRobot.Goal(use_dock_id=True, dock_id=dock_id, navigate_to_staging_pose=nav_to_dock)
        self.info(f"Docking at dock ID: {dock_id}...")
        return self._start("docking_client", "DockRobot", goal, "Docking request")

    def undockRobot(self, dock_type: str = "") -> bool:  # noqa: N802
        """Leaves the dock."""
        self.info(f"Undocking from dock of type: {dock_type}...")
        return self._start("undocking_client", "UndockRobot", UndockRobot.Goal(dock_type=dock_type), "Undocking request")

    def cancelTask(self) -> None:  # noqa: N802
        """Asks to cancel the task."""
        self.info("Canceling current task.")
        if self.result_future:
            rclpy.spin_until_future_complete(self, self.goal_handle.cancel_goal_async())

    def isTaskComplete(self) -> bool:  # noqa: N802
        """True if there is no task or it has ended; waits up to 0.1 s for that."""
        if not self.result_future:
            return True
        rclpy.spin_until_future_complete(self, self.result_future, timeout_sec=0.10)
        outcome = self.result_future.result()
        if not outcome:
            return False
        self.status = outcome.status
        if self.status == GoalStatus.STATUS_SUCCEEDED:
            self.debug("Task succeeded!")
        else:
            self.debug(f"Task failed with status code: {self.status}")
        return True

    def getFeedback(self) -> Any:  # noqa: N802
        """Last feedback of the task, or None."""
        return self.feedback

    def getResult(self) -> TaskResult:  # noqa: N802
        """Outcome of the task that has ended."""
        return _RESULTS.get(self.status, TaskResult.UNKNOWN)

    # ---- paths

    def getPath(self, start: PoseStamped, goal: PoseStamped, planner_id: str = "", use_start: bool = False) -> Any:  # noqa: N802
        """Path to a pose, or None."""
        return self._path(self._getPathImpl(start, goal, planner_id, use_start), "Getting path")

    def _getPathImpl(self, start: PoseStamped, goal: PoseStamped, planner_id: str = "", use_start: bool = False) -> Any:  # noqa: N802
        asked = ComputePathToPose.Goal(start=start, goal=goal, planner_id=planner_id, use_start=use_start)
        return self._call_action("compute_path_to_pose_client", "ComputePathToPose", asked, "Get path")

    def getPathThroughPoses(  # noqa: N802
        self, start: PoseStamped, goals: list[PoseStamped], planner_id: str = "", use_start: bool = False
    ) -> Any:
        """Path through poses, or None."""
        return self._path(self._getPathThroughPosesImpl(start, goals, planner_id, use_start), "Getting path")

    def _getPathThroughPosesImpl(  # noqa: N802
        self, start: PoseStamped, goals: list[PoseStamped], planner_id: str = "", use_start: bool = False
    ) -> Any:
        asked = ComputePathThroughPoses.Goal(start=start, goals=goals, planner_id=planner_id, use_start=use_start)
        return self._call_action("compute_path_through_poses_client", "ComputePathThroughPoses", asked, "Get path")

    def smoothPath(  # noqa: N802
        self, path: Any, smoother_id: str = "", max_duration: float = 2.0, check_for_collision: bool = False
    ) -> Any:
        """Smoothed path, or None."""
        return self._path(self._smoothPathImpl(path, smoother_id, max_duration, check_for_collision), "Smoothing path")

    def _smoothPathImpl(  # noqa: N802
        self, path: Any, smoother_id: str = "", max_duration: float = 2.0, check_for_collision: bool = False
    ) -> Any:
        asked = SmoothPath.Goal(
            path=path,
            smoother_id=smoother_id,
            max_smoothing_duration=rclpy.duration.Duration(seconds=max_duration).to_msg(),
            check_for_collisions=check_for_collision,
        )
        return self._call_action("smoother_client", "SmoothPath", asked, "Smooth path")

    def _path(self, outcome: Any, what: str) -> Any:
        if outcome is None or self.status != GoalStatus.STATUS_SUCCEEDED:
            self.warn(f"{what} failed with status code: {self.status}")
            return None
        return outcome.path

    # ---- maps and costmaps

    def changeMap(self, map_filepath: str) -> bool:  # noqa: N802
        """Lets the map server load another map."""
        answer = self._call("change_maps_srv", "change map", LoadMap.Request(map_url=map_filepath))
        done = answer is not None and answer.result == LoadMap.Response.RESULT_SUCCESS
        (self.info if done else self.error)(f"Change map request {'was successful' if done else 'failed'}!")
        return done

    def clearAllCostmaps(self) -> None:  # noqa: N802
        """Clears both costmaps."""
        self.clearLocalCostmap()
        self.clearGlobalCostmap()

    def clearLocalCostmap(self) -> None:  # noqa: N802
        """Clears the local costmap."""
        self._call("clear_costmap_local_srv", "Clear local costmaps", ClearEntireCostmap.Request())

    def clearGlobalCostmap(self) -> None:  # noqa: N802
        """Clears the global costmap."""
        self._call("clear_costmap_global_srv", "Clear global costmaps", ClearEntireCostmap.Request())

    def clearCostmapExceptRegion(self, reset_distance: float) -> None:  # noqa: N802
        """Clears the local costmap outside of a square around the robot [m]."""
        request = ClearCostmapExceptRegion.Request(reset_distance=reset_distance)
        self._call("clear_costmap_except_region_srv", "ClearCostmapExceptRegion", request)

    def clearCostmapAroundRobot(self, reset_distance: float) -> None:  # noqa: N802
        """Clears the local costmap around the robot [m]."""
        request = ClearCostmapAroundRobot.Request(reset_distance=reset_distance)
        self._call("clear_costmap_around_robot_srv", "ClearCostmapAroundRobot", request)

    def clearCostmapAroundPose(self, pose: PoseStamped, reset_distance: float) -> None:  # noqa: N802
        """Clears the local costmap around a pose [m]."""
        request = ClearCostmapAroundPose.Request(pose=pose, reset_distance=reset_distance)
        self._call("clear_costmap_around_pose_srv", "ClearCostmapAroundPose", request)

    def getGlobalCostmap(self) -> Any:  # noqa: N802
        """Global costmap."""
        answer = self._call("get_costmap_global_srv", "Get global costmaps", GetCostmap.Request())
        return None if answer is None else answer.map

    def getLocalCostmap(self) -> Any:  # noqa: N802
        """Local costmap."""
        answer = self._call("get_costmap_local_srv", "Get local costmaps", GetCostmap.Request())
        return None if answer is None else answer.map

    # ---- start and end

    def setInitialPose(self, initial_pose: PoseStamped) -> None:  # noqa: N802
        """Sets the pose at which localization begins."""
        self.initial_pose_received = False
        self.initial_pose = initial_pose
        self._setInitialPose()

    def _setInitialPose(self) -> None:  # noqa: N802
        message = PoseWithCovarianceStamped()
        message.pose.pose = self.initial_pose.pose
        message.header.frame_id = self.initial_pose.header.frame_id
        message.header.stamp = self.initial_pose.header.stamp
        self.info("Publishing Initial Pose")
        self.initial_pose_pub.publish(message)

    def waitUntilNav2Active(self, navigator: str = "bt_navigator", localizer: str = "amcl") -> None:  # noqa: N802
        """Waits until localization and navigation are active; sets the initial pose for amcl."""
        if localizer != "robot_localization":
            self._waitForNodeToActivate(localizer)
        if localizer == "amcl":
            self._waitForInitialPose()
        self._waitForNodeToActivate(navigator)
        self.info("Nav2 is ready for use!")

    def _waitForNodeToActivate(self, node_name: str) -> None:  # noqa: N802
        self.debug(f"Waiting for {node_name} to become active..")
        client = self.create_client(GetState, f"{node_name}/get_state")
        self._wait_for(client.wait_for_service, f"{node_name}/get_state service")
        while True:
            answer = self._answer(client, GetState.Request())
            if answer is not None:
                self.debug(f"Result of get_state: {answer.current_state.label}")
                if answer.current_state.label == "active":
                    return
            _waiting.sleep_ns(None, _STATE_POLL_NS)

    def _waitForInitialPose(self) -> None:  # noqa: N802
        while not self.initial_pose_received:
            self.info("Setting initial pose")
            self._setInitialPose()
            self.info("Waiting for amcl_pose to be received")
            rclpy.spin_once(self, timeout_sec=1.0)

    def lifecycleStartup(self) -> None:  # noqa: N802
        """Starts the nodes of all lifecycle managers."""
        self.info("Starting up lifecycle nodes based on lifecycle_manager.")
        self._manage(ManageLifecycleNodes.Request.STARTUP, "Starting up")
        self.info("Nav2 is ready for use!")

    def lifecycleShutdown(self) -> None:  # noqa: N802
        """Ends the nodes of all lifecycle managers."""
        self.info("Shutting down lifecycle nodes based on lifecycle_manager.")
        self._manage(ManageLifecycleNodes.Request.SHUTDOWN, "Shutting down")

    def _manage(self, command: int, what: str) -> None:
        for name, types in self.get_service_names_and_types():
            if types[0] != "nav2_msgs/srv/ManageLifecycleNodes":
                continue
            self.info(f"{what} {name}")
            client = self.create_client(ManageLifecycleNodes, name)
            self._wait_for(client.wait_for_service, f"{name} service")
            future = client.call_async(ManageLifecycleNodes.Request(command=command))
            while not future.done():
                rclpy.spin_until_future_complete(self, future, timeout_sec=0.10)
                # Localization becomes active only once it has a pose.
                if not future.done() and command == ManageLifecycleNodes.Request.STARTUP and not self.initial_pose_received:
                    self._setInitialPose()

    # ---- callbacks

    def _on_pose(self, msg: Any) -> None:
        self.debug("Received amcl pose")
        self.initial_pose_received = True


def _seconds(duration: float) -> Duration:
    seconds = int(duration)
    return Duration(sec=seconds, nanosec=int((duration - seconds) * 1e9))
