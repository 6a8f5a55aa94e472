"""Clients of actions."""

from __future__ import annotations

import threading
import weakref
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.action._names import ABORTED, CANCELED, SUCCEEDED, UNKNOWN, check_action_type, key_of, new_uuid, part_name
from rclpy.client import wait_until
from rclpy.qos import QoSProfile, qos_profile_action_status_default, qos_profile_services_default
from rclpy.task import Future
from rclpy.type_support import check_for_type_support
from rclpy.waitable import NumberOfEntities, Waitable

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.node import Node

__all__ = ["ActionClient", "ClientGoalHandle", "check_for_type_support"]


class ClientGoalHandle:
    """Goal as its client sees it. Keep it: without it the client forgets the goal's state."""

    def __init__(self, action_client: ActionClient, goal_id: Any, goal_response: Any) -> None:
        self._action_client = action_client
        self._goal_id = goal_id
        self._goal_response = goal_response
        self._status = UNKNOWN

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ClientGoalHandle) and self._goal_id == other._goal_id

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(key_of(self._goal_id))

    def __repr__(self) -> str:
        return f"ClientGoalHandle <id={self._goal_id.uuid}, accepted={self.accepted}, status={self._status}>"

    @property
    def goal_id(self) -> Any:
        """Identifier of the goal."""
        return self._goal_id

    @property
    def stamp(self) -> Any:
        """Time at which the server accepted the goal."""
        return self._goal_response.stamp

    @property
    def accepted(self) -> bool:
        """True if the server accepted the goal."""
        return bool(self._goal_response.accepted)

    @property
    def status(self) -> int:
        """State of the goal, as in `action_msgs.msg.GoalStatus`."""
        return self._status

    def cancel_goal(self) -> Any:
        """Asks the server to cancel the goal, and blocks until it answers. Another thread must spin the node."""
        return self._action_client._cancel_goal(self)

    def cancel_goal_async(self) -> Future:
        """Asks the server to cancel the goal. The future gets the answer."""
        return self._action_client._cancel_goal_async(self)

    def get_result(self) -> Any:
        """Blocks until the goal has ended, and returns its state and result. Another thread must spin the node."""
        return self._action_client._get_result(self)

    def get_result_async(self) -> Future:
        """Asks for the result. The future gets an object with `.status` and `.result` when the goal has ended."""
        return self._action_client._get_result_async(self)


class ActionClient(Waitable):
    """Sends goals to an action server."""

    def __init__(
        self,
        node: Node,
        action_type: Any,
        action_name: str,
        *,
        callback_group: CallbackGroup | None = None,
        goal_service_qos_profile: QoSProfile = qos_profile_services_default,
        result_service_qos_profile: QoSProfile = qos_profile_services_default,
        cancel_service_qos_profile: QoSProfile = qos_profile_services_default,
        feedback_sub_qos_profile: QoSProfile = QoSProfile(depth=10),  # noqa: B008
        status_sub_qos_profile: QoSProfile = qos_profile_action_status_default,
    ) -> None:
        """Makes a client of the action `action_name`, whose callbacks run in `callback_group` (default: the node's)."""
        super().__init__(node.default_callback_group if callback_group is None else callback_group)
        check_action_type(action_type)
        self._node = node
        self._action_type = action_type
        self._action_name = action_name
        self._destroyed = False
        base = node._rcl_full(action_name, True) + "/_action/"
        self._full = base[: -len("/_action/")]
        native = node._rcl_native
        self._goal_client = native.client(base + "send_goal", part_name(action_type, "SendGoal"))
        self._cancel_client = native.client(base + "cancel_goal", "action_msgs/srv/CancelGoal")
        self._result_client = native.client(base + "get_result", part_name(action_type, "GetResult"))
        self._feedback = native.subscription(
            base + "feedback", part_name(action_type, "FeedbackMessage"), feedback_sub_qos_profile._to_native()
        )
        self._status = native.subscription(
            base + "status", "action_msgs/msg/GoalStatusArray", status_sub_qos_profile._to_native()
        )
        self._natives = (
            self._goal_client,
            self._cancel_client,
            self._result_client,
            self._feedback,
            self._status,
        )
        self._goal_handles: dict[bytes, weakref.ReferenceType[ClientGoalHandle]] = {}
        # (future, identifier of the goal) by the number of the request.
        self._pending_goals: dict[int, tuple[Future, Any]] = {}
        self._pending_cancels: dict[int, Future] = {}
        self._pending_results: dict[int, tuple[Future, bytes]] = {}
        # Held from a request until its number is known: another thread may take the response at once.
        self._pending_lock = threading.Lock()
        self._feedback_callbacks: dict[bytes, Callable[[Any], Any]] = {}
        node.add_waitable(self)

    # ---- use

    def send_goal_async(
        self, goal: Any, feedback_callback: Callable[[Any], Any] | None = None, goal_uuid: Any = None
    ) -> Future:
        """Sends a goal. The future gets a `ClientGoalHandle` when the server has answered.

        Args:
            goal: Goal message.
            feedback_callback: Function of each feedback message, with `.goal_id` and `.feedback`.
            goal_uuid: Identifier (default: a random one).
        """
        self._check()
        if not isinstance(goal, self._action_type.Goal):
            raise TypeError(f"Expected {self._action_type.Goal}, got {type(goal)}")
        goal_id = new_uuid() if goal_uuid is None else goal_uuid
        request = self._action_type.Impl.SendGoalService.Request(goal_id=goal_id, goal=goal)
        if feedback_callback is not None:
            self._feedback_callbacks[key_of(goal_id)] = feedback_callback
        future = Future()
        future._origin = self
        with self._pending_lock:
            self._pending_goals[self._goal_client.call(request)] = (future, goal_id)
        return future

    def send_goal(self, goal: Any, **kwargs: Any) -> Any:
        """Sends a goal and blocks until it has ended; returns an object with `.status` and `.result`.

        Another thread must spin the node. Keywords as for `send_goal_async`.
        """
        handle = self._wait(self.send_goal_async(goal, **kwargs))
        return self._get_result(handle)

    def server_is_ready(self) -> bool:
        """True if there is a server."""
        self._check()
        return (
            self._goal_client.is_ready
            and self._cancel_client.is_ready
            and self._result_client.is_ready
            and self._feedback.publisher_count > 0
            and self._status.publisher_count > 0
        )

    def wait_for_server(self, timeout_sec: float | None = None) -> bool:
        """Blocks until there is a server, at most `timeout_sec` (default: no limit). Returns False without one."""
        self._check()
        return wait_until(self._node.context, self.server_is_ready, timeout_sec)

    def destroy(self) -> None:
        """Ends the client."""
        if self._destroyed:
            return
        self._destroyed = True
        self._node.remove_waitable(self)
        for native in self._natives:
            native.close()

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def _wait(self, future: Future) -> Any:
        """Blocks until a future is done."""
        graph = self._node._rcl_graph
        future._add_wake(graph.wake)
        wait_until(self._node.context, lambda: future._is_done() or future.cancelled(), None)
        return future.result()

    def _cancel_goal_async(self, handle: ClientGoalHandle) -> Future:
        self._check()
        if not isinstance(handle, ClientGoalHandle):
            raise TypeError(f"Expected type ClientGoalHandle but received {type(handle)}")
        from action_msgs.srv import CancelGoal

        request = CancelGoal.Request()
        request.goal_info.goal_id = handle.goal_id
        future = Future()
        future._origin = self
        with self._pending_lock:
            self._pending_cancels[self._cancel_client.call(request)] = future
        return future

    def _cancel_goal(self, handle: ClientGoalHandle) -> Any:
        return self._wait(self._cancel_goal_async(handle))

    def _get_result_async(self, handle: ClientGoalHandle) -> Future:
        self._check()
        if not isinstance(handle, ClientGoalHandle):
            raise TypeError(f"Expected type ClientGoalHandle but received {type(handle)}")
        request = self._action_type.Impl.GetResultService.Request(goal_id=handle.goal_id)
        future = Future()
        future._origin = self
        with self._pending_lock:
            self._pending_results[self._result_client.call(request)] = (future, key_of(handle.goal_id))
        return future

    def _get_result(self, handle: ClientGoalHandle) -> Any:
        return self._wait(self._get_result_async(handle))

    # ---- for the executor

    @property
    def _kind(self) -> str:
        return "action client"

    def _full_name(self) -> str:
        return self._full

    def _has_work(self) -> bool:
        for native in self._natives:
            if native.has_data:
                return True
        return False

    def is_ready(self, wait_set: Any) -> bool:
        """True if something has arrived."""
        return self._has_work()

    def _take(self) -> Any:
        """Takes all states and feedback, and one response of each kind."""
        if self._destroyed:
            return None
        taken: list[tuple[int, Any]] = []
        # States and feedback first: they are older than a result that arrives together with them.
        for index in (4, 3, 2, 1, 0):
            native = self._natives[index]
            while native.has_data:
                data = native.take()
                if data is None:
                    break
                taken.append((index, data))
                if index < 3:
                    break
        return taken or None

    def take_data(self) -> Any:
        """Takes what has arrived."""
        return self._take()

    def _call(self, taken: Any, executor: Any) -> Any:
        later = []
        handlers = (self._on_goal, self._on_cancel, self._on_result, self._on_feedback, self._on_status)
        for index, data in taken:
            result = handlers[index](data, executor)
            if type(result) is CoroutineType:
                later.append(result)
        return _run_all(later) if later else None

    async def execute(self, taken_data: Any) -> None:
        """Handles what was taken."""
        result = self._call(taken_data or [], self._node.executor)
        if result is not None:
            await result

    def _on_goal(self, data: Any, executor: Any) -> None:
        sequence, response = data
        with self._pending_lock:
            future, goal_id = self._pending_goals.pop(sequence, (None, None))
        if future is None:
            return
        handle = ClientGoalHandle(self, goal_id, response)
        key = key_of(goal_id)
        if handle.accepted:
            self._goal_handles[key] = weakref.ref(handle)
        else:
            self._feedback_callbacks.pop(key, None)
        future._set_executor(executor)
        future.set_result(handle)

    def _on_cancel(self, data: Any, executor: Any) -> None:
        sequence, response = data
        with self._pending_lock:
            future = self._pending_cancels.pop(sequence, None)
        if future is not None:
            future._set_executor(executor)
            future.set_result(response)

    def _on_result(self, data: Any, executor: Any) -> None:
        sequence, response = data
        with self._pending_lock:
            future, key = self._pending_results.pop(sequence, (None, b""))
        if future is None:
            return
        reference = self._goal_handles.pop(key, None)
        handle = None if reference is None else reference()
        if handle is not None:
            handle._status = response.status
        self._feedback_callbacks.pop(key, None)
        future._set_executor(executor)
        future.set_result(response)

    def _on_feedback(self, data: Any, executor: Any) -> Any:
        message = data[0]
        callback = self._feedback_callbacks.get(key_of(message.goal_id))
        return None if callback is None else callback(message)

    def _on_status(self, data: Any, executor: Any) -> None:
        for status in data[0].status_list:
            key = key_of(status.goal_info.goal_id)
            reference = self._goal_handles.get(key)
            if reference is None:
                continue
            handle = reference()
            if handle is not None:
                handle._status = status.status
            if handle is None or status.status in (SUCCEEDED, CANCELED, ABORTED):
                self._goal_handles.pop(key, None)

    def get_num_entities(self) -> NumberOfEntities:
        """Three clients and two subscriptions."""
        return NumberOfEntities(num_subs=2, num_clients=3)

    def add_to_wait_set(self, wait_set: Any) -> None:
        """Does nothing: there are no wait sets."""


async def _run_all(coroutines: list[Any]) -> None:
    for coroutine in coroutines:
        await coroutine


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
