"""The executor that is driven by events: here all executors are."""

from __future__ import annotations

from rclpy.context import Context
from rclpy.executors import Executor, SingleThreadedExecutor


def EventsExecutor(*, context: Context | None = None) -> Executor:  # noqa: N802
    """Executor that runs callbacks in the thread that spins."""
    return SingleThreadedExecutor(context=context)
