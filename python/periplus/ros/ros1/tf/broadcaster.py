"""Publication of transforms."""

from __future__ import annotations

from typing import Any

import rospy
from geometry_msgs.msg import TransformStamped
from tf2_msgs.msg import TFMessage


class TransformBroadcaster:
    """Publishes transforms on `/tf`."""

    def __init__(self, queue_size: int = 100) -> None:
        self.pub_tf = rospy.Publisher("/tf", TFMessage, queue_size=queue_size)

    def sendTransform(self, translation: Any, rotation: Any, time: Any, child: str, parent: str) -> None:  # noqa: N802
        """Publishes the pose of a frame in its parent.

        Args:
            translation: x, y, z [m].
            rotation: Quaternion x, y, z, w.
            time: Time of the pose.
            child: Frame.
            parent: Its parent.
        """
        made = TransformStamped()
        made.header.frame_id = parent
        made.header.stamp = time
        made.child_frame_id = child
        place, turn = made.transform.translation, made.transform.rotation
        place.x, place.y, place.z = (float(one) for one in translation)
        turn.x, turn.y, turn.z, turn.w = (float(one) for one in rotation)
        self.sendTransformMessage(made)

    def sendTransformMessage(self, transform: Any) -> None:  # noqa: N802
        """Publishes a `TransformStamped`."""
        self.pub_tf.publish(TFMessage([transform]))
