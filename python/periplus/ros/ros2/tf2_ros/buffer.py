"""Buffer of transforms that waits for them."""

from __future__ import annotations

import threading
import time as _time
from collections.abc import Callable
from typing import Any

from periplus.ros import _waiting
from rclpy.duration import Duration
from rclpy.logging import get_logger

from tf2_py import BufferCore
from tf2_py._core import time_ns
from tf2_ros.buffer_interface import BufferInterface

# Interval at which a waiting lookup tests the buffer [ns].
_POLL_NS = 20_000_000


class Buffer(BufferCore, BufferInterface):
    """Transforms of the last `cache_time` (default 10 s).

    With `node`, the buffer offers the service `tf2_frames` and is cleared when the time of the node jumps back.
    """

    def __init__(self, cache_time: Any = None, node: Any = None) -> None:
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._new_data_callbacks: list[Callable[[], None]] = []
        self._callbacks_lock = threading.RLock()
        self._jump_handle: Any = None
        # Node of the listener that fills this buffer.
        self._listener_node: Any = None
        self.srv: Any = None
        if node is not None:
            self._serve(node)

    def _serve(self, node: Any) -> None:
        from rclpy.clock import JumpThreshold
        from tf2_msgs.srv import FrameGraph

        self.srv = node.create_service(FrameGraph, "tf2_frames", self._answer_frames)
        threshold = JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True)
        self._jump_handle = node.get_clock().create_jump_callback(threshold, post_callback=self._on_jump)

    def _answer_frames(self, request: Any, response: Any) -> Any:
        response.frame_yaml = self.all_frames_as_yaml()
        return response

    def _on_jump(self, jump: Any) -> None:
        get_logger("tf2_buffer").warning("Detected jump back in time. Clearing tf buffer.")
        self.clear()

    def set_transform(self, transform: Any, authority: str) -> None:
        """Adds a transform."""
        super().set_transform(transform, authority)
        if self._new_data_callbacks:
            self._call_new_data_callbacks()

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Adds a transform that holds at all times."""
        super().set_transform_static(transform, authority)
        if self._new_data_callbacks:
            self._call_new_data_callbacks()

    def _call_new_data_callbacks(self) -> None:
        with self._callbacks_lock:
            waiting = list(self._new_data_callbacks)
        for callback in waiting:
            callback()

    # ---- lookups that may wait

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        """Transform from `source_frame` to `target_frame`; waits for it up to `timeout` (default 0)."""
        self._wait(timeout, lambda: self.can_transform_core(target_frame, source_frame, time)[0])
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
        """Transform between two times, through a frame that is fixed."""
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(timeout, lambda: self.can_transform_full_core(*arguments)[0])
        return self.lookup_transform_full_core(*arguments)

    def can_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = None, return_debug_tuple: bool = False
    ) -> Any:
        """1 if there is a transform, 0 otherwise; with `return_debug_tuple` and the reason."""
        self._wait(timeout, lambda: self.can_transform_core(target_frame, source_frame, time)[0])
        made = self.can_transform_core(target_frame, source_frame, time)
        return made if return_debug_tuple else made[0]

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
        """1 if there is a transform between two times, 0 otherwise; with `return_debug_tuple` and the reason."""
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        self._wait(timeout, lambda: self.can_transform_full_core(*arguments)[0])
        made = self.can_transform_full_core(*arguments)
        return made if return_debug_tuple else made[0]

    def _wait(self, timeout: Any, is_there: Callable[[], Any]) -> None:
        """Waits until a transform is there, by the wall clock (by simulated time in lockstep)."""
        if timeout is None:
            return
        left_ns = time_ns(timeout)
        if left_ns <= 0 or is_there():
            return
        end_s = _time.monotonic() + left_ns * 1e-9
        while _time.monotonic() < end_s:
            _waiting.sleep_ns(None, _POLL_NS)
            if is_there():
                return

    # ---- lookups for coroutines

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Transform from `source_frame` to `target_frame`, once there is one."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Transform between two times, once there is one."""
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        await self.wait_for_transform_full_async(*arguments)
        return self.lookup_transform_full_core(*arguments)

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """Future that is done, with the transform, once there is one."""
        return self._future(
            lambda: self.can_transform_core(target_frame, source_frame, time)[0],
            lambda: self.lookup_transform_core(target_frame, source_frame, time),
        )

    def wait_for_transform_full_async(
        self, target_frame: str, target_time: Any, source_frame: str, source_time: Any, fixed_frame: str
    ) -> Any:
        """Future that is done, with the transform, once there is one between two times."""
        arguments = (target_frame, target_time, source_frame, source_time, fixed_frame)
        return self._future(
            lambda: self.can_transform_full_core(*arguments)[0], lambda: self.lookup_transform_full_core(*arguments)
        )

    def _future(self, is_there: Callable[[], Any], lookup: Callable[[], Any]) -> Any:
        from rclpy.task import Future

        # With an executor, callbacks of the future run after the callback that asked: they may need its locks.
        executor = None if self._listener_node is None else self._listener_node.executor
        future: Any = Future(executor=executor)
        if is_there():
            future.set_result(lookup())
            return future

        def on_new_data() -> None:
            try:
                if not future.cancelled():
                    if not is_there():
                        return
                    future.set_result(lookup())
            except BaseException as error:
                future.set_exception(error)
            with self._callbacks_lock:
                if on_new_data in self._new_data_callbacks:
                    self._new_data_callbacks.remove(on_new_data)

        with self._callbacks_lock:
            self._new_data_callbacks.append(on_new_data)
        return future
