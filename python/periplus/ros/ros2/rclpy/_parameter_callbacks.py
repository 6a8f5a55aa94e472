"""Functions that a node calls before, while and after its parameters are set."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rclpy.parameter import Parameter

PreCallback = Callable[[list[Parameter]], list[Parameter]]
OnCallback = Callable[[list[Parameter]], Any]
PostCallback = Callable[[list[Parameter]], None]


class ParameterCallbacks:
    """The lists of callbacks of a node."""

    _pre_set_parameters_callbacks: list[PreCallback]
    _on_set_parameters_callbacks: list[OnCallback]
    _post_set_parameters_callbacks: list[PostCallback]

    def _rcl_init_callbacks(self) -> None:
        self._pre_set_parameters_callbacks = []
        self._on_set_parameters_callbacks = []
        self._post_set_parameters_callbacks = []

    def add_pre_set_parameters_callback(self, callback: PreCallback) -> None:
        """Calls a function before parameters are set; it returns the list that is set instead."""
        self._pre_set_parameters_callbacks.insert(0, _callable(callback))

    def add_on_set_parameters_callback(self, callback: OnCallback) -> None:
        """Asks a function whether parameters may be set; the newest is asked first, the first refusal counts."""
        self._on_set_parameters_callbacks.insert(0, _callable(callback))

    def add_post_set_parameters_callback(self, callback: PostCallback) -> None:
        """Calls a function after parameters were set."""
        self._post_set_parameters_callbacks.insert(0, _callable(callback))

    def remove_pre_set_parameters_callback(self, callback: PreCallback) -> None:
        """Undoes `add_pre_set_parameters_callback`. Raises `ValueError` if it was not added."""
        self._pre_set_parameters_callbacks.remove(callback)

    def remove_on_set_parameters_callback(self, callback: OnCallback) -> None:
        """Undoes `add_on_set_parameters_callback`. Raises `ValueError` if it was not added."""
        self._on_set_parameters_callbacks.remove(callback)

    def remove_post_set_parameters_callback(self, callback: PostCallback) -> None:
        """Undoes `add_post_set_parameters_callback`. Raises `ValueError` if it was not added."""
        self._post_set_parameters_callbacks.remove(callback)


def _callable(callback: Any) -> Any:
    if not callable(callback):
        raise TypeError("Callback must be callable, got {}", type(callback))
    return callback
