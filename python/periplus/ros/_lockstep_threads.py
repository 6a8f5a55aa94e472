"""Locks and threads that take turns (`_scheduler`)."""

from __future__ import annotations

import _thread
import threading
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from ._lockstep_task import Task
from ._scheduler import Scheduler

if TYPE_CHECKING:
    from collections.abc import Callable

_get_ident = _thread.get_ident
_real_sleep = time.sleep
_real_start = _thread.start_new_thread
_real_start_joinable = getattr(threading, "_start_joinable_thread", None)
_real_join = threading.Thread.join
_real_is_alive = threading.Thread.is_alive

# Set by install(); None in a forked child, where locks work without turns.
_scheduler: Scheduler | None = None


def _wait_for(waiters: deque[Task], timeout: float, is_free: Callable[[], bool], give_back: Callable[[], None]) -> bool:
    """Waits until a release hands the lock over. True if this thread has it."""
    scheduler = _scheduler
    if scheduler is None or not scheduler.has_turn():
        # A signal handler, a thread of a C library or a forked child.
        end_s = None if timeout < 0 else time.perf_counter() + timeout
        while not is_free():
            if end_s is not None and time.perf_counter() >= end_s:
                return False
            _real_sleep(0.0005)
        return True
    if timeout == 0:
        scheduler.poll()
        return is_free()
    task = scheduler.current
    waiters.append(task)
    try:
        was_woken = scheduler.block(None if timeout < 0 else scheduler.now_ns() + int(timeout * 1e9))
    except BaseException:
        # A signal handler has raised; the lock may have been handed over before.
        if task in waiters:
            waiters.remove(task)
        else:
            give_back()
        raise
    if not was_woken and task in waiters:
        waiters.remove(task)
    return was_woken


def _check_arguments(blocking: bool, timeout: float) -> None:
    if not blocking and timeout != -1:
        raise ValueError("can't specify a timeout for a non-blocking call")
    if timeout < 0 and timeout != -1:
        raise ValueError("timeout value must be a non-negative number")
    if timeout > threading.TIMEOUT_MAX:
        raise OverflowError("timeout value is too large")


class Lock:
    """`threading.Lock`. A release hands the lock to the thread that has waited longest."""

    __slots__ = ("__weakref__", "_is_locked", "_waiters")

    def __init__(self) -> None:
        self._is_locked = False
        self._waiters: deque[Task] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        if not self._is_locked:
            self._is_locked = True
            return True
        _check_arguments(blocking, timeout)
        if not blocking:
            if _scheduler is not None:
                _scheduler.poll()
            return False
        return _wait_for(self._waiters, timeout, self._take, self._hand_over)

    def _take(self) -> bool:
        if self._is_locked:
            return False
        self._is_locked = True
        return True

    def release(self) -> None:
        if not self._is_locked:
            raise RuntimeError("release unlocked lock")
        self._hand_over()

    def _hand_over(self) -> None:
        while self._waiters and _scheduler is not None:
            if _scheduler.wake(self._waiters.popleft()):
                return
        self._is_locked = False

    def locked(self) -> bool:
        if _scheduler is not None:
            _scheduler.poll()
        return self._is_locked

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_: object) -> None:
        self.release()

    def _at_fork_reinit(self) -> None:
        self._is_locked = False
        self._waiters.clear()

    def __repr__(self) -> str:
        return f"<{'locked' if self._is_locked else 'unlocked'} lock object at {id(self):#x}>"

    acquire_lock = acquire
    release_lock = release
    locked_lock = locked


class RLock:
    """`threading.RLock`."""

    __slots__ = ("__weakref__", "_count", "_owner", "_waiters")

    def __init__(self) -> None:
        self._owner = 0
        self._count = 0
        self._waiters: deque[Task] = deque()

    def acquire(self, blocking: bool = True, timeout: float = -1) -> bool:
        ident = _get_ident()
        if self._owner == ident:
            self._count += 1
            return True
        if self._count == 0:
            self._owner, self._count = ident, 1
            return True
        _check_arguments(blocking, timeout)
        if not blocking:
            if _scheduler is not None:
                _scheduler.poll()
            return False
        if not _wait_for(self._waiters, timeout, self._is_free, self._hand_over):
            return False
        self._owner, self._count = ident, 1
        return True

    def _is_free(self) -> bool:
        return self._count == 0

    def release(self) -> None:
        if self._owner != _get_ident():
            raise RuntimeError("cannot release un-acquired lock")
        self._count -= 1
        if self._count == 0:
            self._hand_over()

    def _hand_over(self) -> None:
        self._owner = self._count = 0
        while self._waiters and _scheduler is not None:
            task = self._waiters.popleft()
            if _scheduler.wake(task):
                # No other thread may take it before the next owner runs.
                self._owner, self._count = task.ident, 1
                return

    def __enter__(self) -> bool:
        return self.acquire()

    def __exit__(self, *_: object) -> None:
        self.release()

    def locked(self) -> bool:
        return self._count > 0

    def _release_save(self) -> tuple[int, int]:
        if self._count == 0:
            raise RuntimeError("cannot release un-acquired lock")
        state = (self._count, self._owner)
        self._count = 0
        self._hand_over()
        return state

    def _acquire_restore(self, state: tuple[int, int]) -> None:
        self.acquire()
        self._count, self._owner = state

    def _is_owned(self) -> bool:
        return self._owner == _get_ident()

    def _recursion_count(self) -> int:
        return self._count if self._is_owned() else 0

    def _at_fork_reinit(self) -> None:
        self._owner = self._count = 0
        self._waiters.clear()

    def __repr__(self) -> str:
        state = "locked" if self._count else "unlocked"
        return f"<{state} RLock owner={self._owner} count={self._count} at {id(self):#x}>"


def _as_task(function: Callable[..., Any], arguments: tuple[Any, ...], keywords: dict[str, Any]) -> tuple[Task, Callable[[], None]]:
    assert _scheduler is not None
    scheduler = _scheduler
    thread = getattr(function, "__self__", None)
    if isinstance(thread, threading.Thread):
        task = Task(thread.name, is_daemon=thread.daemon)
        thread._lockstep_task = task  # type: ignore[attr-defined]
    else:
        task = Task(getattr(function, "__name__", "thread"))

    def run() -> None:
        scheduler.begin(task)
        try:
            function(*arguments, **keywords)
        finally:
            scheduler.finish(task)

    return task, run


def start_new_thread(function: Callable[..., Any], args: tuple[Any, ...] = (), kwargs: dict[str, Any] | None = None) -> int:
    """`_thread.start_new_thread`: the new thread runs when its turn comes."""
    scheduler = _scheduler
    if scheduler is None:
        return _real_start(function, args, kwargs or {})
    task, run = _as_task(function, args, kwargs or {})
    ident = _real_start(run, ())
    scheduler.add(task)
    return ident


def start_joinable_thread(function: Callable[..., Any], handle: Any = None, daemon: bool = True) -> Any:
    """`_thread.start_joinable_thread` of Python 3.13."""
    scheduler = _scheduler
    assert _real_start_joinable is not None
    if scheduler is None:
        return _real_start_joinable(function, handle=handle, daemon=daemon)
    task, run = _as_task(function, (), {})
    task.is_daemon = daemon
    handle = _real_start_joinable(run, handle=handle, daemon=daemon)
    scheduler.add(task)
    return handle


def _join(self: threading.Thread, timeout: float | None = None) -> None:
    task = getattr(self, "_lockstep_task", None)
    scheduler = _scheduler
    if task is None or scheduler is None or self is threading.current_thread():
        _real_join(self, timeout)
        return
    # A negative timeout does not block.
    if scheduler.join(task, None if timeout is None else max(0, int(timeout * 1e9))):
        # The thread has passed its turn on and is leaving.
        _real_join(self)


def _is_alive(self: threading.Thread) -> bool:
    task = getattr(self, "_lockstep_task", None)
    if task is None or _scheduler is None:
        return _real_is_alive(self)
    _scheduler.poll()
    return self._started.is_set() and not task.done  # type: ignore[attr-defined]


def join_all() -> None:
    """Waits for threads that are not daemons, as Python does at its end."""
    scheduler = _scheduler
    while scheduler is not None:
        left = [task for task in scheduler.tasks.values() if not task.is_daemon and task is not scheduler.current]
        left += [task for task in scheduler.ready if not task.is_daemon and task not in left]
        if not left:
            return
        scheduler.join(left[0], None)


def replacements(scheduler: Scheduler) -> list[tuple[Any, str, Any]]:
    """Replacements of threads and locks: (module or class, name, new value)."""
    global _scheduler
    _scheduler = scheduler
    patches: list[tuple[Any, str, Any]] = [
        (_thread, "allocate_lock", Lock),
        (_thread, "allocate", Lock),
        (_thread, "RLock", RLock),
        (_thread, "start_new_thread", start_new_thread),
        (_thread, "start_new", start_new_thread),
        (threading, "_allocate_lock", Lock),
        (threading, "Lock", Lock),
        (threading, "RLock", RLock),
        (threading, "_CRLock", RLock),
        (threading, "_start_new_thread", start_new_thread),
        (threading.Thread, "join", _join),
        (threading.Thread, "is_alive", _is_alive),
    ]
    if _real_start_joinable is not None:
        patches += [
            (threading, "_start_joinable_thread", start_joinable_thread),
            (_thread, "start_joinable_thread", start_joinable_thread),
        ]
    return [(owner, name, value) for owner, name, value in patches if hasattr(owner, name)]


def uninstall() -> None:
    """Locks work without turns from now on; for a forked child."""
    global _scheduler
    _scheduler = None
