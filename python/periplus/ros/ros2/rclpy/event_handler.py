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
    rmw_qos_policy_kind_t,
)
from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.qos import LivelinessPolicy, qos_policy_name_from_kind
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
                name = f"RMW_QOS_POLICY_{policies[-1].upper()}"
                kind = rmw_qos_policy_kind_t.__members__.get(name, rmw_qos_policy_kind_t.RMW_QOS_POLICY_INVALID)
                self._pending.append(
                    QoSRequestedIncompatibleQoSInfo(
                        total_count=self._total, total_count_change=len(policies), last_policy_kind=kind
                    )
                )
        elif self.event_type.name.endswith("LIVELINESS_CHANGED"):
            count = self._parent._native.publisher_count
            change, self._current = count - self._current, count
            if change:
                self._pending.append(QoSLivelinessChangedInfo(alive_count=count, alive_count_change=change))
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

    def due_ns(self) -> int | None:
        """Steady time [ns] at which a silence becomes an event, or None."""
        return None

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


class SilenceHandler(EventHandler):
    """Callback for deadlines and leases: for the time since the last message."""

    def __init__(self, *, info: Any, period_ns: int, repeats: bool, **options: Any) -> None:
        super().__init__(**options)
        self._info = info
        self._period_ns = period_ns
        self._repeats = repeats
        self._last_ns: int | None = None
        self._missed = 0
        name = "_send" if hasattr(self._parent, "_send") else "_take"
        inner = getattr(self._parent, name)

        def noted(*arguments: Any) -> Any:
            self.note()
            return inner(*arguments)

        setattr(self._parent, name, noted)

    def note(self) -> None:
        """Notes a message."""
        self._last_ns = source.steady_ns()
        self._missed = 0

    def due_ns(self) -> int | None:
        """Steady time [ns] at which the silence becomes an event, or None before the first message."""
        if self._last_ns is None or (self._missed and not self._repeats):
            return None
        return self._last_ns + (self._missed + 1) * self._period_ns

    def poll(self, policies: list[str]) -> None:
        """Notes the periods that have passed without a message."""
        due_ns, now_ns = self.due_ns(), source.steady_ns()
        if due_ns is None or now_ns < due_ns:
            return
        change = 1 + (now_ns - due_ns) // self._period_ns if self._repeats else 1
        self._missed += change
        self._total += change
        self._pending.append(self._info(total_count=self._total, total_count_change=change))


class QoSEventHandler(EventHandler):
    """Old name of `EventHandler`."""


class _EventCallbacks:
    """Base of the callbacks of a publisher and of a subscription."""

    _types: Any
    _prefix: str
    _warning: str

    deadline: Any
    liveliness: Any
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
        named = [(incompatible_qos, _INCOMPATIBLE), (self.matched, _MATCHED)]
        silent = [(self.deadline, "DEADLINE_MISSED", parent.qos_profile.deadline, True)]
        if self._types is QoSSubscriptionEventType:
            named.append((self.liveliness, "LIVELINESS_CHANGED"))
        elif parent.qos_profile.liveliness == LivelinessPolicy.MANUAL_BY_TOPIC:
            silent.append((self.liveliness, "LIVELINESS_LOST", parent.qos_profile.liveliness_lease_duration, False))
        for callback, name in named:
            if callback is not None:
                found.append(EventHandler(**self._options(callback, name, callback_group, parent)))
        for callback, name, period, repeats in silent:
            if callback is not None and 0 < period.nanoseconds < 2**62:
                options = self._options(callback, name, callback_group, parent)
                info = QoSRequestedDeadlineMissedInfo if hasattr(parent, "raw") else QoSOfferedDeadlineMissedInfo
                found.append(
                    SilenceHandler(
                        info=info if repeats else QoSLivelinessLostInfo,
                        period_ns=period.nanoseconds,
                        repeats=repeats,
                        **options,
                    )
                )
        return found

    def _options(self, callback: Any, name: str, group: CallbackGroup, parent: Any) -> dict[str, Any]:
        event_type = next(one for one in self._types if one.name.endswith(name))
        return {"callback_group": group, "callback": callback, "event_type": event_type, "parent_impl": parent}


class SubscriptionEventCallbacks(_EventCallbacks):
    """Callbacks for the events of a subscription. Lost messages and other types are not reported."""

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
    """Callbacks for the events of a publisher. Other types are not reported."""

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
        self._timed: list[EventHandler] = []

    @property
    def _kind(self) -> str:
        return "QoS event"

    def refresh(self) -> None:
        """Looks at all handlers soon: there is a new one."""
        self._seen = -1
        self._next_poll_ns = 0
        self._graph.wake()

    def _has_work(self) -> bool:
        if self._ready:
            return True
        self._delay_ns = None
        has_changed = self._graph.events != self._seen
        if not has_changed and not self._timed:
            return False
        now_ns = source.steady_ns()
        if has_changed and now_ns >= self._next_poll_ns:
            self._poll_all(now_ns)
            has_changed = False
        if self._timed:
            self._poll_timed(now_ns)
        if has_changed:
            delay_ns = self._next_poll_ns - now_ns
            self._delay_ns = delay_ns if self._delay_ns is None else min(delay_ns, self._delay_ns)
        return bool(self._ready)

    def _poll_all(self, now_ns: int) -> None:
        self._next_poll_ns = now_ns + _PERIOD_NS
        self._seen = self._graph.events
        timed: list[EventHandler] = []
        entities: list[Any] = [*self._node._publishers, *self._node._subscriptions]
        for entity in entities:
            handlers = entity.event_handlers
            if handlers:
                policies = entity._native.take_events()
                for handler in handlers:
                    handler.poll(policies)
                    if handler._pending:
                        self._ready.append(handler)
                    if isinstance(handler, SilenceHandler):
                        timed.append(handler)
        self._timed = timed

    def _poll_timed(self, now_ns: int) -> None:
        for handler in self._timed:
            due_ns = handler.due_ns()
            if due_ns is not None and due_ns <= now_ns:
                handler.poll([])
                self._ready.append(handler)
            elif due_ns is not None and (self._delay_ns is None or due_ns - now_ns < self._delay_ns):
                self._delay_ns = due_ns - now_ns

    def _next_ns(self) -> int | None:
        return self._delay_ns

    def _take(self) -> Any:
        while self._ready:
            handler = self._ready.pop(0)
            if handler._pending:
                return (handler,)
        return None

    def _call(self, taken: Any, executor: Any) -> Any:
        handler = taken[0]
        return handler.callback(handler.take_data())


def __getattr__(name: str) -> Any:
    from rclpy._homes import find

    return find(__name__, name)
