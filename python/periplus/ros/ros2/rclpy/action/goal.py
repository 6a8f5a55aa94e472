"""Goals as the server sees them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._clock_source import look, source
from rclpy._rclpy_pybind11 import RCLError
from rclpy.action._names import (
    ABORTED,
    ACCEPTED,
    ACTIVE,
    CANCELED,
    CANCELING,
    EXECUTING,
    SUCCEEDED,
    UNKNOWN,
    key_of,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.action.server import ActionServer

_NAMES = ("UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED")

# State after an event, by the event and the state before it.
_TRANSITIONS = {
    ("EXECUTE", ACCEPTED): EXECUTING,
    ("CANCEL_GOAL", ACCEPTED): CANCELING,
    ("CANCEL_GOAL", EXECUTING): CANCELING,
    ("SUCCEED", EXECUTING): SUCCEEDED,
    ("SUCCEED", CANCELING): SUCCEEDED,
    ("ABORT", EXECUTING): ABORTED,
    ("ABORT", CANCELING): ABORTED,
    ("CANCELED", CANCELING): CANCELED,
}


class ServerGoalHandle:
    """Goal that a server has accepted."""

    def __init__(self, action_server: ActionServer, goal_info: Any, goal_request: Any) -> None:
        self._action_server = action_server
        self._goal_info = goal_info
        self._goal_request = goal_request
        self._status = ACCEPTED
        #: Steady time [ns] at which the result is forgotten, once the goal has ended.
        self._expires_ns: int | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServerGoalHandle) and self.goal_id == other.goal_id

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(key_of(self.goal_id))

    @property
    def request(self) -> Any:
        """The goal message."""
        return self._goal_request

    @property
    def goal_id(self) -> Any:
        """Identifier of the goal."""
        return self._goal_info.goal_id

    @property
    def status(self) -> int:
        """State of the goal, as in `action_msgs.msg.GoalStatus`."""
        return self._status

    @property
    def is_active(self) -> bool:
        """True until the goal has ended."""
        return self._status in ACTIVE

    @property
    def is_cancel_requested(self) -> bool:
        """True once a request to cancel the goal was accepted."""
        if source.lockstep_graph is not None:
            look()
        return self._status == CANCELING

    def _update(self, event: str) -> None:
        status = _TRANSITIONS.get((event, self._status))
        if status is None:
            raise RCLError(
                "Failed to update goal state: goal_handle attempted invalid transition "
                f"from state {_NAMES[self._status]} with event {event}"
            )
        self._status = status

    def execute(self, execute_callback: Callable[[Any], Any] | None = None) -> None:
        """Starts the goal, with the server's callback or another one."""
        if self._status != CANCELING:
            self._update("EXECUTE")
        self._action_server.notify_execute(self, execute_callback)

    def publish_feedback(self, feedback: Any) -> None:
        """Publishes a feedback message. Raises `TypeError` for another type."""
        action_type = self._action_server.action_type
        if not isinstance(feedback, action_type.Feedback):
            raise TypeError(f"Expected {action_type.Feedback}, got {type(feedback)}")
        if self._status == UNKNOWN:
            return
        self._action_server._publish_feedback(
            action_type.Impl.FeedbackMessage(goal_id=self.goal_id, feedback=feedback)
        )

    def succeed(self) -> None:
        """Ends the goal with success. Raises `RCLError` if it has ended or was not started."""
        self._end("SUCCEED")

    def abort(self) -> None:
        """Ends the goal with a failure. Raises `RCLError` if it has ended or was not started."""
        self._end("ABORT")

    def canceled(self) -> None:
        """Ends the goal as canceled. Raises `RCLError` unless `is_cancel_requested`."""
        self._end("CANCELED")

    def _end(self, event: str) -> None:
        self._update(event)
        self._action_server.notify_goal_done()

    def destroy(self) -> None:
        """Forgets the goal."""
        self._action_server._forget(self)
