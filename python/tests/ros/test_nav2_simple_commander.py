"""Goals to Nav2 from Python, against a stand-in for Nav2."""

import threading
import time

import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

import rclpy  # noqa: E402
from geometry_msgs.msg import Point32, Polygon, PoseStamped, PoseWithCovarianceStamped  # noqa: E402
from lifecycle_msgs.srv import GetState  # noqa: E402
from nav2_msgs.action import ComputePathToPose, NavigateToPose  # noqa: E402
from nav2_simple_commander.costmap_2d import PyCostmap2D  # noqa: E402
from nav2_simple_commander.footprint_collision_checker import LETHAL_OBSTACLE, FootprintCollisionChecker  # noqa: E402
from nav2_simple_commander.line_iterator import LineIterator  # noqa: E402
from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult  # noqa: E402
from nav_msgs.msg import OccupancyGrid  # noqa: E402
from rclpy.action import ActionServer, CancelResponse, GoalResponse  # noqa: E402
from rclpy.callback_groups import ReentrantCallbackGroup  # noqa: E402
from rclpy.executors import MultiThreadedExecutor  # noqa: E402
from rclpy.qos import DurabilityPolicy, QoSProfile  # noqa: E402


@pytest.fixture
def navigator(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "126")
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    rclpy.init(args=[])
    server = rclpy.create_node("nav2")
    group = ReentrantCallbackGroup()

    def drive(handle):
        for index in range(100 if handle.request.behavior_tree == "long" else 2):
            if handle.is_cancel_requested:
                handle.canceled()
                return NavigateToPose.Result()
            handle.publish_feedback(NavigateToPose.Feedback(distance_remaining=float(10 - index)))
            time.sleep(0.05)
        handle.succeed()
        return NavigateToPose.Result()

    def plan(handle):
        handle.succeed()
        result = ComputePathToPose.Result()
        result.path.poses = [handle.request.start, handle.request.goal]
        return result

    ActionServer(
        server, NavigateToPose, "navigate_to_pose", drive, callback_group=group,
        goal_callback=lambda goal: GoalResponse.REJECT if goal.behavior_tree == "no" else GoalResponse.ACCEPT,
        cancel_callback=lambda handle: CancelResponse.ACCEPT,
    )  # fmt: skip
    ActionServer(server, ComputePathToPose, "compute_path_to_pose", plan, callback_group=group)

    def active(request, response):
        response.current_state.label = "active"
        return response

    for name in ("amcl", "bt_navigator"):
        server.create_service(GetState, f"{name}/get_state", active)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    pose = server.create_publisher(PoseWithCovarianceStamped, "amcl_pose", latched)
    server.create_subscription(PoseWithCovarianceStamped, "initialpose", pose.publish, 10)
    executor = MultiThreadedExecutor(4)
    executor.add_node(server)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    yield BasicNavigator()
    rclpy.shutdown()
    thread.join()


def test_tasks(navigator: BasicNavigator) -> None:
    navigator.setInitialPose(PoseStamped())
    navigator.waitUntilNav2Active()
    assert navigator.goToPose(PoseStamped())
    while not navigator.isTaskComplete():
        pass
    assert navigator.getResult() == TaskResult.SUCCEEDED
    assert navigator.getFeedback().distance_remaining == 9.0
    assert not navigator.goToPose(PoseStamped(), behavior_tree="no")
    assert navigator.goToPose(PoseStamped(), behavior_tree="long")
    navigator.cancelTask()
    while not navigator.isTaskComplete():
        pass
    assert navigator.getResult() == TaskResult.CANCELED
    assert len(navigator.getPath(PoseStamped(), PoseStamped()).poses) == 2


def costmap() -> PyCostmap2D:
    grid = OccupancyGrid()
    grid.info.width, grid.info.height, grid.info.resolution = 4, 3, 0.5
    grid.info.origin.position.x = -1.0
    grid.data = [0] * 11 + [-1]
    return PyCostmap2D(grid)


def test_costmap_cells() -> None:
    made = costmap()
    assert made.worldToMapValidated(0.6, 0.6) == (3, 1)
    assert made.worldToMapValidated(5.0, 0.0) == (None, None)
    assert made.mapToWorld(0, 0) == (-0.75, 0.25)
    assert made.getCostXY(3, 2) == 255
    made.setCost(1, 1, 254)
    assert made.getCostIdx(5) == 254


def test_footprint_hits_a_lethal_cell() -> None:
    made = costmap()
    checker = FootprintCollisionChecker()
    with pytest.raises(ValueError, match="Costmap not specified"):
        checker.pointCost(0, 0)
    checker.setCostmap(made)
    square = Polygon(points=[Point32(x=x, y=y) for x, y in ((-0.4, -0.4), (0.4, -0.4), (0.4, 0.4), (-0.4, 0.4))])
    assert checker.footprintCostAtPose(-0.5, 0.5, 0.0, square) == 0.0
    assert checker.footprintCostAtPose(9.0, 0.5, 0.0, square) == LETHAL_OBSTACLE
    made.setCost(1, 1, LETHAL_OBSTACLE)
    assert checker.footprintCostAtPose(-0.5, 0.5, 0.0, square) == LETHAL_OBSTACLE


@pytest.mark.parametrize(
    ("ends", "points"),
    [
        ((0, 0, 2, 2), [(0, 0), (1, 1), (2, 2)]),
        ((2, 0, 0, 1), [(2, 0), (1, 0.5), (0, 1)]),
        ((1, 3, 1, 1), [(1, 3), (1, 2), (1, 1)]),
    ],
)
def test_points_of_a_line(ends: tuple[int, int, int, int], points: list[tuple[float, float]]) -> None:
    line = LineIterator(*ends)
    found = []
    while line.isValid():
        found.append((line.getX(), line.getY()))
        line.advance()
    assert found == points
