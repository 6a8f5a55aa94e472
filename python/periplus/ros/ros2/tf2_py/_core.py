"""Buffer of transforms."""

from __future__ import annotations

import math
from typing import Any

from periplus import _native

from tf2_py._errors import exception_of

# Tolerance of the squared norm of a quaternion, as in tf2.
_QUATERNION_NORM_TOLERANCE_RATIO = 10e-3


def time_ns(time: Any) -> int:
    """Nanoseconds of a message stamp (`sec`, `nanosec`) or of an `rclpy.time.Time` (`nanoseconds`)."""
    seconds = getattr(time, "sec", None)
    if seconds is not None and hasattr(time, "nanosec"):
        return int(seconds) * 1_000_000_000 + int(time.nanosec)
    nanoseconds = getattr(time, "nanoseconds", None)
    if nanoseconds is None:
        raise TypeError(f"time must have sec and nanosec, or nanoseconds; {type(time).__name__!r} has neither.")
    return int(nanoseconds)


def _log(level: str, text: str) -> None:
    from rclpy.logging import get_logger

    getattr(get_logger("tf2"), level)(text)


class BufferCore:
    """Transforms between frames over time, without waiting."""

    def __init__(self, cache_time: Any = None) -> None:
        cache_s = 10.0 if cache_time is None else time_ns(cache_time) * 1e-9
        self._buffer = _native.TfBuffer(cache_s)

    # ---- transforms in

    def set_transform(self, transform: Any, authority: str) -> None:
        """Adds a transform; one that is not valid is logged and ignored."""
        self._add(transform, authority, False)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Adds a transform that holds at all times."""
        self._add(transform, authority, True)

    def _add(self, transform: Any, authority: str, is_static: bool) -> None:
        header = transform.header
        parent, child = header.frame_id, transform.child_frame_id
        translation, rotation = transform.transform.translation, transform.transform.rotation
        position = (translation.x, translation.y, translation.z)
        quaternion = (rotation.x, rotation.y, rotation.z, rotation.w)
        problem = _problem(parent.lstrip("/"), child.lstrip("/"), position, quaternion, authority)
        if problem is not None:
            _log("error", problem)
            return
        pose = _native.Pose.from_quaternion(position, quaternion)
        nanoseconds = time_ns(header.stamp)
        try:
            self._buffer.set_transform(
                parent, child, pose, time_ns=nanoseconds, is_static=is_static, authority=authority
            )
        except ValueError as error:
            _log("warning", str(error))

    # ---- transforms out

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Transform from `source_frame` to `target_frame` at a time; 0 is the latest common time."""
        nanoseconds = time_ns(time)
        try:
            pose = self._buffer.lookup(target_frame, source_frame, time_ns=nanoseconds)
            if nanoseconds == 0:
                nanoseconds = self._buffer.latest_time_ns(target_frame, source_frame)
        except _native.TransformError as error:
            raise exception_of(error) from None
        return _stamped(target_frame, source_frame, pose, nanoseconds)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Transform from `source_frame` at one time to `target_frame` at another, through a frame that is fixed."""
        try:
            first = self._buffer.lookup(target_frame, fixed_frame, time_ns=time_ns(target_time))
            second = self._buffer.lookup(fixed_frame, source_frame, time_ns=time_ns(source_time))
            nanoseconds = time_ns(target_time) or self._buffer.latest_time_ns(target_frame, fixed_frame)
        except _native.TransformError as error:
            raise exception_of(error) from None
        return _stamped(target_frame, source_frame, first * second, nanoseconds)

    def can_transform_core(self, target_frame: str, source_frame: str, time: Any) -> tuple[int, str]:
        """1 if there is a transform, 0 and the reason otherwise."""
        nanoseconds = time_ns(time)
        if target_frame == source_frame:
            return 1, ""
        # The quick test first: it makes no exception.
        if self._buffer.can_transform(target_frame, source_frame, time_ns=nanoseconds):
            return 1, ""
        reason = self._missing_frames(target_frame, source_frame)
        if not reason:
            try:
                self._buffer.lookup(target_frame, source_frame, time_ns=nanoseconds)
            except _native.TransformError as error:
                reason = str(error)
        return 0, reason

    def can_transform_full_core(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> tuple[int, str]:
        """1 if there is a transform between two times, 0 and the reason otherwise."""
        first = self.can_transform_core(target_frame, fixed_frame, target_time)
        return self.can_transform_core(fixed_frame, source_frame, source_time) if first[0] else first

    def _missing_frames(self, target_frame: str, source_frame: str) -> str:
        texts = []
        for role, frame in (("target_frame", target_frame), ("source_frame", source_frame)):
            if not frame:
                return f'Invalid argument "" passed to canTransform argument {role} - in tf2 frame_ids cannot be empty'
            if frame.startswith("/"):
                return (
                    f'Invalid argument "{frame}" passed to canTransform argument {role} - '
                    "in tf2 frame_ids cannot start with a '/'"
                )
        known = self._buffer.frames()
        for role, frame in (("target_frame", target_frame), ("source_frame", source_frame)):
            if frame not in known:
                texts.append(f"canTransform: {role} {frame} does not exist.")
        return " ".join(texts)

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Any:
        """Latest time at which there is a transform."""
        from rclpy.time import Time

        try:
            nanoseconds = self._buffer.latest_time_ns(target_frame, source_frame)
        except _native.TransformError as error:
            raise exception_of(error) from None
        return Time(nanoseconds=nanoseconds)

    # ---- frames

    def clear(self) -> None:
        """Removes all transforms, static ones excepted."""
        statics = [
            (status["parent"], status["frame"], self._buffer.lookup(status["parent"], status["frame"]), status["authority"])
            for status in self._buffer.frame_status()
            if status["is_static"]
        ]
        self._buffer.clear()
        for parent, child, pose, authority in statics:
            self._buffer.set_transform(parent, child, pose, time_ns=0, is_static=True, authority=authority)

    def all_frames_as_yaml(self, time: Any = None) -> str:
        """Frames with their parents and rates, as YAML."""
        return self._buffer.frames_yaml() or "{}"

    def all_frames_as_string(self) -> str:
        """Frames with their parents, one a line."""
        lines = [
            f"Frame {status['frame']} exists with parent {status['parent']}."
            for status in self._buffer.frame_status()
            if status.get("parent")
        ]
        return "".join(line + "\n" for line in lines)

    def _allFramesAsDot(self, time: Any = None) -> str:  # noqa: N802
        lines = ["digraph G {"]
        for status in self._buffer.frame_status():
            if status.get("parent"):
                lines.append(
                    f'"{status["parent"]}" -> "{status["frame"]}"[label=" Broadcaster: {status["authority"]}\\n'
                    f'Average rate: {status["rate_hz"]:.3f}\\nBuffer length: '
                    f'{status["newest_time_s"] - status["oldest_time_s"]:.3f}\\n'
                    f'Most recent transform: {status["newest_time_s"]:.6f}\\n'
                    f'Oldest transform: {status["oldest_time_s"]:.6f}\\n"];'
                )
        return "\n".join([*lines, "}"])

    def _frameExists(self, frame_id: str) -> bool:  # noqa: N802
        return frame_id in self._buffer.frames()

    def _getFrameStrings(self) -> list[str]:  # noqa: N802
        return self._buffer.frames()

    def _chain(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> list[str]:
        return self._buffer.chain(target_frame, source_frame) or []


def _problem(
    parent: str, child: str, position: tuple[float, ...], quaternion: tuple[float, ...], authority: str
) -> str | None:
    """Reason to ignore a transform, with the codes of tf2."""
    if child == parent and child:
        return (
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and child_frame_id  '
            f'"{child}" because they are the same'
        )
    if not child:
        return f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because child_frame_id not set '
    if not parent:
        return (
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}" from authority "{authority}" '
            "because frame_id not set"
        )
    if not all(math.isfinite(value) for value in (*position, *quaternion)):
        values = f"({' '.join(f'{one:f}' for one in position)}) ({' '.join(f'{one:f}' for one in quaternion)})"
        return (
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
            f"because of a nan value in the transform {values}"
        )
    norm = sum(one * one for one in quaternion)
    if abs(norm - 1.0) >= _QUATERNION_NORM_TOLERANCE_RATIO:
        return (
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from authority "{authority}" '
            f"because of an invalid quaternion in the transform ({' '.join(f'{one:f}' for one in quaternion)})"
        )
    return None


def _stamped(target_frame: str, source_frame: str, pose: _native.Pose, nanoseconds: int) -> Any:
    from geometry_msgs.msg import TransformStamped

    message = TransformStamped()
    stamp = message.header.stamp
    stamp.sec, stamp.nanosec = divmod(nanoseconds, 1_000_000_000)
    message.header.frame_id = target_frame
    message.child_frame_id = source_frame
    translation, rotation = message.transform.translation, message.transform.rotation
    translation.x, translation.y, translation.z = pose.position.tolist()
    rotation.x, rotation.y, rotation.z, rotation.w = pose.quaternion.tolist()
    return message
