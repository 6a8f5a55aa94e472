"""Exceptions and enumerations that programs import from the compiled module of the original."""

from __future__ import annotations

import builtins
from enum import Enum, IntEnum, IntFlag

from rclpy._events import (
    IncompatibleTypeInfo,
    QoSLivelinessChangedInfo,
    QoSLivelinessLostInfo,
    QoSMessageLostInfo,
    QoSOfferedDeadlineMissedInfo,
    QoSOfferedIncompatibleQoSInfo,
    QoSPublisherEventType,
    QoSPublisherMatchedInfo,
    QoSRequestedDeadlineMissedInfo,
    QoSRequestedIncompatibleQoSInfo,
    QoSSubscriptionEventType,
    QoSSubscriptionMatchedInfo,
)
from rclpy.clock_type import ClockType

__all__ = [
    "ClockChange",
    "ClockType",
    "GoalEvent",
    "IncompatibleTypeInfo",
    "InvalidHandle",
    "NodeNameNonExistentError",
    "QoSCheckCompatibleResult",
    "QoSCompatibility",
    "QoSLivelinessChangedInfo",
    "QoSLivelinessLostInfo",
    "QoSMessageLostInfo",
    "QoSOfferedDeadlineMissedInfo",
    "QoSOfferedIncompatibleQoSInfo",
    "QoSPublisherEventType",
    "QoSPublisherMatchedInfo",
    "QoSRequestedDeadlineMissedInfo",
    "QoSRequestedIncompatibleQoSInfo",
    "QoSSubscriptionEventType",
    "QoSSubscriptionMatchedInfo",
    "RCLError",
    "RCLInvalidROSArgsError",
    "RCUtilsError",
    "RMWError",
    "ServiceIntrospectionState",
    "SignalHandlerOptions",
    "TransitionCallbackReturnType",
    "UnknownROSArgsError",
    "UnsupportedEventTypeError",
]


class RCLError(RuntimeError):
    """Failure of an operation of the core."""


class RCLInvalidROSArgsError(RCLError):
    """Malformed argument after `--ros-args`."""


class UnknownROSArgsError(RuntimeError):
    """Unknown argument after `--ros-args`."""


class NodeNameNonExistentError(RCLError):
    """Query about a node that is not on the network."""


class UnsupportedEventTypeError(RCLError):
    """Event that the middleware does not report."""


class NotImplementedError(builtins.NotImplementedError):
    """Feature that the middleware does not have."""


class RCUtilsError(RuntimeError):
    """Failure of a utility function."""


class RMWError(RuntimeError):
    """Failure of the middleware, such as bytes that are no message of the type."""


class InvalidHandle(RuntimeError):
    """Use of an object after its destruction."""

    def __init__(self, message: str = "cannot use Destroyable because destruction was requested") -> None:
        super().__init__(message)


class SignalHandlerOptions(IntFlag):
    """Signals that `init` handles."""

    NO = 0
    SIGINT = 1
    SIGTERM = 2
    ALL = 3


class ClockChange(IntEnum):
    """Change of a clock at a jump."""

    ROS_TIME_NO_CHANGE = 1
    ROS_TIME_ACTIVATED = 2
    ROS_TIME_DEACTIVATED = 3
    SYSTEM_TIME_NO_CHANGE = 4


class GoalEvent(IntEnum):
    """Event that changes the state of a goal."""

    EXECUTE = 0
    CANCEL_GOAL = 1
    SUCCEED = 2
    ABORT = 3
    CANCELED = 4


class QoSCompatibility(Enum):
    """Outcome of `qos_check_compatible`."""

    OK = 0
    WARNING = 1
    ERROR = 2

    def __str__(self) -> str:
        return f"QoSCompatibility.{self.name}"


class QoSCheckCompatibleResult:
    """Outcome of `qos_check_compatible` with its reason."""

    def __init__(self) -> None:
        self.compatibility = QoSCompatibility.OK
        self.reason = ""


class TransitionCallbackReturnType(Enum):
    """Outcome of a callback of a lifecycle node."""

    SUCCESS = 97
    FAILURE = 98
    ERROR = 99

    def to_label(self) -> str:
        """Label of the transition that follows."""
        return f"transition_{self.name.lower()}"


class ServiceIntrospectionState(IntEnum):
    """Content of the events that a service publishes about its calls."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


class service_introspection:  # noqa: N801
    """Namespace of the state of introspection."""

    ServiceIntrospectionState = ServiceIntrospectionState


class rmw_qos_policy_kind_t(IntEnum):  # noqa: N801
    """Kind of a QoS policy."""

    RMW_QOS_POLICY_INVALID = 1
    RMW_QOS_POLICY_DURABILITY = 2
    RMW_QOS_POLICY_DEADLINE = 4
    RMW_QOS_POLICY_LIVELINESS = 8
    RMW_QOS_POLICY_RELIABILITY = 16
    RMW_QOS_POLICY_HISTORY = 32
    RMW_QOS_POLICY_LIFESPAN = 64
    RMW_QOS_POLICY_DEPTH = 128
    RMW_QOS_POLICY_LIVELINESS_LEASE_DURATION = 256
    RMW_QOS_POLICY_AVOID_ROS_NAMESPACE_CONVENTIONS = 512

    def __str__(self) -> str:
        return f"{type(self).__name__}.{self.name}"

    def __format__(self, form: str) -> str:
        return format(str(self), form)


def rclpy_get_rmw_implementation_identifier() -> str:
    """Name of the middleware."""
    return "rmw_periplus"
