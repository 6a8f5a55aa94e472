"""State of the node of this process: graph, shutdown, hooks."""

from __future__ import annotations

import atexit
import os
import sys
import threading
import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from periplus.ros import _waiting

from rospy._log import (  # noqa: F401
    logdebug,
    logdebug_once,
    logdebug_throttle,
    logdebug_throttle_identical,
    logerr,
    logerr_once,
    logerr_throttle,
    logerr_throttle_identical,
    logerror,
    logfatal,
    logfatal_once,
    logfatal_throttle,
    logfatal_throttle_identical,
    loginfo,
    loginfo_once,
    loginfo_throttle,
    loginfo_throttle_identical,
    logout,
    logwarn,
    logwarn_once,
    logwarn_throttle,
    logwarn_throttle_identical,
)
from rospy.exceptions import ROSException, ROSInitException, ROSInterruptException
from rospy.names import get_caller_id, get_name, get_namespace  # noqa: F401

if TYPE_CHECKING:
    from rospy._dispatch import Dispatcher

#: Time for the messages of the last hooks to leave this process.
_FLUSH_NS = 200_000_000

_NOT_INITIALIZED = "ROS node has not been initialized yet. Please call init_node() first"


class State:
    """The node of this process."""

    def __init__(self) -> None:
        self.graph: Any = None
        self.node: Any = None
        self.dispatcher: Dispatcher | None = None
        self.is_initialized = False
        self.is_shutdown = False
        self.in_shutdown = False
        self.init_arguments: tuple[Any, ...] = ()
        self.lock = threading.RLock()
        #: Functions that finish what was made before `init_node()`.
        self.waiting: list[Callable[[], None]] = []
        self.client_hooks: list[Callable[[], Any]] = []
        self.preshutdown_hooks: list[Callable[[str], Any]] = []
        self.shutdown_hooks: list[Callable[[str], Any]] = []
        self.pid = os.getpid()


state = State()


def require_init(what: str = "") -> None:
    """Raises `ROSInitException` before `init_node()`."""
    if not state.is_initialized:
        raise ROSInitException(_NOT_INITIALIZED)


def when_initialized(function: Callable[[], None]) -> None:
    """Calls the function now, or at the end of `init_node()`."""
    with state.lock:
        if not state.is_initialized:
            state.waiting.append(function)
            return
    function()


def is_initialized() -> bool:
    """True once `init_node()` has been called."""
    return state.is_initialized


def is_shutdown() -> bool:
    """True once the node has shut down. False before `init_node()` only if nothing has ended the process yet."""
    _waiting.poll()
    return state.is_shutdown


def is_shutdown_requested() -> bool:
    """True as soon as the shutdown has begun, while hooks run."""
    return state.is_shutdown or state.in_shutdown


def add_client_shutdown_hook(h: Callable[[], Any]) -> None:
    """Adds a function that is called at shutdown, while topics and services still work."""
    _add_hook(state.client_hooks, h)


def add_preshutdown_hook(h: Callable[[str], Any]) -> None:
    """Adds a function of the reason that is called before the shutdown."""
    _add_hook(state.preshutdown_hooks, h)


def add_shutdown_hook(h: Callable[[str], Any]) -> None:
    """Adds a function of the reason that is called after the shutdown."""
    _add_hook(state.shutdown_hooks, h)


def _add_hook(hooks: list[Any], hook: Any) -> None:
    if not callable(hook):
        raise TypeError(f"shutdown hook [{hook!r}] must be a function or callable object: {type(hook)}")
    if state.is_shutdown:
        _run_hooks([hook], () if hooks is state.client_hooks else ("shutdown",))
    else:
        hooks.append(hook)


def _run_hooks(hooks: list[Any], arguments: tuple[Any, ...]) -> None:
    from periplus.ros import _faults

    for hook in list(hooks):
        try:
            hook(*arguments)
        except Exception as error:
            sys.stderr.write(f"shutdown hook {hook!r} of node {get_name()} failed:\n{_faults.format_exception(error)}")
    hooks.clear()


def signal_shutdown(reason: object) -> None:
    """Shuts the node down: calls the hooks, then closes topics and services."""
    if state.is_shutdown or state.in_shutdown:
        return
    with state.lock:
        if state.is_shutdown or state.in_shutdown:
            return
        state.in_shutdown = True
    text = str(reason)
    _run_hooks(state.client_hooks, ())
    _run_hooks(state.preshutdown_hooks, (text,))
    state.is_shutdown = True
    _run_hooks(state.shutdown_hooks, (text,))
    if state.dispatcher is not None:
        state.dispatcher.close()
    graph = state.graph
    if graph is not None and os.getpid() == state.pid:
        try:
            graph.flush(_FLUSH_NS)
            state.node.close()
            graph.wake()
        except Exception:
            sys.stderr.write(f"node {get_name()} was not closed:\n{traceback.format_exc()}")


def _at_exit() -> None:
    signal_shutdown("atexit")
    if state.graph is not None and os.getpid() == state.pid:
        graph, state.graph = state.graph, None
        graph.close()


def register_signals() -> None:
    """Shuts down at SIGINT and SIGTERM. Only the main thread may do this."""
    import signal

    def install(number: int) -> None:
        before = signal.getsignal(number)

        def handler(received: int, stack: Any) -> None:
            signal_shutdown(f"signal-{received}")
            if callable(before) and before not in (signal.default_int_handler, handler):
                before(received, stack)

        signal.signal(number, handler)

    if threading.current_thread() is not threading.main_thread():
        return
    install(signal.SIGTERM)
    install(signal.SIGINT)


def register_exit() -> None:
    """Shuts down at the end of the program."""
    atexit.register(_at_exit)


def live_node() -> Any:
    """The node, for a new topic or service.

    Raises:
        ROSInitException: `init_node()` has not been called.
        ROSInterruptException: The node has shut down.
    """
    if state.node is None:
        raise ROSInitException(_NOT_INITIALIZED)
    if state.is_shutdown:
        raise ROSInterruptException("rospy shutdown")
    return state.node


def wait_events(done: Callable[[], bool], timeout_ns: int | None = None) -> bool:
    """Blocks until `done()` is true (True), or for the timeout [ns of steady time] (False).

    Raises:
        ROSInterruptException: The node shut down meanwhile.
    """
    graph = state.graph
    if graph is None:
        raise ROSInitException(_NOT_INITIALIZED)
    end = None if timeout_ns is None else _waiting.steady_ns(graph) + timeout_ns
    while True:
        seen = graph.events
        if done():
            return True
        if state.is_shutdown:
            raise ROSInterruptException("rospy shutdown")
        left = None
        if end is not None:
            left = end - _waiting.steady_ns(graph)
            if left <= 0:
                return False
        _waiting.wait(graph, seen, left)


def parse_rosrpc_uri(uri: str) -> Any:
    raise ROSException("services have no address here: they are found on the graph")


def configure_logging(node_name: str, level: int = 0) -> None:
    """Does nothing: the log goes to the console and to /rosout."""


def rospydebug(msg: str, *args: Any) -> None:
    """Discards an internal message."""


rospyinfo = rospywarn = rospyerr = rospydebug
