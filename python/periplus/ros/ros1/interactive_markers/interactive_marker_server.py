"""Server of interactive markers: publishes them and receives what the user does."""

from __future__ import annotations

from typing import Any

import rospy
from geometry_msgs.msg import Pose
from periplus.ros._marker_server import ANY_FEEDBACK, MarkerServer
from std_msgs.msg import Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerControl,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
)

_KEEP_ALIVE_S = 0.5


class InteractiveMarkerServer(MarkerServer):
    """Keeps markers; changes are sent by `applyChanges()`.

    Args:
        topic_ns: Namespace of the topics `update`, `update_full` and `feedback`.
        server_id: Name of the server (default that of the node).
        q_size: Number of updates that wait.
    """

    DEFAULT_FEEDBACK_CB = ANY_FEEDBACK

    def __init__(self, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        super().__init__()
        self.topic_ns = topic_ns
        self.server_id = server_id or rospy.get_name()
        self.init_pub = rospy.Publisher(f"{topic_ns}/update_full", InteractiveMarkerInit, latch=True, queue_size=100)
        self.update_pub = rospy.Publisher(f"{topic_ns}/update", InteractiveMarkerUpdate, queue_size=q_size)
        rospy.Subscriber(f"{topic_ns}/feedback", InteractiveMarkerFeedback, self.processFeedback, queue_size=q_size)
        rospy.Timer(rospy.Duration(_KEEP_ALIVE_S), lambda event: self._keep_alive())
        self._publish_init()

    def insert(self, marker: Any, feedback_callback: Any = -1, feedback_type: int = DEFAULT_FEEDBACK_CB) -> None:
        """Adds or replaces a marker, with a function of its feedback."""
        self._insert(marker)
        if feedback_callback != -1:
            self.setCallback(marker.name, feedback_callback, feedback_type)

    def _keep_alive(self) -> None:
        if not rospy.is_shutdown():
            self._publish(InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.KEEP_ALIVE))

    def _send(self, update: Any) -> None:
        self._publish(update)
        self._publish_init()

    def _publish(self, update: Any) -> None:
        update.server_id, update.seq_num = self.server_id, self.seq_num
        self.update_pub.publish(update)

    def _publish_init(self) -> None:
        with self.mutex:
            self.init_pub.publish(InteractiveMarkerInit(self.server_id, self.seq_num, self._in_order()))


# Names that programs take from this module.
_ = (Header, InteractiveMarker, InteractiveMarkerControl, InteractiveMarkerPose, Pose)
