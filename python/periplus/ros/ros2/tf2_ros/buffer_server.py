"""Lookup of transforms for other nodes, as the action `LookupTransform`."""

from __future__ import annotations

from typing import Any

from rclpy.action import ActionServer
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

_CODES: dict[type[TransformException], int] = {
    LookupException: TF2Error.LOOKUP_ERROR,
    ConnectivityException: TF2Error.CONNECTIVITY_ERROR,
    ExtrapolationException: TF2Error.EXTRAPOLATION_ERROR,
    InvalidArgumentException: TF2Error.INVALID_ARGUMENT_ERROR,
    TimeoutException: TF2Error.TIMEOUT_ERROR,
}


class BufferServer:
    """Answers lookups of `BufferClient` objects with the transforms of a buffer."""

    def __init__(self, node: Any, buffer: Any, ns: str, check_period: Any = None) -> None:
        self.node = node
        self.buffer = buffer
        self.check_period = Duration(seconds=0.01) if check_period is None else check_period
        self.action_server = ActionServer(node, LookupTransform, ns, self.execute_callback)

    async def execute_callback(self, goal_handle: Any) -> Any:
        """Answers one lookup, once the transform is there or the time limit has passed."""
        goal = goal_handle.request
        result = LookupTransform.Result()
        try:
            if not self._can_transform(goal):
                await self._wait(goal)
            result.transform = self._lookup(goal)
            goal_handle.succeed()
        except TransformException as error:
            result.error.error = _CODES.get(type(error), TF2Error.TRANSFORM_ERROR)
            result.error.error_string = str(error)
            goal_handle.abort()
        return result

    async def _wait(self, goal: Any) -> None:
        from rclpy.task import Future

        done: Any = Future()
        end = self.node.get_clock().now() + Duration.from_msg(goal.timeout)

        def look() -> None:
            if self._can_transform(goal) or self.node.get_clock().now() >= end:
                done.set_result(True)

        timer = self.node.create_timer(self.check_period.nanoseconds * 1e-9, look)
        try:
            await done
        finally:
            self.node.destroy_timer(timer)

    def _arguments(self, goal: Any) -> tuple[Any, ...]:
        source_time = Time.from_msg(goal.source_time)
        if not goal.advanced:
            return (goal.target_frame, goal.source_frame, source_time)
        target_time = Time.from_msg(goal.target_time)
        return (goal.target_frame, target_time, goal.source_frame, source_time, goal.fixed_frame)

    def _can_transform(self, goal: Any) -> bool:
        can = self.buffer.can_transform_full_core if goal.advanced else self.buffer.can_transform_core
        return bool(can(*self._arguments(goal))[0])

    def _lookup(self, goal: Any) -> Any:
        lookup = self.buffer.lookup_transform_full_core if goal.advanced else self.buffer.lookup_transform_core
        return lookup(*self._arguments(goal))

    def destroy(self) -> None:
        """Ends the action server."""
        self.action_server.destroy()
