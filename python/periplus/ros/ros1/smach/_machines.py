"""State machines, sequences and loops."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

from smach._core import (
    CBState,
    Container,
    InvalidConstructionError,
    InvalidStateError,
    InvalidTransitionError,
    UserData,
    has_smach_interface,
    is_shutdown,
    loginfo,
    run_state,
)


class StateMachine(Container):
    """Executes states one after another, by the transitions of their outcomes."""

    def __init__(
        self, outcomes: Iterable[str], input_keys: Iterable[str] = (), output_keys: Iterable[str] = ()
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._states: dict[str, Any] = {}
        self._transitions: dict[str, dict[str, str]] = {}
        self._remappings: dict[str, dict[str, str]] = {}
        self._initial_state_label: str | None = None
        self._current_label: str | None = None
        self._state_lock = threading.RLock()
        self._is_running = False
        self._auto: tuple[str, list[str]] | None = None

    @staticmethod
    def add(
        label: str,
        state: Any,
        transitions: dict[str, str] | None = None,
        remapping: dict[str, str] | None = None,
    ) -> Any:
        """Adds a state to the open machine.

        Args:
            label: Name of the state.
            state: State, or a function of the user data.
            transitions: Outcome of the state -> label of the next one, or outcome of the machine.
            remapping: Key of the state -> key of the machine.
        """
        machine = StateMachine.opened()
        return machine._add(label, state, dict(transitions or {}), dict(remapping or {}))

    def _add(self, label: str, state: Any, transitions: dict[str, str], remapping: dict[str, str]) -> Any:
        if not has_smach_interface(state):
            if not callable(state):
                raise InvalidStateError(f"State '{label}' is neither a state nor callable: {state!r}")
            state = CBState(state)
        if label in self._states:
            raise InvalidStateError(f"Attempting to add state with label '{label}' to state machine, but this label is already being used.")
        outcomes = state.get_registered_outcomes()
        for outcome in transitions:
            if outcome not in outcomes:
                raise InvalidTransitionError(
                    f"State '{label}' has no outcome '{outcome}'. Its outcomes: {sorted(outcomes)}"
                )
        for outcome in outcomes:
            # An outcome without a transition is an outcome of the machine.
            transitions.setdefault(outcome, outcome)
        if self._auto is not None:
            last, connectors = self._auto
            self._transitions[last].update(dict.fromkeys(connectors, label))
            self._auto = None
        self._states[label] = state
        self._transitions[label] = transitions
        self._remappings[label] = remapping
        return state

    @staticmethod
    def add_auto(
        label: str,
        state: Any,
        connector_outcomes: Iterable[str],
        transitions: dict[str, str] | None = None,
        remapping: dict[str, str] | None = None,
    ) -> Any:
        """Adds a state whose outcomes lead to the state that is added next."""
        machine = StateMachine.opened()
        made = machine._add(label, state, dict(transitions or {}), dict(remapping or {}))
        machine._auto = (label, list(connector_outcomes))
        return made

    def set_initial_state(self, initial_states: list[str], userdata: Any = None) -> None:
        """Sets the first state."""
        if userdata is not None:
            self.userdata.update(userdata)
        if len(initial_states) > 1:
            raise InvalidStateError("A state machine has one initial state.")
        if initial_states:
            self._initial_state_label = initial_states[0]

    def check_consistency(self) -> None:
        if not self._states:
            raise InvalidStateError("The state machine has no states.")
        if self._initial_state_label is None:
            self._initial_state_label = next(iter(self._states))
        if self._initial_state_label not in self._states:
            raise InvalidStateError(f"Initial state '{self._initial_state_label}' is not in the machine.")
        known = set(self._states) | self._outcomes
        for label, transitions in self._transitions.items():
            for outcome, target in transitions.items():
                if target is not None and target not in known:
                    raise InvalidTransitionError(
                        f"State '{label}': outcome '{outcome}' leads to '{target}', which is neither a state "
                        f"({sorted(self._states)}) nor an outcome of the machine ({sorted(self._outcomes)})"
                    )

    def execute(self, parent_ud: Any = None) -> str | None:
        """Runs the machine; returns its outcome."""
        parent_ud = UserData() if parent_ud is None else parent_ud
        self.check_consistency()
        self._take(parent_ud)
        label = self._initial_state_label
        assert label is not None
        self._current_label = label
        self._is_running = True
        loginfo(f"State machine starting in initial state '{label}' with userdata: \n\t{self.userdata.keys()}")
        self._call(self._start_cbs, [label])
        try:
            while not is_shutdown():
                if self.preempt_requested() and self._preempts(label):
                    self.service_preempt()
                    return "preempted" if "preempted" in self._outcomes else None
                state = self._states[label]
                outcome = run_state(label, state, self.userdata, self._remappings[label])
                if outcome not in state.get_registered_outcomes():
                    raise InvalidTransitionError(
                        f"Attempted to return outcome '{outcome}' preempt_requested from state '{label}' of type "
                        f"'{state}' which only has registered outcomes: {state.get_registered_outcomes()}"
                    )
                target = self._transitions[label][outcome]
                if target in self._outcomes and target not in self._states:
                    loginfo(f"State machine terminating '{label}':'{outcome}':'{target}'")
                    self._call(self._termination_cbs, [label], target)
                    self._give(parent_ud)
                    return target
                loginfo(f"State machine transitioning '{label}':'{outcome}'-->'{target}'")
                label = self._current_label = target
                self._call(self._transition_cbs, [label])
        finally:
            self._is_running = False
        return "preempted" if "preempted" in self._outcomes else None

    def _preempts(self, label: str) -> bool:
        return "preempted" in self._outcomes or "preempted" not in self._transitions[label]

    def get_children(self) -> dict[str, Any]:
        return self._states

    def get_active_states(self) -> list[str]:
        return [self._current_label] if self._is_running and self._current_label is not None else []

    def get_initial_states(self) -> list[str]:
        return [self._initial_state_label] if self._initial_state_label is not None else []


class Sequence(StateMachine):
    """State machine whose states follow one another by one outcome."""

    def __init__(
        self,
        outcomes: Iterable[str],
        connector_outcome: str,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._connector = connector_outcome
        self._last: str | None = None

    def _add(self, label: str, state: Any, transitions: dict[str, str], remapping: dict[str, str]) -> Any:
        is_open = self._connector not in transitions
        made = super()._add(label, state, transitions, remapping)
        if self._last is not None:
            self._transitions[self._last][self._connector] = label
        self._last = label if is_open else None
        return made


class Iterator(Container):
    """Executes one state for each value of a sequence.

    Args:
        outcomes: Outcomes of the loop.
        input_keys: Keys that it reads.
        output_keys: Keys that it writes.
        it: Values, or a function that makes them.
        it_label: Key of the current value.
        exhausted_outcome: Outcome after the last value.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        input_keys: Iterable[str],
        output_keys: Iterable[str],
        it: Any = (),
        it_label: str = "it_data",
        exhausted_outcome: str = "exhausted",
    ) -> None:
        super().__init__({*outcomes, exhausted_outcome}, input_keys, output_keys)
        self._values: Any = it
        self._it_label = it_label
        self._exhausted = exhausted_outcome
        self._label = ""
        self._state: Any = None
        self._loop_outcomes: list[str] = []
        self._break_outcomes: list[str] = []
        self._remapping: dict[str, str] = {}
        self._final: dict[str, str] = {}

    @staticmethod
    def set_contained_state(
        label: str,
        state: Any,
        loop_outcomes: Iterable[str] = (),
        break_outcomes: Iterable[str] = (),
        final_outcome_map: dict[str, str] | None = None,
        remapping: dict[str, str] | None = None,
    ) -> None:
        """Sets the state of the open loop."""
        loop = Iterator.opened()
        loop._label, loop._state = label, state
        loop._loop_outcomes, loop._break_outcomes = list(loop_outcomes), list(break_outcomes)
        loop._remapping = dict(remapping or {})
        loop._final = dict(final_outcome_map or {})

    def set_iteritems(self, it: Any, it_label: str) -> None:
        """Sets the values."""
        self._values, self._it_label = it, it_label

    def check_consistency(self) -> None:
        if self._state is None:
            raise InvalidConstructionError("The loop has no state: use Iterator.set_contained_state()")

    def execute(self, parent_ud: Any = None) -> Any:
        parent_ud = UserData() if parent_ud is None else parent_ud
        self._take(parent_ud)
        values = self._values() if isinstance(self._values, Callable) else self._values  # type: ignore[arg-type]
        for value in values:
            if is_shutdown() or self.preempt_requested():
                self.service_preempt()
                return "preempted" if "preempted" in self._outcomes else None
            self.userdata[self._it_label] = value
            outcome = run_state(self._label, self._state, self.userdata, self._remapping)
            if outcome in self._break_outcomes or (self._loop_outcomes and outcome not in self._loop_outcomes):
                self._give(parent_ud)
                return self._final.get(outcome, outcome)
        self._give(parent_ud)
        return self._exhausted

    def get_children(self) -> dict[str, Any]:
        return {self._label: self._state}

    def get_active_states(self) -> list[str]:
        return [self._label]
