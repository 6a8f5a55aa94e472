"""A thread of a program in lockstep, and the part of the graph that its scheduler needs."""

from __future__ import annotations

import _thread
from typing import Any, Protocol

_real_allocate_lock = _thread.allocate_lock


class LockstepGraph(Protocol):
    """The part of `RosGraph` that the scheduler needs."""

    @property
    def events(self) -> int: ...
    def now_ns(self) -> int: ...
    def wake(self) -> None: ...
    def exchange(self, wake_ns: int | None, wants_messages: bool) -> None: ...


class Task:
    """One thread of the program."""

    __slots__ = ("done", "empty_polls", "gate", "ident", "is_daemon", "joiners", "name", "polls", "result", "rounds", "token", "waits", "was_woken")

    def __init__(self, name: str, *, is_daemon: bool = True) -> None:
        self.name = name
        self.is_daemon = is_daemon
        self.ident = 0
        #: Held while the thread does not have the turn.
        self.gate = _real_allocate_lock()
        self.gate.acquire()
        self.waits = self.was_woken = self.done = False
        #: Number of the current wait; older entries among the sleepers are void.
        self.token = 0
        self.polls = self.empty_polls = self.rounds = 0
        self.joiners: list[Task] = []
        self.result: Any = None
