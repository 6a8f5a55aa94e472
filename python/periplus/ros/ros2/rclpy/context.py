"""Contexts: the shared state of the nodes between `init` and `shutdown`."""

from __future__ import annotations

import os
import sys
from _thread import allocate_lock
from typing import TYPE_CHECKING, Any

from periplus.ros import _waiting

from rclpy import _clock_source, _log_settings
from rclpy._native import RosArgumentsError, RosGraph, ros_split_arguments
from rclpy._rclpy_pybind11 import RCLError, RCLInvalidROSArgsError, UnknownROSArgsError
from rclpy.exceptions import NotInitializedException

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import TracebackType

g_logging_ref_count = 0

#: Initialized contexts that are not shut down; signals shut all of them down.
_valid_contexts: list[Context] = []

_NOT_SHUT_DOWN = "rcl_shutdown already called on the given context"


class Context:
    """Connection of this process to the ROS graph."""

    def __init__(self) -> None:
        self._lock = allocate_lock()
        self._graph: RosGraph | None = None
        self._valid = False
        self._domain_id = 0
        self._callbacks: list[Callable[[], Any]] = []
        self._logs = False

    # ---- life

    def init(
        self,
        args: list[str] | None = None,
        *,
        initialize_logging: bool = True,
        domain_id: int | None = None,
        graph_of: Callable[[list[str]], RosGraph] | None = None,
    ) -> None:
        """Joins the ROS graph.

        Args:
            args: Arguments of the program (default: `sys.argv`). Those after `--ros-args` apply to all nodes.
            initialize_logging: Take the settings of logging from the arguments (default True).
            domain_id: Domain (default: the environment variable `ROS_DOMAIN_ID`, else 0).
            graph_of: Not in ROS: makes the graph that is joined from the words after `--ros-args`, such as
                `periplus.Simulation.ros_graph`.

        Raises:
            RuntimeError: The context was initialized before.
            UnknownROSArgsError: A word after `--ros-args` is no ROS argument.
        """
        if domain_id is not None and domain_id < 0:
            raise RuntimeError(f"Domain id ({domain_id}) should not be lower than zero.")
        words = sys.argv if args is None else list(args)
        with self._lock:
            if self._graph is not None:
                raise RuntimeError("Context.init() must only be called once")
            ros = ros_split_arguments(words)[1]
            try:
                if graph_of is not None:
                    graph = graph_of(ros)
                else:
                    graph = RosGraph(ros, domain_id=domain_id, link=_waiting.link())
            except RosArgumentsError as error:
                raise argument_error(error) from None
            _clock_source.follow(graph)
            self._graph = graph
            self._domain_id = int(os.environ.get("ROS_DOMAIN_ID") or 0) if domain_id is None else domain_id
            self._valid = True
            _valid_contexts.append(self)
        if initialize_logging:
            self._logs = True
            _log_settings.configure(ros)

    def ok(self) -> bool:
        """True between `init` and shutdown."""
        if self._valid and _clock_source.source.lockstep_graph is not None:
            _clock_source.look()
        return self._valid

    def _invalidate(self) -> None:
        """Ends all waits; called by signals too, at any point of the program."""
        if self._valid:
            self._valid = False
            if self in _valid_contexts:
                _valid_contexts.remove(self)
            if self._graph is not None:
                self._graph.wake()

    def shutdown(self) -> None:
        """Leaves the ROS graph and calls the functions of `on_shutdown`.

        Raises `RuntimeError` before `init`, and `RCLError` if the context is shut down already, as after Ctrl-C.
        """
        if self._graph is None:
            raise RuntimeError("Context must be initialized before it can be shutdown")
        if not self._valid:
            raise RCLError(f"failed to shutdown: {_NOT_SHUT_DOWN}")
        self._finish()

    def try_shutdown(self) -> None:
        """Shuts the context down if it is valid."""
        if self._graph is not None and self._valid:
            self._finish()

    def _finish(self) -> None:
        self._invalidate()
        callbacks, self._callbacks = self._callbacks, []
        for callback in callbacks:
            callback()

    def on_shutdown(self, callback: Callable[[], None]) -> None:
        """Calls a function at shutdown."""
        if not callable(callback):
            raise TypeError("callback should be a callable, got {}", type(callback))
        self._callbacks.append(callback)

    def destroy(self) -> None:
        """Closes the connection to the graph with all of its nodes."""
        graph = self._graph
        self._invalidate()
        if graph is not None:
            graph.close()

    def get_domain_id(self) -> int:
        """Domain of the context."""
        if self._graph is None or not self._valid:
            raise RCLError("Failed to get domain id: the context is not initialized")
        return self._domain_id

    @property
    def handle(self) -> RosGraph | None:
        """The native connection, or None before `init`."""
        return self._graph

    # ---- for the other modules

    def _use(self, message: str | None = None) -> RosGraph:
        """The native connection; raises `NotInitializedException` if it cannot be used."""
        if self._graph is None or not self._valid:
            raise NotInitializedException(message)
        return self._graph

    def __enter__(self) -> Context:
        if self._graph is None:
            self.init()
        return self

    def __exit__(
        self, exc_type: type[BaseException] | None, exc_val: BaseException | None, exc_tb: TracebackType | None
    ) -> None:
        self.try_shutdown()


def argument_error(error: RosArgumentsError) -> Exception:
    """Exception of the original for an error in ROS arguments."""
    if error.unknown:
        return UnknownROSArgsError(str(error.unknown))
    return RCLInvalidROSArgsError(f"failed to initialize rcl: {error}")
