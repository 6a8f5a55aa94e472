"""States and transitions of managed nodes."""

from __future__ import annotations

from collections.abc import Callable

from rclpy import _log_output
from rclpy._rclpy_pybind11 import RCLError

State = tuple[int, str]
Transition = tuple[int, str, int, int]

STATES: dict[int, str] = {
    0: "unknown",
    1: "unconfigured",
    2: "inactive",
    3: "active",
    4: "finalized",
    10: "configuring",
    11: "cleaningup",
    12: "shuttingdown",
    13: "activating",
    14: "deactivating",
    15: "errorprocessing",
}

_SUCCESS, _FAILURE, _ERROR = "transition_success", "transition_failure", "transition_error"

#: Transitions: number, label, state before, state after.
TRANSITIONS: list[Transition] = [
    (1, "configure", 1, 10),
    (10, _SUCCESS, 10, 2),
    (11, _FAILURE, 10, 1),
    (12, _ERROR, 10, 15),
    (2, "cleanup", 2, 11),
    (20, _SUCCESS, 11, 1),
    (21, _FAILURE, 11, 2),
    (22, _ERROR, 11, 15),
    (3, "activate", 2, 13),
    (30, _SUCCESS, 13, 3),
    (31, _FAILURE, 13, 2),
    (32, _ERROR, 13, 15),
    (4, "deactivate", 3, 14),
    (40, _SUCCESS, 14, 2),
    (41, _FAILURE, 14, 3),
    (42, _ERROR, 14, 15),
    (5, "shutdown", 1, 12),
    (6, "shutdown", 2, 12),
    (7, "shutdown", 3, 12),
    (50, _SUCCESS, 12, 4),
    (51, _FAILURE, 12, 4),
    (52, _ERROR, 12, 15),
    (60, _SUCCESS, 15, 1),
    (61, _FAILURE, 15, 4),
    (62, _ERROR, 15, 4),
]


class LifecycleStateMachine:
    """Current state of a managed node."""

    def __init__(self, on_transition: Callable[[Transition], None]) -> None:
        self._state = 1
        self._on_transition = on_transition
        self.initialized = True

    @property
    def current_state(self) -> State:
        """Number and label of the state."""
        return self._state, STATES[self._state]

    @property
    def available_states(self) -> list[State]:
        """All states."""
        return list(STATES.items())

    @property
    def available_transitions(self) -> list[tuple[int, str, int, str, int, str]]:
        """Transitions that are possible now."""
        return [one for one in self.transition_graph if one[2] == self._state]

    @property
    def transition_graph(self) -> list[tuple[int, str, int, str, int, str]]:
        """All transitions."""
        return [
            (number, label, before, STATES[before], after, STATES[after]) for number, label, before, after in TRANSITIONS
        ]

    def get_transition_by_label(self, label: str) -> int:
        """Number of the transition with a label that is possible now; raises `RCLError` without one."""
        return self._find(lambda one: one[1] == label, label)[0]

    def trigger_transition_by_id(self, number: int, publish: bool = True) -> None:
        """Goes to the next state. Raises `RCLError` for a transition that is not possible now."""
        self._trigger(self._find(lambda one: one[0] == number, number), publish)

    def trigger_transition_by_label(self, label: str, publish: bool = True) -> None:
        """Goes to the next state. Raises `RCLError` for a transition that is not possible now."""
        self._trigger(self._find(lambda one: one[1] == label, label), publish)

    def _find(self, is_meant: Callable[[Transition], bool], what: int | str) -> Transition:
        for one in TRANSITIONS:
            if one[2] == self._state and is_meant(one):
                return one
        _log_output.report(
            30, "rcl_lifecycle", f"No transition matching {what} found for current state {STATES[self._state]}"
        )
        raise RCLError("Failed to trigger lifecycle state machine transition: Transition is not registered.")

    def _trigger(self, transition: Transition, publish: bool) -> None:
        self._state = transition[3]
        if publish:
            self._on_transition(transition)
