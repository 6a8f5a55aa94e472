"""Listener for `/tf` and `/tf_static`."""

from __future__ import annotations

from typing import Any

from periplus.ros import _waiting
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile
from tf2_msgs.msg import TFMessage

DEFAULT_TF_TOPIC = "/tf"
DEFAULT_STATIC_TF_TOPIC = "/tf_static"


class TransformListener:
    """Fills a buffer with the transforms of `/tf` and `/tf_static`.

    The node must be spun for that; `spin_thread=True` does so in a thread of its own.
    """

    def __init__(
        self,
        buffer: Any,
        node: Any,
        *,
        spin_thread: bool = False,
        qos: Any = None,
        static_qos: Any = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None:
        if qos is None:
            qos = QoSProfile(depth=100, durability=DurabilityPolicy.VOLATILE, history=HistoryPolicy.KEEP_LAST)
        if static_qos is None:
            static_qos = QoSProfile(
                depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL, history=HistoryPolicy.KEEP_LAST
            )
        self.buffer = buffer
        self.node = node
        buffer._listener_node = node
        # Lookups that wait in another callback must not block these.
        self.group = ReentrantCallbackGroup()
        self.tf_sub = node.create_subscription(TFMessage, tf_topic, self.callback, qos, callback_group=self.group)
        self.tf_static_sub = node.create_subscription(
            TFMessage, tf_static_topic, self.static_callback, static_qos, callback_group=self.group
        )
        if spin_thread:
            from rclpy.executors import SingleThreadedExecutor

            self.executor = SingleThreadedExecutor()
            self.dedicated_listener_thread = _waiting.start_thread(self._spin, "tf_listener")

    def _spin(self) -> None:
        from rclpy.executors import ExternalShutdownException

        self.executor.add_node(self.node)
        try:
            self.executor.spin()
        except ExternalShutdownException:
            pass
        finally:
            self.executor.remove_node(self.node)

    def __del__(self) -> None:
        executor = getattr(self, "executor", None)
        if executor is not None:
            executor.shutdown(timeout_sec=0)
        self.unregister()

    def unregister(self) -> None:
        """Ends the subscriptions."""
        for name in ("tf_sub", "tf_static_sub"):
            subscription = self.__dict__.get(name)
            if subscription is not None:
                self.node.destroy_subscription(subscription)

    def callback(self, data: Any) -> None:
        """Adds the transforms of a message."""
        add = self.buffer.set_transform
        for transform in data.transforms:
            add(transform, "default_authority")

    def static_callback(self, data: Any) -> None:
        """Adds the static transforms of a message."""
        add = self.buffer.set_transform_static
        for transform in data.transforms:
            add(transform, "default_authority")
