"""Timers and rates."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from periplus.ros import _tracebacks, _waiting

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.clock import ClockChange
from rclpy.exceptions import ROSInterruptException
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context


class Timer:
    """Callback that an executor runs each `timer_period_ns` of a clock.

    A timer fires once however many periods were missed, and keeps its phase.
    """

    _kind = "timer"
    _monitor: Any = None

    def __init__(
        self,
        callback: Callable[..., Any] | None,
        callback_group: CallbackGroup,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Context | None = None,
        autostart: bool = True,
    ) -> None:
        from rclpy._rclpy_pybind11 import RCLError

        self._context = get_default_context() if context is None else context
        if timer_period_ns < 0:
            raise RCLError("failed to create timer: timer period must be non-negative")
        self.callback = callback
        self.callback_group = callback_group
        #: Line that has made a timer without a callback, for the error of its first call.
        self._maker = "" if callback is not None else _tracebacks.location(_tracebacks.user_frame(sys._getframe(1)))
        self._clock = clock
        self._period_ns = int(timer_period_ns)
        self._canceled = not autostart
        self._destroyed = False
        now_ns = clock._now_ns()
        self._last_call_ns = now_ns
        self._next_call_ns = now_ns + self._period_ns
        clock._observers.append(self._on_jump)

    # ---- use

    @property
    def clock(self) -> Clock:
        """The clock of the timer."""
        return self._clock

    @property
    def handle(self) -> Timer:
        """The timer itself."""
        return self

    @property
    def timer_period_ns(self) -> int:
        """Period [ns]; a change counts from the next call on."""
        self._check()
        return self._period_ns

    @timer_period_ns.setter
    def timer_period_ns(self, value: float) -> None:
        self._check()
        self._period_ns = int(value)
        if self._monitor is not None:
            self._monitor.period_ns = self._period_ns
        self._wake()

    def is_ready(self) -> bool:
        """True if the callback is due."""
        self._check()
        return not self._canceled and self._next_call_ns <= self._clock._now_ns()

    def is_canceled(self) -> bool:
        """True after `cancel()`."""
        self._check()
        return self._canceled

    def cancel(self) -> None:
        """Stops the timer until `reset()`."""
        self._check()
        self._canceled = True

    def reset(self) -> None:
        """Starts a full period now."""
        self._check()
        now_ns = self._clock._now_ns()
        self._last_call_ns = now_ns
        self._next_call_ns = now_ns + self._period_ns
        self._canceled = False
        self._wake()

    def time_since_last_call(self) -> int:
        """Time [ns] since the last call, or since the start."""
        self._check()
        return self._clock._now_ns() - self._last_call_ns

    def time_until_next_call(self) -> int | None:
        """Time [ns] until the next call, negative if it is overdue; None for a canceled timer."""
        self._check()
        return None if self._canceled else self._next_call_ns - self._clock._now_ns()

    def destroy(self) -> None:
        """Makes the timer unusable. `Node.destroy_timer` does it."""
        if not self._destroyed:
            self._destroyed = True
            self._canceled = True
            if self._on_jump in self._clock._observers:
                self._clock._observers.remove(self._on_jump)

    def _check(self) -> None:
        if self._destroyed:
            raise InvalidHandle

    def _wake(self) -> None:
        graph = self._context._graph
        if graph is not None:
            graph.wake()

    def _on_jump(self, change: ClockChange, before_ns: int) -> None:
        """Keeps the time until the next call when the clock's source changes, and restarts the period after a jump back."""
        now_ns = self._clock._now_ns()
        if change is not ClockChange.ROS_TIME_NO_CHANGE:
            if now_ns == 0:
                return
            credit_ns = self._next_call_ns - before_ns if before_ns else self._period_ns
            self._next_call_ns = now_ns + credit_ns
            self._last_call_ns = self._next_call_ns - self._period_ns
        elif now_ns < self._last_call_ns:
            self._last_call_ns = now_ns
            self._next_call_ns = now_ns + self._period_ns

    # ---- for the executor

    def _full_name(self) -> str:
        return ""

    def _take(self) -> tuple[Any, ...] | None:
        if self._canceled:
            return None
        now_ns = self._clock._now_ns()
        next_ns = self._next_call_ns
        if next_ns > now_ns:
            return None
        period_ns = self._period_ns
        self._last_call_ns = now_ns
        next_ns += period_ns
        if next_ns <= now_ns:
            next_ns = now_ns if period_ns == 0 else next_ns + ((now_ns - next_ns) // period_ns + 1) * period_ns
        self._next_call_ns = next_ns
        return ()

    def _call(self, taken: Any, executor: Any) -> Any:
        callback = self.callback
        if callback is None:
            raise TypeError(f"'NoneType' object is not callable: the timer of {self._maker} has no callback")
        return callback()


class Rate:
    """Sleeps so that a loop runs at a frequency. Another thread must spin the node."""

    def __init__(self, timer: Timer, *, context: Context) -> None:
        self._timer = timer
        self._clock = timer.clock
        self._context = context
        self._graph = context._use()
        self._is_destroyed = False
        # Number of periods that have begun, and the one that the last sleep has ended with.
        self._fired = self._used = 0
        timer.callback = self._on_timer

    def _on_timer(self) -> None:
        self._fired += 1
        self._graph.wake()

    def destroy(self) -> None:
        """Ends all sleeps."""
        self._is_destroyed = True
        self._graph.wake()

    def _check(self) -> None:
        if not self._context._valid:
            raise ROSInterruptException
        if self._is_destroyed or self._timer._destroyed:
            raise RuntimeError("Rate cannot sleep because it has been destroyed")
        if self._timer._canceled:
            raise RuntimeError("Rate cannot sleep because its timer has been canceled")

    def sleep(self) -> None:
        """Blocks until the next period begins. Raises `ROSInterruptException` at shutdown."""
        self._check()
        used = self._used
        while True:
            seen = self._graph.events
            if not self._context._valid:
                raise ROSInterruptException
            if self._is_destroyed or self._timer._destroyed:
                return
            if self._fired != used:
                self._used = self._fired
                return
            _waiting.wait(self._graph, seen, None)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
