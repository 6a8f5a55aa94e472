"""Futures and tasks."""

from __future__ import annotations

import sys
import weakref
from _thread import allocate_lock, get_ident
from enum import Enum
from types import CoroutineType
from typing import TYPE_CHECKING, Any

from rclpy._warnings import warn
from rclpy._clock_source import look, source

if TYPE_CHECKING:
    from collections.abc import Callable, Generator

    from rclpy.executors import Executor


class FutureState(Enum):
    """State of a future."""

    PENDING = "PENDING"
    CANCELLED = "CANCELLED"
    FINISHED = "FINISHED"


_PENDING, _CANCELLED, _FINISHED = FutureState.PENDING, FutureState.CANCELLED, FutureState.FINISHED

# The task that each thread is running, by the identifier of the thread.
_running: dict[int, Task] = {}


def _no_executor() -> None:
    return None


class Future:
    """Result that comes later. `await` it in callbacks of an executor."""

    def __init__(self, *, executor: Executor | None = None) -> None:
        self._state = _PENDING
        self._result: Any = None
        self._exception: BaseException | None = None
        self._exception_fetched = False
        self._callbacks: list[Callable[[Future], Any]] = []
        # Functions that are called at once, in the thread that sets the result.
        self._wakes: list[Callable[[], Any]] = []
        self._lock = allocate_lock()
        self._executor: Callable[[], Executor | None] = _no_executor
        # The client that completes the future; errors of done callbacks name it.
        self._origin: Any = None
        if executor is not None:
            self._set_executor(executor)

    def __del__(self) -> None:
        exception = getattr(self, "_exception", None)
        if exception is not None and not self._exception_fetched and sys is not None:
            print("The following exception was never retrieved: " + str(exception), file=sys.stderr)

    def __await__(self) -> Generator[Any, None, Any]:
        while self._state is _PENDING:
            task = _running.get(get_ident())
            if task is not None:
                task._awaited = self
            yield
        return self.result()

    def _pending(self) -> bool:
        return self._state is _PENDING

    def cancel(self) -> None:
        """Cancels a pending future: who awaits it goes on, with no result."""
        with self._lock:
            if self._state is not _PENDING:
                return
            self._state = _CANCELLED
        self._finish()

    def cancelled(self) -> bool:
        """True after `cancel()`."""
        return self._state is _CANCELLED

    def done(self) -> bool:
        """True once there is a result or an exception."""
        if source.lockstep_graph is not None:
            look()
        return self._state is _FINISHED

    def _is_done(self) -> bool:
        return self._state is _FINISHED

    def result(self) -> Any:
        """The result; None before the end. Raises the exception if there is one."""
        if self._exception is not None:
            self._exception_fetched = True
            raise self._exception
        return self._result

    def exception(self) -> BaseException | None:
        """The exception, or None."""
        self._exception_fetched = True
        return self._exception

    def set_result(self, result: Any) -> None:
        """Ends the future with a result."""
        with self._lock:
            self._result = result
            self._state = _FINISHED
        self._finish()

    def set_exception(self, exception: BaseException) -> None:
        """Ends the future with an exception."""
        with self._lock:
            self._exception = exception
            self._exception_fetched = False
            self._state = _FINISHED
        self._finish()

    def _finish(self) -> None:
        """Wakes who waits and runs the callbacks: as tasks of the executor, or at once without one."""
        with self._lock:
            wakes, self._wakes = self._wakes, []
            callbacks, self._callbacks = self._callbacks, []
        for wake in wakes:
            wake()
        for callback in callbacks:
            self._invoke(callback)

    def _invoke(self, callback: Callable[[Future], Any]) -> None:
        executor = self._executor()
        if executor is not None and not executor._is_shutdown:
            executor.create_task(callback, self)._origin = self._origin
            return
        try:
            callback(self)
        except Exception as error:
            warn(f"Unhandled exception in done callback: {error}")

    def _set_executor(self, executor: Executor | None) -> None:
        self._executor = _no_executor if executor is None else weakref.ref(executor)

    def _add_wake(self, wake: Callable[[], Any]) -> None:
        """Calls a function at the end of the future, at once if it has ended."""
        with self._lock:
            if self._state is _PENDING:
                if wake not in self._wakes:
                    self._wakes.append(wake)
                return
        wake()

    def add_done_callback(self, callback: Callable[[Future], Any]) -> None:
        """Calls a function with the future at its end, or now if it has ended."""
        with self._lock:
            if self._state is _PENDING:
                self._callbacks.append(callback)
                return
        self._invoke(callback)

    def remove_done_callback(self, callback: Callable[[Future], Any]) -> bool:
        """Undoes `add_done_callback`. Returns False if the function was not added."""
        with self._lock:
            if callback not in self._callbacks:
                return False
            self._callbacks.remove(callback)
            return True


class Task(Future):
    """Function or coroutine that an executor runs. A call runs it to its end or to its next `await`."""

    def __init__(
        self,
        handler: Any,
        args: Any = None,
        kwargs: dict[str, Any] | None = None,
        executor: Executor | None = None,
    ) -> None:
        super().__init__(executor=executor)
        self._args = () if args is None else tuple(args)
        self._kwargs = {} if kwargs is None else kwargs
        self._handler = handler
        self._coroutine: Any = handler if isinstance(handler, CoroutineType) else None
        if self._coroutine is None and not callable(handler):
            raise TypeError(f"{type(handler).__name__!r} object is not callable")
        self._executing = False
        self._task_lock = allocate_lock()
        # The future that the coroutine waits for, or None.
        self._awaited: Future | None = None

    def __call__(self) -> None:
        """Runs the function, or the coroutine up to its next `await`. The exception is kept, not raised."""
        if self._state is not _PENDING or not self._task_lock.acquire(False):
            return
        try:
            self._executing = True
            self._step()
        finally:
            self._executing = False
            self._task_lock.release()

    def _step(self) -> None:
        identifier = get_ident()
        outer = _running.get(identifier)
        self._awaited = None
        _running[identifier] = self
        try:
            if self._coroutine is None:
                result = self._handler(*self._args, **self._kwargs)
                if not isinstance(result, CoroutineType):
                    self._end(result, None)
                    return
                self._coroutine = result
            self._coroutine.send(None)
        except StopIteration as stop:
            self._end(stop.value, None)
        except Exception as error:
            self._end(None, error)
        finally:
            if outer is None:
                _running.pop(identifier, None)
            else:
                _running[identifier] = outer

    def _end(self, result: Any, error: BaseException | None) -> None:
        self._handler = None
        self._args = ()
        self._kwargs = {}
        self._coroutine = None
        if error is None:
            self.set_result(result)
        else:
            self.set_exception(error)

    def executing(self) -> bool:
        """True while a thread runs the task."""
        return self._executing

    def cancel(self) -> None:
        """Ends a task that waits."""
        if self._pending() and not self._executing and self._coroutine is not None:
            self._coroutine.close()
            self._coroutine = None
        super().cancel()
