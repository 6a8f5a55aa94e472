"""Modules of names that programs also import from other modules, as in `from rclpy.node import Publisher`."""

from __future__ import annotations

from importlib import import_module
from typing import Any

_NAMES = {
    "_multi_threaded": "MultiThreadedExecutor",
    "callback_groups": "CallbackGroup MutuallyExclusiveCallbackGroup ReentrantCallbackGroup",
    "client": "Client",
    "clock": "Clock JumpHandle JumpThreshold ROSClock TimeJump",
    "clock_type": "ClockType",
    "context": "Context",
    "duration": "Duration",
    "event_handler": "EventHandler PublisherEventCallbacks SubscriptionEventCallbacks",
    "exceptions": "InvalidHandle",
    "executors": "Executor await_or_execute",
    "expand_topic_name": "expand_topic_name",
    "guard_condition": "GuardCondition",
    "logging": "get_logger",
    "logging_service": "LoggingService",
    "node": "Node",
    "parameter": "Parameter",
    "parameter_service": "ParameterService",
    "publisher": "Publisher",
    "qos": "QoSHistoryPolicy QoSProfile ReliabilityPolicy qos_policy_name_from_kind",
    "qos_overriding_options": "QoSOverridingOptions",
    "service": "Service",
    "signals": "SignalHandlerGuardCondition",
    "subscription": "Subscription",
    "task": "Future Task",
    "time": "Time",
    "time_source": "TimeSource",
    "timer": "Rate Timer",
    "topic_endpoint_info": "TopicEndpointInfo",
    "type_description_service": "TypeDescriptionService",
    "type_support": "check_for_type_support check_is_valid_msg_type check_is_valid_srv_type",
    "utilities": "get_default_context timeout_sec_to_nsec",
    "validate_full_topic_name": "validate_full_topic_name",
    "validate_namespace": "validate_namespace",
    "validate_node_name": "validate_node_name",
    "validate_parameter_name": "validate_parameter_name",
    "validate_topic_name": "validate_topic_name",
    "waitable": "NumberOfEntities Waitable",
    "_rclpy_pybind11": "NodeNameNonExistentError ServiceIntrospectionState",
}
_HOMES = {name: f"rclpy.{module}" for module, names in _NAMES.items() for name in names.split()}


def find(module: str, name: str) -> Any:
    """The object with a name, for a module that does not define it. Raises `AttributeError` for an unknown name."""
    home = _HOMES.get(name)
    if home is None or home == module:
        raise AttributeError(f"module {module!r} has no attribute {name!r}")
    return getattr(import_module(home), name)
