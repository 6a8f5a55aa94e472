"""Filters of messages: synchronization of topics, caches."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Callable, Sequence
from typing import Any

import genpy
import rospy

__all__ = ["ApproximateTimeSynchronizer", "Cache", "Chain", "SimpleFilter", "Subscriber", "TimeSynchronizer"]


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
    """Subscription to a topic, with the arguments of `rospy.Subscriber`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__()
        self.topic = args[0]
        kwargs["callback"] = self.callback
        self.sub = rospy.Subscriber(*args, **kwargs)

    def callback(self, msg: Any) -> None:
        """Passes a message on."""
        self.signalMessage(msg)

    def getTopic(self) -> str:  # noqa: N802
        """Name of the topic."""
        return str(self.topic)

    def unregister(self) -> None:
        """Ends the subscription."""
        self.sub.unregister()

    def __getattr__(self, name: str) -> Any:
        if name == "sub":
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
        one.registerCallback(self._passed, one)
        self.filters.append(one)
        return len(self.filters) - 1

    def _passed(self, msg: Any, one: Any) -> None:
        if one is self.filters[-1]:
            self.signalMessage(msg)

    def getFilter(self, index: int) -> Any:  # noqa: N802
        """Filter at a position."""
        return self.filters[index]


def _stamp_of(msg: Any, allow_headerless: bool) -> Any:
    """Time of a message; that of now for one without a header, None if that is not allowed."""
    if hasattr(msg, "header") and hasattr(msg.header, "stamp"):
        return msg.header.stamp
    if allow_headerless:
        return rospy.Time.now()
    rospy.logwarn(
        "Cannot use message filters with non-stamped messages. "
        "Use the 'allow_headerless' constructor option to auto-assign ROS time to headerless messages."
    )
    return None


class Cache(SimpleFilter):
    """The last messages of a filter, by their stamps."""

    def __init__(self, f: Any, cache_size: int = 1, allow_headerless: bool = False) -> None:
        super().__init__()
        self.cache_msgs: list[Any] = []
        self.cache_times: list[Any] = []
        self.cache_size = cache_size
        self.allow_headerless = allow_headerless
        self.connectInput(f)

    def connectInput(self, f: Any) -> None:  # noqa: N802
        """Takes the messages of a filter."""
        self.incoming_connection = f.registerCallback(self.add)

    def add(self, msg: Any) -> None:
        """Adds a message."""
        stamp = _stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        while len(self.cache_msgs) >= self.cache_size:
            del self.cache_msgs[0], self.cache_times[0]
        self.cache_msgs.append(msg)
        self.cache_times.append(stamp)
        self.signalMessage(msg)

    def _sorted(self) -> list[tuple[Any, Any]]:
        return sorted(zip(self.cache_times, self.cache_msgs), key=lambda one: one[0].to_nsec())

    def getInterval(self, from_stamp: Any, to_stamp: Any) -> list[Any]:  # noqa: N802
        """Messages between two times, both included."""
        return [msg for stamp, msg in self._sorted() if from_stamp <= stamp <= to_stamp]

    def getElemAfterTime(self, stamp: Any) -> Any:  # noqa: N802
        """Oldest message at or after a time, or None."""
        return next((msg for time, msg in self._sorted() if time >= stamp), None)

    def getElemBeforeTime(self, stamp: Any) -> Any:  # noqa: N802
        """Newest message at or before a time, or None."""
        return next((msg for time, msg in reversed(self._sorted()) if time <= stamp), None)

    def getLastestTime(self) -> Any:  # noqa: N802
        """Newest stamp, or None."""
        return self._sorted()[-1][0] if self.cache_times else None

    getLatestTime = getLastestTime  # noqa: N815

    def getOldestTime(self) -> Any:  # noqa: N802
        """Oldest stamp, or None."""
        return self._sorted()[0][0] if self.cache_times else None

    def getLast(self) -> Any:  # noqa: N802
        """Message with the newest stamp, or None."""
        return self.getElemAfterTime(self.getLastestTime()) if self.cache_times else None


class TimeSynchronizer(SimpleFilter):
    """Passes on messages with exactly equal stamps, one of each input."""

    def __init__(self, fs: Sequence[Any], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.lock = threading.RLock()
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[Any]) -> None:  # noqa: N802
        """Takes the messages of filters."""
        self.queues: list[dict[Any, Any]] = [{} for _ in fs]
        self.input_connections = [
            one.registerCallback(self.add, queue, index) for index, (one, queue) in enumerate(zip(fs, self.queues))
        ]

    def add(self, msg: Any, my_queue: dict[Any, Any], my_queue_index: int | None = None) -> None:
        """Adds a message to the queue of its input."""
        with self.lock:
            self._insert(my_queue, msg.header.stamp, msg)
            for stamp in sorted(set.intersection(*(set(queue) for queue in self.queues))):
                self.signalMessage(*[queue.pop(stamp) for queue in self.queues])

    def _insert(self, queue: dict[Any, Any], stamp: Any, msg: Any) -> None:
        queue[stamp] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on messages whose stamps differ by less than `slop` [s], one of each input."""

    def __init__(
        self,
        fs: Sequence[Any],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
        reset: bool = False,
    ) -> None:
        super().__init__(fs, queue_size)
        self.slop = genpy.Duration.from_sec(slop)
        self.allow_headerless = allow_headerless
        self._reset = reset
        self.last_added = genpy.Time()

    def add(self, msg: Any, my_queue: dict[Any, Any], my_queue_index: int | None = None) -> None:
        """Adds a message, and passes on the nearest ones of the other inputs with it."""
        stamp = _stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        with self.lock:
            if self._reset and stamp < self.last_added:
                for queue in self.queues:
                    queue.clear()
            self.last_added = stamp
            self._insert(my_queue, stamp, msg)
            mine = self.queues.index(my_queue) if my_queue_index is None else my_queue_index
            others = [queue for index, queue in enumerate(self.queues) if index != mine]
            near = []
            for queue in others:
                times = [(abs(time - stamp), time) for time in queue]
                near.append(sorted((one for one in times if one[0] < self.slop), key=lambda one: one[0]))
            for choice in itertools.product(*near):
                stamps = [time for _, time in choice]
                stamps.insert(mine, stamp)
                if max(stamps) - min(stamps) < self.slop and all(
                    time in queue for time, queue in zip(stamps, self.queues)
                ):
                    self.signalMessage(*[queue.pop(time) for time, queue in zip(stamps, self.queues)])
                    return
