"""One callback: taking its data, the callback group, and the notes of an exception.

Entities have `callback_group`, `_has_work()`, `_take()` (None: nothing after all), `_call(taken, executor)`, `_kind`,
`_full_name()` and `_monitor`, which times the calls.
"""

from __future__ import annotations

from types import CoroutineType
from typing import TYPE_CHECKING, Any

from periplus.ros import _faults

from rclpy._clock_source import source

if TYPE_CHECKING:
    from collections.abc import Coroutine, Iterable

    from rclpy.executors import Executor
    from rclpy.node import Node


def run_entity(executor: Executor, entity: Any, node: Node) -> tuple[bool, Any]:
    """Runs the callback of an entity.

    Returns False if it could not run, and the coroutine if the callback is one; the entity's group is held until
    `finish` has run it.
    """
    group = entity.callback_group
    if not group.beginning_execution(entity):
        return False, None
    monitor = entity._monitor
    try:
        taken = entity._take()
        if taken is None:
            group.ending_execution(entity)
            return False, None
        executor._taken(entity)
        if monitor is None:
            monitor = entity._monitor = _make_monitor(entity, node)
        outer = monitor.start()
        try:
            result = entity._call(taken, executor)
        finally:
            monitor.end(outer)
    except BaseException as error:
        group.ending_execution(entity)
        if isinstance(error, Exception):
            _note(error, entity, node)
        raise
    if type(result) is CoroutineType:
        return True, result
    group.ending_execution(entity)
    return True, None


async def finish(entity: Any, node: Node, coroutine: Coroutine[Any, Any, Any]) -> None:
    """Runs the coroutine of a callback to its end, and frees its group."""
    try:
        await coroutine
    except Exception as error:
        _note(error, entity, node)
        raise
    finally:
        entity.callback_group.ending_execution(entity)
        node._rcl_graph.wake()


def _make_monitor(entity: Any, node: Node) -> _faults.CallbackMonitor:
    callback = getattr(entity, "callback", None)
    return _faults.CallbackMonitor(
        entity._call if callback is None else callback,
        node=node._rcl_full_name,
        kind=entity._kind,
        name=entity._full_name(),
        period_ns=getattr(entity, "_period_ns", None),
    )


def note_origin(error: BaseException, entity: Any, nodes: Iterable[Node]) -> None:
    """Adds the node and the client to an exception of a done callback."""
    for node in nodes:
        if any(own is entity for own in (*node.clients, *node.waitables)):
            _note(error, entity, node)


def _note(error: BaseException, entity: Any, node: Node) -> None:
    """Adds the node, the topic or timer, and the time to an exception."""
    _faults.callback_failed(
        error,
        node=node._rcl_full_name,
        kind=entity._kind,
        name=entity._full_name(),
        time_ns=source.system_ns(),
        callback=getattr(entity, "callback", None),
    )
