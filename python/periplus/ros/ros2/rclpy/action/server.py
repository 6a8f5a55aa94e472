"""Servers of actions."""

from __future__ import annotations

from enum import Enum
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from periplus.ros import _faults

from rclpy import _log_output
from rclpy._clock_source import source
from rclpy._rclpy_pybind11 import GoalEvent, RCLError
from rclpy.action._names import UNKNOWN, check_action_type, key_of, part_name
from rclpy.action.goal import ServerGoalHandle
from rclpy.constants import S_TO_NS
from rclpy.executors import await_or_execute
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.task import Future
from rclpy.type_support import check_for_type_support
from rclpy.waitable import NumberOfEntities, Waitable

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node

__all__ = [
    "ActionServer",
    "CancelResponse",
    "GoalEvent",
    "GoalResponse",
    "RCLError",
    "ServerGoalHandle",
    "check_for_type_support",
    "default_cancel_callback",
    "default_goal_callback",
    "default_handle_accepted_callback",
]

_GOAL, _CANCEL, _RESULT = range(3)

# Return codes of action_msgs/srv/CancelGoal.
_REJECTED, _UNKNOWN_GOAL_ID, _GOAL_TERMINATED = 1, 2, 3


class GoalResponse(Enum):
    """Answer to a goal."""

    REJECT = 1
    ACCEPT = 2


class CancelResponse(Enum):
    """Answer to a request to cancel a goal."""

    REJECT = 1
    ACCEPT = 2


def default_handle_accepted_callback(goal_handle: ServerGoalHandle) -> None:
    """Starts the goal at once."""
    goal_handle.execute()


def default_goal_callback(goal_request: Any) -> GoalResponse:
    """Accepts all goals."""
    return GoalResponse.ACCEPT


def default_cancel_callback(cancel_request: Any) -> CancelResponse:
    """Refuses to cancel."""
    return CancelResponse.REJECT


class ActionServer(Waitable):
    """Executes goals of an action."""

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        execute_callback: Callable[[ServerGoalHandle], Any],
        *,
        callback_group: CallbackGroup | None = None,
        goal_callback: Callable[[Any], Any] | None = default_goal_callback,
        handle_accepted_callback: Callable[[ServerGoalHandle], Any] | None = default_handle_accepted_callback,
        cancel_callback: Callable[[ServerGoalHandle], Any] | None = default_cancel_callback,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_pub_qos_profile: QoSProfile = QoSProfile(depth=10),  # noqa: B008
        status_pub_qos_profile: QoSProfile = qos_profile_action_status_default,
        result_timeout: float = 900,
    ) -> None:
        """Makes a server of the action `action_name`.

        Args:
            node: Node of the server.
            action_type: Action class.
            action_name: Name of the action.
            execute_callback: Function or coroutine function of a goal handle, which returns the result. It runs as a
                task of the executor, in no callback group.
            callback_group: Group of the other callbacks (default: the node's).
            goal_callback: Function of a goal that returns a `GoalResponse` (default: all are accepted).
            handle_accepted_callback: Function of an accepted goal's handle (default: starts it).
            cancel_callback: Function of a goal handle that returns a `CancelResponse` (default: REJECT).
            result_timeout: Time [s] for which results are kept (default 900).
        """
        super().__init__(node.default_callback_group if callback_group is None else callback_group)
        check_action_type(action_type)
        self.register_handle_accepted_callback(handle_accepted_callback)
        self.register_goal_callback(goal_callback)
        self.register_cancel_callback(cancel_callback)
        self.register_execute_callback(execute_callback)
        self._node = node
        self._action_type = action_type
        self._destroyed = False
        self._result_timeout_ns = int(result_timeout * S_TO_NS)
        self._logger_name = f"{node._logger.name}.action_server"
        base = node._rcl_full(action_name, True) + "/_action/"
        self._full = base[: -len("/_action/")]
        native = node._rcl_native
        self._natives = (
            native.server(base + "send_goal", part_name(action_type, "SendGoal")),
            native.server(base + "cancel_goal", "action_msgs/srv/CancelGoal"),
            native.server(base + "get_result", part_name(action_type, "GetResult")),
        )
        self._feedback = native.publisher(
            base + "feedback", part_name(action_type, "FeedbackMessage"), feedback_pub_qos_profile._to_native()
        )
        self._status = native.publisher(
            base + "status", "action_msgs/msg/GoalStatusArray", status_pub_qos_profile._to_native()
        )
        self._goal_handles: dict[bytes, ServerGoalHandle] = {}
        self._result_futures: dict[bytes, Future] = {}
        node.add_waitable(self)
        self._publish_status()

    # ---- use

    @property
    def action_type(self) -> Any:
        """The action class."""
        return self._action_type

    def register_handle_accepted_callback(self, handle_accepted_callback: Any) -> None:
        """Replaces the function of accepted goals; None starts them at once."""
        self._handle_accepted_callback = handle_accepted_callback or default_handle_accepted_callback

    def register_goal_callback(self, goal_callback: Any) -> None:
        """Replaces the function that accepts goals; None accepts all."""
        self._goal_callback = goal_callback or default_goal_callback

    def register_cancel_callback(self, cancel_callback: Any) -> None:
        """Replaces the function that accepts requests to cancel; None refuses all."""
        self._cancel_callback = cancel_callback or default_cancel_callback

    def register_execute_callback(self, execute_callback: Any) -> None:
        """Replaces the function that executes goals."""
        if not callable(execute_callback):
            raise TypeError("Failed to register goal execution callback: not callable")
        self._execute_callback = execute_callback

    def notify_execute(self, goal_handle: ServerGoalHandle, execute_callback: Any) -> None:
        """Runs the execution of a goal as a task of the executor."""
        callback = self._execute_callback if execute_callback is None else execute_callback
        executor = self._node.executor
        if executor is None:
            raise RuntimeError(
                f"the goal of {self._full} cannot be executed: the node {self._node._rcl_full_name} is in no executor"
            )
        self._publish_status()
        executor.create_task(self._execute_goal(callback, goal_handle))

    def notify_goal_done(self) -> None:
        """Publishes the states of the goals after one has ended."""
        self._publish_status()

    def destroy(self) -> None:
        """Ends the server."""
        if self._destroyed:
            return
        self._destroyed = True
        self._node.remove_waitable(self)
        for native in (*self._natives, self._feedback, self._status):
            native.close()

    # ---- goals

    def _log(self, severity: int, text: str) -> None:
        _log_output.report(severity, self._logger_name, text)

    def _publish_feedback(self, message: Any) -> None:
        if not self._destroyed:
            self._feedback.publish(message)

    def _publish_status(self) -> None:
        if self._destroyed:
            return
        from action_msgs.msg import GoalStatus, GoalStatusArray

        statuses = [
            GoalStatus(goal_info=handle._goal_info, status=handle._status) for handle in self._goal_handles.values()
        ]
        self._status.publish(GoalStatusArray(status_list=statuses))

    def _forget(self, handle: ServerGoalHandle) -> None:
        key = key_of(handle.goal_id)
        self._goal_handles.pop(key, None)
        self._result_futures.pop(key, None)

    def _expire(self) -> None:
        """Forgets goals that have ended long ago."""
        now_ns = source.steady_ns()
        for handle in list(self._goal_handles.values()):
            if handle._expires_ns is not None and handle._expires_ns <= now_ns:
                self._forget(handle)

    async def _execute_goal(self, callback: Any, handle: ServerGoalHandle) -> None:
        try:
            result = await await_or_execute(callback, handle)
        except Exception as error:
            result = self._action_type.Result()
            self._log(40, f"Error raised in execute callback: {error}")
            _faults.callback_failed(
                error, node=self._node._rcl_full_name, kind="action", name=self._full, time_ns=source.system_ns()
            )
            _faults.print_exception(error)
        if handle.is_active:
            self._log(30, f"Goal state not set, assuming aborted. Goal ID: {handle.goal_id.uuid}")
            if handle._status == 1:
                handle._update("EXECUTE")
            handle.abort()
        if not isinstance(result, self._action_type.Result):
            given, result = result, self._action_type.Result()
            self._finish(handle, result)
            raise TypeError(
                f"the execute callback of the action {self._full} returned {type(given).__name__}: "
                f"it must return a {self._action_type.__name__}.Result"
            )
        self._finish(handle, result)

    def _finish(self, handle: ServerGoalHandle, result: Any) -> None:
        handle._expires_ns = source.steady_ns() + self._result_timeout_ns
        response = self._action_type.Impl.GetResultService.Response(status=handle._status, result=result)
        future = self._result_futures.get(key_of(handle.goal_id))
        if future is not None and not future.done():
            future.set_result(response)

    # ---- requests

    async def _on_goal(self, call: Any, request: Any) -> None:
        self._expire()
        send_goal = self._action_type.Impl.SendGoalService
        key = key_of(request.goal_id)
        accepted = False
        if key not in self._goal_handles:
            answer = await await_or_execute(self._goal_callback, request.goal)
            if isinstance(answer, GoalResponse):
                accepted = answer is GoalResponse.ACCEPT
            else:
                self._log(30, "Goal request callback did not return a GoalResponse type. Rejecting goal.")
        stamp = self._node.get_clock().now().to_msg()
        if not accepted:
            call.respond(send_goal.Response(accepted=False))
            return
        from action_msgs.msg import GoalInfo

        handle = ServerGoalHandle(self, GoalInfo(goal_id=request.goal_id, stamp=stamp), request.goal)
        self._goal_handles[key] = handle
        self._result_futures[key] = Future()
        call.respond(send_goal.Response(accepted=True, stamp=stamp))
        self._publish_status()
        result = self._handle_accepted_callback(handle)
        if isinstance(result, CoroutineType):
            await result

    def _candidates(self, info: Any) -> tuple[list[ServerGoalHandle], int]:
        """Goals that a request to cancel means, and the return code without one."""
        key = key_of(info.goal_id)
        stamp_ns = info.stamp.sec * S_TO_NS + info.stamp.nanosec
        is_given = any(key)
        handles = list(self._goal_handles.values())
        if not is_given and stamp_ns == 0:
            return [handle for handle in handles if handle.is_active], 0
        found = []
        for handle in handles:
            stamp = handle._goal_info.stamp
            is_older = 0 < stamp.sec * S_TO_NS + stamp.nanosec <= stamp_ns
            if handle.is_active and (is_older or key_of(handle.goal_id) == key):
                found.append(handle)
        if not found and is_given:
            return [], _GOAL_TERMINATED if key in self._goal_handles else _UNKNOWN_GOAL_ID
        return found, 0

    async def _on_cancel(self, call: Any, request: Any) -> None:
        from action_msgs.srv import CancelGoal

        self._expire()
        candidates, code = self._candidates(request.goal_info)
        response = CancelGoal.Response(return_code=code)
        canceling = []
        for handle in candidates:
            answer = await await_or_execute(self._cancel_callback, handle)
            if answer is CancelResponse.ACCEPT and handle.is_active:
                if handle._status != 3:
                    handle._update("CANCEL_GOAL")
                canceling.append(handle._goal_info)
        if candidates and not canceling:
            response.return_code = _REJECTED
        response.goals_canceling = canceling
        if canceling:
            self._publish_status()
        call.respond(response)

    def _on_result(self, call: Any, request: Any) -> None:
        self._expire()
        future = self._result_futures.get(key_of(request.goal_id))
        if future is None:
            call.respond(self._action_type.Impl.GetResultService.Response(status=UNKNOWN))
        else:
            future._add_wake(lambda: call.respond(future.result()))

    # ---- for the executor

    @property
    def _kind(self) -> str:
        return "action server"

    def _full_name(self) -> str:
        return self._full

    def _has_work(self) -> bool:
        for native in self._natives:
            if native.has_data:
                return True
        return False

    def is_ready(self, wait_set: Any) -> bool:
        """True if a request has arrived."""
        return self._has_work()

    def _take(self) -> Any:
        """Takes one request of each kind."""
        if self._destroyed:
            return None
        taken = [(index, native.take()) for index, native in enumerate(self._natives) if native.has_data]
        return [one for one in taken if one[1] is not None] or None

    def take_data(self) -> Any:
        """Takes one request of each kind."""
        return self._take()

    def _call(self, taken: Any, executor: Any) -> Any:
        return self.execute(taken)

    async def execute(self, taken_data: Any) -> None:
        """Answers what was taken."""
        for index, (call, request) in taken_data:
            if index == _GOAL:
                await self._on_goal(call, request)
            elif index == _CANCEL:
                await self._on_cancel(call, request)
            else:
                self._on_result(call, request)

    def get_num_entities(self) -> NumberOfEntities:
        """Three services and a timer."""
        return NumberOfEntities(num_timers=1, num_services=3)

    def add_to_wait_set(self, wait_set: Any) -> None:
        """Does nothing: there are no wait sets."""
