"""Kinds of clocks."""

from enum import IntEnum


class ClockType(IntEnum):
    """Source of the time of a clock."""

    UNINITIALIZED = 0
    #: Time of the simulation if `use_sim_time` is set, else system time.
    ROS_TIME = 1
    SYSTEM_TIME = 2
    #: Monotonic time since an arbitrary start.
    STEADY_TIME = 3
