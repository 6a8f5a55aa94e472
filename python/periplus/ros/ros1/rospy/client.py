"""Functions of programs: `init_node`, `spin`, parameters, waiting for messages."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any

import genpy
from periplus.ros import _waiting

from rospy import core, names, rostime
from rospy._dispatch import Dispatcher, Source
from rospy._log import DEBUG, ERROR, FATAL, INFO, WARN, log, set_level  # noqa: F401
from rospy._params import service as parameters
from rospy._reader import Reader, qos
from rospy.exceptions import ROSException, ROSInitException, ROSInterruptException
from rospy.timer import Rate, sleep  # noqa: F401

_NS = 10**9
_unset = object()
#: Time for which the subscription of `wait_for_message` stays open for the next call [ns].
_KEPT_NS = 2 * _NS


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


# ---- waiting for messages

_kept: dict[tuple[str, str], tuple[Reader, int]] = {}


class _Keeper(Source):
    """Closes the readers of `wait_for_message` that are no longer used."""

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        self.wake_ns = None
        now = core.state.graph.steady_ns()
        with core.state.lock:
            for key, (reader, until) in list(_kept.items()):
                if now >= until:
                    del _kept[key]
                    reader.close()
                elif self.wake_ns is None or until < self.wake_ns:
                    self.wake_ns = until
        return []


_keeper: _Keeper | None = None


def wait_for_message(topic: str, topic_type: Any, timeout: Any = None) -> Any:
    """Returns the next message of a topic.

    Args:
        topic: Topic.
        topic_type: Message class.
        timeout: Time to wait: seconds or a `Duration`; without one, for ever.

    Raises:
        ROSException: The timeout has passed.
        ROSInterruptException: The node shut down meanwhile.
    """
    global _keeper
    core.require_init()
    if isinstance(timeout, genpy.Duration):
        timeout = timeout.to_sec()
    name = core.state.node.resolve(names.remap_name(topic))
    native_type = topic_type.__type_handle__.type_name
    with core.state.lock:
        kept = _kept.pop((name, native_type), None)
    if kept is not None:
        reader = kept[0]
        # What came between the calls is not the next message.
        reader.poll()
    else:
        reader = Reader(name, native_type, 10)
    found: list[Any] = []

    def has_arrived() -> bool:
        found.extend(reader.poll())
        return bool(found)

    end = None if timeout is None else int(timeout * _NS)
    try:
        arrived = _wait_reader(reader, has_arrived, end)
    except KeyboardInterrupt:
        if core.state.is_shutdown:
            raise ROSInterruptException("rospy shutdown") from None
        raise
    finally:
        if core.state.is_shutdown:
            reader.close()
        else:
            with core.state.lock:
                _kept[name, native_type] = (reader, core.state.graph.steady_ns() + _KEPT_NS)
                if _keeper is None:
                    _keeper = _Keeper()
                    assert core.state.dispatcher is not None
                    core.state.dispatcher.add(_keeper)
            core.state.graph.wake()
    if not arrived:
        raise ROSException(f"timeout exceeded while waiting for message on topic {name}")
    from rospy.msg import received

    header = {"topic": name, "type": topic_type._type, "md5sum": topic_type._md5sum, "callerid": ""}
    return received(found[0][0], topic_type, header)


def _wait_reader(reader: Reader, done: Callable[[], bool], timeout_ns: int | None) -> bool:
    """Waits for a reader, which wants to look at the publishers now and then."""
    graph = core.state.graph
    end = None if timeout_ns is None else _waiting.steady_ns(graph) + timeout_ns
    while True:
        left = None if end is None else end - _waiting.steady_ns(graph)
        if left is not None and left <= 0:
            return done()
        step = left
        if reader.wake_ns is not None:
            until_check = max(1_000_000, reader.wake_ns - graph.steady_ns())
            step = until_check if left is None else min(left, until_check)
        if core.wait_events(done, step):
            return True


# ---- parameters


def get_param(param_name: str, default: Any = _unset) -> Any:
    """Value of a parameter; a dict for a subtree.

    Raises:
        KeyError: It is not set and there is no default.
    """
    name = _parameter(param_name)
    try:
        return parameters.get(name)
    except KeyError:
        if default is _unset:
            raise KeyError(param_name) from None
        return default


def get_param_cached(param_name: str, default: Any = _unset) -> Any:
    """Value of a parameter, as `get_param` returns it."""
    return get_param(param_name, default)


def set_param(param_name: str, param_value: Any) -> None:
    """Sets a parameter in all nodes."""
    parameters.set(_parameter(param_name), param_value)


def has_param(param_name: str) -> bool:
    """True if a parameter is set."""
    return parameters.has(_parameter(param_name))


def delete_param(param_name: str) -> None:
    """Deletes a parameter or a subtree. Raises `KeyError` if it is not set."""
    try:
        parameters.delete(_parameter(param_name))
    except KeyError:
        raise KeyError(param_name) from None


def search_param(param_name: str) -> str | None:
    """Full name of a parameter in the namespace of the node, or in the nearest one around it; None without one."""
    if names.is_global(param_name) or names.is_private(param_name):
        full = _parameter(param_name)
        return full if parameters.has(full) else None
    first, _, _ = param_name.partition("/")
    scope = core.get_name()
    while True:
        if parameters.has(f"{scope}/{first}"):
            return f"{scope}/{param_name}"
        if not scope:
            return None
        scope = scope.rpartition("/")[0]


def get_param_names() -> list[str]:
    """Names of all parameters."""
    return parameters.names()


def _parameter(name: str) -> str:
    if not name:
        raise ValueError("param_name cannot be empty")
    if name.startswith("~") and not core.is_initialized():
        return names.resolve_name(name)
    return names.remap_name(name)


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


