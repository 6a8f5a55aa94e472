"""Nodes."""

from __future__ import annotations

import weakref
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from rclpy import _log_output, _log_settings
from rclpy._native import RosArgumentsError, ros_split_arguments
from rclpy._node_entities import NodeEntities
from rclpy._node_graph import NodeGraph
from rclpy._node_parameters import NodeParameters
from rclpy._parameter_callbacks import ParameterCallbacks
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.callback_groups import CallbackGroup, MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.clock import Clock, ROSClock
from rclpy.constants import S_TO_NS
from rclpy.context import Context, argument_error
from rclpy.duration import Duration
from rclpy.exceptions import (
    InvalidParameterTypeException,
    InvalidParameterValueException,
    InvalidTopicNameException,
    NotInitializedException,
    ParameterAlreadyDeclaredException,
    ParameterImmutableException,
    ParameterNotDeclaredException,
    ParameterUninitializedException,
)
from rclpy.executors import Executor
from rclpy.impl.rcutils_logger import RcutilsLogger
from rclpy.logging import get_logger
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.qos import QoSProfile, qos_profile_parameter_events, qos_profile_services_default
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rclpy.utilities import get_default_context
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name

if TYPE_CHECKING:
    from rclpy._native import RosNode

HIDDEN_NODE_PREFIX = "_"

MsgType = TypeVar("MsgType")
SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")

__all__ = [
    "CallbackGroup",
    "Client",
    "Clock",
    "Context",
    "Duration",
    "Executor",
    "GuardCondition",
    "HIDDEN_NODE_PREFIX",
    "InvalidHandle",
    "InvalidParameterTypeException",
    "InvalidParameterValueException",
    "InvalidTopicNameException",
    "MutuallyExclusiveCallbackGroup",
    "Node",
    "NotInitializedException",
    "PARAMETER_SEPARATOR_STRING",
    "Parameter",
    "ParameterAlreadyDeclaredException",
    "ParameterImmutableException",
    "ParameterNotDeclaredException",
    "ParameterUninitializedException",
    "Publisher",
    "QoSProfile",
    "Rate",
    "ReentrantCallbackGroup",
    "S_TO_NS",
    "Service",
    "Subscription",
    "Timer",
    "Time",
    "TimeSource",
    "get_logger",
    "qos_profile_parameter_events",
    "qos_profile_services_default",
]


class Node(NodeEntities, NodeParameters, NodeGraph):
    """Node of the ROS graph: makes publishers, subscriptions, services, clients, timers, and has parameters."""

    def __init__(
        self,
        node_name: str,
        *,
        context: Context | None = None,
        cli_args: list[str] | None = None,
        namespace: str | None = None,
        use_global_arguments: bool = True,
        enable_rosout: bool = True,
        start_parameter_services: bool = True,
        parameter_overrides: Sequence[Parameter] | None = None,
        allow_undeclared_parameters: bool = False,
        automatically_declare_parameters_from_overrides: bool = False,
        enable_logger_service: bool = False,
    ) -> None:
        """Makes a node.

        Args:
            node_name: Name; the argument `-r __node:=...` replaces it.
            context: Context (default: that of `rclpy.init()`).
            cli_args: Arguments of this node alone; those after `--ros-args` count.
            namespace: Namespace (default `/`).
            use_global_arguments: Apply the arguments of `init` too (default True).
            enable_rosout: Publish log messages on `/rosout` (default True).
            start_parameter_services: Offer the services of parameters (default True).
            parameter_overrides: Values that replace the defaults of declared parameters, and those of arguments.
            allow_undeclared_parameters: Let parameters be used that are not declared (default False).
            automatically_declare_parameters_from_overrides: Declare all overrides (default False).
            enable_logger_service: Offer services for the levels of loggers (default False).

        Raises:
            NotInitializedException: `rclpy.init()` was not called.
            InvalidNodeNameException, InvalidNamespaceException: A name is not valid.
        """
        self._rcl_destroyed = False
        self._context = get_default_context() if context is None else context
        self._rcl_graph = self._context._use("cannot create node")
        self._rcl_native = self._rcl_make_native(node_name, namespace, use_global_arguments, cli_args)
        try:
            self._rcl_set_up(
                enable_rosout,
                start_parameter_services,
                parameter_overrides,
                allow_undeclared_parameters,
                automatically_declare_parameters_from_overrides,
                enable_logger_service,
            )
        except BaseException:
            self._rcl_native.close()
            raise

    def _rcl_set_up(
        self,
        enable_rosout: bool,
        start_parameter_services: bool,
        parameter_overrides: Sequence[Parameter] | None,
        allow_undeclared_parameters: bool,
        automatically_declare_parameters_from_overrides: bool,
        enable_logger_service: bool,
    ) -> None:
        """Makes what each node has."""
        name, inside = self._rcl_native.name, self._rcl_native.namespace.rstrip("/")
        self._rcl_full_name = f"{inside}/{name}"
        self._rcl_executor: Callable[[], Executor | None] | None = None
        self._default_callback_group = MutuallyExclusiveCallbackGroup()
        self._rate_group = ReentrantCallbackGroup()
        self._rcl_init_entities()
        self._rcl_init_parameters(
            self._rcl_overrides(parameter_overrides), allow_undeclared_parameters
        )
        self._logger: RcutilsLogger = get_logger(self._rcl_full_name[1:].replace("/", "."))
        self._rcl_set_log_level()
        self._rcl_rosout: Any = None
        if enable_rosout and self._rcl_native.logs_to_rosout:
            from rclpy._rosout import Rosout

            self._rcl_rosout = Rosout(self)
        from rcl_interfaces.msg import ParameterEvent

        self._parameter_event_publisher = self.create_publisher(
            ParameterEvent, "/parameter_events", qos_profile_parameter_events
        )
        self._clock = ROSClock()
        if automatically_declare_parameters_from_overrides:
            self.declare_parameters(
                "", [(one, parameter.value) for one, parameter in self._parameter_overrides.items()], True
            )
        self._time_source = TimeSource(node=self)
        self._time_source.attach_clock(self._clock)
        if start_parameter_services:
            from rclpy.parameter_service import ParameterService

            self._parameter_service = ParameterService(self)
        if enable_logger_service:
            from rclpy.logging_service import LoggingService

            self._rcl_logger_service = LoggingService(self)
        from rclpy.type_description_service import TypeDescriptionService

        self._type_description_service = TypeDescriptionService(self)

    def _rcl_make_native(
        self, name: str, namespace: str | None, use_global_arguments: bool, cli_args: list[str] | None
    ) -> RosNode:
        if name is None:
            raise RCLError("error creating node: name argument is null")
        if not isinstance(name, str):
            raise TypeError(f"node_name must be a str, not {type(name).__name__}")
        validate_node_name(name)
        namespace = namespace or "/"
        if not namespace.startswith("/"):
            namespace = "/" + namespace
        validate_namespace(namespace)
        ros = ros_split_arguments(list(cli_args or ()))[1]
        try:
            return self._rcl_graph.node(name, namespace, use_global_arguments=use_global_arguments, arguments=ros)
        except RosArgumentsError as error:
            raise argument_error(error) from None

    def _rcl_overrides(self, given: Sequence[Parameter] | None) -> dict[str, Parameter]:
        """Values of arguments and files, then those of the constructor."""
        overrides = {
            name: Parameter(name, value=value) for name, value in self._rcl_native.parameters().items()
        }
        for parameter in given or ():
            if not isinstance(parameter, Parameter):
                raise TypeError(
                    f"parameter_overrides must be a list of rclpy.parameter.Parameter, not of {type(parameter).__name__}"
                )
            overrides[parameter.name] = parameter
        return overrides

    def _rcl_set_log_level(self) -> None:
        level = self._rcl_native.log_level
        if level and level != _log_settings.levels.effective(self._logger.name):
            _log_settings.levels.set(self._logger.name, level)

    # ---- life

    def destroy_node(self) -> None:
        """Ends the node and all of its publishers, subscriptions and so on. Safe to call twice."""
        if self._rcl_destroyed:
            return
        executor = self.executor
        if executor is not None:
            executor.remove_node(self)
        self._time_source.detach_node()
        self._rcl_destroy_entities()
        self._rcl_destroyed = True
        if self._rcl_rosout is not None:
            self._rcl_rosout.destroy()
        self._rcl_native.close()

    @property
    def context(self) -> Context:
        """The context of the node."""
        return self._context

    @property
    def handle(self) -> Node:
        """The node itself."""
        return self

    @property
    def executor(self) -> Executor | None:
        """The executor that the node was added to, or None. Assigning adds it to another, or takes it out."""
        return None if self._rcl_executor is None else self._rcl_executor()

    @executor.setter
    def executor(self, new_executor: Executor | None) -> None:
        old = self.executor
        if old is new_executor:
            return
        self._rcl_executor = None if new_executor is None else weakref.ref(new_executor)
        if old is not None:
            old.remove_node(self)
        if new_executor is not None:
            new_executor.add_node(self)

    def _rcl_wake_executor(self) -> None:
        self._rcl_graph.wake()

    # ---- names

    def get_name(self) -> str:
        """Name of the node."""
        if self._rcl_destroyed:
            raise InvalidHandle
        return self._rcl_native.name

    def get_namespace(self) -> str:
        """Namespace of the node."""
        if self._rcl_destroyed:
            raise InvalidHandle
        return self._rcl_native.namespace

    def get_fully_qualified_name(self) -> str:
        """Namespace and name of the node."""
        if self._rcl_destroyed:
            raise InvalidHandle
        return self._rcl_full_name

    def get_logger(self) -> RcutilsLogger:
        """Logger of the node."""
        return self._logger

    def get_clock(self) -> Clock:
        """Clock of the node: simulated time while the parameter `use_sim_time` is set, else system time."""
        return self._clock

    @property
    def default_callback_group(self) -> CallbackGroup:
        """Group of callbacks without one of their own: one at a time."""
        return self._default_callback_group

    # ---- entities

    @property
    def publishers(self) -> Iterator[Any]:
        """The publishers."""
        yield from self._publishers

    @property
    def subscriptions(self) -> Iterator[Any]:
        """The subscriptions."""
        yield from self._subscriptions

    @property
    def clients(self) -> Iterator[Any]:
        """The clients."""
        yield from self._clients

    @property
    def services(self) -> Iterator[Any]:
        """The services."""
        yield from self._services

    @property
    def timers(self) -> Iterator[Any]:
        """The timers."""
        yield from self._timers

    @property
    def guards(self) -> Iterator[Any]:
        """The guard conditions."""
        yield from self._guards

    @property
    def waitables(self) -> Iterator[Any]:
        """The waitables: actions and events."""
        yield from self._rcl_waitables


# Errors about arguments name the class that programs know.
for _part in (NodeEntities, NodeParameters, ParameterCallbacks, NodeGraph):
    for _name, _method in vars(_part).items():
        if callable(_method) and hasattr(_method, "__qualname__"):
            _method.__qualname__ = f"Node.{_name}"


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
