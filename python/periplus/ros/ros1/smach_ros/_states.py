"""States that call services, send goals and watch topics."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

import actionlib
import rospy
import smach
from actionlib_msgs.msg import GoalStatus


class ServiceState(smach.State):
    """Calls a service: outcomes succeeded, aborted, preempted."""

    def __init__(
        self,
        service_name: str,
        service_spec: Any,
        request: Any = None,
        request_cb: Callable[..., Any] | None = None,
        request_cb_args: Iterable[Any] = (),
        request_cb_kwargs: dict[str, Any] | None = None,
        request_key: str | None = None,
        request_slots: Iterable[str] = (),
        response_cb: Callable[..., Any] | None = None,
        response_cb_args: Iterable[Any] = (),
        response_cb_kwargs: dict[str, Any] | None = None,
        response_key: str | None = None,
        response_slots: Iterable[str] = (),
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(("succeeded", "aborted", "preempted"), input_keys, output_keys)
        self._name, self._spec = service_name, service_spec
        self._request = request
        self._request_cb = request_cb
        self._request_extra = (list(request_cb_args), dict(request_cb_kwargs or {}))
        self._request_key, self._request_slots = request_key, list(request_slots)
        self._response_cb = response_cb
        self._response_extra = (list(response_cb_args), dict(response_cb_kwargs or {}))
        self._response_key, self._response_slots = response_key, list(response_slots)
        self.register_input_keys([*self._request_slots, *([request_key] if request_key else [])])
        self.register_output_keys([*self._response_slots, *([response_key] if response_key else [])])

    def execute(self, ud: Any) -> str:
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        request = self._request if self._request is not None else self._spec._request_class()
        if self._request_key:
            request = ud[self._request_key]
        for slot in self._request_slots:
            setattr(request, slot, ud[slot])
        if self._request_cb is not None:
            args, kwargs = self._request_extra
            made = self._request_cb(ud, request, *args, **kwargs)
            request = request if made is None else made
        try:
            rospy.wait_for_service(self._name)
            response = rospy.ServiceProxy(self._name, self._spec)(request)
        except rospy.ServiceException as error:
            rospy.logerr("Exception when calling service '%s': %s", self._name, error)
            return "aborted"
        if self._response_key:
            ud[self._response_key] = response
        for slot in self._response_slots:
            ud[slot] = getattr(response, slot)
        outcome = None
        if self._response_cb is not None:
            args, kwargs = self._response_extra
            outcome = self._response_cb(ud, response, *args, **kwargs)
        return "succeeded" if outcome is None else str(outcome)


class SimpleActionState(smach.State):
    """Sends a goal and waits for its end: outcomes succeeded, aborted, preempted."""

    def __init__(
        self,
        action_name: str,
        action_spec: Any,
        goal: Any = None,
        goal_key: str | None = None,
        goal_slots: Iterable[str] = (),
        goal_cb: Callable[..., Any] | None = None,
        goal_cb_args: Iterable[Any] = (),
        goal_cb_kwargs: dict[str, Any] | None = None,
        result_key: str | None = None,
        result_slots: Iterable[str] = (),
        result_cb: Callable[..., Any] | None = None,
        result_cb_args: Iterable[Any] = (),
        result_cb_kwargs: dict[str, Any] | None = None,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        outcomes: Iterable[str] = (),
        exec_timeout: Any = None,
        preempt_timeout: Any = None,
        server_wait_timeout: Any = None,
    ) -> None:
        super().__init__(("succeeded", "aborted", "preempted"), input_keys, output_keys)
        self.register_outcomes(outcomes)
        self._name, self._spec = action_name, action_spec
        self._goal = goal
        self._goal_key, self._goal_slots, self._goal_cb = goal_key, list(goal_slots), goal_cb
        self._goal_extra = (list(goal_cb_args), dict(goal_cb_kwargs or {}))
        self._result_key, self._result_slots, self._result_cb = result_key, list(result_slots), result_cb
        self._result_extra = (list(result_cb_args), dict(result_cb_kwargs or {}))
        self._exec_timeout = exec_timeout
        self._preempt_timeout = preempt_timeout or rospy.Duration(60.0)
        self._wait_timeout = server_wait_timeout
        self._client = actionlib.SimpleActionClient(action_name, action_spec)
        self.register_input_keys([*self._goal_slots, *([goal_key] if goal_key else [])])
        self.register_output_keys([*self._result_slots, *([result_key] if result_key else [])])
        for callback in (goal_cb, result_cb):
            if getattr(callback, "_has_smach_interface", False):
                self.register_input_keys(callback.get_registered_input_keys())  # type: ignore[union-attr]
                self.register_output_keys(callback.get_registered_output_keys())  # type: ignore[union-attr]
                self.register_outcomes(callback.get_registered_outcomes())  # type: ignore[union-attr]

    def request_preempt(self) -> None:
        super().request_preempt()
        self._client.cancel_goal()

    def execute(self, ud: Any) -> str:
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        if not self._client.wait_for_server(self._wait_timeout):
            rospy.logwarn("Action server [%s] is not there", self._name)
            return "aborted"
        goal = self._goal if self._goal is not None else type(self._spec().action_goal.goal)()
        if self._goal_key:
            goal = ud[self._goal_key]
        for slot in self._goal_slots:
            setattr(goal, slot, ud[slot])
        if self._goal_cb is not None:
            args, kwargs = self._goal_extra
            made = self._goal_cb(ud, goal, *args, **kwargs)
            goal = goal if made is None else made
        self._client.send_goal(goal)
        if not self._client.wait_for_result(self._exec_timeout):
            self._client.cancel_goal()
            self._client.wait_for_result(self._preempt_timeout)
        status, result = self._client.get_state(), self._client.get_result()
        if self._result_key:
            ud[self._result_key] = result
        for slot in self._result_slots:
            ud[slot] = getattr(result, slot)
        if self._result_cb is not None:
            args, kwargs = self._result_extra
            outcome = self._result_cb(ud, status, result, *args, **kwargs)
            if outcome is not None:
                return str(outcome)
        if status == GoalStatus.SUCCEEDED:
            return "succeeded"
        if status == GoalStatus.PREEMPTED and self.preempt_requested():
            self.service_preempt()
        return "preempted" if status in (GoalStatus.PREEMPTED, GoalStatus.RECALLED) else "aborted"


class MonitorState(smach.State):
    """Watches a topic while a function of user data and message is true: outcomes valid, invalid, preempted."""

    def __init__(
        self,
        topic: str,
        msg_type: Any,
        cond_cb: Callable[[Any, Any], bool],
        max_checks: int = -1,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(("valid", "invalid", "preempted"), input_keys, output_keys)
        self._topic, self._type, self._cond_cb, self._max_checks = topic, msg_type, cond_cb, max_checks
        self._event = threading.Event()

    def request_preempt(self) -> None:
        super().request_preempt()
        self._event.set()

    def execute(self, ud: Any) -> str:
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        self._event.clear()
        count, outcome = 0, "invalid"

        def callback(message: Any) -> None:
            nonlocal count, outcome
            if self._event.is_set():
                return
            count += 1
            is_true = self._cond_cb(ud, message)
            if not is_true or 0 < self._max_checks <= count:
                outcome = "valid" if is_true else "invalid"
                self._event.set()

        subscriber = rospy.Subscriber(self._topic, self._type, callback)
        while not self._event.wait(0.1) and not rospy.is_shutdown():
            pass
        subscriber.unregister()
        if self.preempt_requested():
            self.service_preempt()
            return "preempted"
        return outcome


class ConditionState(smach.State):
    """Asks a function until it is true: outcomes true, false, preempted."""

    def __init__(
        self,
        cond_cb: Callable[..., bool],
        input_keys: Iterable[str] = (),
        poll_rate: Any = None,
        timeout: Any = None,
        max_checks: int = 1,
    ) -> None:
        super().__init__(("true", "false", "preempted"), input_keys)
        self._cond_cb, self._max_checks = cond_cb, max_checks
        self._poll_rate = poll_rate if poll_rate is not None else rospy.Duration(0.05)
        self._timeout = timeout

    def execute(self, ud: Any) -> str:
        start, count = rospy.Time.now(), 0
        while self._max_checks == -1 or count <= self._max_checks:
            if self._timeout and rospy.Time.now() - start > self._timeout:
                break
            if self.preempt_requested():
                self.service_preempt()
                return "preempted"
            if self._cond_cb(ud):
                return "true"
            count += 1
            rospy.sleep(self._poll_rate)
        return "false"


class IntrospectionServer:
    """Stands for the server that shows a machine to a viewer, which Periplus does not have."""

    def __init__(self, server_name: str, state: Any, path: str) -> None:
        self.server_name = server_name

    def start(self) -> None:
        """Does nothing."""

    def stop(self) -> None:
        """Does nothing."""


def set_preempt_handler(sc: Any) -> None:
    """Preempts a container at the shutdown of the node."""
    rospy.on_shutdown(sc.request_preempt)
