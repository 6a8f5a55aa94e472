"""Filters that collect messages of several inputs."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import Any

from periplus.ros import _waiting

from message_filters._filters import SimpleFilter, stamp_of

_Queue = dict[int, Any]


class TimeSynchronizer(SimpleFilter):
    """Passes on messages with exactly equal stamps, one of each input."""

    def __init__(self, fs: Sequence[Any], queue_size: int) -> None:
        super().__init__()
        self.queue_size = queue_size
        self.lock = _waiting.RLock()
        self.connectInput(fs)

    def connectInput(self, fs: Sequence[Any]) -> None:  # noqa: N802
        """Takes the messages of filters."""
        self.queues: list[_Queue] = [{} for _ in fs]
        self.input_connections = [
            one.registerCallback(self.add, queue, index) for index, (one, queue) in enumerate(zip(fs, self.queues))
        ]

    def add(self, msg: Any, my_queue: _Queue, my_queue_index: int | None = None) -> None:
        """Adds a message to the queue of its input."""
        stamp: Any = stamp_of(msg, True)
        with self.lock:
            self._insert(my_queue, stamp.nanoseconds, msg)
            for time in sorted(set.intersection(*(set(queue) for queue in self.queues))):
                messages = [queue.pop(time) for queue in self.queues]
                self.signalMessage(*messages)

    def _insert(self, queue: _Queue, time_ns: int, msg: Any) -> None:
        queue[time_ns] = msg
        while len(queue) > self.queue_size:
            del queue[min(queue)]


class ApproximateTimeSynchronizer(TimeSynchronizer):
    """Passes on messages whose stamps differ by less than `slop` [s], one of each input.

    As in the Python module of ROS: at each message, the nearest ones of the other inputs are tried.
    """

    def __init__(self, fs: Sequence[Any], queue_size: int, slop: float, allow_headerless: bool = False) -> None:
        super().__init__(fs, queue_size)
        from rclpy.duration import Duration

        self.slop = Duration(seconds=slop)
        self.allow_headerless = allow_headerless

    def add(self, msg: Any, my_queue: _Queue, my_queue_index: int | None = None) -> None:
        """Adds a message to the queue of its input."""
        stamp = stamp_of(msg, self.allow_headerless)
        if stamp is None:
            return
        now_ns, slop_ns = stamp.nanoseconds, self.slop.nanoseconds
        with self.lock:
            self._insert(my_queue, now_ns, msg)
            candidates: list[list[int]] = []
            for index, queue in enumerate(self.queues):
                if index == my_queue_index:
                    candidates.append([now_ns])
                    continue
                near = [time for time in queue if abs(time - now_ns) <= slop_ns]
                if not near:
                    return
                candidates.append(sorted(near, key=lambda time: abs(time - now_ns)))
            for times in itertools.product(*candidates):
                if max(times) - min(times) >= slop_ns:
                    continue
                if all(time in queue for time, queue in zip(times, self.queues)):
                    self.signalMessage(*(queue[time] for time, queue in zip(times, self.queues)))
                    for time, queue in zip(times, self.queues):
                        del queue[time]
                    break
