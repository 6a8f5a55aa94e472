"""End of the tracking of goals."""

from __future__ import annotations

from typing import Any

import rospy


class HandleTrackerDeleter:
    """Marks the time at which a goal was last used."""

    def __init__(self, action_server: Any, status_tracker: Any) -> None:
        self.action_server = action_server
        self.status_tracker = status_tracker

    def __call__(self, ptr: Any) -> None:
        if self.action_server:
            self.status_tracker.handle_destruction_time = rospy.Time.now()
