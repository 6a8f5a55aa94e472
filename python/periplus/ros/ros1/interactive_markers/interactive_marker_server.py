"""Server of interactive markers: publishes them and receives what the user does."""

from __future__ import annotations

import copy
import threading
from collections.abc import Callable
from typing import Any

import rospy
from geometry_msgs.msg import Pose
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
_ANY = 255


class InteractiveMarkerServer:
    """Keeps markers; changes are sent by `applyChanges()`.

    Args:
        topic_ns: Namespace of the topics `update`, `update_full` and `feedback`.
        server_id: Name of the server (default that of the node).
        q_size: Number of updates that wait.
    """

    DEFAULT_FEEDBACK_CB = _ANY

    def __init__(self, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        self.topic_ns = topic_ns
        self.server_id = server_id or rospy.get_name()
        self.seq_num = 0
        self.mutex = threading.RLock()
        self._markers: dict[str, Any] = {}
        self._callbacks: dict[str, dict[int, Callable[[Any], Any]]] = {}
        self._last_client: dict[str, str] = {}
        self._changed: set[str] = set()
        self._moved: set[str] = set()
        self._erased: set[str] = set()
        self._pending: dict[str, Any] = {}
        self.init_pub = rospy.Publisher(f"{topic_ns}/update_full", InteractiveMarkerInit, latch=True, queue_size=100)
        self.update_pub = rospy.Publisher(f"{topic_ns}/update", InteractiveMarkerUpdate, queue_size=q_size)
        rospy.Subscriber(f"{topic_ns}/feedback", InteractiveMarkerFeedback, self.processFeedback, queue_size=q_size)
        rospy.Timer(rospy.Duration(_KEEP_ALIVE_S), lambda event: self._keep_alive())
        self._publish_init()

    def insert(self, marker: Any, feedback_callback: Any = -1, feedback_type: int = DEFAULT_FEEDBACK_CB) -> None:
        """Adds or replaces a marker, with a function of its feedback."""
        with self.mutex:
            self._pending[marker.name] = copy.deepcopy(marker)
            self._changed.add(marker.name)
            self._erased.discard(marker.name)
        if feedback_callback != -1:
            self.setCallback(marker.name, feedback_callback, feedback_type)

    def setPose(self, name: str, pose: Any, header: Any = None) -> bool:  # noqa: N802
        """Moves a marker; False for an unknown one."""
        with self.mutex:
            marker = self._pending.get(name) or copy.deepcopy(self._markers.get(name))
            if marker is None:
                return False
            marker.pose = copy.deepcopy(pose)
            if header is not None and header.frame_id:
                marker.header = copy.deepcopy(header)
            self._pending[name] = marker
            if name not in self._changed:
                self._moved.add(name)
            return True

    def erase(self, name: str) -> bool:
        """Removes a marker; False for an unknown one."""
        with self.mutex:
            self._changed.discard(name)
            self._moved.discard(name)
            known = self._pending.pop(name, None) is not None or name in self._markers
            if name in self._markers:
                self._erased.add(name)
            return known

    def clear(self) -> None:
        """Removes all markers."""
        for name in {*self._markers, *self._pending}:
            self.erase(name)

    def get(self, name: str) -> Any:
        """Marker as it is after the next `applyChanges()`, or None."""
        with self.mutex:
            if name in self._erased:
                return None
            found = self._pending.get(name) or self._markers.get(name)
            return copy.deepcopy(found)

    def setCallback(self, name: str, feedback_cb: Any, feedback_type: int = DEFAULT_FEEDBACK_CB) -> bool:  # noqa: N802
        """Sets the function of the feedback of a marker, or of one kind of it; None removes it."""
        with self.mutex:
            if name not in self._markers and name not in self._pending:
                return False
            own = self._callbacks.setdefault(name, {})
            if feedback_cb is None:
                own.pop(feedback_type, None)
            else:
                own[feedback_type] = feedback_cb
            return True

    def applyChanges(self) -> None:  # noqa: N802
        """Sends the changes."""
        with self.mutex:
            if not (self._changed or self._moved or self._erased):
                return
            update = InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.UPDATE)
            for name in sorted(self._changed):
                self._markers[name] = self._pending.pop(name)
                update.markers.append(self._markers[name])
            for name in sorted(self._moved):
                marker = self._markers[name] = self._pending.pop(name)
                update.poses.append(InteractiveMarkerPose(marker.header, marker.pose, name))
            for name in sorted(self._erased):
                self._markers.pop(name, None)
                self._callbacks.pop(name, None)
                update.erases.append(name)
            for changes in (self._changed, self._moved, self._erased):
                changes.clear()
            self.seq_num += 1
            self._send(update)
            self._publish_init()

    def processFeedback(self, feedback: Any) -> None:  # noqa: N802
        """Takes what a user has done: moves the marker and calls its function."""
        with self.mutex:
            name = feedback.marker_name
            marker = self._markers.get(name)
            if marker is None:
                return
            self._last_client[name] = feedback.client_id
            if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE:
                self.setPose(name, feedback.pose, feedback.header)
            own = self._callbacks.get(name, {})
            callback = own.get(feedback.event_type, own.get(_ANY))
        if callback is not None:
            callback(feedback)

    def _keep_alive(self) -> None:
        if not rospy.is_shutdown():
            self._send(InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.KEEP_ALIVE))

    def _send(self, update: Any) -> None:
        update.server_id, update.seq_num = self.server_id, self.seq_num
        self.update_pub.publish(update)

    def _publish_init(self) -> None:
        with self.mutex:
            made = InteractiveMarkerInit(self.server_id, self.seq_num, [self._markers[one] for one in sorted(self._markers)])
            self.init_pub.publish(made)


# Names that programs take from this module.
_ = (Header, InteractiveMarker, InteractiveMarkerControl, Pose)
