"""Server of an action with one goal at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import rospy
from actionlib_msgs.msg import GoalStatus
from periplus.ros import _waiting
from rospy import _dispatch, core

from actionlib.action_server import ActionServer
from actionlib.server_goal_handle import ServerGoalHandle

_OTHER_GOAL = "This goal was canceled because another goal was received by the simple action server"


class SimpleActionServer:
    """Works on one goal; a new one preempts it.

    Args:
        name: Name of the action.
        ActionSpec: Action class, such as `FibonacciAction`.
        execute_cb: Function of the goal, which runs in a thread of its own and ends with `set_succeeded()`,
            `set_aborted()` or `set_preempted()`.
        auto_start: Starts at once (default True); with False, `start()` does.
    """

    def __init__(
        self,
        name: str,
        ActionSpec: Any,  # noqa: N803
        execute_cb: Callable[[Any], Any] | None = None,
        auto_start: bool = True,
    ) -> None:
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.need_to_terminate = False
        self.terminate_mutex = threading.RLock()
        self.lock = threading.RLock()
        self.execute_callback = execute_cb
        self.goal_callback: Callable[[], Any] | None = None
        self.preempt_callback: Callable[[], Any] | None = None
        self.current_goal = ServerGoalHandle()
        self.next_goal = ServerGoalHandle()
        self.execute_thread: threading.Thread | None = None
        self._name = rospy.resolve_name(name)
        self.action_server = ActionServer(
            name, ActionSpec, self.internal_goal_callback, self.internal_preempt_callback, False
        )
        if execute_cb is not None:
            self.execute_thread = _waiting.start_thread(self.executeLoop, f"action {name}")
        if auto_start:
            rospy.logwarn(
                "You've passed in true for auto_start for the python action server, you should always pass "
                "in false to avoid race conditions."
            )
            self.action_server.start()

    def start(self) -> None:
        """Begins to receive goals."""
        self.action_server.start()

    def stop(self) -> None:
        """Ends the server."""
        self.need_to_terminate = True
        core.state.graph.wake()
        if self.action_server.started:
            self.action_server.stop()

    # ---- goals

    def accept_new_goal(self) -> Any:
        """Takes the next goal and returns it; the current one ends as preempted."""
        with self.action_server.lock, self.lock:
            if not self.new_goal or self.next_goal.get_goal() is None:
                rospy.logerr("Attempting to accept the next goal when a new goal is not available")
                return None
            if self.is_active() and self.current_goal.get_goal() is not None and self.current_goal != self.next_goal:
                self.current_goal.set_canceled(None, _OTHER_GOAL)
            self.current_goal = self.next_goal
            self.new_goal = False
            self.preempt_request = self.new_goal_preempt_request
            self.new_goal_preempt_request = False
            self.current_goal.set_accepted("This goal has been accepted by the simple action server")
            return self.current_goal.get_goal()

    def is_new_goal_available(self) -> bool:
        """True if a goal waits to be accepted."""
        _waiting.poll()
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """True if the current goal is to end."""
        _waiting.poll()
        return self.preempt_request

    def is_active(self) -> bool:
        """True while a goal is worked on."""
        _waiting.poll()
        if self.current_goal.get_goal() is None:
            return False
        status = self.current_goal.get_goal_status().status
        return status in (GoalStatus.ACTIVE, GoalStatus.PREEMPTING)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """Ends the goal with success."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_succeeded(result or self.get_default_result(), text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """Ends the goal without success."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_aborted(result or self.get_default_result(), text)

    def set_preempted(self, result: Any = None, text: str = "") -> None:
        """Ends the goal as cancelled, or replaced by another."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_canceled(result or self.get_default_result(), text)

    def publish_feedback(self, feedback: Any) -> None:
        """Publishes feedback on the current goal."""
        self.current_goal.publish_feedback(feedback)

    def get_default_result(self) -> Any:
        """A result with the default values."""
        return self.action_server.ActionResultType()

    def register_goal_callback(self, cb: Callable[[], Any]) -> None:
        """Registers a function that is called when there is a new goal; not together with `execute_cb`."""
        if self.execute_callback is not None:
            rospy.logwarn("Cannot call SimpleActionServer.register_goal_callback() because an executeCallback exists")
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], Any]) -> None:
        """Registers a function that is called when the current goal is to end."""
        self.preempt_callback = cb

    # ---- callbacks

    def internal_goal_callback(self, goal: Any) -> None:
        with self.action_server.lock, self.lock:
            current = self.current_goal.get_goal()
            following = self.next_goal.get_goal()
            stamp = goal.get_goal_id().stamp
            is_newest = (current is None or stamp >= self.current_goal.get_goal_id().stamp) and (
                following is None or stamp >= self.next_goal.get_goal_id().stamp
            )
            if not is_newest:
                goal.set_canceled(None, _OTHER_GOAL)
                return
            if following is not None and (current is None or self.next_goal != self.current_goal):
                if self.new_goal:
                    self.next_goal.set_canceled(None, _OTHER_GOAL)
            self.next_goal = goal
            self.new_goal = True
            self.new_goal_preempt_request = False
            if self.is_active():
                self.preempt_request = True
                if self.preempt_callback is not None:
                    self.preempt_callback()
            if self.goal_callback is not None:
                self.goal_callback()
        core.state.graph.wake()

    def internal_preempt_callback(self, preempt: Any) -> None:
        with self.action_server.lock, self.lock:
            if preempt == self.current_goal:
                self.preempt_request = True
                if self.preempt_callback is not None:
                    self.preempt_callback()
            else:
                self.new_goal_preempt_request = True
        core.state.graph.wake()

    def executeLoop(self) -> None:  # noqa: N802
        """Works on the goals, one after another."""
        try:
            while not rospy.is_shutdown() and not self.need_to_terminate:
                core.wait_events(lambda: self.new_goal and not self.is_active() or self.need_to_terminate)
                if not self.need_to_terminate:
                    self._execute()
        except rospy.ROSInterruptException:
            return

    def _execute(self) -> None:
        goal = self.accept_new_goal()
        if goal is None or self.execute_callback is None:
            return
        try:
            self.execute_callback(goal)
            if self.is_active() and not core.is_shutdown_requested():
                rospy.logwarn(
                    "Your executeCallback did not set the goal to a terminal status. "
                    "This is a bug in your ActionServer implementation. Fix your code! "
                    "For now, the ActionServer will set this goal to aborted"
                )
                self.set_aborted(None, "No terminal state was set.")
        except rospy.ROSInterruptException:
            if not core.is_shutdown_requested():
                raise
        except Exception as error:
            rospy.logerr("Exception in your execute callback: %s", error)
            _dispatch.print_fault(error, "action", self._name)
            if self.is_active():
                self.set_aborted(None, f"Exception in execute callback: {error}")
