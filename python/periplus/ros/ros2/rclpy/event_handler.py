"""Events of publishers and subscriptions: incompatible QoS and matched peers."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._clock_source import source
from rclpy._rclpy_pybind11 import (
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
    UnsupportedEventTypeError,
)
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.qos import QoSPolicyKind, qos_policy_name_from_kind
from rclpy.waitable import NumberOfEntities, Waitable

if TYPE_CHECKING:
    from collections.abc import Callable
    from enum import IntEnum

    from rclpy.node import Node

__all__ = [
    "EventHandler",
    "IncompatibleTypeInfo",
    "PublisherEventCallbacks",
    "QoSEventHandler",
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
    "SubscriptionEventCallbacks",
    "UnsupportedEventTypeError",
]

_INCOMPATIBLE = "INCOMPATIBLE_QOS"
_MATCHED = "MATCHED"

# Shortest time [ns] between two looks at the events of a node.
_PERIOD_NS = 100_000_000


class EventHandler(Waitable):
    """Callback for one kind of event of one publisher or subscription."""

    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[[Any], Any],
        event_type: IntEnum,
        parent_impl: Any,
    ) -> None:
        super().__init__(callback_group)
        self.event_type = event_type
        self.callback = callback
        self._parent = parent_impl
        self._pending: list[Any] = []
        self._total = 0
        self._current = 0

    def poll(self, policies: list[str]) -> None:
        """Notes what has happened; `policies` are those of newly found incompatible peers."""
        if self.event_type.name.endswith(_INCOMPATIBLE):
            if policies:
                self._total += len(policies)
                kind = QoSPolicyKind.__members__.get(policies[-1].upper(), QoSPolicyKind.INVALID)
                self._pending.append(
                    QoSRequestedIncompatibleQoSInfo(
                        total_count=self._total, total_count_change=len(policies), last_policy_kind=kind
                    )
                )
        elif self.event_type.name.endswith(_MATCHED):
            native = self._parent._native
            count = native.subscription_count if hasattr(native, "subscription_count") else native.publisher_count
            change = count - self._current
            if change:
                self._current = count
                self._total += max(change, 0)
                self._pending.append(
                    QoSSubscriptionMatchedInfo(
                        total_count=self._total,
                        total_count_change=max(change, 0),
                        current_count=count,
                        current_count_change=change,
                    )
                )

    def is_ready(self, wait_set: Any) -> bool:
        """True if an event was noted."""
        return bool(self._pending)

    def take_data(self) -> Any:
        """Takes the data of the oldest event."""
        return self._pending.pop(0) if self._pending else None

    async def execute(self, taken_data: Any) -> None:
        """Calls the callback."""
        if taken_data is not None:
            self.callback(taken_data)

    def get_num_entities(self) -> NumberOfEntities:
        """One event."""
        return NumberOfEntities(num_events=1)

    def add_to_wait_set(self, wait_set: Any) -> None:
        """Does nothing: there are no wait sets."""

    def destroy(self) -> None:
        """Forgets events."""
        self._pending.clear()


class QoSEventHandler(EventHandler):
    """Old name of `EventHandler`."""


class _EventCallbacks:
    """Base of the callbacks of a publisher and of a subscription."""

    _types: Any
    _prefix: str
    _warning: str

    incompatible_qos: Any
    matched: Any
    use_default_callbacks: bool

    def create_event_handlers(
        self, callback_group: CallbackGroup, parent: Any, topic_name: str
    ) -> list[EventHandler]:
        """Handlers for a publisher or a subscription."""
        found = []
        incompatible_qos = self.incompatible_qos
        if incompatible_qos is None and self.use_default_callbacks:

            def incompatible_qos(event: Any) -> None:
                from rclpy import _log_output

                text = self._warning.format(topic=topic_name, policy=qos_policy_name_from_kind(event.last_policy_kind))
                _log_output.report(30, getattr(parent, "_logger_name", "rclpy"), text)

            callback_group = ReentrantCallbackGroup() if callback_group is None else callback_group
        for callback, name in ((incompatible_qos, _INCOMPATIBLE), (self.matched, _MATCHED)):
            if callback is not None:
                event_type = next(one for one in self._types if one.name.endswith(name))
                found.append(
                    EventHandler(
                        callback_group=callback_group, callback=callback, event_type=event_type, parent_impl=parent
                    )
                )
        return found


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a subscription. Deadlines, liveliness and lost messages are not reported."""

    _types = QoSSubscriptionEventType
    _warning = (
        "New publisher discovered on topic '{topic}', offering incompatible QoS. No messages will be received from it. "
        "Last incompatible policy: {policy}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[QoSRequestedDeadlineMissedInfo], Any] | None = None,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], Any] | None = None,
        liveliness: Callable[[QoSLivelinessChangedInfo], Any] | None = None,
        message_lost: Callable[[QoSMessageLostInfo], Any] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], Any] | None = None,
        matched: Callable[[QoSSubscriptionMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.incompatible_qos = incompatible_qos
        self.liveliness = liveliness
        self.message_lost = message_lost
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks


class PublisherEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a publisher. Deadlines and liveliness are not reported."""

    _types = QoSPublisherEventType
    _warning = (
        "New subscription discovered on topic '{topic}', requesting incompatible QoS. No messages will be sent to it. "
        "Last incompatible policy: {policy}"
    )

    def __init__(
        self,
        *,
        deadline: Callable[[QoSOfferedDeadlineMissedInfo], Any] | None = None,
        liveliness: Callable[[QoSLivelinessLostInfo], Any] | None = None,
        incompatible_qos: Callable[[QoSRequestedIncompatibleQoSInfo], Any] | None = None,
        incompatible_type: Callable[[IncompatibleTypeInfo], Any] | None = None,
        matched: Callable[[QoSPublisherMatchedInfo], Any] | None = None,
        use_default_callbacks: bool = True,
    ) -> None:
        self.deadline = deadline
        self.liveliness = liveliness
        self.incompatible_qos = incompatible_qos
        self.incompatible_type = incompatible_type
        self.matched = matched
        self.use_default_callbacks = use_default_callbacks


class NodeEvents(Waitable):
    """All event handlers of a node: looked at when the graph has changed, at most ten times a second."""

    def __init__(self, node: Node, callback_group: CallbackGroup) -> None:
        super().__init__(callback_group)
        self._node = node
        self._graph = node._rcl_graph
        self._seen = -1
        self._next_poll_ns = 0
        self._delay_ns: int | None = None
        self._ready: list[EventHandler] = []

    def _has_work(self) -> bool:
        if self._ready:
            return True
        self._delay_ns = None
        if self._graph.events == self._seen:
            return False
        now_ns = source.steady_ns()
        if now_ns < self._next_poll_ns:
            self._delay_ns = self._next_poll_ns - now_ns
            return False
        self._next_poll_ns = now_ns + _PERIOD_NS
        self._seen = self._graph.events
        entities: list[Any] = [*self._node._publishers, *self._node._subscriptions]
        for entity in entities:
            handlers = entity.event_handlers
            if handlers:
                policies = entity._native.take_events()
                for handler in handlers:
                    handler.poll(policies)
                    if handler._pending:
                        self._ready.append(handler)
        return bool(self._ready)

    def _next_ns(self) -> int | None:
        return self._delay_ns

    def _take(self) -> Any:
        return (self._ready.pop(0),) if self._ready else None

    def _call(self, taken: Any, executor: Any) -> Any:
        handler = taken[0]
        return handler.callback(handler.take_data())
