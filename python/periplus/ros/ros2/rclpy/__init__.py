"""ROS 2 for Python, without a ROS installation.

A program calls `init()`, makes nodes, lets an executor run their callbacks (`spin`), and calls `shutdown()`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import SignalHandlerOptions
from rclpy.context import Context
from rclpy.parameter import Parameter
from rclpy.signals import install_signal_handlers, uninstall_signal_handlers
from rclpy.task import Future
from rclpy.utilities import (
    get_default_context,
    get_rmw_implementation_identifier,
    ok,
    try_shutdown,
)
from rclpy.utilities import shutdown as _shutdown

if TYPE_CHECKING:
    from types import TracebackType

    from rclpy.executors import Executor
    from rclpy.node import Node

__all__ = [
    "Context",
    "Future",
    "Parameter",
    "SignalHandlerOptions",
    "create_node",
    "get_default_context",
    "get_global_executor",
    "get_rmw_implementation_identifier",
    "init",
    "install_signal_handlers",
    "ok",
    "shutdown",
    "spin",
    "spin_once",
    "spin_until_future_complete",
    "try_shutdown",
    "uninstall_signal_handlers",
]

_global_executor: Executor | None = None


class InitContextManager:
    """Result of `init`: `with rclpy.init():` shuts the context down at the end."""

    def __init__(self, context: Context, installed_handlers: bool) -> None:
        self.context = context
        self.installed_signal_handlers = installed_handlers

    def __enter__(self) -> InitContextManager:
        return self

    def __exit__(
        self, exc_type: type[BaseException] | None, exc_val: BaseException | None, exc_tb: TracebackType | None
    ) -> None:
        try_shutdown(context=None if self.context is get_default_context() else self.context)
        if self.installed_signal_handlers:
            uninstall_signal_handlers()


def init(
    *,
    args: list[str] | None = None,
    context: Context | None = None,
    domain_id: int | None = None,
    signal_handler_options: SignalHandlerOptions | None = None,
) -> InitContextManager:
    """Joins the ROS graph.

    Args:
        args: Arguments of the program (default: `sys.argv`); those after `--ros-args` apply to all nodes.
        context: Context (default: the default context).
        domain_id: Domain (default: the environment variable `ROS_DOMAIN_ID`, else 0).
        signal_handler_options: Signals that shut down (default: SIGINT and SIGTERM for the default context, else none).
    """
    used = get_default_context() if context is None else context
    if signal_handler_options is None:
        signal_handler_options = SignalHandlerOptions.ALL if context is None else SignalHandlerOptions.NO
    used.init(args, domain_id=domain_id)
    install_signal_handlers(signal_handler_options)
    return InitContextManager(used, signal_handler_options != SignalHandlerOptions.NO)


def get_global_executor() -> Executor:
    """The executor of `spin` and the like without an `executor`."""
    global _global_executor
    if _global_executor is None:
        from rclpy.executors import SingleThreadedExecutor

        _global_executor = SingleThreadedExecutor()
        get_default_context().on_shutdown(_reset_global_executor)
    elif not _global_executor.context._valid and get_default_context() is not _global_executor.context:
        _reset_global_executor()
        return get_global_executor()
    return _global_executor


def _reset_global_executor() -> None:
    global _global_executor
    executor, _global_executor = _global_executor, None
    if executor is not None:
        executor.shutdown()


def shutdown(*, context: Context | None = None, uninstall_handlers: bool | None = None) -> None:
    """Leaves the ROS graph. Raises if the context (default: the default context) is not valid.

    Signal handlers are removed with the default context, or as `uninstall_handlers` asks.
    """
    _shutdown(context=context)
    if uninstall_handlers or (uninstall_handlers is None and context is None):
        uninstall_signal_handlers()


def create_node(node_name: str, **options: Any) -> Node:
    """Makes a node. Keywords as for `rclpy.node.Node`."""
    from rclpy.node import Node

    return Node(node_name, **options)


class _Membership:
    """A node in an executor, until the end of a spin; then it goes back to where it was."""

    def __init__(self, executor: Executor, node: Node) -> None:
        self._executor = executor
        self._node = node
        self._before = node.executor
        self._is_new = executor._join(node)

    def __enter__(self) -> None:
        return None

    def __exit__(self, *error: object) -> None:
        if self._is_new:
            self._executor._leave(self._node)
            if self._before is not None and not self._before._is_shutdown:
                self._before.add_node(self._node)


def _executor_of(node: Node, executor: Executor | None) -> Executor:
    if node is None or not hasattr(node, "executor"):
        raise TypeError(f"spin needs a node, not {type(node).__name__}")
    return get_global_executor() if executor is None else executor


def spin_once(node: Node, *, executor: Executor | None = None, timeout_sec: float | None = None) -> None:
    """Runs one callback of a node, waiting for it at most `timeout_sec` (default: no limit)."""
    executor = _executor_of(node, executor)
    with _Membership(executor, node):
        executor.spin_once(timeout_sec=timeout_sec)


def spin(node: Node, executor: Executor | None = None) -> None:
    """Runs the callbacks of a node until shutdown."""
    executor = _executor_of(node, executor)
    with _Membership(executor, node):
        while executor.context._valid and not executor._is_shutdown:
            executor.spin_once()


def spin_until_future_complete(
    node: Node, future: Future, executor: Executor | None = None, timeout_sec: float | None = None
) -> None:
    """Runs the callbacks of a node until a future is done, or for `timeout_sec` (default: no limit)."""
    executor = _executor_of(node, executor)
    with _Membership(executor, node):
        executor.spin_until_future_complete(future, timeout_sec)


_SUBMODULES = (
    "action",
    "callback_groups",
    "client",
    "clock",
    "clock_type",
    "constants",
    "duration",
    "event_handler",
    "exceptions",
    "executors",
    "expand_topic_name",
    "guard_condition",
    "impl",
    "lifecycle",
    "logging",
    "node",
    "parameter",
    "parameter_client",
    "parameter_event_handler",
    "parameter_service",
    "publisher",
    "qos",
    "qos_event",
    "qos_overriding_options",
    "serialization",
    "service",
    "subscription",
    "time",
    "time_source",
    "timer",
    "topic_endpoint_info",
    "type_support",
    "validate_full_topic_name",
    "validate_namespace",
    "validate_node_name",
    "validate_parameter_name",
    "validate_topic_name",
    "wait_for_message",
    "waitable",
)


def __getattr__(name: str) -> Any:
    if name in _SUBMODULES:
        import importlib

        return importlib.import_module(f"rclpy.{name}")
    raise AttributeError(f"module 'rclpy' has no attribute {name!r}")
