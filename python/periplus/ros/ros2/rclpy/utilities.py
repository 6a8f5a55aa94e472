"""Functions about the default context and the arguments."""

from __future__ import annotations

import os
import sys
from _thread import allocate_lock
from collections.abc import Sequence

from rclpy._native import RosArgumentsError, ros_split_arguments
from rclpy._rclpy_pybind11 import rclpy_get_rmw_implementation_identifier
from rclpy.constants import S_TO_NS
from rclpy.context import Context, argument_error

g_default_context: Context | None = None
g_context_lock = allocate_lock()


def get_default_context(*, shutting_down: bool = False) -> Context:
    """The context that functions use without a `context`; a new one after each shutdown."""
    global g_default_context
    with g_context_lock:
        if g_default_context is None:
            g_default_context = Context()
        context = g_default_context
        if shutting_down:
            g_default_context = None
        return context


def remove_ros_args(args: Sequence[str] | None = None) -> list[str]:
    """The arguments (default: `sys.argv`) without those after `--ros-args`.

    Raises `UnknownROSArgsError` if one of those is no ROS argument.
    """
    own, ros = ros_split_arguments(list(sys.argv if args is None else args))
    if ros:
        from rclpy._native import RosGraph

        try:
            RosGraph(ros, network=False).close()
        except RosArgumentsError as error:
            raise argument_error(error) from None
    return list(own)


def ok(*, context: Context | None = None) -> bool:
    """True between `init` and shutdown of the context (default: the default context)."""
    return (get_default_context() if context is None else context).ok()


def shutdown(*, context: Context | None = None) -> None:
    """Shuts a context down. Raises if it is not valid."""
    (get_default_context(shutting_down=True) if context is None else context).shutdown()


def try_shutdown(*, context: Context | None = None) -> None:
    """Shuts a context down if it is valid."""
    if context is None:
        global g_default_context
        with g_context_lock:
            context, g_default_context = g_default_context, None
        if context is None:
            return
    context.try_shutdown()


def get_rmw_implementation_identifier() -> str:
    """Name of the middleware."""
    return rclpy_get_rmw_implementation_identifier()


def get_available_rmw_implementations() -> set[str]:
    """Names of the middlewares that can be used."""
    return {rclpy_get_rmw_implementation_identifier()}


def timeout_sec_to_nsec(timeout_sec: float | None) -> int:
    """Timeout [ns]; -1 stands for no limit."""
    if timeout_sec is None or timeout_sec < 0:
        return -1
    return int(float(timeout_sec) * S_TO_NS)


def _environment_true(name: str) -> bool:
    """True if an environment variable is `1`."""
    return os.environ.get(name, "") == "1"
