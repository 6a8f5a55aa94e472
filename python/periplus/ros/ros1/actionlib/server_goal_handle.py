"""Goals of a server."""

from __future__ import annotations

from typing import Any

import rospy
from actionlib_msgs.msg import GoalID, GoalStatus

_S = GoalStatus
_NAMES = {
    getattr(_S, name): name
    for name in "PENDING ACTIVE PREEMPTED SUCCEEDED ABORTED REJECTED PREEMPTING RECALLING RECALLED LOST".split()
}


class ServerGoalHandle:
    """One goal: its state and the words that change it."""

    def __init__(self, status_tracker: Any = None, action_server: Any = None, handle_tracker: Any = None) -> None:
        self.status_tracker = status_tracker
        self.action_server = action_server
        self.handle_tracker = handle_tracker
        self.goal = status_tracker.goal if status_tracker is not None else None

    def _change(self, word: str, states: dict[int, int], text: str, result: Any = None, is_end: bool = False) -> bool:
        if self.goal is None:
            rospy.logerr("Attempt to set status on an uninitialized ServerGoalHandle")
            return False
        with self.action_server.lock:
            status = self.status_tracker.status
            if status.status not in states:
                rospy.logerr(
                    "To transition to %s, the goal must be in a %s state, it is currently in state: %s",
                    word,
                    " or ".join(_NAMES[one].lower() for one in states),
                    _NAMES.get(status.status, status.status),
                )
                return False
            status.status = states[status.status]
            status.text = text
            if is_end:
                self.action_server.publish_result(status, result)
                self.status_tracker.handle_destruction_time = rospy.Time.now()
            else:
                self.action_server.publish_status()
        return True

    def set_accepted(self, text: str = "") -> bool:
        """The goal becomes active."""
        states = {_S.PENDING: _S.ACTIVE, _S.RECALLING: _S.PREEMPTING}
        return self._change("an active state", states, text)

    def set_canceled(self, result: Any = None, text: str = "") -> bool:
        """The goal ends as preempted, or recalled if it never was active."""
        states = {
            _S.PENDING: _S.RECALLED,
            _S.RECALLING: _S.RECALLED,
            _S.ACTIVE: _S.PREEMPTED,
            _S.PREEMPTING: _S.PREEMPTED,
        }
        return self._change("a cancelled state", states, text, self._result(result), True)

    def set_rejected(self, result: Any = None, text: str = "") -> bool:
        """The goal ends as rejected."""
        states = {_S.PENDING: _S.REJECTED, _S.RECALLING: _S.REJECTED}
        return self._change("a rejected state", states, text, self._result(result), True)

    def set_aborted(self, result: Any = None, text: str = "") -> bool:
        """The goal ends as aborted."""
        states = {_S.ACTIVE: _S.ABORTED, _S.PREEMPTING: _S.ABORTED}
        return self._change("an aborted state", states, text, self._result(result), True)

    def set_succeeded(self, result: Any = None, text: str = "") -> bool:
        """The goal ends as succeeded."""
        states = {_S.ACTIVE: _S.SUCCEEDED, _S.PREEMPTING: _S.SUCCEEDED}
        return self._change("a succeeded state", states, text, self._result(result), True)

    def set_cancel_requested(self) -> bool:
        """Notes that a client wants to cancel; False if it is too late."""
        if self.goal is None:
            return False
        with self.action_server.lock:
            status = self.status_tracker.status
            if status.status == _S.PENDING:
                status.status = _S.RECALLING
            elif status.status == _S.ACTIVE:
                status.status = _S.PREEMPTING
            else:
                return False
            self.action_server.publish_status()
        return True

    def _result(self, result: Any) -> Any:
        return result if result is not None or self.action_server is None else self.action_server.ActionResultType()

    def publish_feedback(self, feedback: Any) -> None:
        """Publishes feedback on this goal."""
        with self.action_server.lock:
            self.action_server.publish_feedback(self.status_tracker.status, feedback)

    def get_goal(self) -> Any:
        """The goal message, or None."""
        return None if self.goal is None else self.goal.goal

    def get_goal_id(self) -> Any:
        """The id of the goal."""
        return self.status_tracker.status.goal_id if self.goal is not None else GoalID()

    def get_goal_status(self) -> Any:
        """The status of the goal."""
        return self.status_tracker.status if self.goal is not None else GoalStatus()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ServerGoalHandle) or self.goal is None or other.goal is None:
            return isinstance(other, ServerGoalHandle) and self.goal is other.goal
        return bool(self.get_goal_id().id == other.get_goal_id().id)

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self.get_goal_id().id)
