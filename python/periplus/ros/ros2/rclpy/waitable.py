"""Waitables: objects with a readiness of their own, such as actions and events."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.task import Future


class NumberOfEntities:
    """Number of entities of each kind."""

    __slots__ = [
        "num_subscriptions",
        "num_guard_conditions",
        "num_timers",
        "num_clients",
        "num_services",
        "num_events",
    ]

    def __init__(
        self,
        num_subs: int = 0,
        num_gcs: int = 0,
        num_timers: int = 0,
        num_clients: int = 0,
        num_services: int = 0,
        num_events: int = 0,
    ) -> None:
        self.num_subscriptions = num_subs
        self.num_guard_conditions = num_gcs
        self.num_timers = num_timers
        self.num_clients = num_clients
        self.num_services = num_services
        self.num_events = num_events

    def __add__(self, other: NumberOfEntities) -> NumberOfEntities:
        total = NumberOfEntities()
        for name in self.__slots__:
            setattr(total, name, getattr(self, name) + getattr(other, name))
        return total

    def __repr__(self) -> str:
        return f"NumberOfEntities({', '.join(str(getattr(self, name)) for name in self.__slots__)})"


class Waitable:
    """Base of the objects that an executor asks whether they are ready.

    The executor calls `is_ready`, then `take_data`, then awaits `execute(taken_data)`.
    """

    def __init__(self, callback_group: CallbackGroup) -> None:
        self.callback_group = callback_group
        self.callback_group.add_entity(self)
        self._futures: list[Future] = []

    def __enter__(self) -> Waitable:
        return self

    def __exit__(self, t: Any, v: Any, tb: Any) -> None:
        return None

    def add_future(self, future: Future) -> None:
        """Lets the executor resume the tasks that wait for `future`."""
        self._futures.append(future)

    def remove_future(self, future: Future) -> None:
        """Undoes `add_future`."""
        self._futures.remove(future)

    def is_ready(self, wait_set: Any) -> bool:
        """True if there is something to execute."""
        raise NotImplementedError("Must be implemented by subclass")

    def take_data(self) -> Any:
        """Takes what `execute` needs."""
        raise NotImplementedError("Must be implemented by subclass")

    async def execute(self, taken_data: Any) -> Any:
        """Executes what was taken."""
        raise NotImplementedError("Must be implemented by subclass")

    def get_num_entities(self) -> NumberOfEntities:
        """Number of entities of each kind."""
        raise NotImplementedError("Must be implemented by subclass")

    def add_to_wait_set(self, wait_set: Any) -> None:
        """Adds the entities to a wait set."""
        raise NotImplementedError("Must be implemented by subclass")

    # ---- for the executor

    _monitor: Any = None

    @property
    def _kind(self) -> str:
        return type(self).__name__

    def _full_name(self) -> str:
        return ""

    def _has_work(self) -> bool:
        return bool(self.is_ready(None))

    def _next_ns(self) -> int | None:
        """Time [ns] until the waitable gets ready by itself, or None."""
        return None

    def _take(self) -> Any:
        if not self._has_work():
            return None
        return (self.take_data(),)

    def _call(self, taken: Any, executor: Any) -> Any:
        return self.execute(taken[0])
