"""Events of publishers and subscriptions, with their data."""

from __future__ import annotations

from enum import IntEnum
from typing import Any


class QoSPublisherEventType(IntEnum):
    """Event of a publisher."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(IntEnum):
    """Event of a subscription."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class _Info:
    """Base of the data of events: counters that start at 0."""

    __slots__: tuple[str, ...] = ()

    def __init__(self, **values: Any) -> None:
        for name in self.__slots__:
            setattr(self, name, values.get(name, 0))

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)}' for name in self.__slots__)})"


class QoSOfferedDeadlineMissedInfo(_Info):
    """Deadlines that a publisher missed."""

    __slots__ = ("total_count", "total_count_change")


class QoSRequestedDeadlineMissedInfo(_Info):
    """Deadlines of a subscription that were missed."""

    __slots__ = ("total_count", "total_count_change")


class QoSLivelinessLostInfo(_Info):
    """Times that a publisher did not assert its liveliness."""

    __slots__ = ("total_count", "total_count_change")


class QoSMessageLostInfo(_Info):
    """Messages that a subscription lost."""

    __slots__ = ("total_count", "total_count_change")


class IncompatibleTypeInfo(_Info):
    """Peers with another type of the topic."""

    __slots__ = ("total_count", "total_count_change")


class QoSLivelinessChangedInfo(_Info):
    """Publishers of a subscription that are alive."""

    __slots__ = ("alive_count", "not_alive_count", "alive_count_change", "not_alive_count_change")


class QoSRequestedIncompatibleQoSInfo(_Info):
    """Peers with QoS that do not fit."""

    __slots__ = ("total_count", "total_count_change", "last_policy_kind")


class QoSSubscriptionMatchedInfo(_Info):
    """Peers that a publisher or subscription is connected to."""

    __slots__ = ("total_count", "total_count_change", "current_count", "current_count_change")


QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo
QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo
