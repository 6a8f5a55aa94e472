"""Callback groups: which callbacks may run at the same time."""

from __future__ import annotations

import weakref
from _thread import allocate_lock
from typing import Any


class CallbackGroup:
    """Base of the callback groups. Keeps its entities by weak references."""

    def __init__(self) -> None:
        super().__init__()
        self.entities: set[weakref.ReferenceType[Any]] = set()

    def add_entity(self, entity: Any) -> None:
        """Adds a timer, subscription, service, client or waitable."""
        self.entities.add(weakref.ref(entity))

    def has_entity(self, entity: Any) -> bool:
        """True if the entity belongs to the group."""
        return weakref.ref(entity) in self.entities

    def can_execute(self, entity: Any) -> bool:
        """True if a callback of the entity may start now."""
        raise NotImplementedError

    def beginning_execution(self, entity: Any) -> bool:
        """Marks the start of a callback; False if it may not start now."""
        raise NotImplementedError

    def ending_execution(self, entity: Any) -> None:
        """Marks the end of a callback."""
        raise NotImplementedError


class ReentrantCallbackGroup(CallbackGroup):
    """Group whose callbacks may all run at the same time."""

    def can_execute(self, entity: Any) -> bool:
        """True."""
        return True

    def beginning_execution(self, entity: Any) -> bool:
        """True."""
        return True

    def ending_execution(self, entity: Any) -> None:
        """Does nothing."""


class MutuallyExclusiveCallbackGroup(CallbackGroup):
    """Group of which one callback runs at a time, also while a coroutine of it awaits something."""

    def __init__(self) -> None:
        super().__init__()
        self._active_entity: Any = None
        self._lock = allocate_lock()

    def can_execute(self, entity: Any) -> bool:
        """True unless another callback of the group runs."""
        return self._active_entity is None

    def beginning_execution(self, entity: Any) -> bool:
        """Marks the start of a callback; False if another one runs."""
        with self._lock:
            if self._active_entity is not None:
                return False
            self._active_entity = entity
            return True

    def ending_execution(self, entity: Any) -> None:
        """Marks the end of the callback."""
        with self._lock:
            assert self._active_entity is entity
            self._active_entity = None
