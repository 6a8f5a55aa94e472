"""Server of an action with any number of goals at a time."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import rospy
from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray

from actionlib.exceptions import ActionException
from actionlib.handle_tracker_deleter import HandleTrackerDeleter
from actionlib.server_goal_handle import ServerGoalHandle
from actionlib.status_tracker import StatusTracker

#: Time for which the status of a goal that has ended is still published (default) [s].
_STATUS_KEPT_S = 5.0


def _nop(goal_handle: Any) -> None:
    """Stands for a callback that was not given."""


class ActionServer:
    """Receives goals and cancellations, publishes status, feedback and results.

    Args:
        ns: Name of the action.
        ActionSpec: Action class, such as `FibonacciAction`.
        goal_cb: Function of the handle of a new goal.
        cancel_cb: Function of the handle of a goal that is to be cancelled.
        auto_start: Starts at once (default True); with False, `start()` does.
    """

    def __init__(
        self,
        ns: str,
        ActionSpec: Any,  # noqa: N803
        goal_cb: Callable[[Any], Any] | None = None,
        cancel_cb: Callable[[Any], Any] = _nop,
        auto_start: bool = True,
    ) -> None:
        self.ns = ns
        try:
            action = ActionSpec()
            self.ActionSpec = ActionSpec
            self.ActionGoal = type(action.action_goal)
            self.ActionResult = type(action.action_result)
            self.ActionResultType = type(action.action_result.result)
            self.ActionFeedback = type(action.action_feedback)
        except AttributeError:
            raise ActionException(f"Type is not an action spec: {ActionSpec}") from None
        self.lock = threading.RLock()
        self.goal_callback = goal_cb
        self.cancel_callback = cancel_cb
        self.auto_start = auto_start
        self.started = False
        self.last_cancel = rospy.Time()
        self.status_list: list[Any] = []
        if auto_start:
            rospy.logwarn(
                "You've passed in true for auto_start for the python action server, you should always pass "
                "in false to avoid race conditions."
            )
            self.start()

    def start(self) -> None:
        """Begins to receive goals."""
        self.started = True
        with self.lock:
            self.initialize()
            self.publish_status()

    def stop(self) -> None:
        """Ends the server."""
        with self.lock:
            self.started = False
            self.status_timer.shutdown()
            for one in (self.goal_sub, self.cancel_sub, self.status_pub, self.result_pub, self.feedback_pub):
                one.unregister()

    def initialize(self) -> None:
        """Makes the topics."""
        size = rospy.get_param("actionlib_server_pub_queue_size", 50)
        size = size if isinstance(size, int) and size >= 0 else 50
        self.status_pub = rospy.Publisher(f"{self.ns}/status", GoalStatusArray, latch=True, queue_size=size)
        self.result_pub = rospy.Publisher(f"{self.ns}/result", self.ActionResult, queue_size=size)
        self.feedback_pub = rospy.Publisher(f"{self.ns}/feedback", self.ActionFeedback, queue_size=size)
        self.goal_sub = rospy.Subscriber(f"{self.ns}/goal", self.ActionGoal, self.internal_goal_callback)
        self.cancel_sub = rospy.Subscriber(f"{self.ns}/cancel", GoalID, self.internal_cancel_callback)
        found = rospy.search_param("actionlib_status_frequency")
        self.status_frequency = float(rospy.get_param(found, 5.0)) if found else 5.0
        found = rospy.search_param("status_list_timeout")
        seconds = float(rospy.get_param(found, _STATUS_KEPT_S)) if found else _STATUS_KEPT_S
        self.status_list_timeout = rospy.Duration(seconds)
        self.status_timer = rospy.Timer(
            rospy.Duration(1.0 / self.status_frequency), lambda event: self._publish_regularly(), reset=True
        )

    def _publish_regularly(self) -> None:
        with self.lock:
            if self.started:
                self.publish_status()

    def publish_result(self, status: Any, result: Any) -> None:
        """Publishes the result of a goal and the status of all."""
        with self.lock:
            message = self.ActionResult()
            message.header.stamp = rospy.Time.now()
            message.status = _copied(status)
            if result is not None:
                message.result = result
            self._send(self.result_pub, message)
            self.publish_status()

    def publish_feedback(self, status: Any, feedback: Any) -> None:
        """Publishes feedback on a goal."""
        with self.lock:
            message = self.ActionFeedback()
            message.header.stamp = rospy.Time.now()
            message.status = _copied(status)
            message.feedback = feedback
            self._send(self.feedback_pub, message)

    def publish_status(self) -> None:
        """Publishes the status of all goals."""
        with self.lock:
            now = rospy.Time.now()
            message = GoalStatusArray()
            message.header.stamp = now
            kept = []
            for one in self.status_list:
                message.status_list.append(one.status)
                ended = one.handle_destruction_time
                if ended.is_zero() or ended + self.status_list_timeout >= now:
                    kept.append(one)
            self.status_list = kept
            self._send(self.status_pub, message)

    @staticmethod
    def _send(publisher: Any, message: Any) -> None:
        if not rospy.is_shutdown():
            publisher.publish(message)

    def internal_cancel_callback(self, goal_id: Any) -> None:
        """Cancels goals: the one with the id, those up to the stamp, or all."""
        with self.lock:
            if not self.started:
                return
            is_found = False
            for one in list(self.status_list):
                mine = one.status.goal_id
                is_all = not goal_id.id and goal_id.stamp.is_zero()
                is_older = not goal_id.stamp.is_zero() and mine.stamp <= goal_id.stamp
                if not (is_all or goal_id.id == mine.id or is_older):
                    continue
                is_found = is_found or goal_id.id == mine.id
                if one.goal is None:
                    continue
                handle = ServerGoalHandle(one, self, one.handle_tracker)
                if handle.set_cancel_requested():
                    self.cancel_callback(handle)
            if goal_id.id and not is_found:
                # The goal may come after its cancellation.
                tracker = StatusTracker(goal_id, GoalStatus.RECALLING)
                tracker.handle_destruction_time = rospy.Time.now()
                self.status_list.append(tracker)
            if goal_id.stamp > self.last_cancel:
                self.last_cancel = goal_id.stamp

    def internal_goal_callback(self, goal: Any) -> None:
        """Takes a new goal."""
        with self.lock:
            if not self.started:
                return
            for one in self.status_list:
                if goal.goal_id.id and goal.goal_id.id == one.status.goal_id.id:
                    if one.status.status == GoalStatus.RECALLING:
                        one.status.status = GoalStatus.RECALLED
                        self.publish_result(one.status, self.ActionResultType())
                    one.handle_destruction_time = rospy.Time.now()
                    return
            is_stamped = not goal.goal_id.stamp.is_zero()
            tracker = StatusTracker(None, None, goal)
            tracker.handle_tracker = HandleTrackerDeleter(self, tracker)
            self.status_list.append(tracker)
            handle = ServerGoalHandle(tracker, self, tracker.handle_tracker)
            if is_stamped and not self.last_cancel.is_zero() and goal.goal_id.stamp <= self.last_cancel:
                handle.set_canceled(
                    None, "This goal handle was canceled by the action server because its timestamp is before the "
                    "timestamp of the last cancel request"
                )  # fmt: skip
            elif self.goal_callback is not None:
                self.goal_callback(handle)


def _copied(status: Any) -> Any:
    return GoalStatus(status.goal_id, status.status, status.text)
