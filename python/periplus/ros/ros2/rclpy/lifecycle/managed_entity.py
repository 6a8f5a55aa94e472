"""Objects that follow the state of a managed node."""

from __future__ import annotations

from functools import wraps
from typing import Any

from rclpy._rclpy_pybind11 import TransitionCallbackReturnType as TransitionCallbackReturn


class ManagedEntity:
    """Object with a callback for each transition of its node. All return SUCCESS unless replaced."""

    def on_configure(self, state: Any) -> TransitionCallbackReturn:
        """Called at `configure`."""
        return TransitionCallbackReturn.SUCCESS

    def on_cleanup(self, state: Any) -> TransitionCallbackReturn:
        """Called at `cleanup`."""
        return TransitionCallbackReturn.SUCCESS

    def on_shutdown(self, state: Any) -> TransitionCallbackReturn:
        """Called at `shutdown`."""
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state: Any) -> TransitionCallbackReturn:
        """Called at `activate`."""
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> TransitionCallbackReturn:
        """Called at `deactivate`."""
        return TransitionCallbackReturn.SUCCESS

    def on_error(self, state: Any) -> TransitionCallbackReturn:
        """Called after an error in another callback."""
        return TransitionCallbackReturn.SUCCESS


class SimpleManagedEntity(ManagedEntity):
    """Object that is enabled while its node is active."""

    def __init__(self) -> None:
        self._enabled = False

    def on_activate(self, state: Any) -> TransitionCallbackReturn:
        """Enables the object."""
        self._enabled = True
        return TransitionCallbackReturn.SUCCESS

    def on_deactivate(self, state: Any) -> TransitionCallbackReturn:
        """Disables the object."""
        self._enabled = False
        return TransitionCallbackReturn.SUCCESS

    @property
    def is_activated(self) -> bool:
        """True while the object is enabled."""
        return self._enabled

    @staticmethod
    def when_enabled(wrapped: Any = None, *, when_not_enabled: Any = None) -> Any:
        """Decorator of a method that runs only while the object is enabled; otherwise `when_not_enabled` runs."""

        def decorate(method: Any) -> Any:
            @wraps(method)
            def checked(self: SimpleManagedEntity, *args: Any, **kwargs: Any) -> Any:
                if self._enabled:
                    return method(self, *args, **kwargs)
                return None if when_not_enabled is None else when_not_enabled(self, *args, **kwargs)

            return checked

        return decorate if wrapped is None else decorate(wrapped)
