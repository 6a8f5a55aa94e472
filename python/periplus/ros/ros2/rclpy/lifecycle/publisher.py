"""Publishers of managed nodes."""

from __future__ import annotations

from typing import Any

from rclpy.lifecycle.managed_entity import SimpleManagedEntity
from rclpy.publisher import MsgType, Publisher

__all__ = ["LifecyclePublisher", "MsgType"]


class LifecyclePublisher(SimpleManagedEntity, Publisher):
    """Publisher that drops messages silently unless its node is active."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        SimpleManagedEntity.__init__(self)
        Publisher.__init__(self, *args, **kwargs)

    def publish(self, msg: Any) -> None:
        """Publishes a message while the node is active."""
        if self._enabled:
            Publisher.publish(self, msg)
