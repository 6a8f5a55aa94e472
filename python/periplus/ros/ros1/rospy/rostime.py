"""Time of the node: the wall clock, `/clock`, or the clock of the simulation that this process is a part of."""

from __future__ import annotations

import time
from typing import Any

import genpy
from periplus.ros import _waiting

from rospy.exceptions import ROSInitException


class _Clock:
    """Source of the time."""

    def __init__(self) -> None:
        self.is_initialized = False
        #: Last time of `/clock` [ns], or None without use_sim_time.
        self.sim_ns: int | None = None


clock = _Clock()


class Duration(genpy.Duration):
    """Span of time in seconds and nanoseconds."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Duration[{self.to_nsec()}]"


class Time(genpy.Time):
    """Point in time; `Time.now()` is the time of the node."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"rospy.Time[{self.to_nsec()}]"

    @staticmethod
    def _duration_class() -> type[genpy.Duration]:
        return Duration

    @staticmethod
    def now() -> Time:
        """Current time of the node: simulated time if there is any."""
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> Any:
        return cls.from_sec(float_secs)


def now_ns() -> int:
    """Current time of the node [ns]. The wall clock before `init_node()`."""
    if clock.sim_ns is not None and not _waiting.has_ended():
        _waiting.poll()
        return clock.sim_ns
    from rospy.core import state

    if state.graph is None:
        return time.time_ns()
    return _waiting.now_ns(state.graph)


def is_simulated() -> bool:
    """True if time comes from `/clock` or from a simulation."""
    from rospy.core import state

    return clock.sim_ns is not None or (state.graph is not None and state.graph.is_lockstep)


def is_rostime_initialized() -> bool:
    """True once there is a time."""
    return clock.is_initialized


def is_wallclock() -> bool:
    """True if the time of the node is that of the machine."""
    return not is_simulated()


def get_rostime() -> Time:
    """Current time of the node.

    Raises:
        ROSInitException: `init_node()` has not been called.
    """
    if not clock.is_initialized:
        raise ROSInitException("time is not initialized. Have you called init_node()?")
    return Time(*divmod(now_ns(), 10**9))


def get_time() -> float:
    """Current time of the node [s]."""
    return get_rostime().to_sec()


def wallsleep(duration: float) -> None:
    """Sleeps by the clock of the machine."""
    time.sleep(max(0.0, duration))


def set_rostime_initialized(value: bool) -> None:
    clock.is_initialized = value


def switch_to_wallclock() -> None:
    """Takes the time of the machine from now on."""
    clock.sim_ns = None
    clock.is_initialized = True
