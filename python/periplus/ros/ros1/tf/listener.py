"""Lookup of transforms."""

from __future__ import annotations

from typing import Any

import genpy
import tf2_ros
from geometry_msgs.msg import Point32, PointStamped, PoseStamped, QuaternionStamped, Vector3Stamped
from tf2_py import TransformException

from tf import transformations


def strip_leading_slash(name: str) -> str:
    """Name of a frame without a slash at its front, which tf permits and tf2 does not."""
    return name[1:] if name.startswith("/") else name


def xyz_to_mat44(pos: Any) -> Any:
    """Matrix of a position."""
    return transformations.translation_matrix((pos.x, pos.y, pos.z))


def xyzw_to_mat44(ori: Any) -> Any:
    """Matrix of a quaternion."""
    return transformations.quaternion_matrix((ori.x, ori.y, ori.z, ori.w))


class Transformer:
    """Transforms between frames over time, without messages.

    Args:
        interpolate: Ignored: transforms are interpolated.
        cache_time: Time for which they are kept (`Duration`, default 10 s).
    """

    def __init__(self, interpolate: bool = True, cache_time: Any = None) -> None:
        self._buffer = tf2_ros.Buffer(cache_time, debug=False)
        self._using_dedicated_thread = False

    def setTransform(self, transform: Any, authority: str = "default_authority") -> None:  # noqa: N802
        """Adds a `TransformStamped`."""
        self._buffer.set_transform(transform, authority)

    def canTransform(self, target_frame: str, source_frame: str, time: Any) -> bool:  # noqa: N802
        """True if there is a transform at a time."""
        return bool(
            self._buffer.can_transform(strip_leading_slash(target_frame), strip_leading_slash(source_frame), time)
        )

    def canTransformFull(  # noqa: N802
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> bool:
        """True if there is a transform between two times."""
        return bool(
            self._buffer.can_transform_full(
                strip_leading_slash(target_frame),
                target_time,
                strip_leading_slash(source_frame),
                source_time,
                strip_leading_slash(fixed_frame),
            )
        )

    def waitForTransform(  # noqa: N802
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Waits for a transform. Raises `tf.Exception` at the timeout."""
        ok, reason = self._buffer.can_transform(
            strip_leading_slash(target_frame), strip_leading_slash(source_frame), time, timeout, return_debug_tuple=True
        )
        if not ok:
            raise TransformException(reason or "the transform is missing")

    def waitForTransformFull(  # noqa: N802
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any,
        polling_sleep_duration: Any = None,
    ) -> None:
        """Waits for a transform between two times. Raises `tf.Exception` at the timeout."""
        ok, reason = self._buffer.can_transform_full(
            strip_leading_slash(target_frame),
            target_time,
            strip_leading_slash(source_frame),
            source_time,
            strip_leading_slash(fixed_frame),
            timeout,
            return_debug_tuple=True,
        )
        if not ok:
            raise TransformException(reason or "the transform is missing")

    def lookupTransform(self, target_frame: str, source_frame: str, time: Any) -> tuple[list[float], list[float]]:  # noqa: N802
        """Position and quaternion (x, y, z, w) of `source_frame` in `target_frame`; `Time(0)` is the latest."""
        found = self._buffer.lookup_transform(
            strip_leading_slash(target_frame), strip_leading_slash(source_frame), time
        )
        return _lists(found)

    def lookupTransformFull(  # noqa: N802
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> tuple[list[float], list[float]]:
        """Position and quaternion between two times."""
        found = self._buffer.lookup_transform_full(
            strip_leading_slash(target_frame),
            target_time,
            strip_leading_slash(source_frame),
            source_time,
            strip_leading_slash(fixed_frame),
        )
        return _lists(found)

    def lookupTwist(self, tracking_frame: str, observation_frame: str, time: Any, averaging_interval: Any) -> Any:  # noqa: N802
        """Velocity of a frame: linear and angular, averaged over an interval."""
        import numpy as np

        half = averaging_interval * 0.5
        latest = self.getLatestCommonTime(tracking_frame, observation_frame)
        end = latest if not time or time + half > latest else time + half
        start = end - averaging_interval
        first_place, first_turn = self.lookupTransform(observation_frame, tracking_frame, start)
        last_place, last_turn = self.lookupTransform(observation_frame, tracking_frame, end)
        seconds = averaging_interval.to_sec()
        linear = (np.array(last_place) - np.array(first_place)) / seconds
        turn = transformations.quaternion_multiply(last_turn, transformations.quaternion_inverse(first_turn))
        angle, axis, _ = transformations.rotation_from_matrix(transformations.quaternion_matrix(turn))
        return tuple(linear), tuple(np.array(axis) * angle / seconds)

    def getLatestCommonTime(self, source_frame: str, dest_frame: str) -> Any:  # noqa: N802
        """Latest time at which there is a transform."""
        return self._buffer.get_latest_common_time(strip_leading_slash(source_frame), strip_leading_slash(dest_frame))

    def chain(self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str) -> Any:
        """Frames between two frames."""
        return self._buffer._chain(target_frame, target_time, source_frame, source_time, fixed_frame)

    def frameExists(self, frame_id: str) -> bool:  # noqa: N802
        """True for a frame that is known."""
        return bool(self._buffer._frameExists(strip_leading_slash(frame_id)))

    def getFrameStrings(self) -> list[str]:  # noqa: N802
        """Names of all frames."""
        return list(self._buffer._getFrameStrings())

    def allFramesAsDot(self, current_time: Any = None) -> str:  # noqa: N802
        """Graph of the frames in the language of Graphviz."""
        return str(self._buffer._allFramesAsDot(current_time))

    def allFramesAsString(self) -> str:  # noqa: N802
        """Frames with their parents, one a line."""
        return str(self._buffer.all_frames_as_string())

    def clear(self) -> None:
        """Removes all transforms."""
        self._buffer.clear()

    def setUsingDedicatedThread(self, value: bool) -> None:  # noqa: N802
        self._using_dedicated_thread = value


def _lists(found: Any) -> tuple[list[float], list[float]]:
    place, turn = found.transform.translation, found.transform.rotation
    return [place.x, place.y, place.z], [turn.x, turn.y, turn.z, turn.w]


class TransformerROS(Transformer):
    """Transforms of messages."""

    def asMatrix(self, target_frame: str, hdr: Any) -> Any:  # noqa: N802
        """Matrix that takes data with this header to a frame."""
        return self.fromTranslationRotation(*self.lookupTransform(target_frame, hdr.frame_id, hdr.stamp))

    def fromTranslationRotation(self, translation: Any, rotation: Any) -> Any:  # noqa: N802
        """Matrix of a position and a quaternion."""
        import numpy as np

        return np.dot(transformations.translation_matrix(translation), transformations.quaternion_matrix(rotation))

    def transformPoint(self, target_frame: str, ps: Any) -> Any:  # noqa: N802
        """`PointStamped` in another frame."""
        import numpy as np

        xyz = np.dot(self.asMatrix(target_frame, ps.header), np.array([ps.point.x, ps.point.y, ps.point.z, 1.0]))
        made = PointStamped()
        _head(made, ps, target_frame)
        made.point.x, made.point.y, made.point.z = (float(one) for one in xyz[:3])
        return made

    def transformVector3(self, target_frame: str, v3s: Any) -> Any:  # noqa: N802
        """`Vector3Stamped` in another frame; only the rotation counts."""
        import numpy as np

        matrix = self.asMatrix(target_frame, v3s.header)
        xyz = np.dot(matrix[:3, :3], np.array([v3s.vector.x, v3s.vector.y, v3s.vector.z]))
        made = Vector3Stamped()
        _head(made, v3s, target_frame)
        made.vector.x, made.vector.y, made.vector.z = (float(one) for one in xyz)
        return made

    def transformQuaternion(self, target_frame: str, ps: Any) -> Any:  # noqa: N802
        """`QuaternionStamped` in another frame."""
        import numpy as np

        matrix = np.dot(self.asMatrix(target_frame, ps.header), xyzw_to_mat44(ps.quaternion))
        made = QuaternionStamped()
        _head(made, ps, target_frame)
        turn = made.quaternion
        turn.x, turn.y, turn.z, turn.w = (float(one) for one in transformations.quaternion_from_matrix(matrix))
        return made

    def transformPose(self, target_frame: str, ps: Any) -> Any:  # noqa: N802
        """`PoseStamped` in another frame."""
        import numpy as np

        pose = np.dot(xyz_to_mat44(ps.pose.position), xyzw_to_mat44(ps.pose.orientation))
        matrix = np.dot(self.asMatrix(target_frame, ps.header), pose)
        made = PoseStamped()
        _head(made, ps, target_frame)
        place, turn = made.pose.position, made.pose.orientation
        place.x, place.y, place.z = (float(one) for one in transformations.translation_from_matrix(matrix)[:3])
        turn.x, turn.y, turn.z, turn.w = (float(one) for one in transformations.quaternion_from_matrix(matrix))
        return made

    def transformPointCloud(self, target_frame: str, point_cloud: Any) -> Any:  # noqa: N802
        """`PointCloud` in another frame."""
        import numpy as np

        made = type(point_cloud)()
        _head(made, point_cloud, target_frame)
        made.channels = point_cloud.channels
        matrix = self.asMatrix(target_frame, point_cloud.header)
        points = np.array([(one.x, one.y, one.z, 1.0) for one in point_cloud.points]).reshape(-1, 4)
        made.points = [Point32(*(float(one) for one in row[:3])) for row in np.dot(points, matrix.T)]
        return made


def _head(made: Any, given: Any, target_frame: str) -> None:
    made.header.stamp = genpy.Time(given.header.stamp.secs, given.header.stamp.nsecs)
    made.header.frame_id = target_frame


class TransformListener(TransformerROS):
    """Transforms that other nodes publish on `/tf` and `/tf_static`."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._listener = tf2_ros.TransformListener(self._buffer)
        self.setUsingDedicatedThread(True)

    def unregister(self) -> None:
        """Ends the reception."""
        self._listener.unregister()


