"""Threads that run the callbacks: each subscription one at a time, different ones beside each other.

One thread at a time watches the graph. The thread that finds a message runs its callback itself, after it has handed the
watch to another. Messages start in the order of their source stamps; in lockstep, where one thread runs at a time, that is the
order of the callbacks.
"""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from periplus.ros import _faults, _waiting

from rospy import core, rostime


class Item:
    """One call that waits for a thread."""

    __slots__ = ("function", "order")

    def __init__(self, order: tuple[int, int], function: Callable[[], None]) -> None:
        self.order = order
        self.function = function


class Source:
    """Something that has calls to make: a subscription, a service.

    `poll()` runs in the watching thread and returns pairs of source stamp [ns] and function.
    """

    #: True if one call must end before the next begins.
    serial = True

    def __init__(self) -> None:
        self.items: deque[Item] = deque()
        self.busy = False
        #: Steady time [ns] at which `poll` wants to be called without an arrival, or None.
        self.wake_ns: int | None = None
        #: Number of waiting calls that are kept; the oldest are dropped. None: all.
        self.limit: int | None = None

    def poll(self) -> list[tuple[int, Callable[[], None]]]:
        raise NotImplementedError


class Dispatcher:
    """Threads and sources of a node."""

    def __init__(self, graph: Any) -> None:
        self._graph = graph
        self._condition = threading.Condition()
        self._sources: tuple[Source, ...] = ()
        self._watcher: threading.Thread | None = None
        self._idle = 0
        self._threads = 0
        self._count = 0
        self._closed = False

    def add(self, source: Source) -> None:
        """Adds a source; its calls begin at once."""
        with self._condition:
            self._sources = (*self._sources, source)
            self._ensure_watcher()
        self._graph.wake()

    def remove(self, source: Source) -> None:
        """Removes a source. Calls that wait are dropped; one that runs goes on."""
        with self._condition:
            self._sources = tuple(one for one in self._sources if one is not source)
            source.items.clear()

    def close(self) -> None:
        """Ends all threads once their callbacks return."""
        with self._condition:
            self._closed = True
            self._sources = ()
            self._condition.notify_all()
        self._graph.wake()

    def _ensure_watcher(self) -> None:
        """Gives the watch to an idle or a new thread. Needs the lock."""
        if self._watcher is not None or self._closed:
            return
        if self._idle:
            self._condition.notify()
        else:
            self._threads += 1
            _waiting.start_thread(self._run, f"rospy callbacks {self._threads}")

    def _next(self) -> tuple[Source, Item] | None:
        """Takes the oldest call that may begin. Needs the lock."""
        best: Source | None = None
        for source in self._sources:
            if source.items and not (source.serial and source.busy):
                if best is None or source.items[0].order < best.items[0].order:
                    best = source
        return None if best is None else (best, best.items.popleft())

    def _run(self) -> None:
        me = threading.current_thread()
        condition = self._condition
        with condition:
            while not self._closed:
                found = self._next()
                if found is not None:
                    source, item = found
                    source.busy = True
                    self._ensure_watcher()
                    condition.release()
                    try:
                        item.function()
                    finally:
                        condition.acquire()
                        source.busy = False
                elif self._watcher is None:
                    self._watcher = me
                    condition.release()
                    try:
                        self._watch()
                    except Exception:
                        # The node may close while this thread reads its topics.
                        if not (self._closed or core.is_shutdown_requested()):
                            raise
                        return
                    finally:
                        condition.acquire()
                        self._watcher = None
                else:
                    self._idle += 1
                    condition.wait()
                    self._idle -= 1

    def _watch(self) -> None:
        """Waits until a source has calls."""
        graph = self._graph
        while not self._closed:
            seen = graph.events
            found = False
            wake_ns: int | None = None
            for source in self._sources:
                calls = source.poll()
                if calls:
                    found = True
                    with self._condition:
                        for stamp, function in calls:
                            self._count += 1
                            source.items.append(Item((stamp, self._count), function))
                        if source.limit is not None:
                            while len(source.items) > source.limit:
                                source.items.popleft()
                if source.wake_ns is not None and (wake_ns is None or source.wake_ns < wake_ns):
                    wake_ns = source.wake_ns
            if found:
                return
            # A callback that ended while this thread watched may have left calls of its source.
            with self._condition:
                if any(one.items and not (one.serial and one.busy) for one in self._sources):
                    return
            timeout = None if wake_ns is None else max(1_000_000, wake_ns - graph.steady_ns())
            _waiting.wait(graph, seen, timeout)


def report_fault(callback: Any, kind: str, name: str = "") -> None:
    """Prints the error that a callback has raised, with the node, the topic and the time."""
    import sys

    error = sys.exc_info()[1]
    assert error is not None
    core.logerr("bad callback: %s", callback)
    print_fault(error, kind, name, callback)


def print_fault(error: BaseException, kind: str, name: str = "", callback: Any = None) -> None:
    """Prints an error with the node, the topic and the time."""
    time_ns = rostime.now_ns() if rostime.is_rostime_initialized() else None
    _faults.callback_failed(error, node=core.get_name(), kind=kind, name=name, time_ns=time_ns, callback=callback)
    _faults.print_exception(error)
