"""The deterministic scheduler of a process that runs in step with a simulation.

Exactly one thread of the program runs at a time: the one that holds the turn. It gives the turn up in the blocking calls that
`_lockstep` replaces, and the thread that has waited longest gets it. Once no thread can run, the scheduler reports to the
simulation and blocks until simulated time reaches the earliest wake-up, or a message arrives. The order of everything that
happens is therefore the same in each run, and a sleeping program costs no time.
"""

from __future__ import annotations

import _thread
import sys
import time
from collections import deque
from heapq import heappop, heappush
from typing import TYPE_CHECKING, Any

from . import _faults
from ._lockstep_task import LockstepGraph, Task

if TYPE_CHECKING:
    from collections.abc import Callable

#: Looks at a clock or a flag that are free between two waits. A program with more of them is in a busy loop.
_FREE_POLLS = 1000
#: Looks, and empty polls of the executor, that cost one step of simulated time in a busy loop.
_POLLS_PER_STEP = 100
_EMPTY_POLLS_PER_STEP = 10
#: Rounds of a loop that may be waiting, which count as one look.
_ROUNDS_PER_POLL = 100
#: Waits that end without any advance of time, after which a loop of messages is assumed.
_WAITS_PER_INSTANT = 10_000
#: Simulated time that a busy loop advances by [ns].
_STEP_NS = 1_000_000
#: Simulated time between two looks at sockets and files that a thread waits for [ns].
_SELECT_STEP_NS = 20_000_000
#: Wall time after the end of the simulation until a program that does not end is ended [s].
_GRACE_S = 5.0
#: Wall time that the signal handler of the main thread gets at the end of the simulation [s].
_HANDLER_S = 0.5
#: Wall time between two looks of a waiting main thread at signals [s].
_SIGNAL_CHECK_S = 0.05

_real_get_ident = _thread.get_ident
_real_sleep = time.sleep
_real_monotonic = time.monotonic


class _Interrupted(BaseException):
    """Ends a wait for the simulation after a signal handler that has not raised anything."""


class Scheduler:
    """Hands the turn from thread to thread. All methods but `wake` and `handle_signal` are called by the thread that has it."""

    def __init__(self, graph: LockstepGraph, note: Callable[[str, str], None] = lambda kind, text: None) -> None:
        self.graph = graph
        #: Receives (kind, text) of what is worth a line in the report.
        self.note = note
        self.current = Task("MainThread", is_daemon=False)
        self.current.ident = _real_get_ident()
        self.main = self.current
        self.tasks: dict[int, Task] = {self.current.ident: self.current}
        self.ready: deque[Task] = deque()
        self.sleepers: list[tuple[int, int, Task, int]] = []
        self.receivers: dict[Task, tuple[Any, int]] = {}
        self.selecting: dict[Task, Callable[[], Any]] = {}
        #: Handlers of signals that came while the main thread was in a wait, with their numbers.
        self.pending_signals: deque[tuple[Callable[[int, Any], Any], int]] = deque()
        self.is_main_in_wait = False
        self.sequence = 0
        self.switches = 0
        self.is_exchanging = False
        self.has_ended = False
        self._end_ns = 0
        self._end_wall_s = 0.0
        self._instant_ns, self._instant_waits = -1, 0
        self._named_deadlock = False

    # ---- clock

    def now_ns(self) -> int:
        """Simulated time [ns]. After the end of the simulation it advances by the program's own sleeps."""
        return self._end_ns if self.has_ended else self.graph.now_ns()

    def has_turn(self) -> bool:
        """False in threads of C libraries and in signal handlers of a thread that waits for its turn."""
        return self.current.ident == _real_get_ident()

    # ---- waits of the program

    def wait(self, graph: Any, seen: int, timeout_ns: int | None) -> int:
        """The operation `_waiting.wait`."""
        if not self.has_turn():
            return self._wait_outside(graph, seen, timeout_ns)
        task = self.current
        if graph.events != seen:
            task.polls = task.empty_polls = 0
            self._count_instant()
            if self.ready:
                self._yield(task)
            return int(graph.events)
        if timeout_ns is not None and timeout_ns <= 0:
            self._empty_poll(task)
            return int(graph.events)
        wake_ns = None if timeout_ns is None else self.now_ns() + timeout_ns
        task.polls = task.empty_polls = 0
        if not self.ready and not self.sleepers and not self.selecting and not self.receivers:
            # The only thread: no switch can happen.
            while not self.ready and not self.has_ended:
                self._exchange(wake_ns, True)
                if graph.events != seen or (wake_ns is not None and self.now_ns() >= wake_ns):
                    return int(graph.events)
        self.receivers[task] = (graph, seen)
        try:
            self.block(wake_ns)
        finally:
            self.receivers.pop(task, None)
        return int(graph.events)

    def sleep_ns(self, duration_ns: int) -> None:
        """The operation `_waiting.sleep_ns` and `time.sleep`."""
        if not self.has_turn():
            self.note("thread", f"thread {_real_get_ident()} sleeps on the wall clock: it was not started by Python")
            _real_sleep(max(0, duration_ns) / 1e9)
            return
        task = self.current
        if duration_ns <= 0:
            self._empty_poll(task)
            return
        task.polls = task.empty_polls = 0
        self.block(self.now_ns() + duration_ns)

    def poll(self) -> None:
        """The operation `_waiting.poll`."""
        task = self.current
        task.polls += 1
        if task.polls > _FREE_POLLS and self.has_turn():
            task.polls = _FREE_POLLS - _POLLS_PER_STEP
            self.note("busy loop", "a loop never waits: it costs 1 ms of simulated time per 100 looks at a clock or a flag")
            self.block(self.now_ns() + _STEP_NS)

    def round_of_loop(self) -> None:
        """The operation `_waiting.round_of_loop`."""
        task = self.current
        task.rounds += 1
        if task.rounds >= _ROUNDS_PER_POLL:
            task.rounds = 0
            self.poll()

    def select(self, look: Callable[[], Any], timeout_ns: int | None) -> Any:
        """Waits until `look()` gives something true; for sockets and files. Returns the last result."""
        result = look()
        if result or not self.has_turn():
            return result
        task = self.current
        if timeout_ns is not None and timeout_ns <= 0:
            self._empty_poll(task)
            return look()
        task.result = None
        self.selecting[task] = look
        try:
            self.block(None if timeout_ns is None else self.now_ns() + timeout_ns)
        finally:
            self.selecting.pop(task, None)
        return task.result or look()

    def join(self, task: Task, timeout_ns: int | None) -> bool:
        """Waits until the thread has ended; False after the timeout."""
        if task.done or not self.has_turn():
            return task.done
        task.joiners.append(self.current)
        try:
            self.block(None if timeout_ns is None else self.now_ns() + timeout_ns)
        finally:
            if self.current in task.joiners:
                task.joiners.remove(self.current)
        return task.done

    # ---- turns

    def block(self, wake_ns: int | None) -> bool:
        """Gives the turn up until `wake` or the time `wake_ns` [ns]. True if it was `wake`."""
        task = self.current
        if task is self.main:
            self.is_main_in_wait = True
        task.token += 1
        task.waits, task.was_woken = True, False
        if wake_ns is not None:
            self.sequence += 1
            heappush(self.sleepers, (wake_ns, self.sequence, task, task.token))
        try:
            self._switch(task)
        finally:
            task.waits = False
            task.token += 1
        if task is self.main:
            self.is_main_in_wait = False
            if self.pending_signals:
                self._run_handlers()
        return task.was_woken

    def wake(self, task: Task) -> bool:
        """Ends the wait of a thread; it runs when its turn comes. False if it does not wait any more."""
        if not task.waits:
            return False
        task.waits, task.was_woken = False, True
        self.ready.append(task)
        if not self.has_turn():
            self.graph.wake()
        return True

    def add(self, task: Task) -> None:
        """Adds a thread that has been started and waits at its gate."""
        self.ready.append(task)

    def begin(self, task: Task) -> None:
        """First act of a new thread: waits for its turn."""
        task.ident = _real_get_ident()
        task.gate.acquire()
        self.tasks[task.ident] = task

    def finish(self, task: Task) -> None:
        """Last act of a thread: passes the turn on."""
        self.tasks.pop(task.ident, None)
        task.done = True
        for joiner in task.joiners:
            self.wake(joiner)
        task.joiners.clear()
        following = self._next()
        self.current = following
        self.switches += 1
        following.gate.release()

    def _yield(self, task: Task) -> None:
        """Lets the other threads that can run go first."""
        if task is self.main:
            self.is_main_in_wait = True
        self.ready.append(task)
        self._switch(task)
        if task is self.main:
            self.is_main_in_wait = False
            if self.pending_signals:
                self._run_handlers()

    # ---- signals

    def handle_signal(self, handler: Callable[[int, Any], Any], number: int, frame: Any) -> None:
        """Runs a signal handler in the main thread: at once, or when the main thread has the turn again."""
        if self.current is self.main and not self.is_main_in_wait:
            handler(number, frame)
        else:
            self.pending_signals.append((handler, number))
            self.graph.wake()
        if self.is_exchanging and self.current is self.main:
            raise _Interrupted

    def _run_handlers(self) -> None:
        while self.pending_signals:
            handler, number = self.pending_signals.popleft()
            handler(number, sys._getframe(2))

    def _switch(self, task: Task) -> None:
        following = self._next()
        if following is task:
            return
        self.current = following
        self.switches += 1
        following.gate.release()
        if task is self.main:
            # A signal that comes between the last instruction and the wait is seen only after the wait.
            while not task.gate.acquire(True, _SIGNAL_CHECK_S):
                pass
        else:
            task.gate.acquire()

    def _next(self) -> Task:
        """The thread whose turn it is; advances simulated time until there is one."""
        while True:
            if self.pending_signals and self.main.waits:
                self.main.waits = False
                self.ready.appendleft(self.main)
            if self.receivers:
                for task, (graph, seen) in list(self.receivers.items()):
                    if task.waits and graph.events != seen:
                        task.waits, task.was_woken = False, True
                        self.ready.append(task)
            if self.ready:
                return self.ready.popleft()
            now_ns = self.now_ns()
            if self._expire(now_ns):
                continue
            if self.selecting and self._look():
                continue
            wake_ns = self.sleepers[0][0] if self.sleepers else None
            if self.selecting:
                step_ns = now_ns + _SELECT_STEP_NS
                wake_ns = step_ns if wake_ns is None else min(wake_ns, step_ns)
            self._exchange(wake_ns, bool(self.receivers))

    def _expire(self, now_ns: int) -> bool:
        """Makes sleepers ready whose time has come, in the order of their times."""
        found = False
        sleepers = self.sleepers
        while sleepers and (sleepers[0][0] <= now_ns or sleepers[0][3] != sleepers[0][2].token):
            _, _, task, token = heappop(sleepers)
            if token == task.token and task.waits:
                task.waits = False
                self.ready.append(task)
                found = True
        return found

    def _look(self) -> bool:
        found = False
        for task, look in list(self.selecting.items()):
            if task.waits:
                task.result = look()
                if task.result:
                    task.waits, task.was_woken = False, True
                    self.ready.append(task)
                    found = True
        return found

    def _exchange(self, wake_ns: int | None, wants_messages: bool) -> None:
        """Waits for the simulation."""
        if self.has_ended:
            self._after_end(wake_ns)
            return
        if wake_ns is None and not wants_messages and not self._named_deadlock:
            self._named_deadlock = True
            self.note("deadlock", "every thread waits for another one")
        stall_ns = _faults.next_stall_ns()
        if stall_ns is not None and (wake_ns is None or stall_ns < wake_ns):
            wake_ns = stall_ns
        is_over = False
        try:
            self.is_exchanging = True
            try:
                self.graph.exchange(wake_ns, wants_messages)
            finally:
                self.is_exchanging = False
        except _Interrupted:
            pass
        except (ConnectionError, EOFError):
            is_over = True
        if is_over:
            # Not in the handler: the interrupt would show the lost connection as its cause.
            self._end()
            return
        if stall_ns is not None and self.graph.now_ns() >= stall_ns:
            _faults.report_stalled(stall_ns)

    # ---- end of the simulation

    def _end(self) -> None:
        """The simulation is over: the program is interrupted as by Ctrl-C, and its sleeps end at once."""
        import signal

        self._end_ns = self.graph.now_ns()
        _faults.report_stalled(self._end_ns, at_end=True)
        self.has_ended = True
        self._end_wall_s = _real_monotonic()
        if hasattr(signal, "pthread_kill"):
            # A main thread that waits for its turn must be woken up by the signal.
            signal.pthread_kill(self.main.ident, signal.SIGINT)
        else:
            _thread.interrupt_main()
        if self.current is not self.main:
            # The handler runs in the main thread; other threads must not run ahead of it.
            seen, limit_s = self.graph.events, _real_monotonic() + _HANDLER_S
            while not self.pending_signals and self.graph.events == seen and _real_monotonic() < limit_s:
                _real_sleep(0.0005)

    def _after_end(self, wake_ns: int | None) -> None:
        if _real_monotonic() - self._end_wall_s > _GRACE_S:
            self._give_up()
        if wake_ns is not None:
            self._end_ns = max(self._end_ns, wake_ns)
            return
        # Nothing but a signal handler can go on.
        _real_sleep(0.001)

    def _give_up(self) -> None:
        import os

        sys.stderr.write(f"periplus: the program did not end within {_GRACE_S:.0f} s after the simulation\n")
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(1)

    # ---- loops that do not wait

    def _empty_poll(self, task: Task) -> None:
        task.empty_polls += 1
        if task.empty_polls >= _EMPTY_POLLS_PER_STEP:
            task.polls = task.empty_polls = 0
            self.block(self.now_ns() + _STEP_NS)
        elif self.ready or self.receivers or self.selecting:
            self._yield(task)

    def _count_instant(self) -> None:
        now_ns = self.now_ns()
        if now_ns != self._instant_ns:
            self._instant_ns, self._instant_waits = now_ns, 0
            return
        self._instant_waits += 1
        if self._instant_waits > _WAITS_PER_INSTANT:
            self._instant_waits = 0
            self.note("busy loop", "a loop of messages without any delay: it costs 1 ms of simulated time per 10000 messages")
            self.block(now_ns + _STEP_NS)

    def _wait_outside(self, graph: Any, seen: int, timeout_ns: int | None) -> int:
        """A wait by a thread that does not take turns."""
        end_s = None if timeout_ns is None else _real_monotonic() + timeout_ns / 1e9
        while graph.events == seen and (end_s is None or _real_monotonic() < end_s):
            _real_sleep(0.001)
        return int(graph.events)
