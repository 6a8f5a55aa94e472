"""Client of an action with one goal at a time."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import rospy
from actionlib_msgs.msg import GoalStatus
from periplus.ros import _waiting
from rospy import core

from actionlib.action_client import ActionClient, ClientGoalHandle, CommState, _wait


class SimpleGoalState:
    """States of the goal of a simple client."""

    PENDING = 0
    ACTIVE = 1
    DONE = 2

    @staticmethod
    def to_string(value: int) -> str:
        return ("PENDING", "ACTIVE", "DONE")[value]


class SimpleActionClient:
    """Sends goals, one at a time.

    Args:
        ns: Name of the action.
        ActionSpec: Action class, such as `FibonacciAction`.
    """

    def __init__(self, ns: str, ActionSpec: Any) -> None:  # noqa: N803
        self.action_client = ActionClient(ns, ActionSpec)
        self.simple_state = SimpleGoalState.DONE
        self.gh: Any = None
        self.done_cb: Callable[..., Any] | None = None
        self.active_cb: Callable[[], Any] | None = None
        self.feedback_cb: Callable[[Any], Any] | None = None

    def wait_for_server(self, timeout: Any = None) -> bool:
        """Waits until the server is there; False at the timeout (`Duration`, zero for none)."""
        return self.action_client.wait_for_server(timeout)

    def send_goal(
        self,
        goal: Any,
        done_cb: Callable[..., Any] | None = None,
        active_cb: Callable[[], Any] | None = None,
        feedback_cb: Callable[[Any], Any] | None = None,
    ) -> None:
        """Sends a goal; the one before is no longer tracked.

        Args:
            goal: Goal message.
            done_cb: Function of the final status and the result.
            active_cb: Function without arguments, called when the server begins.
            feedback_cb: Function of the feedback.
        """
        self.stop_tracking_goal()
        self.done_cb = done_cb
        self.active_cb = active_cb
        self.feedback_cb = feedback_cb
        self.simple_state = SimpleGoalState.PENDING
        self.gh = self.action_client.send_goal(goal, self._handle_transition, self._handle_feedback)

    def send_goal_and_wait(self, goal: Any, execute_timeout: Any = None, preempt_timeout: Any = None) -> int:
        """Sends a goal and waits for its end; cancels it at the timeout. Returns the final status."""
        self.send_goal(goal)
        if not self.wait_for_result(execute_timeout):
            rospy.logdebug("Canceling goal")
            self.cancel_goal()
            if self.wait_for_result(preempt_timeout):
                rospy.logdebug("Preempt finished within specified preempt_timeout")
            else:
                rospy.logdebug("Preempt didn't finish specified preempt_timeout")
        return self.get_state()

    def wait_for_result(self, timeout: Any = None) -> bool:
        """Waits for the end of the goal; False at the timeout (`Duration`, zero for none)."""
        if not self.gh:
            rospy.logerr("Called wait_for_result when no goal exists")
            return False
        return _wait(lambda: self.simple_state == SimpleGoalState.DONE, timeout)

    def get_result(self) -> Any:
        """Result of the goal, or None."""
        if not self.gh:
            rospy.logerr("Called get_result when no goal is running")
            return None
        return self.gh.get_result()

    def get_state(self) -> int:
        """Status of the goal, of `GoalStatus`; LOST without a goal."""
        _waiting.poll()
        if not self.gh:
            return int(GoalStatus.LOST)
        status = self.gh.get_goal_status()
        if status == GoalStatus.RECALLING:
            return int(GoalStatus.PENDING)
        if status == GoalStatus.PREEMPTING:
            return int(GoalStatus.ACTIVE)
        return int(status)

    def get_goal_status_text(self) -> str:
        """Text of the server on the goal."""
        if not self.gh:
            rospy.logerr("Called get_goal_status_text when no goal is running")
            return "ERROR: Called get_goal_status_text when no goal is running"
        return str(self.gh.get_goal_status_text())

    def cancel_all_goals(self) -> None:
        """Cancels all goals of the server."""
        self.action_client.cancel_all_goals()

    def cancel_goals_at_and_before_time(self, time: Any) -> None:
        """Cancels all goals of the server up to a time."""
        self.action_client.cancel_goals_at_and_before_time(time)

    def cancel_goal(self) -> None:
        """Cancels the goal."""
        if self.gh:
            self.gh.cancel()

    def stop_tracking_goal(self) -> None:
        """Stops hearing of the goal, which goes on."""
        self.gh = None

    def _handle_transition(self, gh: ClientGoalHandle) -> None:
        if self.gh is not None and gh != self.gh:
            return
        state = gh.get_comm_state()
        if state == CommState.ACTIVE and self.simple_state == SimpleGoalState.PENDING:
            self.simple_state = SimpleGoalState.ACTIVE
            if self.active_cb is not None:
                self.active_cb()
        elif state == CommState.DONE and self.simple_state != SimpleGoalState.DONE:
            self.simple_state = SimpleGoalState.DONE
            try:
                if self.done_cb is not None:
                    self.done_cb(gh.get_goal_status(), gh.get_result())
            finally:
                core.state.graph.wake()

    def _handle_feedback(self, gh: ClientGoalHandle, feedback: Any) -> None:
        if self.gh is not None and gh == self.gh and self.feedback_cb is not None:
            self.feedback_cb(feedback)
