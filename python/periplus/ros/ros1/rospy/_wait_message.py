"""Waiting for one message of a topic."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import genpy
from periplus.ros import _waiting

from rospy import core, names
from rospy._dispatch import Source
from rospy._reader import Reader
from rospy.exceptions import ROSException, ROSInterruptException

_NS = 10**9
#: Time for which the subscription of `wait_for_message` stays open for the next call [ns].
_KEPT_NS = 2 * _NS

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
    name = core.live_node().resolve(names.remap_name(topic))
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
