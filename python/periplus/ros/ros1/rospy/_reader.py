"""Reception of a topic from publishers of any quality of service, as ROS 1 programs expect it.

A subscriber of ROS 1 hears every publisher, and the last message of a latched one. On the wire these differ: best-effort
publishers are heard by best-effort subscribers alone, old messages come to transient-local ones alone. A reader therefore
watches who publishes, keeps one native subscription or two, and drops what arrives twice.
"""

from __future__ import annotations

from typing import Any

from rospy import core

_RELIABLE, _BEST_EFFORT = "reliable", "best_effort"
_CHECK_INTERVAL_NS = 50_000_000
_SLOW_INTERVAL_NS = 500_000_000
#: Number of checks after which they become slow.
_FAST_CHECKS = 40
#: Number of messages that are remembered to recognize duplicates.
_REMEMBERED = 512
DEFAULT_DEPTH = 1000


def qos(depth: int, reliability: str = _RELIABLE, durability: str = "volatile") -> tuple[Any, ...]:
    """Quality of service for the native module."""
    return ("keep_last", max(1, depth), reliability, durability, None, None, "automatic", None)


class Reader:
    """Messages of one topic."""

    def __init__(self, topic: str, type_name: str, depth: int = DEFAULT_DEPTH, *, raw: bool = False) -> None:
        self.topic = topic
        self.type_name = type_name
        self._depth = depth
        self._raw = raw
        self._kind = _RELIABLE
        self._base = self._open(_RELIABLE, "volatile")
        self._latched: Any = None
        self._counts: dict[tuple[int, int], dict[int, int]] = {}
        self._given: dict[tuple[int, int], int] = {}
        self._checks = 0
        self._checked_ns = -_CHECK_INTERVAL_NS
        self._closed = False
        #: Steady time [ns] of the next look at the publishers; None if none is due.
        self.wake_ns: int | None = None
        self._check()

    def _open(self, reliability: str, durability: str) -> Any:
        settings = qos(self._depth, reliability, durability)
        return core.live_node().subscription(self.topic, self.type_name, settings, style="genpy")

    @property
    def publisher_count(self) -> int:
        """Number of publishers that this reader hears."""
        if self._closed:
            return 0
        return int(self._base.publisher_count)

    def _check(self) -> list[Any]:
        """Looks who publishes and changes the subscriptions; returns what a closed one still had."""
        self._checks += 1
        self._checked_ns = core.state.graph.steady_ns()
        self.wake_ns = None
        publishers = [
            one["qos"]
            for one in core.state.graph.endpoints(self.topic, True)
            if one["topic_type"] == self.type_name
        ]
        left: list[Any] = []
        if any(one[2] == _BEST_EFFORT for one in publishers) and self._kind != _BEST_EFFORT:
            old, self._kind = self._base, _BEST_EFFORT
            self._base = self._open(_BEST_EFFORT, "volatile")
            left = self._drain(old)
            old.close()
        if self._latched is None and any(one[3] == "transient_local" and one[2] != _BEST_EFFORT for one in publishers):
            self._latched = self._open(_RELIABLE, "transient_local")
        return left

    def poll(self) -> list[tuple[Any, int]]:
        """New messages with their source stamps [ns]."""
        if self._closed:
            return []
        found: list[tuple[Any, int]] = []
        now = core.state.graph.steady_ns()
        interval = _CHECK_INTERVAL_NS if self._checks < _FAST_CHECKS else _SLOW_INTERVAL_NS
        if now - self._checked_ns >= interval or self._base.take_events():
            found += self._check()
        else:
            self.wake_ns = self._checked_ns + interval
        found += self._drain(self._base)
        if self._latched is not None:
            found += self._drain(self._latched)
        return found

    def _drain(self, subscription: Any) -> list[tuple[Any, int]]:
        found = []
        while subscription.has_data:
            taken = subscription.take_raw() if self._raw else subscription.take()
            if taken is None:
                break
            message, source_ns, _, number, _ = taken
            if self._is_new(id(subscription), (source_ns, number)):
                found.append((message, source_ns))
        return found

    def _is_new(self, subscription: int, key: tuple[int, int]) -> bool:
        """True for a message that no other subscription of this reader has given yet."""
        counts = self._counts.setdefault(key, {})
        count = counts[subscription] = counts.get(subscription, 0) + 1
        if count <= self._given.get(key, 0):
            return False
        self._given[key] = count
        if len(self._given) > _REMEMBERED:
            oldest = next(iter(self._given))
            del self._given[oldest]
            self._counts.pop(oldest, None)
        return True

    def close(self) -> None:
        """Stops the reception."""
        if not self._closed:
            self._closed = True
            self._base.close()
            if self._latched is not None:
                self._latched.close()
