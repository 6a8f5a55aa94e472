"""The topic /rosout."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy import _log_output
from rclpy.duration import Duration
from rclpy.qos import DurabilityPolicy, QoSProfile

if TYPE_CHECKING:
    from rclpy.node import Node

# Same as in the compiled core: kept for late subscriptions, for ten seconds.
_QOS = QoSProfile(depth=1000, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(seconds=10))


class Rosout:
    """Publishes the messages of a node's logger."""

    def __init__(self, node: Node) -> None:
        self._native = node._rcl_native.publisher("/rosout", "rcl_interfaces/msg/Log", _QOS._to_native())
        self._context = node._context
        self._name = node._logger.name
        self._publish = self.publish
        if self._name in _log_output.rosout:
            _log_output.report(
                30,
                "rcl.logging_rosout",
                f"Publisher already registered for node name: '{node._rcl_native.name}'. If this is due to multiple nodes "
                f"with the same name then all logs for the logger named '{self._name}' will go out over the existing "
                "publisher. As soon as any node with that name is destructed it will unregister the publisher, "
                "preventing any further logs for that name from being published on the rosout topic.",
            )
        else:
            _log_output.rosout[self._name] = self._publish

    def publish(self, nanoseconds: int, severity: int, name: str, text: str, file: str, function: str, line: int) -> None:
        """Publishes one message."""
        if not self._context._valid:
            return
        from builtin_interfaces.msg import Time
        from rcl_interfaces.msg import Log

        message: Any = Log(
            stamp=Time(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9),
            level=severity,
            name=name,
            msg=text,
            file=file,
            function=function,
            line=line,
        )
        self._native.publish(message)

    def destroy(self) -> None:
        """Ends the publisher."""
        for name in [name for name, publish in _log_output.rosout.items() if publish is self._publish]:
            del _log_output.rosout[name]
        self._native.close()
