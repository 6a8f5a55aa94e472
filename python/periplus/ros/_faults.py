"""Faults of callbacks: errors with their context, callbacks that are too slow, executors that hang."""

from __future__ import annotations

import _thread
import linecache
import os
import re
import sys
import time
from typing import TYPE_CHECKING, Any

from . import _tracebacks, _waiting
from ._tracebacks import format_exception, print_exception

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["CallbackMonitor", "callback_failed", "format_exception", "install", "print_exception", "set_timeout"]

#: Wall time [s] after which a callback that has not returned is reported (0: never). Default of the variable
#: PERIPLUS_CALLBACK_TIMEOUT_S.
DEFAULT_TIMEOUT_S = 10.0
#: A line that polls a future in a loop.
_FUTURE_LOOP = re.compile(r"^\s*while\b.*\.done\(\)")
_RCLPY = f"{os.sep}rclpy{os.sep}"
_NO_ADVICE = "It is here:"
#: Share of the time between two calls that a subscription's callback may take before it counts as saturated.
_SATURATION_RATIO = 0.95
#: Number of saturated calls in a row after which a subscription is reported.
_SATURATED_CALLS = 10
#: Calls shorter than this are never saturated [ns]: they only show a fast publisher.
_SATURATION_MIN_NS = 5_000_000

# The true clock, also when lockstep replaces the functions of `time`.
_perf_counter_ns = time.perf_counter_ns
_sleep = time.sleep

# The callback that each thread is in, and when it began.
_running: dict[int, tuple[CallbackMonitor, int]] = {}
_monitors: list[CallbackMonitor] = []
# The reported ones of them in lockstep.
_stalled: set[tuple[int, int]] = set()
_watching = False
_timeout_ns = -1


class CallbackMonitor:
    """Times the calls of one callback. Executors make one for each timer, subscription and so on.

    Use: `before = monitor.start()`, the call, then `monitor.end(before)` in `finally`.
    """

    __slots__ = ("callback", "calls", "kind", "last_start_ns", "max_ns", "name", "node", "period_ns", "saturated", "slow_calls", "slow_ns", "was_named")

    def __init__(
        self, callback: Callable[..., Any], *, node: str, kind: str, name: str = "", period_ns: int | None = None
    ) -> None:
        self.callback = callback
        #: Full name of the node.
        self.node = node
        #: `timer`, `subscription`, `service`, `client`, `action server`, ...
        self.kind = kind
        #: Topic, service or action; empty for a timer.
        self.name = name
        #: Period of a timer [ns]; None for others. May be changed.
        self.period_ns = period_ns
        self.calls = self.slow_calls = self.slow_ns = self.max_ns = 0
        self.last_start_ns = self.saturated = 0
        self.was_named = False

    def start(self) -> tuple[CallbackMonitor, int] | None:
        """Notes the start of a call; returns the outer call of this thread for `end`."""
        if not _watching:
            _watch()
        thread = _thread.get_ident()
        outer = _running.get(thread)
        _running[thread] = (self, _steady_ns())
        return outer

    def end(self, outer: tuple[CallbackMonitor, int] | None) -> None:
        """Notes the end of a call, and reports the callback if it is too slow."""
        thread = _thread.get_ident()
        own = _running.get(thread)
        if outer is None:
            _running.pop(thread, None)
        else:
            _running[thread] = outer
        if own is None:
            return
        start_ns = own[1]
        taken_ns = _steady_ns() - start_ns
        self.calls += 1
        period_ns = self.period_ns
        if period_ns is not None:
            if taken_ns > period_ns > 0:
                self._slow(taken_ns)
        elif self.kind == "subscription":
            since_ns = start_ns - self.last_start_ns
            self.last_start_ns = start_ns
            # A queue that is never empty: the next call starts where the last one ended.
            if taken_ns > _SATURATION_MIN_NS and taken_ns > since_ns * _SATURATION_RATIO:
                self.saturated += 1
                if self.saturated >= _SATURATED_CALLS:
                    self._slow(taken_ns)
            else:
                self.saturated = 0

    def _slow(self, taken_ns: int) -> None:
        self.slow_calls += 1
        self.slow_ns += taken_ns
        self.max_ns = max(self.max_ns, taken_ns)
        if not self.was_named:
            self.was_named = True
            _monitors.append(self)
            if len(_monitors) == 1:
                import atexit

                atexit.register(_print_summary)
            _report(f"{self} took {taken_ns / 1e6:.1f} ms, {self._limit()}")

    def _limit(self) -> str:
        if self.period_ns is not None:
            return f"longer than its period of {self.period_ns / 1e6:.1f} ms: calls are skipped"
        return "and messages come faster than that: they queue up and the oldest are dropped"

    def __str__(self) -> str:
        what = f"{self.kind} {self.name}".rstrip()
        return f"callback {callback_location(self.callback)} of the {what} of node {self.node}"


def callback_location(callback: Any) -> str:
    """`name (file:line)` of a callback."""
    function = callback
    for attribute in ("__wrapped__", "func", "__func__"):
        function = getattr(function, attribute, function)
    code = getattr(function, "__code__", None)
    if code is None:
        call = getattr(type(function), "__call__", None)
        code = getattr(call, "__code__", None)
    name = getattr(function, "__qualname__", type(function).__name__)
    return f"{name} ({_tracebacks.short_path(code.co_filename)}:{code.co_firstlineno})" if code is not None else str(name)


def _steady_ns() -> int:
    scheduler = _waiting._scheduler
    return _perf_counter_ns() if scheduler is None else scheduler.now_ns()


def callback_failed(
    error: BaseException, *, node: str, kind: str, name: str = "", time_ns: int | None = None, callback: Any = None
) -> None:
    """Adds the callback's node, topic and time [ns] to an error as a note, which every printed traceback shows.

    A callback that is not in the traceback, since it could not be called, is named with its line.
    """
    what = f"{kind} {name}".rstrip()
    when = f" at {time_ns / 1e9:.3f} s" if time_ns is not None else ""
    note = f"in a callback of the {what} of node {node}{when}"
    if callback is not None and not _was_entered(error):
        note += f": {callback_location(callback)}"
    notes = list(getattr(error, "__notes__", ()))
    # The innermost callback of nested spins comes first.
    error.__notes__ = [*notes, note]  # type: ignore[attr-defined]


def _was_entered(error: BaseException) -> bool:
    """True if the user's code was called: its frames follow those of the executor."""
    trace, last = error.__traceback__, ""
    while trace is not None:
        last = trace.tb_frame.f_code.co_filename
        trace = trace.tb_next
    return not _tracebacks.is_own_file(last)


def install() -> None:
    """Prints errors that end the program or a thread without frames of Periplus."""
    _tracebacks.install()


def set_timeout(timeout_s: float) -> None:
    """Sets the wall time [s] after which a callback that has not returned is reported (0: never)."""
    global _timeout_ns
    _timeout_ns = int(timeout_s * 1e9)


def _watch() -> None:
    """Starts the thread that looks for callbacks which do not return. In lockstep, the scheduler does it."""
    global _watching
    _watching = True
    if _timeout_ns < 0:
        try:
            set_timeout(float(os.environ.get("PERIPLUS_CALLBACK_TIMEOUT_S", "") or DEFAULT_TIMEOUT_S))
        except ValueError:
            set_timeout(DEFAULT_TIMEOUT_S)
    if _timeout_ns == 0 or _waiting.in_lockstep():
        return
    # No `threading.Thread`: a program that lists its threads does not see this one.
    _thread.start_new_thread(_watch_loop, ())


def _watch_loop() -> None:
    named: set[tuple[int, int]] = set()
    while True:
        _sleep(min(1.0, _timeout_ns / 4e9))
        now_ns = _perf_counter_ns()
        for thread, (monitor, start_ns) in list(_running.items()):
            if now_ns - start_ns > _timeout_ns and (thread, start_ns) not in named:
                named.add((thread, start_ns))
                frame = sys._current_frames().get(thread)
                _report(f"{monitor} has not returned for {(now_ns - start_ns) / 1e9:.1f} s. {blocked_call(frame)}\n{_tracebacks.format_stack(frame)}")


def next_stall_ns() -> int | None:
    """Simulated time at which `report_stalled` is to look at the callbacks that run now, or None."""
    starts = [start_ns for thread, (_, start_ns) in list(_running.items()) if (thread, start_ns) not in _stalled]
    return min(starts) + _timeout_ns + 1 if starts and _timeout_ns > 0 else None


def report_stalled(now_ns: int, *, at_end: bool = False) -> None:
    """Names callbacks in lockstep that have not returned for the timeout in simulated time, once each.

    `at_end`: the simulation has ended; those that would never have returned are named whatever their time.
    """
    for thread, (monitor, start_ns) in list(_running.items()):
        taken_ns = now_ns - start_ns
        if (thread, start_ns) in _stalled or not (at_end or taken_ns > _timeout_ns > 0):
            continue
        frame = sys._current_frames().get(thread)
        advice = blocked_call(frame)
        if at_end and (advice == _NO_ADVICE or not _is_only_thread(frame)):
            continue
        _stalled.add((thread, start_ns))
        when = "has not returned until the end" if at_end else f"has not returned for {taken_ns / 1e9:.1f} s"
        _report(f"{monitor}, called at {start_ns / 1e9:.3f} s, {when}. {advice}\n{_tracebacks.format_stack(frame)}")


def _is_only_thread(frame: Any) -> bool:
    """True for a callback of a SingleThreadedExecutor: nothing else can complete what it waits for."""
    while frame is not None:
        if type(frame.f_locals.get("self")).__name__ == "SingleThreadedExecutor":
            return True
        frame = frame.f_back
    return False


def blocked_call(frame: Any) -> str:
    """Advice for a thread that waits inside a callback."""
    user = _tracebacks.user_frame(frame)
    if user is not None and _FUTURE_LOOP.search(linecache.getline(user.f_code.co_filename, user.f_lineno)):
        return (
            "It waits for a future that its own executor would have to complete: use add_done_callback, or await it in an "
            "async callback."
        )
    while frame is not None:
        file, function = os.path.basename(frame.f_code.co_filename), frame.f_code.co_name
        own = _tracebacks.is_own_file(frame.f_code.co_filename) and _RCLPY in frame.f_code.co_filename
        if own and file == "client.py" and function == "call":
            return (
                "It waits for a response that its own executor would have to deliver: use call_async, or a "
                "MultiThreadedExecutor and another callback group for the client."
            )
        if own and function == "sleep" and file in ("timer.py", "rate.py"):
            return "Rate.sleep() needs another thread that spins: a rate cannot be used in the only thread of the executor."
        frame = frame.f_back
    return _NO_ADVICE


def _report(text: str) -> None:
    sys.stderr.write(f"periplus: {text.rstrip()}\n")
    sys.stderr.flush()


def _print_summary() -> None:
    for monitor in _monitors:
        if monitor.slow_calls > 1:
            what = "longer than the period" if monitor.period_ns is not None else "longer than messages take to come"
            _report(
                f"{monitor}: {monitor.slow_calls} of {monitor.calls} calls took {what}, "
                f"{monitor.slow_ns / monitor.slow_calls / 1e6:.1f} ms on average, {monitor.max_ns / 1e6:.1f} ms at most"
            )


def dump_on_signal() -> None:
    """Prints the stacks of all threads when the process receives SIGUSR1, also while Python code is stuck in C."""
    import faulthandler
    import signal

    if hasattr(signal, "SIGUSR1") and sys.__stderr__ is not None:
        faulthandler.register(signal.SIGUSR1, file=sys.__stderr__, all_threads=True, chain=False)
