"""Topics by name."""

from __future__ import annotations

from typing import Any

import genpy
import rospy
from rospy import core


class ROSTopicException(Exception):
    """A topic that cannot be asked for."""


def get_topic_type(topic: str, blocking: bool = False) -> tuple[str | None, str | None, Any]:
    """Type and full name of a topic; None without it."""
    core.require_init()
    from periplus.ros._genpy_types import type_in_ros1

    name = rospy.resolve_name(topic)

    def find() -> str | None:
        return next((types[0] for one, types in core.state.graph.topics() if one == name and types), None)

    if blocking:
        core.wait_events(lambda: find() is not None)
    else:
        core.wait_events(lambda: find() is not None, 500_000_000)
    found = find()
    return (None, None, None) if found is None else (type_in_ros1(found), name, None)


def get_topic_class(topic: str, blocking: bool = False) -> tuple[Any, str | None, Any]:
    """Message class and full name of a topic; None without it."""
    type_name, name, function = get_topic_type(topic, blocking)
    if type_name is None:
        return None, None, None
    found = genpy.get_message_class(type_name)
    if found is None:
        raise ROSTopicException(f"Cannot load message class for [{type_name}]. Is its package beside yours?")
    return found, name, function


def find_by_type(topic_type: str) -> list[str]:
    """Names of the topics of a type."""
    return [name for name, one in rospy.get_published_topics() if one == topic_type]


class ROSTopicHz:
    """Rate of a topic: `callback_hz` is the callback of a subscriber."""

    def __init__(self, window_size: int, filter_expr: Any = None, use_wtime: bool = False) -> None:
        self.window_size = window_size if window_size >= 0 else 50000
        self.times: list[float] = []
        self._last: float | None = None

    def callback_hz(self, m: Any, topic: str | None = None) -> None:
        now = rospy.get_time()
        if self._last is not None:
            self.times.append(now - self._last)
            del self.times[: -self.window_size]
        self._last = now

    def get_hz(self, topic: str | None = None) -> tuple[float, float, float, float, int] | None:
        """Rate [Hz], shortest, longest and standard deviation of the periods [s], number of them."""
        if not self.times:
            return None
        count = len(self.times)
        mean = sum(self.times) / count
        deviation = (sum((one - mean) ** 2 for one in self.times) / count) ** 0.5
        return (1.0 / mean if mean > 0 else 0.0), min(self.times), max(self.times), deviation, count + 1
