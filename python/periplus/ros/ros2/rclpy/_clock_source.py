"""System and steady time [ns]: of the machine, or of the simulation in lockstep."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy._native import RosGraph


class _Source:
    """The functions that read the clocks."""

    __slots__ = ("system_ns", "steady_ns", "lockstep_graph")

    def __init__(self) -> None:
        self.system_ns: Callable[[], int] = time.time_ns
        self.steady_ns: Callable[[], int] = time.monotonic_ns
        self.lockstep_graph: RosGraph | None = None


source = _Source()


def follow(graph: RosGraph) -> None:
    """Takes the time of `graph` if it is in lockstep."""
    if graph.is_lockstep:
        source.lockstep_graph = graph
        source.system_ns = graph.now_ns
        source.steady_ns = graph.steady_ns


def look() -> None:
    """Marks one look of the program at a clock or a flag: in lockstep, a loop of nothing else must not stop time."""
    if source.lockstep_graph is not None:
        from periplus.ros import _waiting

        _waiting.poll()
