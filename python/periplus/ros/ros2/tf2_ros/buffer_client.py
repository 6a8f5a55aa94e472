"""Lookup of transforms in the buffer of another node, through its action `LookupTransform`."""

from __future__ import annotations

from typing import Any

from geometry_msgs.msg import TransformStamped
from periplus.ros import _waiting
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.time import Time
from tf2_msgs.action import LookupTransform
from tf2_msgs.msg import TF2Error

from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)
from tf2_py._core import time_ns
from tf2_ros.buffer_interface import BufferInterface

_EXCEPTIONS: dict[int, type[TransformException]] = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
}


class BufferClient(BufferInterface):
    """Client of a `BufferServer`. The node must be spun by another thread while a lookup waits."""

    def __init__(self, node: Any, ns: str, check_frequency: float = 10.0, timeout_padding: Any = None) -> None:
        super().__init__()
        self.node = node
        self.action_client = ActionClient(node, LookupTransform, ns)
        self.check_frequency = check_frequency
        self.timeout_padding = Duration(seconds=2.0) if timeout_padding is None else timeout_padding

    def destroy(self) -> None:
        """Ends the action client."""
        self.action_client.destroy()

    def wait_for_server(self, timeout: Any = None) -> bool:
        """True once the server is there, False after `timeout`."""
        seconds = None if timeout is None else time_ns(timeout) * 1e-9
        return bool(self.action_client.wait_for_server(timeout_sec=seconds))

    def lookup_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> Any:
        goal = LookupTransform.Goal(
            target_frame=target_frame, source_frame=source_frame, source_time=_stamp(time), advanced=False
        )
        return self._send(goal, timeout)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> Any:
        goal = LookupTransform.Goal(
            target_frame=target_frame,
            source_frame=source_frame,
            source_time=_stamp(source_time),
            target_time=_stamp(target_time),
            fixed_frame=fixed_frame,
            advanced=True,
        )
        return self._send(goal, timeout)

    def can_transform(self, target_frame: str, source_frame: str, time: Any, timeout: Any = None) -> bool:
        try:
            self.lookup_transform(target_frame, source_frame, time, timeout)
        except TransformException:
            return False
        return True

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = None,
    ) -> bool:
        try:
            self.lookup_transform_full(target_frame, target_time, source_frame, source_time, fixed_frame, timeout)
        except TransformException:
            return False
        return True

    def _send(self, goal: Any, timeout: Any) -> TransformStamped:
        wait_ns = time_ns(timeout) if timeout is not None else 0
        goal.timeout = Duration(nanoseconds=wait_ns).to_msg()
        if not self.action_client.server_is_ready():
            raise TimeoutException("The BufferServer is not ready.")
        done = _waiting.Event()
        outcome: list[Any] = []

        def on_result(future: Any) -> None:
            outcome.append(future.result().result)
            done.set()

        def on_accepted(future: Any) -> None:
            handle = future.result()
            if handle is None or not handle.accepted:
                done.set()
                return
            handle.get_result_async().add_done_callback(on_result)

        self.action_client.send_goal_async(goal).add_done_callback(on_accepted)
        done.wait((wait_ns + self.timeout_padding.nanoseconds) * 1e-9)
        if not outcome:
            raise TimeoutException("The LookupTransform goal sent to the BufferServer did not come back with a result.")
        error = outcome[0].error
        if error.error != TF2Error.NO_ERROR:
            raise _EXCEPTIONS.get(error.error, TransformException)(error.error_string)
        return outcome[0].transform


def _stamp(time: Any) -> Any:
    return time if hasattr(time, "nanosec") else Time(nanoseconds=time_ns(time)).to_msg()
