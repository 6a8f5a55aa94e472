"""Publishers, subscriptions, services, clients, timers and the like of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._names import full_topic_problem, topic_problem
from rclpy._native import RosNameError
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.client import Client
from rclpy.constants import S_TO_NS
from rclpy.event_handler import NodeEvents, PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.guard_condition import GuardCondition
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile, qos_profile_services_default
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.timer import Rate, Timer
from rclpy.type_support import check_is_valid_msg_type, check_is_valid_srv_type, type_name

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy._native import RosGraph, RosNode
    from rclpy.callback_groups import CallbackGroup
    from rclpy.clock import Clock
    from rclpy.context import Context
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.waitable import Waitable


def qos_or_depth(value: Any) -> QoSProfile:
    """Profile of an argument: a profile, or a depth."""
    if isinstance(value, QoSProfile):
        return value
    if isinstance(value, int):
        if value < 0:
            raise ValueError("history depth must be greater than or equal to zero")
        return QoSProfile(depth=value)
    raise TypeError(f"Expected QoSProfile or int, but received {type(value)!r}")


def _without(entities: list[Any], entity: Any) -> list[Any]:
    return [one for one in entities if one is not entity]


class NodeEntities:
    """The part of a node that makes entities.

    The lists are replaced, never changed, so that executors can go through them while callbacks add and remove.
    """

    _rcl_graph: RosGraph
    _rcl_native: RosNode
    _context: Context
    _rcl_destroyed: bool
    _clock: Clock
    _logger: Any
    _default_callback_group: CallbackGroup
    _rate_group: CallbackGroup

    if TYPE_CHECKING:

        def _rcl_expanded(self, name: str) -> str: ...

    def _rcl_init_entities(self) -> None:
        self._publishers: list[Publisher] = []
        self._subscriptions: list[Subscription] = []
        self._clients: list[Client] = []
        self._services: list[Service] = []
        self._timers: list[Timer] = []
        self._guards: list[GuardCondition] = []
        self._rcl_waitables: list[Waitable] = []
        self._rcl_events: NodeEvents | None = None

    def _rcl_destroy_entities(self) -> None:
        for waitable in self._rcl_waitables:
            destroy = getattr(waitable, "destroy", None)
            if destroy is not None:
                destroy()
        for name in ("_publishers", "_subscriptions", "_clients", "_services", "_timers", "_guards"):
            for entity in getattr(self, name):
                entity.destroy()
            setattr(self, name, [])
        self._rcl_waitables = []

    def _rcl_group(self, group: CallbackGroup | None) -> CallbackGroup:
        return self._default_callback_group if group is None else group

    def _rcl_check(self, what: str) -> None:
        if self._rcl_destroyed:
            raise InvalidHandle
        if not self._context._valid:
            raise RCLError(f"Failed to create a {what}: rcl node's context is invalid")

    def _rcl_full(self, name: str, is_service: bool) -> str:
        """Full, remapped name of a topic or a service."""
        error = InvalidServiceNameException if is_service else InvalidTopicNameException
        if not isinstance(name, str):
            raise TypeError(f"the name of a {'service' if is_service else 'topic'} must be a str, not {type(name).__name__}")
        problem = topic_problem(name)
        if problem is not None:
            raise error(name, *problem)
        expanded = self._rcl_expanded(name)
        problem = full_topic_problem(expanded)
        if problem is not None:
            raise error(expanded, *problem)
        try:
            return self._rcl_native.resolve(name, service=is_service)
        except RosNameError as text:
            raise ValueError(f"{'service' if is_service else 'topic'} name {name!r} is invalid: {text}") from None

    def _rcl_add(self, which: str, entity: Any, group: CallbackGroup | None) -> None:
        setattr(self, which, [*getattr(self, which), entity])
        if group is not None:
            group.add_entity(entity)
        self._rcl_graph.wake()

    def _rcl_add_event_handlers(self, entity: Any) -> None:
        if entity.event_handlers and self._rcl_events is None:
            from rclpy.callback_groups import ReentrantCallbackGroup

            self._rcl_events = NodeEvents(self, ReentrantCallbackGroup())  # type: ignore[arg-type]
            self._rcl_waitables = [*self._rcl_waitables, self._rcl_events]
        if self._rcl_events is not None:
            self._rcl_events.refresh()

    # ---- making

    def create_publisher(
        self,
        msg_type: Any,
        topic: str,
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: PublisherEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        publisher_class: type[Publisher] = Publisher,
    ) -> Publisher:
        """Makes a publisher.

        Args:
            msg_type: Message class.
            topic: Name; relative to the namespace, or to the node with `~/`.
            qos_profile: Policies, or the depth of the queue.
            callback_group: Group of the event callbacks.
            event_callbacks: Callbacks for incompatible QoS and for matched subscriptions.
            qos_overriding_options: Policies that parameters may replace.
            publisher_class: Class of the publisher (default `Publisher`).

        Raises:
            InvalidTopicNameException, TypeError, ValueError
        """
        qos = qos_or_depth(qos_profile)
        check_is_valid_msg_type(msg_type)
        self._rcl_check("publisher")
        full = self._rcl_full(topic, False)
        qos = self._rcl_overridden(Publisher, full, qos, qos_overriding_options)
        group = self._rcl_group(callback_group)
        native = self._rcl_native.publisher(full, type_name(msg_type), qos._to_native())
        publisher = publisher_class(
            native, msg_type, topic, qos, event_callbacks=event_callbacks or PublisherEventCallbacks(), callback_group=group
        )
        publisher._context = self._context
        publisher._logger_name = self._logger.name  # type: ignore[attr-defined]
        self._publishers = [*self._publishers, publisher]
        self._rcl_add_event_handlers(publisher)
        return publisher

    def create_subscription(
        self,
        msg_type: Any,
        topic: str,
        callback: Callable[..., Any],
        qos_profile: QoSProfile | int,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Makes a subscription.

        Args:
            msg_type: Message class.
            topic: Name; relative to the namespace, or to the node with `~/`.
            callback: Function of the message, or of the message and a dictionary about it.
            qos_profile: Policies, or the depth of the queue.
            callback_group: Group of the callback (default: the node's, one callback at a time).
            event_callbacks: Callbacks for incompatible QoS and for matched publishers.
            qos_overriding_options: Policies that parameters may replace.
            raw: Give the callback bytes instead of messages (default False).

        Raises:
            InvalidTopicNameException, RuntimeError, TypeError, ValueError
        """
        qos = qos_or_depth(qos_profile)
        check_is_valid_msg_type(msg_type)
        self._rcl_check("subscription")
        full = self._rcl_full(topic, False)
        qos = self._rcl_overridden(Subscription, full, qos, qos_overriding_options)
        group = self._rcl_group(callback_group)
        native = self._rcl_native.subscription(full, type_name(msg_type), qos._to_native())
        try:
            subscription = Subscription(
                native, msg_type, topic, callback, group, qos, raw, event_callbacks or SubscriptionEventCallbacks()
            )
        except BaseException:
            native.close()
            raise
        subscription._logger_name = self._logger.name  # type: ignore[attr-defined]
        self._rcl_add("_subscriptions", subscription, group)
        self._rcl_add_event_handlers(subscription)
        return subscription

    def _rcl_overridden(self, kind: Any, topic: str, qos: QoSProfile, options: QoSOverridingOptions | None) -> QoSProfile:
        if options is None:
            return qos
        from rclpy.qos_overriding_options import _declare_qos_parameters, copy_profile

        qos = copy_profile(qos)
        _declare_qos_parameters(kind, self, topic, qos, options)
        return qos

    def create_client(
        self,
        srv_type: Any,
        srv_name: str,
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Client:
        """Makes a client of a service."""
        check_is_valid_srv_type(srv_type)
        self._rcl_check("client")
        group = self._rcl_group(callback_group)
        native = self._rcl_native.client(self._rcl_full(srv_name, True), type_name(srv_type))
        client = Client(self._context, native, srv_type, srv_name, qos_profile, group)
        client._logger_name = self._logger.name  # type: ignore[attr-defined]
        self._rcl_add("_clients", client, group)
        return client

    def create_service(
        self,
        srv_type: Any,
        srv_name: str,
        callback: Callable[..., Any],
        *,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> Service:
        """Makes a service. The callback gets the request and an empty response, and must return the response."""
        check_is_valid_srv_type(srv_type)
        self._rcl_check("service")
        group = self._rcl_group(callback_group)
        native = self._rcl_native.server(self._rcl_full(srv_name, True), type_name(srv_type))
        service = Service(native, srv_type, srv_name, callback, group, qos_profile)
        service._logger_name = self._logger.name  # type: ignore[attr-defined]
        self._rcl_add("_services", service, group)
        return service

    def create_timer(
        self,
        timer_period_sec: float,
        callback: Callable[..., Any] | None,
        callback_group: CallbackGroup | None = None,
        clock: Clock | None = None,
        autostart: bool = True,
    ) -> Timer:
        """Makes a timer that calls a function each `timer_period_sec` of a clock (default: the node's clock)."""
        timer_period_ns = int(float(timer_period_sec) * S_TO_NS)
        group = self._rcl_group(callback_group)
        clock = self._clock if clock is None else clock
        timer = Timer(callback, group, timer_period_ns, clock, context=self._context, autostart=autostart)
        self._rcl_add("_timers", timer, group)
        return timer

    def create_guard_condition(
        self, callback: Callable[[], Any], callback_group: CallbackGroup | None = None
    ) -> GuardCondition:
        """Makes a guard condition: `trigger()` asks for one call of the function."""
        group = self._rcl_group(callback_group)
        guard = GuardCondition(callback, group, context=self._context)
        self._rcl_add("_guards", guard, group)
        return guard

    def create_rate(self, frequency: float, clock: Clock | None = None) -> Rate:
        """Makes a rate: `sleep()` lets a loop run at `frequency` [Hz] while another thread spins the node."""
        if frequency <= 0:
            raise ValueError("frequency must be > 0")
        timer = self.create_timer(1.0 / frequency, None, self._rate_group, clock)
        return Rate(timer, context=self._context)

    def add_waitable(self, waitable: Waitable) -> None:
        """Lets executors ask a waitable."""
        self._rcl_waitables = [*self._rcl_waitables, waitable]
        self._rcl_graph.wake()

    def remove_waitable(self, waitable: Waitable) -> None:
        """Undoes `add_waitable`."""
        self._rcl_waitables = _without(self._rcl_waitables, waitable)
        self._rcl_graph.wake()

    # ---- destroying

    def _rcl_remove(self, which: str, entity: Any) -> bool:
        entities = getattr(self, which)
        if not any(one is entity for one in entities):
            return False
        setattr(self, which, _without(entities, entity))
        entity.destroy()
        self._rcl_graph.wake()
        return True

    def destroy_publisher(self, publisher: Publisher) -> bool:
        """Ends a publisher. Returns False if it is not one of the node."""
        return self._rcl_remove("_publishers", publisher)

    def destroy_subscription(self, subscription: Subscription) -> bool:
        """Ends a subscription. Returns False if it is not one of the node."""
        return self._rcl_remove("_subscriptions", subscription)

    def destroy_client(self, client: Client) -> bool:
        """Ends a client. Returns False if it is not one of the node."""
        return self._rcl_remove("_clients", client)

    def destroy_service(self, service: Service) -> bool:
        """Ends a service. Returns False if it is not one of the node."""
        return self._rcl_remove("_services", service)

    def destroy_timer(self, timer: Timer) -> bool:
        """Ends a timer. Returns False if it is not one of the node."""
        return self._rcl_remove("_timers", timer)

    def destroy_guard_condition(self, guard: GuardCondition) -> bool:
        """Ends a guard condition. Returns False if it is not one of the node."""
        return self._rcl_remove("_guards", guard)

    def destroy_rate(self, rate: Rate) -> bool:
        """Ends a rate with its timer. Returns False if it is not one of the node."""
        rate.destroy()
        return self._rcl_remove("_timers", rate._timer)
