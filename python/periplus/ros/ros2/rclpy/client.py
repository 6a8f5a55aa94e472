"""Clients of services."""

from __future__ import annotations

from _thread import allocate_lock
from typing import TYPE_CHECKING, Any, TypeVar

from periplus.ros import _waiting

from rclpy._clock_source import source
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.constants import S_TO_NS
from rclpy.task import Future
from rclpy.type_support import wrong_type

if TYPE_CHECKING:
    from rclpy._native import RosClient
    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context
    from rclpy.qos import QoSProfile

SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")

# Longest time [ns] between two looks for a server: not each change of the graph is an arrival.
_LOOK_NS = 50_000_000


class Client:
    """Calls a service. `Node.create_client` makes it."""

    _kind = "client"
    _monitor: Any = None

    def __init__(
        self,
        context: Context,
        client_impl: RosClient,
        srv_type: Any,
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
    ) -> None:
        self.context = context
        self._native = client_impl
        self._destroyed = False
        self.srv_type = srv_type
        #: Name as the program gave it.
        self.srv_name = srv_name
        self.qos_profile = qos_profile
        self.callback_group = callback_group
        self._pending_requests: dict[int, Future] = {}
        self._lock = allocate_lock()

    # ---- use

    def call(self, request: Any, timeout_sec: float | None = None) -> Any:
        """Calls the service and blocks until the response is there; returns None at the timeout.

        Another thread must spin the node. In a callback of the only thread this never returns: use `call_async` there.
        """
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(self._wrong_type(request))
        graph = self.context._use()
        future = self.call_async(request)
        future._add_wake(graph.wake)
        deadline_ns = None if timeout_sec is None or timeout_sec < 0 else source.steady_ns() + int(timeout_sec * S_TO_NS)
        while True:
            seen = graph.events
            if future._is_done() or future.cancelled() or not self.context._valid:
                break
            left_ns = None
            if deadline_ns is not None:
                left_ns = deadline_ns - source.steady_ns()
                if left_ns <= 0:
                    break
            _waiting.wait(graph, seen, left_ns)
        if not future._is_done():
            self.remove_pending_request(future)
            return None
        return future.result()

    def call_async(self, request: Any) -> Future:
        """Calls the service. The future that is returned gets the response while the node spins."""
        self._check()
        if not isinstance(request, self.srv_type.Request):
            raise TypeError(self._wrong_type(request))
        future = Future()
        future._origin = self
        with self._lock:
            self._pending_requests[self._native.call(request)] = future
        return future

    def _wrong_type(self, request: Any) -> str:
        return wrong_type(self.srv_type.Request, request)

    def get_pending_request(self, sequence_number: int) -> Future:
        """The future of a call. Raises `KeyError` for an unknown number."""
        with self._lock:
            return self._pending_requests[sequence_number]

    def remove_pending_request(self, future: Future) -> None:
        """Ignores the response to a call."""
        with self._lock:
            for sequence, pending in list(self._pending_requests.items()):
                if pending is future:
                    del self._pending_requests[sequence]

    def service_is_ready(self) -> bool:
        """True if there is a server."""
        self._check()
        return self._native.is_ready

    def wait_for_service(self, timeout_sec: float | None = None) -> bool:
        """Blocks until there is a server, at most `timeout_sec` (default: no limit). Returns False without one."""
        self._check()
        return wait_until(self.context, self.service_is_ready, timeout_sec)

    def configure_introspection(self, clock: Any, service_event_qos_profile: Any, introspection_state: Any) -> None:
        """Does nothing: events of calls are not published."""

    @property
    def handle(self) -> Client:
        """The client itself."""
        return self

    @property
    def service_name(self) -> str:
        """Full name of the service."""
        self._check()
        return self._full_name()

    @property
    def logger_name(self) -> str:
        """Name of the logger of the node."""
        self._check()
        return str(getattr(self, "_logger_name", ""))

    def destroy(self) -> None:
        """Ends the client. `Node.destroy_client` does it."""
        if not self._destroyed:
            self._destroyed = True
            self._native.close()

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def __enter__(self) -> Client:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        self.destroy()

    # ---- for the executor

    def _full_name(self) -> str:
        return str(getattr(self._native, "service", self.srv_name))

    def _take(self) -> Any:
        return None if self._destroyed else self._native.take()

    def _call(self, taken: Any, executor: Any) -> None:
        sequence, response = taken
        with self._lock:
            future = self._pending_requests.pop(sequence, None)
        if future is not None:
            future._set_executor(executor)
            future.set_result(response)


def wait_until(context: Context, is_ready: Any, timeout_sec: float | None) -> bool:
    """Blocks until `is_ready()`, the shutdown or the timeout. Returns the last result of `is_ready()`."""
    graph = context._use()
    deadline_ns = None if timeout_sec is None or timeout_sec < 0 else source.steady_ns() + int(timeout_sec * S_TO_NS)
    while True:
        seen = graph.events
        if is_ready():
            return True
        if not context._valid:
            return False
        left_ns = _LOOK_NS
        if deadline_ns is not None:
            left_ns = min(left_ns, deadline_ns - source.steady_ns())
            if left_ns <= 0:
                return False
        _waiting.wait(graph, seen, left_ns)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
