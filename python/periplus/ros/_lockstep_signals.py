"""Signal handlers that run when the main thread has the turn, never beside another thread."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from ._scheduler import Scheduler

_real_signal, _real_getsignal = signal.signal, signal.getsignal


def replacements(scheduler: Scheduler, note: Callable[..., None]) -> list[tuple[Any, str, Any]]:
    """The functions of `signal`: (module, name, new function). Wraps the handlers that are installed."""
    handlers: dict[int, Any] = {}

    def wrapped(number: int, frame: Any) -> None:
        handler = handlers.get(number)
        if handler is not None:
            scheduler.handle_signal(handler, number, frame)

    def set_signal(signalnum: int, handler: Any, /) -> Any:
        before = get_signal(signalnum)
        number = int(signalnum)
        if callable(handler):
            _real_signal(number, wrapped)
            handlers[number] = handler
        else:
            _real_signal(number, handler)
            handlers.pop(number, None)
        return before

    def get_signal(signalnum: int, /) -> Any:
        known = handlers.get(int(signalnum))
        return known if known is not None else _real_getsignal(signalnum)

    def noting(name: str) -> Any:
        real = getattr(signal, name)

        def function(*arguments: Any) -> Any:
            note("signal", f"signal.{name}", sys._getframe(1))
            return real(*arguments)

        return function

    for number in (signal.SIGINT, signal.SIGTERM):
        handler = _real_getsignal(number)
        if callable(handler):
            set_signal(number, handler)
    patches: list[tuple[Any, str, Any]] = [(signal, "signal", set_signal), (signal, "getsignal", get_signal)]
    return patches + [(signal, name, noting(name)) for name in ("alarm", "setitimer") if hasattr(signal, name)]
