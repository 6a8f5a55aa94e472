"""Publication of transforms."""

from __future__ import annotations

from typing import Any

import rospy
from tf2_msgs.msg import TFMessage


class TransformBroadcaster:
    """Publishes transforms on `/tf`."""

    def __init__(self) -> None:
        self.pub_tf = rospy.Publisher("/tf", TFMessage, queue_size=100)

    def sendTransform(self, transform: Any) -> None:  # noqa: N802
        """Publishes a `TransformStamped` or a list of them."""
        self.pub_tf.publish(TFMessage(_listed(transform)))


class StaticTransformBroadcaster:
    """Publishes transforms that hold at all times on `/tf_static`."""

    def __init__(self) -> None:
        self.pub_tf = rospy.Publisher("/tf_static", TFMessage, queue_size=100, latch=True)
        self.net_message = TFMessage()

    def sendTransform(self, transform: Any) -> None:  # noqa: N802
        """Publishes a `TransformStamped` or a list of them, with all those before. The newest of each child holds."""
        given = {one.child_frame_id: one for one in _listed(transform)}
        kept = [one for one in self.net_message.transforms if one.child_frame_id not in given]
        self.net_message = TFMessage([*kept, *given.values()])
        self.pub_tf.publish(self.net_message)


def _listed(transform: Any) -> list[Any]:
    return list(transform) if isinstance(transform, (list, tuple)) else [transform]
