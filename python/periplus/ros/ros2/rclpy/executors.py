"""Executors: they wait for work of nodes and run the callbacks."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Coroutine
from types import CoroutineType, TracebackType
from typing import TYPE_CHECKING, Any, TypeVar

from periplus.ros import _waiting

from rclpy._clock_source import look, source
from rclpy._execution import finish, note_origin, run_entity
from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.constants import S_TO_NS
from rclpy.task import Future, Task
from rclpy.utilities import get_default_context, timeout_sec_to_nsec

if TYPE_CHECKING:
    from rclpy.context import Context
    from rclpy.node import Node

WaitableEntityType = TypeVar("WaitableEntityType")

# Period [ns] at which coroutines that await something unknown to the executor go on.
_POLL_NS = 1_000_000


class TimeoutException(Exception):
    """End of a wait by its timeout."""


class ShutdownException(Exception):
    """End of a wait by the shutdown of the executor."""


class ExternalShutdownException(Exception):
    """End of a wait by the shutdown of the context."""


class ConditionReachedException(Exception):
    """End of a wait because its condition holds."""


class TimeoutObject:
    """Timeout [s] that may change during a wait."""

    def __init__(self, timeout: float) -> None:
        self._timeout = timeout

    @property
    def timeout(self) -> float:
        """The timeout [s]."""
        return self._timeout

    @timeout.setter
    def timeout(self, timeout: float) -> None:
        self._timeout = timeout


async def await_or_execute(callback: Callable[..., Any] | Coroutine[Any, Any, Any], *args: Any) -> Any:
    """Result of a function or of a coroutine function."""
    result = callback(*args)  # type: ignore[operator]
    if isinstance(result, CoroutineType):
        return await result
    return result


class Executor:
    """Base of the executors. Nodes are served in the order in which they were added."""

    def __init__(self, *, context: Context | None = None) -> None:
        super().__init__()
        self._context = get_default_context() if context is None else context
        self._graph = self._context._use("cannot create executor")
        self._nodes: dict[Node, None] = {}
        self._is_shutdown = False
        # What is ready: (entity, node), or (task, None).
        self._ready: deque[tuple[Any, Any]] = deque()
        self._queued: set[Any] = set()
        # Tasks that can go on.
        self._tasks: list[Task] = []
        self._polled_tasks: list[Task] = []
        self._filters = type(self).can_execute is not Executor.can_execute

    # ---- nodes

    @property
    def context(self) -> Context:
        """The context of the executor."""
        return self._context

    def add_node(self, node: Node) -> bool:
        """Adds a node, which leaves its executor. Returns False if the node is here already."""
        if not self._join(node):
            return False
        self._graph.wake()
        return True

    def remove_node(self, node: Node) -> None:
        """Takes a node out."""
        if node in self._nodes:
            self._leave(node)
            self._graph.wake()

    def _join(self, node: Node) -> bool:
        """Adds a node without a wake-up of threads that spin."""
        if node in self._nodes:
            return False
        self._nodes = {**self._nodes, node: None}
        node.executor = self
        return True

    def _leave(self, node: Node) -> None:
        """Takes a node out without a wake-up."""
        if node in self._nodes:
            self._nodes = {one: None for one in self._nodes if one is not node}
            if node.executor is self:
                node.executor = None

    def get_nodes(self) -> list[Node]:
        """The nodes, in the order in which they were added."""
        return list(self._nodes)

    def wake(self) -> None:
        """Ends the current wait."""
        self._graph.wake()

    # ---- tasks

    def create_task(self, callback: Callable[..., Any] | Coroutine[Any, Any, Any], *args: Any, **kwargs: Any) -> Task:
        """Runs a function or a coroutine while the executor spins. Returns the task, which is a future."""
        task = Task(callback, args, kwargs, executor=self)
        self._resume(task)
        return task

    def _resume(self, task: Task) -> None:
        self._tasks.append(task)
        self._graph.wake()

    def _run_task(self, task: Task) -> None:
        """Runs a task to its next `await`, and raises its exception."""
        task()
        if task._pending():
            awaited = task._awaited
            if awaited is None:
                self._polled_tasks.append(task)
            else:
                awaited._add_wake(lambda: self._resume(task))
            return
        if task._exception is not None:
            task._exception_fetched = True
            if task._origin is not None:
                note_origin(task._exception, task._origin, self._nodes)
            raise task._exception

    # ---- work

    def can_execute(self, entity: Any) -> bool:
        """True if a callback of the entity may start now. Executors of one's own may be stricter."""
        return entity not in self._queued and entity.callback_group.can_execute(entity)

    def _collect(self) -> int | None:
        """Queues what is ready, and returns the time [ns] until the next timer, or None.

        Tasks come first. Then, node by node: waitables, timers, subscriptions, guard conditions, clients, services.
        """
        ready, queued, filters = self._ready, self._queued, self._filters
        if self._tasks:
            tasks, self._tasks = self._tasks, []
            ready.extend((task, None) for task in reversed(tasks))
        next_ns: int | None = None
        for node in self._nodes:
            found: list[Any] = []
            for waitable in node._rcl_waitables:
                if waitable._has_work():
                    found.append(waitable)
                else:
                    delay = waitable._next_ns()
                    if delay is not None and (next_ns is None or delay < next_ns):
                        next_ns = delay
            for timer in node._timers:
                if timer._canceled:
                    continue
                clock = timer._clock
                delay = timer._next_call_ns - clock._now_ns()
                if delay <= 0:
                    found.append(timer)
                elif clock._runs_by_itself and (next_ns is None or delay < next_ns):
                    if timer not in queued and timer.callback_group.can_execute(timer):
                        next_ns = delay
            for subscription in node._subscriptions:
                if subscription._native.has_data:
                    found.append(subscription)
            for guard in node._guards:
                if guard._triggered:
                    found.append(guard)
            for client in node._clients:
                if client._native.has_data:
                    found.append(client)
            for service in node._services:
                if service._native.has_data:
                    found.append(service)
            for entity in found:
                if entity not in queued and entity.callback_group.can_execute(entity):
                    if not filters or self.can_execute(entity):
                        queued.add(entity)
                        ready.append((entity, node))
        return next_ns

    def _next(self, deadline_ns: int | None, condition: Callable[[], bool] | None) -> tuple[Any, Any]:
        """Waits for work and takes it out of the queue.

        Raises:
            TimeoutException, ShutdownException, ExternalShutdownException, ConditionReachedException: No work any more.
        """
        graph = self._graph
        while True:
            if self._is_shutdown:
                raise ShutdownException
            if not self._context._valid:
                raise ExternalShutdownException
            if condition is not None and condition():
                raise ConditionReachedException
            while self._ready:
                try:
                    entity, node = self._ready.popleft()
                except IndexError:  # another thread was faster
                    break
                if node is None or node in self._nodes:
                    return entity, node
                self._queued.discard(entity)
            seen = graph.events
            next_ns = self._collect()
            if self._ready:
                continue
            polled, self._polled_tasks = self._polled_tasks, []
            self._tasks.extend(polled)
            if polled and (next_ns is None or next_ns > _POLL_NS):
                next_ns = _POLL_NS
            if deadline_ns is not None:
                left = deadline_ns - source.steady_ns()
                if left <= 0:
                    look()
                    raise TimeoutException
                if next_ns is None or left < next_ns:
                    next_ns = left
            _waiting.wait(graph, seen, next_ns)

    def _deadline(self, timeout_sec: float | TimeoutObject | None) -> int | None:
        if isinstance(timeout_sec, TimeoutObject):
            timeout_sec = timeout_sec.timeout
        timeout_ns = timeout_sec_to_nsec(timeout_sec)
        return None if timeout_ns < 0 else source.steady_ns() + timeout_ns

    def _execute(self, entity: Any, node: Any) -> bool:
        """Runs one callback in this thread. Returns False if there was nothing to do after all."""
        if node is None:
            self._run_task(entity)
            return True
        self._queued.discard(entity)
        ran, coroutine = run_entity(self, entity, node)
        if coroutine is not None:
            self._run_task(Task(finish(entity, node, coroutine), executor=self))
        return ran

    def _taken(self, entity: Any) -> None:
        """Called by `run_entity` once the data of an entity is taken."""

    def wait_for_ready_callbacks(
        self,
        timeout_sec: float | TimeoutObject | None = None,
        nodes: list[Node] | None = None,
        condition: Callable[[], bool] | None = None,
    ) -> tuple[Task, Any, Any]:
        """Waits for one callback that is ready.

        Returns a task that runs it, its entity and its node; raises `TimeoutException`, `ShutdownException` or
        `ConditionReachedException` instead. For executors of one's own.
        """
        entity, node = self._next(self._deadline(timeout_sec), condition)
        return Task(lambda: self._execute(entity, node)), entity, node

    # ---- spinning

    def spin(self) -> None:
        """Runs callbacks until shutdown."""
        while self._context._valid and not self._is_shutdown:
            self.spin_once()

    def spin_until_future_complete(self, future: Future, timeout_sec: float | None = None) -> None:
        """Runs callbacks until the future is done, or for `timeout_sec` (default: no limit)."""
        future._add_wake(self._graph.wake)
        deadline_ns = self._deadline(timeout_sec)
        while self._context._valid and not future._is_done() and not self._is_shutdown:
            left: float | None = None
            if deadline_ns is not None:
                left = (deadline_ns - source.steady_ns()) / S_TO_NS
                if left <= 0 and timeout_sec != 0:
                    return
            self.spin_once_until_future_complete(future, left if left is None else max(left, 0.0))
            if timeout_sec == 0:
                return

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Runs one callback, waiting for it at most `timeout_sec` (default: no limit)."""
        raise NotImplementedError

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | TimeoutObject | None = None
    ) -> None:
        """Runs one callback unless the future gets done before."""
        raise NotImplementedError

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Ends spinning. Returns False if callbacks still run after `timeout_sec` (default: no limit)."""
        self._is_shutdown = True
        self._nodes = {}
        self._ready.clear()
        self._queued.clear()
        self._graph.wake()
        return True

    def __enter__(self) -> Executor:
        return self

    def __exit__(
        self, exc_type: type[BaseException] | None, exc_val: BaseException | None, exc_tb: TracebackType | None
    ) -> None:
        self.shutdown()


class SingleThreadedExecutor(Executor):
    """Runs callbacks in the thread that spins."""

    def _spin_once(
        self, timeout_sec: float | TimeoutObject | None, condition: Callable[[], bool] | None = None
    ) -> None:
        deadline_ns = self._deadline(timeout_sec)
        try:
            while True:
                entity, node = self._next(deadline_ns, condition)
                if self._execute(entity, node):
                    return
        except (TimeoutException, ShutdownException, ConditionReachedException):
            return

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Runs one callback, waiting for it at most `timeout_sec` (default: no limit).

        Raises what the callback raises, and `ExternalShutdownException` at shutdown.
        """
        self._spin_once(timeout_sec)

    def spin_once_until_future_complete(
        self, future: Future, timeout_sec: float | TimeoutObject | None = None
    ) -> None:
        """Runs one callback unless the future gets done before."""
        future._add_wake(self._graph.wake)
        self._spin_once(timeout_sec, future._is_done)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)


__all__ = [
    "ConditionReachedException",
    "Executor",
    "ExternalShutdownException",
    "InvalidHandle",
    "MultiThreadedExecutor",
    "ShutdownException",
    "SingleThreadedExecutor",
    "TimeoutException",
    "TimeoutObject",
    "await_or_execute",
]
