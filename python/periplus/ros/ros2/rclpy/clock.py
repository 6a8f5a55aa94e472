"""Clocks, jumps of time, and sleeping."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Any

from periplus.ros import _waiting

from rclpy._clock_source import look, source
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time, _make
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.context import Context


class ClockChange(IntEnum):
    """Change of the source of a clock at a jump."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class JumpThreshold:
    """Jumps that a callback wants to know about.

    Args:
        min_forward: Shortest jump forward, or None for none.
        min_backward: Shortest jump back as a negative duration, or None for none.
        on_clock_change: Also when simulated time is switched on or off (default True).
    """

    def __init__(
        self, *, min_forward: Duration | None, min_backward: Duration | None, on_clock_change: bool = True
    ) -> None:
        if min_forward is not None and min_forward.nanoseconds <= 0:
            raise ValueError("min_forward must be a positive non-zero duration")
        if min_backward is not None and min_backward.nanoseconds >= 0:
            raise ValueError("min_backward must be a negative non-zero duration")
        if min_forward is None and min_backward is None and not on_clock_change:
            raise ValueError("At least one jump threshold must be enabled")
        self.min_forward = min_forward
        self.min_backward = min_backward
        self.on_clock_change = on_clock_change

    def _is_met(self, change: ClockChange, delta_ns: int) -> bool:
        if change in (ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED):
            return self.on_clock_change
        if delta_ns > 0:
            return self.min_forward is not None and delta_ns >= self.min_forward.nanoseconds
        return delta_ns < 0 and self.min_backward is not None and delta_ns <= self.min_backward.nanoseconds


class TimeJump:
    """One jump of a clock."""

    def __init__(self, clock_change: ClockChange, delta: Duration) -> None:
        self._clock_change = clock_change
        self._delta = delta

    @property
    def clock_change(self) -> ClockChange:
        """Kind of the change."""
        return self._clock_change

    @property
    def delta(self) -> Duration:
        """Distance of the jump; negative for a jump back."""
        return self._delta


class JumpHandle:
    """Callbacks for the jumps of a clock, until `unregister()`. The clock keeps no reference to it."""

    def __init__(
        self,
        *,
        clock: Clock,
        threshold: JumpThreshold,
        pre_callback: Callable[[], Any] | None,
        post_callback: Callable[[TimeJump], Any] | None,
    ) -> None:
        if pre_callback is None and post_callback is None:
            raise ValueError("One of pre_callback or post_callback must be callable")
        if pre_callback is not None and not callable(pre_callback):
            raise ValueError("pre_callback must be callable if given")
        if post_callback is not None and not callable(post_callback):
            raise ValueError("post_callback must be callable if given")
        self._clock: Clock | None = clock
        self._threshold = threshold
        self._pre_callback = pre_callback
        self._post_callback = post_callback
        clock._jump_handles.append(self)

    def unregister(self) -> None:
        """Ends the calls."""
        clock, self._clock = self._clock, None
        if clock is not None:
            clock._jump_handles.remove(self)

    def __enter__(self) -> JumpHandle:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        self.unregister()


class Clock:
    """Clock of one kind. `Clock(clock_type=ClockType.ROS_TIME)` makes a `ROSClock`."""

    # False while only its setter moves the clock, so that no timeout can be computed from it.
    _runs_by_itself = True
    _clock_type: ClockType
    _now_ns: Callable[[], int]
    _jump_handles: list[JumpHandle]
    # Called with (change, delta) at each jump, for timers and sleepers.
    _observers: list[Callable[[ClockChange, int], None]]

    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Any:
        if not isinstance(clock_type, ClockType):
            raise TypeError("Clock type must be a ClockType enum")
        made = super().__new__(ROSClock if clock_type is ClockType.ROS_TIME else cls)
        made._clock_type = clock_type
        made._jump_handles = []
        made._observers = []
        made._now_ns = made._steady if clock_type is ClockType.STEADY_TIME else made._system
        return made

    def __init__(self, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> None:
        super().__init__()

    @staticmethod
    def _system() -> int:
        return source.system_ns()

    @staticmethod
    def _steady() -> int:
        return source.steady_ns()

    @property
    def clock_type(self) -> ClockType:
        """Kind of the clock."""
        return self._clock_type

    @property
    def handle(self) -> Clock:
        """The clock itself."""
        return self

    def __repr__(self) -> str:
        return f"Clock(clock_type={self._clock_type.name})"

    def now(self) -> Time:
        """The current time."""
        if source.lockstep_graph is not None:
            look()
        return _make(self._now_ns(), self._clock_type)

    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Callable[[], Any] | None = None,
        post_callback: Callable[[TimeJump], Any] | None = None,
    ) -> JumpHandle:
        """Calls functions before and after jumps of the clock. Returns a handle to end that."""
        return JumpHandle(clock=self, threshold=threshold, pre_callback=pre_callback, post_callback=post_callback)

    def _ros_time_is_active(self) -> bool:
        return False

    # ---- sleeping

    def sleep_until(self, until: Time, context: Context | None = None) -> bool:
        """Blocks until the clock shows `until`.

        Returns False if the context is shut down, or simulated time switched, before. Raises `ValueError` for a time
        of another kind of clock, and `NotInitializedException` before `init`.
        """
        context = get_default_context() if context is None else context
        if not context._valid:
            raise NotInitializedException
        if until.clock_type is not self._clock_type:
            raise ValueError("until's clock type does not match this clock's type")
        graph = context._use()
        until_ns = until.nanoseconds
        active = self._ros_time_is_active()
        while True:
            seen = graph.events
            if not context._valid or self._ros_time_is_active() is not active:
                return False
            left = until_ns - self._now_ns()
            if left <= 0:
                return True
            _waiting.wait(graph, seen, left if self._runs_by_itself else None)

    def sleep_for(self, rel_time: Duration, context: Context | None = None) -> bool:
        """Blocks for a duration of this clock. Returns as `sleep_until` does."""
        return self.sleep_until(self.now() + rel_time, context)


class ROSClock(Clock):
    """Clock that shows simulated time while that is active, else system time."""

    _override_ns = 0
    _active = False

    def __new__(cls, *, clock_type: ClockType = ClockType.ROS_TIME) -> Any:
        return super().__new__(cls, clock_type=ClockType.ROS_TIME)

    def __init__(self, *, clock_type: ClockType = ClockType.ROS_TIME) -> None:
        super().__init__(clock_type=clock_type)

    @property
    def ros_time_is_active(self) -> bool:
        """True while the clock shows simulated time."""
        return self._active

    def _ros_time_is_active(self) -> bool:
        return self._active

    def _overridden(self) -> int:
        return self._override_ns

    def _set_ros_time_is_active(self, enabled: bool) -> None:
        """Switches simulated time on or off."""
        enabled = bool(enabled)
        if enabled == self._active:
            return
        change = ClockChange.ROS_TIME_ACTIVATED if enabled else ClockChange.ROS_TIME_DEACTIVATED
        handles = self._before_jump(change, 0)
        before_ns = self._now_ns()
        self._active = enabled
        # In lockstep the graph's time is simulated time: no topic is needed.
        overrides = enabled and source.lockstep_graph is None
        self._now_ns = self._overridden if overrides else self._system
        self._runs_by_itself = not overrides
        self._after_jump(handles, change, 0, before_ns)

    def set_ros_time_override(self, time: Time) -> None:
        """Sets the simulated time."""
        if not isinstance(time, Time):
            raise TypeError(f"Time must be specified as rclpy.time.Time. Received type: {type(time)}")
        self._set_override_ns(time.nanoseconds)

    def _set_override_ns(self, time_ns: int) -> None:
        before_ns = self._override_ns
        if not self._active or time_ns == before_ns:
            self._override_ns = time_ns
            return
        delta_ns = time_ns - before_ns
        handles = self._before_jump(ClockChange.ROS_TIME_NO_CHANGE, delta_ns) if self._jump_handles else []
        self._override_ns = time_ns
        self._after_jump(handles, ClockChange.ROS_TIME_NO_CHANGE, delta_ns, before_ns)

    def _before_jump(self, change: ClockChange, delta_ns: int) -> list[JumpHandle]:
        handles = [handle for handle in self._jump_handles if handle._threshold._is_met(change, delta_ns)]
        for handle in handles:
            if handle._pre_callback is not None:
                handle._pre_callback()
        return handles

    def _after_jump(self, handles: list[JumpHandle], change: ClockChange, delta_ns: int, before_ns: int) -> None:
        for observer in list(self._observers):
            observer(change, before_ns)
        if handles:
            jump = TimeJump(change, Duration(nanoseconds=delta_ns))
            for handle in handles:
                if handle._post_callback is not None:
                    handle._post_callback(jump)


__all__ = [
    "Clock",
    "ClockChange",
    "ClockType",
    "Duration",
    "JumpHandle",
    "JumpThreshold",
    "ROSClock",
    "Time",
    "TimeJump",
]


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
