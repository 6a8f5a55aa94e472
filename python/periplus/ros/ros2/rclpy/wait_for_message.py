"""Waiting for one message."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy.client import wait_until

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile


def wait_for_message(
    msg_type: Any, node: Node, topic: str, *, qos_profile: QoSProfile | int = 1, time_to_wait: float = -1
) -> tuple[bool, Any]:
    """Waits for the next message of a topic, without spinning the node.

    Returns `(True, message)`, or `(False, None)` after `time_to_wait` [s] (default -1: no limit) or at shutdown.
    """
    subscription = node.create_subscription(msg_type, topic, lambda message: None, qos_profile)
    # The executor must not take the message.
    node._subscriptions = [one for one in node._subscriptions if one is not subscription]
    try:
        native = subscription._native
        timeout_sec = None if time_to_wait < 0 else time_to_wait
        while wait_until(node.context, lambda: native.has_data, timeout_sec):
            taken = native.take()
            if taken is not None:
                return True, taken[0]
        return False, None
    finally:
        subscription.destroy()


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
