"""Callbacks for the changes of parameters of any node."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, qos_profile_parameter_events

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions


class ParameterCallbackHandle:
    """Callback for one parameter of one node."""

    def __init__(self, parameter_name: str, node_name: str, callback: Callable[[Parameter], Any]) -> None:
        self.parameter_name = parameter_name
        self.node_name = node_name
        self.callback = callback


class ParameterEventCallbackHandle:
    """Callback for all changes."""

    def __init__(self, callback: Callable[[Any], Any]) -> None:
        self.callback = callback


class ParameterEventHandler:
    """Follows `/parameter_events`. The newest callbacks are called first."""

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile = qos_profile_parameter_events,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> None:
        from rcl_interfaces.msg import ParameterEvent

        self.node = node
        self.qos_profile = qos_profile
        self._handles: list[ParameterCallbackHandle] = []
        self._event_handles: list[ParameterEventCallbackHandle] = []
        self.parameter_event_subscription = node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            self._on_event,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )

    def destroy(self) -> None:
        """Ends the subscription."""
        self.node.destroy_subscription(self.parameter_event_subscription)

    def _on_event(self, event: Any) -> None:
        for handle in list(self._handles):
            parameter = self.get_parameter_from_event(event, handle.parameter_name, handle.node_name)
            if parameter is not None:
                handle.callback(parameter)
        for event_handle in list(self._event_handles):
            event_handle.callback(event)

    @staticmethod
    def get_parameter_from_event(event: Any, parameter_name: str, node_name: str) -> Parameter | None:
        """New value of a parameter in an event, or None if the event is about others."""
        if event.node != node_name:
            return None
        for message in (*event.new_parameters, *event.changed_parameters):
            if message.name == parameter_name:
                return Parameter.from_parameter_msg(message)
        return None

    @staticmethod
    def get_parameters_from_event(event: Any) -> Iterable[Parameter]:
        """All new values in an event."""
        for message in (*event.new_parameters, *event.changed_parameters):
            yield Parameter.from_parameter_msg(message)

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[Parameter], Any]
    ) -> ParameterCallbackHandle:
        """Calls a function with the new values of a parameter. `node_name` may be relative to this node's namespace."""
        handle = ParameterCallbackHandle(parameter_name, self._full_name(node_name), callback)
        self._handles.insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Undoes `add_parameter_callback`. Raises `RuntimeError` for an unknown handle."""
        _remove(self._handles, handle)

    def add_parameter_event_callback(self, callback: Callable[[Any], Any]) -> ParameterEventCallbackHandle:
        """Calls a function with each event."""
        handle = ParameterEventCallbackHandle(callback)
        self._event_handles.insert(0, handle)
        return handle

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Undoes `add_parameter_event_callback`. Raises `RuntimeError` for an unknown handle."""
        _remove(self._event_handles, handle)

    def _full_name(self, node_name: str) -> str:
        if not node_name:
            return self.node.get_fully_qualified_name()
        if node_name.startswith("/"):
            return node_name
        return f"{self.node.get_namespace().rstrip('/')}/{node_name}"


def _remove(handles: list[Any], handle: Any) -> None:
    if handle not in handles:
        raise RuntimeError("Callback doesn't exist")
    handles.remove(handle)


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
