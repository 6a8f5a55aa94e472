"""Drives a robot with a planner and a controller written in Python, and a condition in its behavior tree."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from periplus import Simulation, World
from periplus.navigation import (
    Controller,
    CostmapView,
    Navigation,
    NoValidControl,
    NoValidPath,
    Planner,
    Port,
    Status,
    TreeNode,
)

Pose = tuple[float, float, float]

TREE = """<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
  <ComputePathToPose goal="{goal}" path="{path}"/>
  <IsShort path="{path}" limit="3.0"/>
  <FollowPath path="{path}"/>
</Sequence></BehaviorTree></root>"""


class StraightLine(Planner):
    """Straight to the goal, if no obstacle is on that line."""

    def plan(self, costmap: CostmapView, start: Pose, goal: Pose) -> npt.ArrayLike:
        length = math.dist(start[:2], goal[:2])
        path = np.linspace(start, goal, 1 + math.ceil(length / self.parameters["step"]))
        path[:, 2] = math.atan2(goal[1] - start[1], goal[0] - start[0])
        if (costmap.cost_at(path) >= 253).any():
            raise NoValidPath("an obstacle is on the straight line")
        return path


class Toward(Controller):
    """Turns towards a point of the path ahead, and drives there."""

    def compute(
        self,
        costmap: CostmapView,
        pose: Pose,
        velocity: Pose,
        path: npt.NDArray[np.float64],
        goal: Pose,
    ) -> Pose:
        if costmap.cost_at([pose])[0] >= 253:
            raise NoValidControl("the robot touches an obstacle")
        x, y, _ = path[min(5, len(path) - 1)]
        angle = math.remainder(math.atan2(y - pose[1], x - pose[0]) - pose[2], math.tau)
        return (0.3 if abs(angle) < 0.5 else 0.0, 0.0, max(-1.0, min(1.0, 2.0 * angle)))


class IsShort(TreeNode):
    """Succeeds if a path is shorter than a limit [m]."""

    kind = "condition"
    ports = (Port("path", "nav_msgs/Path"), Port("limit", "double", default="10.0"))

    def tick(self, time_s: float, ports: dict[str, Any]) -> Status:
        points = [(pose.pose.position.x, pose.pose.position.y) for pose in ports["path"].poses]
        length = sum(math.dist(a, b) for a, b in zip(points, points[1:]))
        return Status.SUCCESS if length < ports["limit"] else Status.FAILURE


def main() -> None:
    Path("tree.xml").write_text(TREE)
    sim = Simulation(World.demo(), physics="kinematic")
    navigation = Navigation(
        sim,
        slam=False,
        planners={"my_package/StraightLine": StraightLine},
        controllers={"FollowPath": Toward},
        tree_nodes=[IsShort],
        parameters={
            "planner_server": {"GridBased": {"plugin": "my_package/StraightLine", "step": 0.1}},
            "bt_navigator": {"default_nav_to_pose_bt_xml": str(Path("tree.xml").resolve())},
        },
    )
    outcome = navigation.go_to((1.0, 0.0, 0.0))
    robot = sim.lookup_transform(navigation.frame, "base_link")
    print(f"{outcome.outcome} after {outcome.time_s:.1f} s at ({robot.x:.2f}, {robot.y:.2f})")
    assert outcome.reached and math.dist((robot.x, robot.y), (1.0, 0.0)) < 0.3

    outcome = navigation.go_to((30.0, 0.0, 0.0))
    print(f"{outcome.outcome}: {outcome.message}")
    assert not outcome.reached


if __name__ == "__main__":
    main()
