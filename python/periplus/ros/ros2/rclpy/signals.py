"""Ctrl-C and SIGTERM.

Both shut all contexts down at once. Ctrl-C then raises `KeyboardInterrupt` as in any Python program; SIGTERM does nothing
else, so that `spin` ends with `ExternalShutdownException`.
"""

from __future__ import annotations

import signal
from types import FrameType
from typing import Any

from rclpy._rclpy_pybind11 import InvalidHandle, SignalHandlerOptions
from rclpy.context import _valid_contexts
from rclpy.guard_condition import GuardCondition

_NUMBERS = {SignalHandlerOptions.SIGINT: signal.SIGINT, SignalHandlerOptions.SIGTERM: signal.SIGTERM}

# Handlers that were installed before ours, by the number of the signal.
_previous: dict[int, Any] = {}
_guards: list[SignalHandlerGuardCondition] = []


def _on_signal(number: int, frame: FrameType | None) -> None:
    for context in list(_valid_contexts):
        context._invalidate()
    for guard in list(_guards):
        guard.trigger()
    previous = _previous.get(number)
    if callable(previous):
        previous(number, frame)


def install_signal_handlers(options: SignalHandlerOptions = SignalHandlerOptions.ALL) -> None:
    """Handles the signals of `options`. Only the main thread can; in others nothing changes."""
    for option, number in _NUMBERS.items():
        if options & option and number not in _previous:
            try:
                previous = signal.getsignal(number)
                signal.signal(number, _on_signal)
            except ValueError:
                return
            _previous[number] = previous


def uninstall_signal_handlers() -> None:
    """Puts the handlers back that were there before `install_signal_handlers`."""
    for number in list(_previous):
        try:
            if signal.getsignal(number) is _on_signal:
                previous = _previous[number]
                signal.signal(number, signal.SIG_DFL if previous is None else previous)
        except ValueError:
            return
        del _previous[number]


def get_current_signal_handlers_options() -> SignalHandlerOptions:
    """The signals that are handled now."""
    options = SignalHandlerOptions.NO
    for option, number in _NUMBERS.items():
        if number in _previous:
            options |= option
    return options


class SignalHandlerGuardCondition(GuardCondition):
    """Guard condition that a signal triggers."""

    def __init__(self, context: Any = None) -> None:
        super().__init__(callback=None, callback_group=None, context=context)
        _guards.append(self)

    def destroy(self) -> None:
        """Stops watching signals."""
        if self in _guards:
            _guards.remove(self)
        super().destroy()


__all__ = [
    "InvalidHandle",
    "SignalHandlerGuardCondition",
    "SignalHandlerOptions",
    "get_current_signal_handlers_options",
    "install_signal_handlers",
    "uninstall_signal_handlers",
]
