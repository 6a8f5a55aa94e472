"""Guard conditions: callbacks that other threads ask for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rclpy._rclpy_pybind11 import InvalidHandle
from rclpy.utilities import get_default_context

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.callback_groups import CallbackGroup
    from rclpy.context import Context


class GuardCondition:
    """Callback that runs in the executor after `trigger()`."""

    def __init__(
        self,
        callback: Callable[[], Any] | None,
        callback_group: CallbackGroup | None,
        context: Context | None = None,
    ) -> None:
        self._context = get_default_context() if context is None else context
        self._graph = self._context._use("cannot create guard condition")
        self._triggered = False
        self._destroyed = False
        self.callback = callback
        self.callback_group = callback_group

    def trigger(self) -> None:
        """Asks for one call of the callback."""
        if self._destroyed:
            raise InvalidHandle
        self._triggered = True
        self._graph.wake()

    @property
    def handle(self) -> GuardCondition:
        """The object itself."""
        return self

    def destroy(self) -> None:
        """Makes the guard condition unusable."""
        self._destroyed = True

    # ---- for the executor

    _kind = "guard condition"
    _monitor: Any = None

    def _full_name(self) -> str:
        return ""

    def _take(self) -> tuple[Any, ...] | None:
        if not self._triggered or self._destroyed:
            return None
        self._triggered = False
        return ()

    def _call(self, taken: Any, executor: Any) -> Any:
        return None if self.callback is None else self.callback()
