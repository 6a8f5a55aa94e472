"""Functions of programs: `init_node`, `spin`, parameters, waiting for messages."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any

from periplus.ros import _waiting

from rospy import core, names, rostime
from rospy._dispatch import Dispatcher, Source
from rospy._log import DEBUG, ERROR, FATAL, INFO, WARN, log, set_level  # noqa: F401
from rospy._param_functions import (  # noqa: F401
    delete_param,
    get_param,
    get_param_cached,
    get_param_names,
    has_param,
    search_param,
    set_param,
)
from rospy._params import service as parameters
from rospy._reader import Reader, qos
from rospy._wait_message import wait_for_message  # noqa: F401
from rospy.exceptions import ROSException, ROSInitException, ROSInterruptException
from rospy.timer import Rate, sleep  # noqa: F401

_NS = 10**9


def myargv(argv: list[str] | None = None) -> list[str]:
    """Command line without the remappings and the words after ``--ros-args``."""
    words = sys.argv if argv is None else argv
    found = []
    for word in words:
        if word == "--ros-args":
            break
        if names.REMAP not in word:
            found.append(word)
    return found


def _yaml(text: str) -> Any:
    """Value of a YAML text: numbers, booleans, lists and dicts, or the text itself."""
    from rospy._yaml import load

    return load(text)


def load_command_line_node_params(argv: list[str]) -> dict[str, Any]:
    """Private parameters of words ``_name:=value``."""
    return {
        left[1:]: _yaml(right)
        for left, right in names.load_mappings(argv).items()
        if left.startswith("_") and not left.startswith("__")
    }


def init_node(
    name: str,
    argv: list[str] | None = None,
    anonymous: bool = False,
    log_level: int | None = None,
    disable_rostime: bool = False,
    disable_rosout: bool = False,
    disable_signals: bool = False,
    xmlrpc_port: int = 0,
    tcpros_port: int = 0,
) -> None:
    """Makes this process a node.

    Args:
        name: Name of the node, without a namespace.
        argv: Command line with remappings (default `sys.argv`).
        anonymous: Adds a suffix, so that the program can run more than once.
        log_level: Lowest level of the log: `rospy.DEBUG` to `rospy.FATAL`.
        disable_rostime: Uses the wall clock, whatever `/use_sim_time` says.
        disable_rosout: Does not publish the log.
        disable_signals: Leaves SIGINT and SIGTERM alone.
        xmlrpc_port: Ignored.
        tcpros_port: Ignored.

    Raises:
        ROSInitException: The node cannot be made.
        ROSException: It exists, with other arguments.
    """
    if not name:
        raise ValueError("name must not be empty")
    if names.SEP in name:
        raise ValueError("namespaces are not allowed in node names")
    state = core.state
    arguments = (name, tuple(argv or ()), anonymous, log_level, disable_rostime, disable_signals)
    with state.lock:
        if state.is_initialized:
            if arguments != state.init_arguments:
                raise ROSException(
                    f"rospy.init_node() has already been called with different arguments: {state.init_arguments}"
                )
            return
        state.init_arguments = arguments
        words = sys.argv if argv is None else argv
        names._names.mappings = names.load_mappings(words)
        mappings = names._names.mappings
        if "__name" in mappings:
            name = mappings["__name"]
        elif anonymous and not _waiting.in_lockstep():
            name = names.anonymous_name(name)
        namespace = mappings.get("__ns", os.environ.get("ROS_NAMESPACE", "/"))
        _make_node(name, namespace, words)
        if log_level is not None:
            if not isinstance(log_level, int):
                raise TypeError(f"log_level must be rospy.DEBUG, INFO, WARN, ERROR or FATAL, not {log_level!r}")
            set_level(log_level)
        _load_parameters(words)
        state.dispatcher = Dispatcher(state.graph)
        state.is_initialized = True
        parameters.start()
    if not disable_signals:
        core.register_signals()
    core.register_exit()
    _start_time(disable_rostime)
    if not disable_rosout:
        _start_rosout()
    while state.waiting:
        state.waiting.pop(0)()


def _make_node(name: str, namespace: str, words: list[str]) -> None:
    from rospy._native import open_graph

    ros_words = words[words.index("--ros-args") + 1 :] if "--ros-args" in words else []
    if "--" in ros_words:
        ros_words = ros_words[: ros_words.index("--")]
    state = core.state
    try:
        state.graph = open_graph(ros_words)
        state.node = state.graph.node(name, "/" + namespace.strip("/") if namespace.strip("/") else "")
    except ValueError as error:
        raise ROSInitException(f"node {name!r} cannot be made: {error}") from None
    state.pid = os.getpid()
    # A node without a namespace has `/`.
    names.initialize_mappings(f"{state.node.namespace.rstrip('/')}/{state.node.name}")
    names._names.namespace = names._with_slashes(state.node.namespace)


def _load_parameters(words: list[str]) -> None:
    tree = parameters.tree
    tree.load_environment()
    given = {**core.state.node.parameters(), **load_command_line_node_params(words)}
    for key, value in given.items():
        tree.set(names.resolve_name("~" + key), value, core.get_name())


def _start_time(disable_rostime: bool) -> None:
    rostime.clock.is_initialized = True
    graph = core.state.graph
    if disable_rostime or graph.is_lockstep:
        return
    tree = parameters.tree
    for name in ("/use_sim_time", names.resolve_name("~use_sim_time")):
        try:
            wanted = tree.get(name)
        except KeyError:
            continue
        if wanted:
            rostime.clock.sim_ns = 0
            assert core.state.dispatcher is not None
            core.state.dispatcher.add(_ClockSource())
            return


class _ClockSource(Source):
    """Reception of `/clock`."""

    def __init__(self) -> None:
        super().__init__()
        import rosgraph_msgs.msg  # noqa: F401

        self._reader = Reader("/clock", "rosgraph_msgs/msg/Clock", 1)

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        messages = self._reader.poll()
        self.wake_ns = self._reader.wake_ns
        if messages:
            stamp = messages[-1][0]._clock
            rostime.clock.sim_ns = stamp._sec * _NS + stamp._nanosec
            core.state.graph.wake()
        return []


def _start_rosout() -> None:
    if not core.state.node.logs_to_rosout:
        return
    from rcl_interfaces.msg import Log

    log.message_class = Log
    log.publisher = core.state.node.publisher(
        "/rosout", "rcl_interfaces/msg/Log", qos(1000, durability="transient_local")
    )


def spin() -> None:
    """Waits until the node shuts down. Callbacks run in other threads meanwhile.

    Raises:
        ROSInitException: `init_node()` has not been called.
    """
    if not core.is_initialized():
        raise ROSInitException("client code must call rospy.init_node() first")
    core.logdebug("node[%s, pid[%s] entering spin()", core.get_name(), os.getpid())
    try:
        core.wait_events(lambda: core.state.is_shutdown)
    except ROSInterruptException:
        return
    except KeyboardInterrupt:
        core.logdebug("keyboard interrupt, shutting down")
        core.signal_shutdown("keyboard interrupt")


on_shutdown = core.add_client_shutdown_hook


# ---- the graph


def get_published_topics(namespace: str = "/") -> list[list[str]]:
    """Topics with a publisher: pairs of name and type."""
    core.require_init()
    from periplus.ros._genpy_types import type_in_ros1

    prefix = namespace.rstrip("/") + "/"
    graph = core.state.graph
    return [
        [name, type_in_ros1(types[0])]
        for name, types in graph.topics()
        if name.startswith(prefix) and types and not name.startswith("/_") and graph.endpoints(name, True)
    ]


def get_node_uri() -> str | None:
    """A name for this node, in place of its address."""
    return f"rosrpc:/{core.get_name()}" if core.is_initialized() else None


def get_ros_root(required: bool = False, env: Any = None) -> str | None:
    return (env or os.environ).get("ROS_ROOT")


def get_master(env: Any = None) -> Any:
    """Answers for the functions of a master that programs call."""
    from rospy.msproxy import MasterProxy

    return MasterProxy()


