"""A context with nodes for tests of rclpy in this process, on a network of their own."""

import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import periplus.ros

periplus.ros.activate(quiet=True)

import rclpy  # noqa: E402
from rclpy.executors import SingleThreadedExecutor  # noqa: E402


class Nodes:
    """Nodes and an executor of one context."""

    def __init__(self, context: Any) -> None:
        self.context = context
        self.executor = SingleThreadedExecutor(context=context)

    def make(self, name: str, cls: Any = None, **options: Any) -> Any:
        """A node in the executor."""
        from rclpy.node import Node

        node = (cls or Node)(name, context=self.context, **options)
        self.executor.add_node(node)
        return node

    def until(self, condition: Callable[[], Any], seconds: float = 20.0) -> Any:
        """Spins until the condition gives something true, and returns it."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            found = condition()
            if found:
                return found
            self.executor.spin_once(timeout_sec=0.02)
        raise AssertionError(f"not within {seconds} s")

    def result(self, future: Any) -> Any:
        """Result of a future."""
        self.until(future.done)
        return future.result()


@contextmanager
def nodes(*arguments: str) -> Iterator[Nodes]:
    """Nodes in a context with ROS arguments."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_LOG_DIR", tempfile.mkdtemp())
    context = rclpy.Context()
    context.init(["test", *(("--ros-args", *arguments) if arguments else ())], domain_id=100 + os.getpid() % 100)
    made = Nodes(context)
    try:
        yield made
    finally:
        for node in made.executor.get_nodes():
            node.destroy_node()
        made.executor.shutdown()
        context.try_shutdown()
        context.destroy()
