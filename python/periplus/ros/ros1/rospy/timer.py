"""Sleeping, rates and timers by the time of the node."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import genpy
from periplus.ros import _faults, _waiting

from rospy import core, rostime
from rospy.exceptions import ROSInterruptException, ROSTimeMovedBackwardsException
from rospy.rostime import Duration, Time

_NS = 10**9


def _sleep_until(end_ns: int, begin_ns: int, is_stopped: Callable[[], bool] | None = None) -> None:
    """Sleeps until the node's time is `end_ns`. Raises at shutdown and when time goes back."""
    graph = core.state.graph
    last = begin_ns
    while True:
        seen = graph.events
        if core.state.is_shutdown:
            raise ROSInterruptException("ROS shutdown request")
        if is_stopped is not None and is_stopped():
            return
        now = rostime.now_ns()
        if now >= end_ns:
            return
        if now < last and now < begin_ns:
            raise ROSTimeMovedBackwardsException(Time(*divmod(now, _NS)))
        last = now
        # With /clock, an arrival ends the wait; the wall clock says nothing.
        follows_clock = rostime.clock.sim_ns is not None and not _waiting.has_ended()
        _waiting.wait(graph, seen, None if follows_clock else end_ns - now)


def _wait_for_clock() -> None:
    if rostime.clock.sim_ns == 0:
        core.wait_events(lambda: rostime.clock.sim_ns != 0)


def sleep(duration: Any) -> None:
    """Sleeps for a number of seconds or a `Duration`.

    Raises:
        ROSInterruptException: The node shut down meanwhile.
        ROSTimeMovedBackwardsException: The clock went back.
    """
    rostime.get_rostime()
    if isinstance(duration, (str, bytes)):
        raise TypeError(f"rospy.sleep() needs a number of seconds or a rospy.Duration, not {duration!r}")
    nanoseconds = duration.to_nsec() if isinstance(duration, genpy.Duration) else int(duration * _NS)
    _wait_for_clock()
    begin = rostime.now_ns()
    if nanoseconds <= 0:
        if core.state.is_shutdown:
            raise ROSInterruptException("ROS shutdown request")
        return
    _sleep_until(begin + nanoseconds, begin)


class Rate:
    """Sleeps so that a loop runs `hz` times a second.

    Args:
        hz: Rate of the loop.
        reset: Begins anew when the clock goes back, rather than raise.
    """

    def __init__(self, hz: float, reset: bool = False) -> None:
        self.last_time = rostime.get_rostime()
        self.sleep_dur: genpy.Duration = Duration(0, int(_NS / hz))
        self._reset = reset
        self._is_stopped: Callable[[], bool] | None = None

    def _remaining(self, curr_time: Time) -> Any:
        if self.last_time > curr_time:
            self.last_time = curr_time
        return self.sleep_dur - (curr_time - self.last_time)

    def remaining(self) -> Any:
        """Time that is left of this turn."""
        return self._remaining(rostime.get_rostime())

    def sleep(self) -> None:
        """Sleeps until the end of this turn. A loop that is more than one turn late starts from now."""
        _wait_for_clock()
        now = rostime.get_rostime()
        if now < self.last_time:
            self.last_time = now
        end = self.last_time + self.sleep_dur
        try:
            _sleep_until(end.to_nsec(), now.to_nsec(), self._is_stopped)
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.last_time = rostime.get_rostime()
            return
        self.last_time = self.last_time + self.sleep_dur
        now = rostime.get_rostime()
        if now - self.last_time > self.sleep_dur * 2:
            self.last_time = now


class TimerEvent:
    """Times of one call of a timer: expected and real, of the last call and of this one."""

    def __init__(
        self,
        last_expected: Time | None,
        last_real: Time | None,
        current_expected: Time,
        current_real: Time,
        last_duration: float | None,
    ) -> None:
        self.last_expected = last_expected
        self.last_real = last_real
        self.current_expected = current_expected
        self.current_real = current_real
        self.last_duration = last_duration


class Timer(threading.Thread):
    """Calls a function of a `TimerEvent` in each period, in a thread of its own.

    Args:
        period: Duration between two calls.
        callback: Function to call.
        oneshot: Calls once (default False).
        reset: Goes on when the clock goes back, rather than end.
    """

    def __init__(
        self, period: Any, callback: Callable[[TimerEvent], Any], oneshot: bool = False, reset: bool = False
    ) -> None:
        super().__init__(name=f"timer of {getattr(callback, '__name__', 'a callable')}", daemon=True)
        self._period = period if isinstance(period, genpy.Duration) else Duration(period)
        self._callback = callback
        self._oneshot = oneshot
        self._reset = reset
        self._shutdown = False
        rostime.get_rostime()
        self.start()

    def shutdown(self) -> None:
        """Ends the timer."""
        self._shutdown = True
        if core.state.graph is not None:
            core.state.graph.wake()

    def run(self) -> None:
        rate = Rate(1.0 / max(self._period.to_sec(), 1e-9), reset=self._reset)
        rate.sleep_dur = self._period
        rate._is_stopped = lambda: self._shutdown
        period_ns = None if self._oneshot else self._period.to_nsec()
        monitor = _faults.CallbackMonitor(self._callback, node=core.get_name(), kind="timer", period_ns=period_ns)
        current_expected = rostime.get_rostime() + self._period
        last_expected = last_real = last_duration = None
        while not core.state.is_shutdown and not self._shutdown:
            try:
                rate.sleep()
            except ROSInterruptException:
                return
            if self._shutdown or core.state.is_shutdown:
                return
            current_real = rostime.get_rostime()
            begin = rostime.now_ns()
            event = TimerEvent(last_expected, last_real, current_expected, current_real, last_duration)
            before = monitor.start()
            try:
                self._callback(event)
            except ROSInterruptException:
                if core.is_shutdown_requested():
                    return
                raise
            except Exception:
                from rospy._dispatch import report_fault

                report_fault(self._callback, "timer")
                return
            finally:
                monitor.end(before)
            if self._oneshot:
                return
            last_duration = (rostime.now_ns() - begin) / _NS
            last_expected, last_real = current_expected, current_real
            current_expected = current_expected + self._period
