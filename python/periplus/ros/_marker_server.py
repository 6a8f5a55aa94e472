"""Interactive markers of both generations of ROS: the markers, their pending changes and the feedback of users."""

from __future__ import annotations

import copy
import importlib
import threading
from collections.abc import Callable
from typing import Any

#: Kind of feedback whose function gets all kinds that have none of their own.
ANY_FEEDBACK = 255


class MarkerServer:
    """Keeps markers; changes are sent by `applyChanges()`. The servers of `rospy` and `rclpy` add the transport."""

    def __init__(self) -> None:
        # Of the generation that the program uses.
        self._messages: Any = importlib.import_module("visualization_msgs.msg")
        self.seq_num = 0
        self.mutex = threading.RLock()
        self._markers: dict[str, Any] = {}
        self._callbacks: dict[str, dict[int, Callable[[Any], Any]]] = {}
        self._changed: set[str] = set()
        self._moved: set[str] = set()
        self._erased: set[str] = set()
        self._pending: dict[str, Any] = {}

    def _send(self, update: Any) -> None:
        """Publishes an update; called with the lock, after the markers have changed."""
        raise NotImplementedError

    def _insert(self, marker: Any) -> None:
        with self.mutex:
            self._pending[marker.name] = copy.deepcopy(marker)
            self._changed.add(marker.name)
            self._moved.discard(marker.name)
            self._erased.discard(marker.name)

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

    def setCallback(self, name: str, feedback_cb: Any, feedback_type: int = ANY_FEEDBACK) -> bool:  # noqa: N802
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
            update = self._messages.InteractiveMarkerUpdate(type=self._messages.InteractiveMarkerUpdate.UPDATE)
            for name in sorted(self._changed):
                self._markers[name] = self._pending.pop(name)
                update.markers.append(self._markers[name])
            for name in sorted(self._moved):
                marker = self._markers[name] = self._pending.pop(name)
                update.poses.append(self._messages.InteractiveMarkerPose(header=marker.header, pose=marker.pose, name=name))
            for name in sorted(self._erased):
                self._markers.pop(name, None)
                self._callbacks.pop(name, None)
                update.erases.append(name)
            for changes in (self._changed, self._moved, self._erased):
                changes.clear()
            self.seq_num += 1
            self._send(update)

    def processFeedback(self, feedback: Any) -> None:  # noqa: N802
        """Takes what a user has done: moves the marker and calls its function."""
        with self.mutex:
            name = feedback.marker_name
            if name not in self._markers:
                return
            if feedback.event_type == self._messages.InteractiveMarkerFeedback.POSE_UPDATE:
                self.setPose(name, feedback.pose, feedback.header)
            own = self._callbacks.get(name, {})
            callback = own.get(feedback.event_type, own.get(ANY_FEEDBACK))
        if callback is not None:
            callback(feedback)

    def _in_order(self) -> list[Any]:
        """The markers by name."""
        return [self._markers[name] for name in sorted(self._markers)]
