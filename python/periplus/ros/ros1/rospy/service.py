"""Services: servers (`Service`), clients (`ServiceProxy`) and waiting for them."""

from __future__ import annotations

import hashlib
import io
import json
import threading
from collections.abc import Callable
from typing import Any

import genpy
from periplus.ros import _faults, _waiting

from rospy import core, names
from rospy._dispatch import Source, report_fault
from rospy._reader import Reader, qos
from rospy.exceptions import ROSException, ROSInterruptException, ROSSerializationException, ServiceException
from rospy.msg import args_kwds_to_message, received

#: Topic on which servers report requests that failed: ROS 2 has no other word for it.
_ERRORS_TOPIC = "/_rosservice_errors"
#: Time for the discovery of a server that is there already [ns].
_DISCOVERY_NS = 2_000_000_000
_NS = 10**9


def _digest(request: Any) -> str:
    buffer = io.BytesIO()
    request.serialize(buffer)
    return hashlib.md5(buffer.getvalue()).hexdigest()


class Service(Source):
    """Server of a service. Each request is handled in a thread of the node.

    Args:
        name: Service.
        service_class: Service class.
        handler: Function of the request. Returns a response, or its fields as a list, tuple, dict or single value.
        buff_size: Ignored.
        error_handler: Function of the exception, its type and traceback, in place of a log message.
    """

    serial = False

    def __init__(
        self,
        name: str,
        service_class: Any,
        handler: Callable[[Any], Any],
        buff_size: int = 65536,
        error_handler: Callable[..., Any] | None = None,
    ) -> None:
        super().__init__()
        _require_class(service_class)
        self.name = self.resolved_name = names.remap_name(name)
        self._given_name = name
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self.type = service_class._type
        self.handler = handler
        self.error_handler = error_handler
        self.done = False
        self._native: Any = None
        self._errors: Any = None
        self._monitor: Any = None
        core.when_initialized(self._start)

    @property
    def uri(self) -> str:
        return f"rosrpc:/{self.resolved_name}"

    def _start(self) -> None:
        self.resolved_name = self.name = core.live_node().resolve(names.remap_name(self._given_name), service=True)
        with core.state.lock:
            if self.resolved_name in _servers:
                raise ServiceException(f"service [{self.resolved_name}] already registered")
            _servers[self.resolved_name] = self
        self._native = core.live_node().server(self.resolved_name, self.service_class._native_type, style="genpy")
        self._monitor = _faults.CallbackMonitor(
            self.handler, node=core.get_name(), kind="service", name=self.resolved_name
        )
        assert core.state.dispatcher is not None
        core.state.dispatcher.add(self)

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        calls: list[tuple[int, Callable[[], None]]] = []
        native = self._native
        now = core.state.graph.now_ns()
        while not self.done and native.has_data:
            taken = native.take()
            if taken is None:
                break
            call, request = taken
            calls.append((now, lambda call=call, request=request: self._handle(call, request)))  # type: ignore[misc]
        return calls

    def _handle(self, call: Any, request: Any) -> None:
        request = received(request, self.request_class, {"service": self.resolved_name, "callerid": ""})
        before = self._monitor.start()
        try:
            response = as_response(self.handler(request), self.response_class)
            call.respond(response)
        except ROSInterruptException:
            return
        except Exception as error:
            self._failed(request, error)
        finally:
            self._monitor.end(before)

    def _failed(self, request: Any, error: Exception) -> None:
        text = f"error processing request: {error}"
        if isinstance(error, _BadResponse):
            text = str(error)
        if self.error_handler is not None:
            self.error_handler(error, type(error), error.__traceback__)
        elif not isinstance(error, _BadResponse):
            report_fault(self.handler, "service", self.resolved_name)
        else:
            where = _faults.callback_location(self.handler)
            core.logerr("service [%s]: %s: %s", self.resolved_name, text, where)
        report = {"service": self.resolved_name, "request": _digest(request), "error": text}
        report["time"] = core.state.graph.now_ns()
        if self._errors is None:
            from std_msgs.msg import String

            self._message = String
            self._errors = core.state.node.publisher(
                _ERRORS_TOPIC, "std_msgs/msg/String", qos(20, durability="transient_local")
            )
        self._errors.publish(self._message(json.dumps(report)))

    def shutdown(self, reason: str = "") -> None:
        """Closes the service."""
        if not self.done:
            self.done = True
            with core.state.lock:
                _servers.pop(self.resolved_name, None)
            if core.state.dispatcher is not None:
                core.state.dispatcher.remove(self)
            if self._native is not None:
                self._native.close()
            core.state.graph.wake()

    def spin(self) -> None:
        """Waits until the service or the node shuts down."""
        try:
            core.wait_events(lambda: self.done)
        except KeyboardInterrupt:
            core.signal_shutdown("keyboard interrupt")


_servers: dict[str, Service] = {}


class _BadResponse(ServiceException):
    """A handler returned something that is no response."""


def as_response(value: Any, response_class: Any) -> Any:
    """Response that the return value of a handler stands for."""
    if isinstance(value, genpy.Message) and type(value)._type == response_class._type:
        return value
    if value is None:
        raise _BadResponse("service handler returned None")
    try:
        if isinstance(value, dict):
            return response_class(**value)
        if isinstance(value, (list, tuple)):
            return response_class(*value)
        return response_class(*([value] if response_class.__slots__ else []))
    except (TypeError, AttributeError) as error:
        raise _BadResponse(f"handler returned invalid value: {error}") from None


def _require_class(service_class: Any) -> None:
    if not hasattr(service_class, "_request_class"):
        raise ValueError(f"{service_class!r} is not a service class, such as std_srvs.srv.Empty")


class ServiceProxy:
    """Client of a service. Calling it sends a request and waits for the response.

    Args:
        name: Service.
        service_class: Service class.
        persistent: Ignored: the connection always stays.
        headers: Ignored.
    """

    def __init__(
        self, name: str, service_class: Any, persistent: bool = False, headers: dict[str, str] | None = None
    ) -> None:
        _require_class(service_class)
        if not name or not isinstance(name, str):
            raise ValueError("service name is not a non-empty string")
        self.name = self.resolved_name = names.remap_name(name)
        self._given_name = name
        self.service_class = service_class
        self.request_class = service_class._request_class
        self.response_class = service_class._response_class
        self.type = service_class._type
        self.persistent = persistent
        self._client: Any = None
        self._lock = threading.RLock()
        self._responses: dict[int, Any] = {}
        self._closed = False
        core.when_initialized(self._start)

    def _start(self) -> None:
        if not self._closed:
            self.resolved_name = self.name = core.live_node().resolve(names.remap_name(self._given_name), service=True)
            self._client = core.live_node().client(self.resolved_name, self.service_class._native_type, style="genpy")

    def wait_for_service(self, timeout: Any = None) -> None:
        """Waits until the service is there. Raises `ROSException` at the timeout [s]."""
        wait_for_service(self.resolved_name, timeout)

    def __call__(self, *args: Any, **kwds: Any) -> Any:
        return self.call(*args, **kwds)

    def call(self, *args: Any, **kwds: Any) -> Any:
        """Sends a request, given whole or by its fields, and returns the response.

        Raises:
            ServiceException: There is no such service, or its server failed.
            ROSSerializationException: A field has a value that does not fit.
        """
        if self._client is None or self._closed:
            core.require_init()
            raise ServiceException(f"service [{self.resolved_name}] proxy is closed")
        try:
            request = args_kwds_to_message(self.request_class, args, kwds)
        except (TypeError, AttributeError) as error:
            raise ServiceException(str(error)) if isinstance(error, AttributeError) else error from None
        if core.state.is_shutdown:
            raise ROSInterruptException("rospy shutdown")
        client = self._client
        if not client.is_ready and not core.wait_events(lambda: client.is_ready, _DISCOVERY_NS):
            raise ServiceException(f"service [{self.resolved_name}] unavailable")
        errors = _error_reports()
        began = core.state.graph.now_ns()
        try:
            sequence = client.call(request)
        except (TypeError, ValueError, AttributeError, OverflowError) as error:
            try:
                request._check_types()
            except genpy.SerializationError as better:
                raise ROSSerializationException(f"{self.resolved_name}: {better}") from None
            raise ROSSerializationException(f"{self.resolved_name}: {error}") from error
        digest = ""
        failure: list[str] = []

        def is_answered() -> bool:
            nonlocal digest
            self._collect()
            if sequence in self._responses:
                return True
            if errors.reports or errors.poll():
                digest = digest or _digest(request)
                text = errors.find(self.resolved_name, digest, began)
                if text is not None:
                    failure.append(text)
                    return True
            return False

        core.wait_events(is_answered)
        if failure:
            raise ServiceException(f"service [{self.resolved_name}] responded with an error: {failure[0].encode()!r}")
        response = self._responses.pop(sequence)
        return received(response, self.response_class, {"service": self.resolved_name, "callerid": ""})

    def _collect(self) -> None:
        with self._lock:
            while self._client.has_data:
                taken = self._client.take()
                if taken is None:
                    break
                self._responses[taken[0]] = taken[1]

    def close(self) -> None:
        """Closes the client."""
        self._closed = True
        if self._client is not None:
            self._client.close()


class _ErrorReports:
    """Failed requests that servers have reported."""

    def __init__(self) -> None:
        self._reader = Reader(_ERRORS_TOPIC, "std_msgs/msg/String", 20)
        self._lock = threading.RLock()
        self.reports: list[dict[str, Any]] = []

    def poll(self) -> bool:
        """Reads new reports; True if there are any."""
        with self._lock:
            for message, _ in self._reader.poll():
                try:
                    self.reports.append(json.loads(message._data))
                except ValueError:
                    continue
            del self.reports[:-100]
            return bool(self.reports)

    def find(self, service: str, digest: str, began_ns: int) -> str | None:
        """Takes the report of a request that was sent after `began_ns`."""
        with self._lock:
            self.poll()
            for index, one in enumerate(self.reports):
                if (one["service"], one["request"]) == (service, digest) and one["time"] >= began_ns:
                    del self.reports[index]
                    return str(one["error"])
        return None


_reports: _ErrorReports | None = None


def _error_reports() -> _ErrorReports:
    global _reports
    with core.state.lock:
        if _reports is None:
            _reports = _ErrorReports()
        return _reports


def wait_for_service(service: str, timeout: Any = None) -> None:
    """Waits until a service is there.

    Args:
        service: Name of the service.
        timeout: Time to wait: seconds or a `Duration`; without one, for ever.

    Raises:
        ROSException: The timeout has passed.
        ROSInterruptException: The node shut down meanwhile.
    """
    if isinstance(timeout, genpy.Duration):
        timeout = timeout.to_sec()
    if timeout is not None and timeout < 0:
        raise ValueError("timeout must be a non-negative number")
    if core.state.graph is None:
        raise ROSException(
            f"wait_for_service({service!r}) needs the graph: call rospy.init_node() first"
        )
    name = core.live_node().resolve(names.remap_name(service), service=True)
    graph = core.state.graph

    def is_there() -> bool:
        _waiting.poll()
        return any(one == name for one, _ in graph.services())

    if is_there():
        return
    if not core.wait_events(is_there, None if timeout is None else int(timeout * _NS)):
        raise ROSException(f"timeout exceeded while waiting for service {name}")
