"""Server of interactive markers: publishes them and receives what the user does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from periplus.ros._marker_server import ANY_FEEDBACK, MarkerServer
from rclpy.duration import Duration
from rclpy.qos import QoSProfile
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerUpdate
from visualization_msgs.srv import GetInteractiveMarkers

if TYPE_CHECKING:
    from rclpy.node import Node

#: Time for which a marker listens to the viewer that has moved it last, and to no other [s].
_OWNED_S = 1.0


class InteractiveMarkerServer(MarkerServer):
    """Keeps markers; changes are sent by `applyChanges()`.

    Args:
        node: Node of the server.
        namespace: Namespace of the topics `update` and `feedback`, and of the service `get_interactive_markers`.
        update_pub_qos: QoS of the updates.
        feedback_sub_qos: QoS of the feedback.
    """

    DEFAULT_FEEDBACK_CALLBACK = ANY_FEEDBACK

    def __init__(
        self,
        node: Node,
        namespace: str,
        *,
        update_pub_qos: QoSProfile | int = QoSProfile(depth=100),  # noqa: B008
        feedback_sub_qos: QoSProfile | int = QoSProfile(depth=1),  # noqa: B008
    ) -> None:
        super().__init__()
        self.node = node
        # Client and time of the last feedback of each marker.
        self._owners: dict[str, tuple[str, Any]] = {}
        self.get_interactive_markers_srv = node.create_service(
            GetInteractiveMarkers, f"{namespace}/get_interactive_markers", self.getInteractiveMarkersCallback
        )
        self.update_pub = node.create_publisher(InteractiveMarkerUpdate, f"{namespace}/update", update_pub_qos)
        self.feedback_sub = node.create_subscription(
            InteractiveMarkerFeedback, f"{namespace}/feedback", self.processFeedback, feedback_sub_qos
        )

    def shutdown(self) -> None:
        """Removes the markers, the topics and the service."""
        self.clear()
        self.applyChanges()
        self.node.destroy_publisher(self.update_pub)
        self.node.destroy_subscription(self.feedback_sub)
        self.node.destroy_service(self.get_interactive_markers_srv)

    def insert(self, marker: Any, *, feedback_callback: Any = None, feedback_type: int = DEFAULT_FEEDBACK_CALLBACK) -> None:
        """Adds or replaces a marker, with a function of its feedback."""
        self._insert(marker)
        if feedback_callback is not None:
            self.setCallback(marker.name, feedback_callback, feedback_type)

    def setCallback(  # noqa: N802
        self, name: str, feedback_callback: Any, feedback_type: int = DEFAULT_FEEDBACK_CALLBACK
    ) -> bool:
        """Sets the function of the feedback of a marker, or of one kind of it; None removes it. False for an unknown one."""
        return super().setCallback(name, feedback_callback, feedback_type)

    def processFeedback(self, feedback: Any) -> None:  # noqa: N802
        """Takes what a user has done, unless another one has the marker: moves it and calls its function."""
        now = self.node.get_clock().now()
        client, since = self._owners.get(feedback.marker_name, ("", now))
        if client and client != feedback.client_id and now - since < Duration(seconds=_OWNED_S):
            return
        self._owners[feedback.marker_name] = (feedback.client_id, now)
        super().processFeedback(feedback)

    def getInteractiveMarkersCallback(self, request: Any, response: Any) -> Any:  # noqa: N802
        """Answers a viewer that begins to show the markers."""
        with self.mutex:
            response.sequence_number = self.seq_num
            response.markers = self._in_order()
        return response

    def publish(self, update: Any) -> None:
        """Publishes an update with the number of the state."""
        update.seq_num = self.seq_num
        self.update_pub.publish(update)

    def _send(self, update: Any) -> None:
        self.publish(update)
