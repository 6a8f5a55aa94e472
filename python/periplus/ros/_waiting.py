"""Clock readings and waits of the ROS modules: they block a thread nowhere else.

Live, each function is the plain operation. In lockstep, the same call hands the turn to the scheduler
(`periplus.ros._lockstep`), which lets simulated time advance once every thread of the process is blocked here.
"""

from __future__ import annotations

import os
import threading
import time
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable


class Graph(Protocol):
    """The part of `RosGraph` that waiting needs."""

    @property
    def events(self) -> int: ...
    def wait(self, seen: int, timeout_ns: int | None) -> int: ...
    def now_ns(self) -> int: ...
    def steady_ns(self) -> int: ...


class Scheduler(Protocol):
    """The lockstep scheduler as this module sees it."""

    has_ended: bool

    def now_ns(self) -> int: ...
    def wait(self, graph: Graph, seen: int, timeout_ns: int | None) -> int: ...
    def sleep_ns(self, duration_ns: int) -> None: ...
    def poll(self) -> None: ...
    def round_of_loop(self) -> None: ...


_scheduler: Scheduler | None = None
_link: str | None = None


def in_lockstep() -> bool:
    """True while this process runs in step with a simulation."""
    return _scheduler is not None


def has_ended() -> bool:
    """True once the simulation has ended: its time stands, and the program's own sleeps advance a time of its own."""
    return _scheduler is not None and _scheduler.has_ended


def link() -> str | None:
    """Address of the simulation for `RosGraph(link=...)`, or None for a live graph."""
    return _link if _scheduler is not None else os.environ.get("PERIPLUS_LOCKSTEP")


def wait(graph: Graph, seen: int, timeout_ns: int | None = None) -> int:
    """Blocks until `graph.events` differs from `seen`, or for `timeout_ns` [ns] (None: no limit, 0: no blocking).

    Returns the counter. An arrival counts from the moment of the call: read `graph.events`, look for work, then wait.
    """
    scheduler = _scheduler
    if scheduler is None:
        return graph.wait(seen, timeout_ns)
    return scheduler.wait(graph, seen, timeout_ns)


def sleep_ns(graph: Graph | None, duration_ns: int) -> None:
    """Blocks this thread for `duration_ns` [ns] of steady time. `graph` may be None."""
    scheduler = _scheduler
    if scheduler is None:
        if duration_ns > 0:
            time.sleep(duration_ns / 1e9)
    else:
        scheduler.sleep_ns(duration_ns)


def poll() -> None:
    """Marks one look at something that another thread changes (`rclpy.ok()`, `future.done()`, a clock reading).

    Costs nothing live. In lockstep, a loop of such looks without a wait would stop time for ever: after 1000 of them
    the thread waits for 1 ms of simulated time, and then after each 100.
    """
    if _scheduler is not None:
        _scheduler.poll()


def round_of_loop() -> None:
    """Marks one round of a loop that may wait for another thread: 100 of them count as one look (see `poll`)."""
    if _scheduler is not None:
        _scheduler.round_of_loop()


def now_ns(graph: Graph) -> int:
    """System time [ns] for user code; counts as one look (see `poll`)."""
    if _scheduler is not None:
        _scheduler.poll()
        if _scheduler.has_ended:
            return _scheduler.now_ns()
    return graph.now_ns()


def steady_ns(graph: Graph) -> int:
    """Steady time [ns] for user code; counts as one look (see `poll`)."""
    if _scheduler is not None:
        _scheduler.poll()
        if _scheduler.has_ended:
            return _scheduler.now_ns()
    return graph.steady_ns()


def Lock() -> threading.Lock:  # noqa: N802
    """A lock that other threads may wait for, also in lockstep."""
    return threading.Lock()


def RLock() -> threading.RLock:  # noqa: N802
    """A reentrant lock that other threads may wait for, also in lockstep."""
    return threading.RLock()


def Condition(lock: threading.Lock | None = None) -> threading.Condition:  # noqa: N802
    """A condition variable; its timeouts are simulated time in lockstep."""
    return threading.Condition(lock)


def Event() -> threading.Event:  # noqa: N802
    """An event; its timeouts are simulated time in lockstep."""
    return threading.Event()


def start_thread(function: Callable[[], object], name: str, *, daemon: bool = True) -> threading.Thread:
    """Starts a thread that takes part in lockstep."""
    thread = threading.Thread(target=function, name=name, daemon=daemon)
    thread.start()
    return thread
