"""Managed nodes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from periplus.ros import _faults

from rclpy import _log_output
from rclpy._clock_source import source
from rclpy._rclpy_pybind11 import TransitionCallbackReturnType as TransitionCallbackReturn
from rclpy.callback_groups import CallbackGroup
from rclpy.lifecycle._machine import STATES, LifecycleStateMachine, Transition
from rclpy.lifecycle.managed_entity import ManagedEntity
from rclpy.lifecycle.publisher import LifecyclePublisher
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.service import Service
from rclpy.type_support import check_is_valid_srv_type

__all__ = [
    "CallbackGroup",
    "LifecycleNode",
    "LifecycleNodeMixin",
    "LifecyclePublisher",
    "LifecycleState",
    "ManagedEntity",
    "Node",
    "QoSProfile",
    "Service",
    "TransitionCallbackReturn",
    "check_is_valid_srv_type",
]

_SUCCESS = TransitionCallbackReturn.SUCCESS


class LifecycleState(NamedTuple):
    """State of a managed node."""

    label: str
    state_id: int


class LifecycleNodeMixin(ManagedEntity):
    """State machine of a managed node. Needs to be initialized after the node."""

    def __init__(
        self, *, enable_communication_interface: bool = True, callback_group: CallbackGroup | None = None
    ) -> None:
        self._rcl_callbacks: dict[str, Callable[[LifecycleState], Any]] = {}
        self._rcl_managed_entities: list[ManagedEntity] = []
        self._rcl_lifecycle_services: list[Service] = []
        self._rcl_event_publisher: Any = None
        self._state_machine = LifecycleStateMachine(self._rcl_publish_event)
        if enable_communication_interface:
            self._rcl_make_services(callback_group)

    def _rcl_make_services(self, group: CallbackGroup | None) -> None:
        from lifecycle_msgs import srv

        node: Any = self
        self._rcl_event_publisher = node._rcl_native.publisher(
            f"{node._rcl_full_name}/transition_event", "lifecycle_msgs/msg/TransitionEvent", QoSProfile(depth=10)._to_native()
        )
        for service_type, name, callback in (
            (srv.ChangeState, "change_state", self._rcl_on_change_state),
            (srv.GetState, "get_state", self._rcl_on_get_state),
            (srv.GetAvailableStates, "get_available_states", self._rcl_on_get_available_states),
            (srv.GetAvailableTransitions, "get_available_transitions", self._rcl_on_get_available_transitions),
            (srv.GetAvailableTransitions, "get_transition_graph", self._rcl_on_get_transition_graph),
        ):
            service = node.create_service(service_type, f"~/{name}", callback, callback_group=group)
            service.srv_name = service.service_name
            self._rcl_lifecycle_services.append(service)

    # ---- transitions

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Configures the node. Raises `RCLError` if that is not possible now; so do the others."""
        return self._rcl_change_state("configure")

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Cleans the node up."""
        return self._rcl_change_state("cleanup")

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """Shuts the node down."""
        return self._rcl_change_state("shutdown")

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Activates the node."""
        return self._rcl_change_state("activate")

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Deactivates the node."""
        return self._rcl_change_state("deactivate")

    def _rcl_change_state(self, label: str) -> TransitionCallbackReturn:
        machine = self._state_machine
        before = self._rcl_state()
        machine.trigger_transition_by_label(label)
        result = self._rcl_run(label, before)
        machine.trigger_transition_by_label(result.to_label())
        if result is TransitionCallbackReturn.ERROR:
            handled = self._rcl_run("error", before)
            machine.trigger_transition_by_label(handled.to_label())
        return result

    def _rcl_state(self) -> LifecycleState:
        number, label = self._state_machine.current_state
        return LifecycleState(label, number)

    def _rcl_run(self, label: str, before: LifecycleState) -> TransitionCallbackReturn:
        """Result of the callback of a transition; an exception counts as an error and is printed."""
        callback = self._rcl_callbacks.get(label) or getattr(self, f"on_{label}")
        try:
            result = callback(before)
        except Exception as error:
            owner: Any = self
            _faults.callback_failed(
                error, node=owner._rcl_full_name, kind="transition", name=label, time_ns=source.system_ns()
            )
            _faults.print_exception(error)
            return TransitionCallbackReturn.ERROR
        if not isinstance(result, TransitionCallbackReturn):
            node: Any = self
            raise AttributeError(
                f"{type(result).__name__!r} object has no attribute 'to_label': on_{label} of the node "
                f"{node._rcl_full_name} must return a TransitionCallbackReturn"
            )
        return result

    def register_callback(self, label: str, callback: Callable[[LifecycleState], Any]) -> None:
        """Replaces the method `on_<label>` by a function."""
        self._rcl_callbacks[label] = callback

    # ---- callbacks

    def _rcl_on_all(self, name: str, state: LifecycleState) -> TransitionCallbackReturn:
        """Calls the managed entities until one does not succeed."""
        for entity in self._rcl_managed_entities:
            result: TransitionCallbackReturn = getattr(entity, name)(state)
            if result is not _SUCCESS:
                return result
        return _SUCCESS

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at `configure`, with the state before. Calls the managed entities; so do the others."""
        return self._rcl_on_all("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at `cleanup`."""
        return self._rcl_on_all("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at `shutdown`."""
        return self._rcl_on_all("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at `activate`."""
        return self._rcl_on_all("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called at `deactivate`."""
        return self._rcl_on_all("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called after an error. SUCCESS makes the node unconfigured, anything else finalized."""
        return self._rcl_on_all("on_error", state)

    # ---- entities

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Lets an object follow the state of the node."""
        self._rcl_managed_entities.append(entity)

    def create_lifecycle_publisher(self, *args: Any, **kwargs: Any) -> LifecyclePublisher:
        """Makes a publisher that drops messages unless the node is active. Arguments as for `create_publisher`."""
        node: Any = self
        if "publisher_class" in kwargs:
            raise TypeError("create_publisher() got an unexpected keyword argument 'publisher_class'")
        publisher: LifecyclePublisher = node.create_publisher(*args, **kwargs, publisher_class=LifecyclePublisher)
        self._rcl_managed_entities.append(publisher)
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Ends a publisher. Returns False if it is not one of the node."""
        node: Any = self
        self._rcl_managed_entities = [entity for entity in self._rcl_managed_entities if entity is not publisher]
        done: bool = node.destroy_publisher(publisher)
        return done

    # ---- services and the topic ~/transition_event

    def _rcl_publish_event(self, transition: Transition) -> None:
        if self._rcl_event_publisher is None:
            return
        from lifecycle_msgs.msg import State, TransitionEvent
        from lifecycle_msgs.msg import Transition as TransitionMessage

        node: Any = self
        if not node.context._valid:
            return
        number, label, before, after = transition
        self._rcl_event_publisher.publish(
            TransitionEvent(
                timestamp=node.get_clock().now().nanoseconds,
                transition=TransitionMessage(id=number, label=label),
                start_state=State(id=before, label=STATES[before]),
                goal_state=State(id=after, label=STATES[after]),
            )
        )

    def _rcl_on_change_state(self, request: Any, response: Any) -> Any:
        wanted = request.transition
        response.success = False
        for number, label, *_ in self._state_machine.available_transitions:
            if (wanted.label and label == wanted.label) or (not wanted.label and number == wanted.id):
                response.success = self._rcl_change_state(label) is _SUCCESS
                return response
        what = wanted.label or wanted.id
        state = self._state_machine.current_state[1]
        _log_output.report(30, "rcl_lifecycle", f"No transition matching {what} found for current state {state}")
        return response

    def _rcl_on_get_state(self, request: Any, response: Any) -> Any:
        number, label = self._state_machine.current_state
        response.current_state.id = number
        response.current_state.label = label
        return response

    def _rcl_on_get_available_states(self, request: Any, response: Any) -> Any:
        from lifecycle_msgs.msg import State

        response.available_states = [
            State(id=number, label=label) for number, label in self._state_machine.available_states
        ]
        return response

    def _rcl_on_get_available_transitions(self, request: Any, response: Any) -> Any:
        return _describe(self._state_machine.available_transitions, response)

    def _rcl_on_get_transition_graph(self, request: Any, response: Any) -> Any:
        return _describe(self._state_machine.transition_graph, response)


def _describe(transitions: list[tuple[int, str, int, str, int, str]], response: Any) -> Any:
    from lifecycle_msgs.msg import TransitionDescription

    found = []
    for number, label, before, before_label, after, after_label in transitions:
        one = TransitionDescription()
        one.transition.id, one.transition.label = number, label
        one.start_state.id, one.start_state.label = before, before_label
        one.goal_state.id, one.goal_state.label = after, after_label
        found.append(one)
    response.available_transitions = found
    return response


class LifecycleNode(LifecycleNodeMixin, Node):
    """Managed node: replace `on_configure` and the like, and call `super()` if there are managed entities."""

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)


