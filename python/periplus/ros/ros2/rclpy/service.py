"""Services."""

from __future__ import annotations

from types import CoroutineType
from typing import TYPE_CHECKING, Any, TypeVar

from rclpy._rclpy_pybind11 import InvalidHandle

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy._native import RosServer
    from rclpy.callback_groups import CallbackGroup
    from rclpy.qos import QoSProfile

SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")


class Service:
    """Answers requests with a callback. `Node.create_service` makes it."""

    _kind = "service"
    _monitor: Any = None

    def __init__(
        self,
        service_impl: RosServer,
        srv_type: Any,
        srv_name: str,
        callback: Callable[..., Any],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
    ) -> None:
        self._native = service_impl
        self._destroyed = False
        self.srv_type = srv_type
        #: Name as the program gave it.
        self.srv_name = srv_name
        self.callback = callback
        self.callback_group = callback_group
        self.qos_profile = qos_profile

    # ---- use

    def send_response(self, response: Any, header: Any) -> None:
        """Answers a request. Raises `TypeError` for anything but a response of the service."""
        self._check()
        if not isinstance(response, self.srv_type.Response):
            raise TypeError(
                f"the callback of the service {self.service_name} returned {type(response).__name__}: "
                f"it must return the response, a {self.srv_type.__name__}.Response"
            )
        header.respond(response)

    def configure_introspection(self, clock: Any, service_event_qos_profile: Any, introspection_state: Any) -> None:
        """Does nothing: events of calls are not published."""

    @property
    def handle(self) -> Service:
        """The service itself."""
        return self

    @property
    def service_name(self) -> str:
        """Full name of the service."""
        self._check()
        return str(getattr(self._native, "service", getattr(self._native, "topic", self.srv_name)))

    @property
    def logger_name(self) -> str:
        """Name of the logger of the node."""
        self._check()
        return str(getattr(self, "_logger_name", ""))

    def destroy(self) -> None:
        """Ends the service. `Node.destroy_service` does it."""
        if not self._destroyed:
            self._destroyed = True
            self._native.close()

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def __enter__(self) -> Service:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        self.destroy()

    # ---- for the executor

    def _full_name(self) -> str:
        return self.srv_name

    def _take(self) -> Any:
        return None if self._destroyed else self._native.take()

    def _call(self, taken: Any, executor: Any) -> Any:
        call, request = taken
        response = self.callback(request, self.srv_type.Response())
        if type(response) is CoroutineType:
            return self._answer_later(call, response)
        self.send_response(response, call)
        return None

    async def _answer_later(self, call: Any, coroutine: Any) -> None:
        self.send_response(await coroutine, call)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
