"""Filters with one input."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable
from typing import Any

_HEADERLESS = (
    "can not use message filters messages without timestamp infomation when 'allow_headerless' is disabled. "
    "auto assign ROSTIME to headerless messages once enabling constructor option of 'allow_headerless'."
)


class SimpleFilter:
    """Passes messages on to callbacks."""

    def __init__(self) -> None:
        self.callbacks: dict[int, tuple[Callable[..., Any], tuple[Any, ...]]] = {}

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:  # noqa: N802
        """Registers a callback, which is called with the messages and `args`."""
        connection = len(self.callbacks)
        self.callbacks[connection] = (cb, args)
        return connection

    def signalMessage(self, *msg: Any) -> None:  # noqa: N802
        """Calls the callbacks."""
        for callback, args in list(self.callbacks.values()):
            callback(*(msg + args))


class Subscriber(SimpleFilter):
    """Subscription to a topic: `Subscriber(node, Type, topic)`, with the keywords of `create_subscription`."""

    def __init__(self, node: Any, msg_type: Any, topic: str, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.node = node
        self.topic = topic
        qos = args[0] if args else kwargs.pop("qos_profile", 10)
        self.sub = node.create_subscription(msg_type, topic, self.callback, qos, *args[1:], **kwargs)

    def callback(self, msg: Any) -> None:
        """Passes a message on."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802
        """Name of the topic."""
        return self.topic

    def unregister(self) -> None:
        """Ends the subscription."""
        self.node.destroy_subscription(self.sub)

    def __getattr__(self, name: str) -> Any:
        if name in ("node", "sub"):
            raise AttributeError(name)
        return getattr(self.sub, name)


class Chain(SimpleFilter):
    """Filters one after another."""

    def __init__(self, *filters: Any) -> None:
        super().__init__()
        self.filters: list[Any] = []
        for one in filters:
            self.addFilter(one)

    def addFilter(self, one: Any) -> int:  # noqa: N802
        """Adds a filter behind the last one."""
        if self.filters:
            self.filters[-1].registerCallback(one.add)
        self.filters.append(one)
        return len(self.filters) - 1

    def getFilter(self, index: int) -> Any:  # noqa: N802
        """Filter at a position."""
        return self.filters[index]

    def registerCallback(self, cb: Callable[..., Any], *args: Any) -> int:  # noqa: N802
        """Registers a callback for the messages that pass all filters."""
        connection: int = self.filters[-1].registerCallback(cb, *args)
        return connection


def stamp_of(msg: Any, allow_headerless: bool) -> Any:
    """Time of a message; that of now for one without a header, None if that is not allowed."""
    from rclpy.clock import ROSClock
    from rclpy.time import Time

    header = getattr(msg, "header", None)
    if header is not None and hasattr(header, "stamp"):
        stamp = header.stamp
        return stamp if hasattr(stamp, "nanoseconds") else Time.from_msg(stamp)
    if allow_headerless:
        return ROSClock().now()
    from rclpy.logging import get_logger

    get_logger("message_filters_cache").warning(_HEADERLESS)
    return None


class Cache(SimpleFilter):
    """The last messages of a filter, sorted by their stamps."""

    def __init__(self, f: Any = None, cache_size: int = 1, allow_headerless: bool = False) -> None:
        super().__init__()
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Any] = []
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        if f is not None:
            self.connectInput(f)

    def connectInput(self, f: Any) -> None:  # noqa: N802
        """Takes the messages of a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Adds a message."""
        stamp = stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        if len(self.cache_times) >= self.cache_size:
            del self.cache_msgs[0]
            del self.cache_times[0]
        index = bisect_right(self.cache_times, stamp)
        self.cache_msgs.insert(index, msg)
        self.cache_times.insert(index, stamp)
        self.signalMessage(msg)

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:  # noqa: N802
        """Messages from one time to another."""
        assert from_stamp <= to_stamp
        first, last = bisect_left(self.cache_times, from_stamp), bisect_right(self.cache_times, to_stamp)
        return self.cache_msgs[first:last]

    def getElemAfterTime(self, stamp: Any) -> Any:  # noqa: N802
        """Oldest message at or after a time, or None."""
        index = bisect_left(self.cache_times, stamp)
        return self.cache_msgs[index] if index < len(self.cache_msgs) else None

    def getElemBeforeTime(self, stamp: Any) -> Any:  # noqa: N802
        """Newest message at or before a time, or None."""
        index = bisect_right(self.cache_times, stamp)
        return self.cache_msgs[index - 1] if index else None

    def getLastestTime(self) -> Any:  # noqa: N802
        """Time of the newest message, or None."""
        return self.cache_times[-1] if self.cache_times else None

    getLatestTime = getLastestTime  # noqa: N815

    def getOldestTime(self) -> Any:  # noqa: N802
        """Time of the oldest message, or None."""
        return self.cache_times[0] if self.cache_times else None

    def getLast(self) -> Any:  # noqa: N802
        """Newest message, or None."""
        return self.cache_msgs[-1] if self.cache_msgs else None
