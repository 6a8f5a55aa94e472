"""Buffer of transforms that can wait."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import genpy
import rospy
from periplus.ros import _waiting
from rospy import core, rostime
from rospy.timer import _sleep_until
from tf2_py import BufferCore

from tf2_ros.buffer_interface import BufferInterface


class Buffer(BufferCore, BufferInterface):
    """Transforms between frames over time.

    Args:
        cache_time: Time for which transforms are kept (`Duration`, default 10 s).
        debug: Ignored.
    """

    def __init__(self, cache_time: Any = None, debug: bool = True) -> None:
        BufferCore.__init__(self, genpy.Duration(10) if cache_time is None else cache_time)

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Transform that takes data in `source_frame` to `target_frame`.

        Args:
            target_frame: Frame that the data is to be in.
            source_frame: Frame that the data is in.
            time: Time of the transform; zero for the latest.
            timeout: Time to wait for it (`Duration`, default none).
        """
        self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        """Transform from a frame at one time to a frame at another, through a frame that is fixed."""
        self.can_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        return self.lookup_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = None,
        return_debug_tuple: bool = False,
    ) -> Any:
        """True if there is a transform, at once or within the timeout; a pair with the reason if asked for."""
        result = self._wait(lambda: self.can_transform_core(target_frame, source_frame, time), timeout)
        return result if return_debug_tuple else bool(result[0])

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
        return_debug_tuple: bool = False,
    ) -> Any:
        """True if there is a transform between two times."""
        result = self._wait(
            lambda: self.can_transform_full_core(target_frame, target_time, source_frame, source_time, fixed_frame),
            timeout,
        )
        return result if return_debug_tuple else bool(result[0])

    def _wait(self, function: Callable[[], tuple[int, str]], timeout: Any) -> tuple[int, str]:
        nanoseconds = 0 if timeout is None else _nanoseconds(timeout)
        # Programs repeat a lookup until it succeeds.
        _waiting.poll()
        result = function()
        if result[0] or nanoseconds <= 0 or not core.is_initialized():
            return result
        begin = rostime.now_ns()

        def is_there() -> bool:
            nonlocal result
            result = function()
            return bool(result[0])

        try:
            _sleep_until(begin + nanoseconds, begin, is_there)
        except rospy.ROSInterruptException:
            if core.is_shutdown_requested():
                return result
            raise
        return function() if not result[0] else result

    def get_latest_common_time(self, target_frame: str, source_frame: str) -> Any:
        """Latest time at which there is a transform."""
        from periplus import _native
        from tf2_py._errors import exception_of

        try:
            nanoseconds = self._buffer.latest_time_ns(target_frame, source_frame)
        except _native.TransformError as error:
            raise exception_of(error) from None
        return rospy.Time(*divmod(nanoseconds, 10**9))


def _nanoseconds(timeout: Any) -> int:
    return int(timeout.to_nsec()) if isinstance(timeout, genpy.Duration) else int(timeout * 1e9)
