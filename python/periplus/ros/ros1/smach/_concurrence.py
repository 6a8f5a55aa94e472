"""States beside each other."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable
from typing import Any

from smach._core import (
    CBState,
    Container,
    InvalidStateError,
    InvalidUserCodeError,
    UserData,
    has_smach_interface,
    is_shutdown,
    logerr,
    run_state,
)


class Concurrence(Container):
    """Executes states at the same time, each in a thread.

    Args:
        outcomes: Outcomes.
        default_outcome: Outcome if none of the others applies.
        input_keys: Keys that are read.
        output_keys: Keys that are written.
        outcome_map: Outcome -> dict of label and outcome that must all be so.
        outcome_cb: Function of the dict of labels and outcomes; returns an outcome or None.
        child_termination_cb: Function of that dict, called when a state ends; True ends the others.
    """

    def __init__(
        self,
        outcomes: Iterable[str],
        default_outcome: str,
        input_keys: Iterable[str] = (),
        output_keys: Iterable[str] = (),
        outcome_map: dict[str, dict[str, str]] | None = None,
        outcome_cb: Callable[[dict[str, Any]], str | None] | None = None,
        child_termination_cb: Callable[[dict[str, Any]], bool] | None = None,
    ) -> None:
        super().__init__(outcomes, input_keys, output_keys)
        self._states: dict[str, Any] = {}
        self._remappings: dict[str, dict[str, str]] = {}
        self._default = default_outcome
        self._map = dict(outcome_map or {})
        self._outcome_cb = outcome_cb
        self._child_cb = child_termination_cb
        self._child_outcomes: dict[str, Any] = {}
        self._errors: list[BaseException] = []
        self._condition = threading.Condition()

    @staticmethod
    def add(label: str, state: Any, remapping: dict[str, str] | None = None) -> Any:
        """Adds a state to the open container."""
        container = Concurrence.opened()
        if not has_smach_interface(state):
            state = CBState(state)
        if label in container._states:
            raise InvalidStateError(f"label '{label}' is used already")
        container._states[label] = state
        container._remappings[label] = dict(remapping or {})
        return state

    def _run(self, label: str) -> None:
        try:
            outcome = run_state(label, self._states[label], self.userdata, self._remappings[label])
        except InvalidUserCodeError as error:
            logerr(error)
            self._errors.append(error)
            outcome = None
        with self._condition:
            self._child_outcomes[label] = outcome
            if self._child_cb is not None and self._child_cb(dict(self._child_outcomes)):
                self._preempt_others()
            self._condition.notify_all()

    def _preempt_others(self) -> None:
        for label, state in self._states.items():
            if self._child_outcomes.get(label) is None:
                state.request_preempt()

    def execute(self, parent_ud: Any = None) -> Any:
        parent_ud = UserData() if parent_ud is None else parent_ud
        self._take(parent_ud)
        self._child_outcomes = {}
        self._errors = []
        self._call(self._start_cbs, list(self._states))
        threads = [threading.Thread(target=self._run, args=(label,), daemon=True) for label in self._states]
        for one in threads:
            one.start()
        with self._condition:
            while len(self._child_outcomes) < len(self._states) and not is_shutdown():
                self._condition.wait(0.1)
        for one in threads:
            one.join()
        if self._errors:
            raise InvalidUserCodeError(f"{len(self._errors)} states of the concurrence failed: {self._errors[0]}")
        if self.preempt_requested():
            self.service_preempt()
        for state in self._states.values():
            state.recall_preempt()
        outcome = self._outcome()
        self._call(self._termination_cbs, list(self._states), outcome)
        self._give(parent_ud)
        return outcome

    def _outcome(self) -> str:
        results = dict(self._child_outcomes)
        if self._outcome_cb is not None:
            found = self._outcome_cb(results)
            if found is not None:
                return found
        for outcome, wanted in self._map.items():
            if all(results.get(label) == one for label, one in wanted.items()):
                return outcome
        return self._default

    def get_children(self) -> dict[str, Any]:
        return self._states

    def get_initial_states(self) -> list[str]:
        return list(self._states)

    def get_active_states(self) -> list[str]:
        return [label for label in self._states if self._child_outcomes.get(label) is None]
