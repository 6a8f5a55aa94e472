"""Reception of `/tf` and `/tf_static`."""

from __future__ import annotations

from typing import Any

import rospy
from rospy import core
from tf2_msgs.msg import TFMessage


class TransformListener:
    """Fills a buffer with the transforms that other nodes publish.

    Args:
        buffer: Buffer to fill.
        queue_size: Number of messages that wait (default all).
        buff_size: Ignored.
        tcp_nodelay: Ignored.
    """

    def __init__(self, buffer: Any, queue_size: int | None = None, buff_size: int = 65536, tcp_nodelay: bool = False) -> None:
        self.buffer = buffer
        self.tf_sub = rospy.Subscriber("/tf", TFMessage, self.callback, queue_size=queue_size)
        self.tf_static_sub = rospy.Subscriber("/tf_static", TFMessage, self.static_callback, queue_size=queue_size)

    def callback(self, data: Any) -> None:
        """Adds transforms."""
        for one in data.transforms:
            self.buffer.set_transform(one, "default_authority")
        core.state.graph.wake()

    def static_callback(self, data: Any) -> None:
        """Adds static transforms."""
        for one in data.transforms:
            self.buffer.set_transform_static(one, "default_authority")
        core.state.graph.wake()

    def unregister(self) -> None:
        """Ends the reception."""
        self.tf_sub.unregister()
        self.tf_static_sub.unregister()
