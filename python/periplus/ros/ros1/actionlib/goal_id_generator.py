"""Ids of goals."""

from __future__ import annotations

import itertools
from typing import Any

import rospy
from actionlib_msgs.msg import GoalID

_count = itertools.count(1)


class GoalIDGenerator:
    """Makes ids that no other goal has: name of the node, number, time."""

    def __init__(self, name: str | None = None) -> None:
        self.name = name or rospy.get_name()

    def set_name(self, name: str) -> None:
        self.name = name

    def generate_ID(self) -> Any:  # noqa: N802
        """A new id with the stamp of now."""
        now = rospy.Time.now()
        return GoalID(now, f"{self.name}-{next(_count)}-{now.secs}.{now.nsecs:09d}")
