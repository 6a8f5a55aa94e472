"""A goal as the server knows it."""

from __future__ import annotations

from typing import Any

import rospy
from actionlib_msgs.msg import GoalStatus

from actionlib.goal_id_generator import GoalIDGenerator


class StatusTracker:
    """Goal and status; without a goal, a cancellation that came before its goal."""

    def __init__(self, goal_id: Any = None, status: int | None = None, goal: Any = None) -> None:
        self.goal = goal
        self.handle_tracker = None
        self.handle_destruction_time = rospy.Time()
        self.id_generator = GoalIDGenerator()
        self.status = GoalStatus()
        if goal is not None:
            self.status.goal_id = goal.goal_id
            self.status.status = GoalStatus.PENDING
            if not self.status.goal_id.id:
                self.status.goal_id = self.id_generator.generate_ID()
            if self.status.goal_id.stamp.is_zero():
                self.status.goal_id.stamp = rospy.Time.now()
        else:
            self.status.goal_id = goal_id
            self.status.status = status
