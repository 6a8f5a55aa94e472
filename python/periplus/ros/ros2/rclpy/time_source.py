"""Simulated time: the topic /clock and the parameter `use_sim_time`."""

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from rclpy._clock_source import source
from rclpy.clock import ROSClock
from rclpy.constants import S_TO_NS
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy

if TYPE_CHECKING:
    from rclpy.node import Node

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"


class TimeSource:
    """Gives clocks the time of the topic /clock while the parameter `use_sim_time` is set.

    In lockstep the time of the graph is simulated time already, and no topic is needed.
    """

    def __init__(self, *, node: Node | None = None) -> None:
        self._clock_subscription: Any = None
        self._node: weakref.ReferenceType[Node] | None = None
        self._clocks: weakref.WeakSet[ROSClock] = weakref.WeakSet()
        self._active = False
        self._last_ns = 0
        if node is not None:
            self.attach_node(node)

    @property
    def ros_time_is_active(self) -> bool:
        """True while simulated time is used."""
        return self._active

    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None:
        if self._active == enabled:
            return
        self._active = enabled
        for clock in list(self._clocks):
            clock._set_ros_time_is_active(enabled)
        node = self._get_node()
        if enabled and node is not None:
            self._subscribe(node)
        elif not enabled and self._clock_subscription is not None:
            if node is not None:
                node.destroy_subscription(self._clock_subscription)
            self._clock_subscription = None

    def _get_node(self) -> Node | None:
        return None if self._node is None else self._node()

    def _subscribe(self, node: Node) -> None:
        if self._clock_subscription is not None or source.lockstep_graph is not None:
            return
        from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
        from rosgraph_msgs.msg import Clock

        self._clock_group = MutuallyExclusiveCallbackGroup()
        self._clock_subscription = node.create_subscription(
            Clock,
            CLOCK_TOPIC,
            self.clock_callback,
            QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT),
            callback_group=self._clock_group,
        )

    def attach_node(self, node: Node) -> None:
        """Follows the parameter of a node, which is declared if it is not yet."""
        if self._get_node() is not None:
            self.detach_node()
        self._node = weakref.ref(node)
        if not node.has_parameter(USE_SIM_TIME_NAME):
            node.declare_parameter(USE_SIM_TIME_NAME, False)
        parameter = node.get_parameter(USE_SIM_TIME_NAME)
        if parameter.type_ is Parameter.Type.BOOL:
            self.ros_time_is_active = parameter.value
        else:
            node.get_logger().error(f"Invalid type for parameter '{USE_SIM_TIME_NAME}' {parameter.type_!r} should be bool")
        node.add_on_set_parameters_callback(self._on_parameters)
        node.add_post_set_parameters_callback(self._after_parameters)

    def detach_node(self) -> None:
        """Stops following the node."""
        node = self._get_node()
        if node is None:
            return
        if self._clock_subscription is not None:
            node.destroy_subscription(self._clock_subscription)
            self._clock_subscription = None
        self._node = None

    def attach_clock(self, clock: ROSClock) -> None:
        """Sets the time of a clock from now on."""
        if not isinstance(clock, ROSClock):
            raise ValueError("Only clocks with type ROS_TIME can be attached.")
        clock._set_override_ns(self._last_ns)
        clock._set_ros_time_is_active(self._active)
        self._clocks.add(clock)

    def clock_callback(self, msg: Any) -> None:
        """Takes the time of a message."""
        time_ns = msg.clock.sec * S_TO_NS + msg.clock.nanosec
        self._last_ns = time_ns
        for clock in list(self._clocks):
            clock._set_override_ns(time_ns)

    def _on_parameters(self, parameters: list[Parameter]) -> Any:
        from rcl_interfaces.msg import SetParametersResult

        for parameter in parameters:
            if parameter.name == USE_SIM_TIME_NAME and parameter.type_ is not Parameter.Type.BOOL:
                return SetParametersResult(successful=False, reason=f"{USE_SIM_TIME_NAME} must be a bool")
        return SetParametersResult(successful=True)

    def _after_parameters(self, parameters: list[Parameter]) -> None:
        for parameter in parameters:
            if parameter.name == USE_SIM_TIME_NAME:
                self.ros_time_is_active = parameter.value


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
