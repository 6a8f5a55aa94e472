"""The executor with several threads."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from periplus.ros import _waiting

from rclpy._warnings import warn
from rclpy._execution import finish, run_entity
from rclpy.executors import (
    ConditionReachedException,
    Executor,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
    TimeoutObject,
)
from rclpy.task import Future, Task

if TYPE_CHECKING:
    from rclpy.context import Context


def _cpu_count() -> int:
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 2


class MultiThreadedExecutor(Executor):
    """Runs callbacks in `num_threads` threads (default: as many as CPUs)."""

    def __init__(self, num_threads: int | None = None, *, context: Context | None = None) -> None:
        super().__init__(context=context)
        self._num_threads = _cpu_count() if num_threads is None else int(num_threads)
        if self._num_threads == 1:
            warn("MultiThreadedExecutor is used with a single thread.\nUse the SingleThreadedExecutor instead.")
        self._condition = _waiting.Condition()
        self._work: deque[tuple[Any, Any]] = deque()
        self._threads: list[Any] = []
        self._idle = 0
        self._busy = 0
        self._errors: deque[BaseException] = deque()

    # ---- threads

    def _submit(self, entity: Any, node: Any) -> None:
        with self._condition:
            self._work.append((entity, node))
            if self._idle >= len(self._work):
                self._condition.notify()
                return
            if len(self._threads) >= self._num_threads:
                return
            name = f"executor-{len(self._threads)}"
        # Started without the lock: in lockstep the start of a thread is a point where another one may go on.
        self._threads.append(_waiting.start_thread(self._serve, name))

    def _serve(self) -> None:
        """Loop of one thread."""
        condition = self._condition
        while True:
            with condition:
                while not self._work and not self._is_shutdown:
                    self._idle += 1
                    try:
                        condition.wait()
                    finally:
                        self._idle -= 1
                if not self._work:
                    return
                entity, node = self._work.popleft()
                self._busy += 1
            try:
                self._execute(entity, node)
            except BaseException as error:
                self._errors.append(error)
            finally:
                with condition:
                    self._busy -= 1
                    if self._is_shutdown:
                        condition.notify_all()
                self._graph.wake()

    def _execute(self, entity: Any, node: Any) -> bool:
        if node is None:
            self._run_task(entity)
            return True
        try:
            ran, coroutine = run_entity(self, entity, node)
        finally:
            self._queued.discard(entity)
        if coroutine is not None:
            self._run_task(Task(finish(entity, node, coroutine), executor=self))
        return ran

    def _taken(self, entity: Any) -> None:
        self._queued.discard(entity)
        self._graph.wake()

    # ---- spinning

    def _spin_once(
        self, timeout_sec: float | TimeoutObject | None, condition: Callable[[], bool] | None = None
    ) -> None:
        self._raise_error()
        try:
            entity, node = self._next(self._deadline(timeout_sec), lambda: self._ends(condition))
        except (TimeoutException, ShutdownException, ExternalShutdownException, ConditionReachedException):
            pass
        else:
            self._submit(entity, node)
        self._raise_error()

    def _ends(self, condition: Callable[[], bool] | None) -> bool:
        return bool(self._errors) or (condition is not None and condition())

    def _raise_error(self) -> None:
        """Raises the exception of a callback that has ended."""
        if self._errors:
            raise self._errors.popleft()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Starts one callback, waiting for it at most `timeout_sec` (default: no limit).

        Raises what an earlier callback has raised.
        """
        self._spin_once(timeout_sec)

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | TimeoutObject | None = None
    ) -> None:
        """Starts one callback unless the future gets done before."""
        future._add_wake(self._graph.wake)
        self._spin_once(timeout_sec, future._is_done)

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Ends spinning and the threads. Returns False if callbacks still run after `timeout_sec`."""
        super().shutdown()
        with self._condition:
            self._work.clear()
            self._condition.notify_all()
            inside = any(thread is _current_thread() for thread in self._threads)
            return bool(self._condition.wait_for(lambda: self._busy <= inside, timeout_sec))


def _current_thread() -> Any:
    import threading

    return threading.current_thread()
