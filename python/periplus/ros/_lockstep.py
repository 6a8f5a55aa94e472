"""Programs in step with a simulation: deterministic threads, simulated clocks, seeded random numbers.

`start()` is called before the first line of the user's program, in a process that `periplus launch` has started with these
variables:

- `PERIPLUS_LOCKSTEP`: address of the simulation. It is removed, so that processes which the program starts are not in step.
- `PERIPLUS_SEED`: seed of the run (default 0). `PERIPLUS_PROCESS`: name of the process in the launch file, so that two
  processes have different random numbers (default: the program with its node name and namespace).
- `PYTHONHASHSEED`: set by the parent, since Python reads it at its start.
"""

from __future__ import annotations

import _thread
import importlib.machinery
import importlib.util
import os
import sys
import threading
import time
from typing import TYPE_CHECKING, Any

from . import _busy_loops, _faults, _lockstep_signals, _lockstep_threads, _lockstep_time, _tracebacks, _waiting
from ._lockstep_report import Report
from ._lockstep_task import LockstepGraph
from ._scheduler import Scheduler

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

_real_sleep = time.sleep
_real_monotonic = time.monotonic
_real_start_thread = _thread.start_new_thread

_scheduler: Scheduler | None = None
_report = Report()
_undo: list[tuple[Any, str, Any]] = []


def start(link: str, *, graph: LockstepGraph | None = None) -> Scheduler:
    """Puts this process in step with the simulation at `link`; `graph` replaces the connection in tests."""
    global _scheduler
    if _scheduler is not None:
        return _scheduler
    if graph is None:
        from periplus import _native

        graph = _native.RosGraph([], link=link)
    assert graph is not None
    os.environ.pop("PERIPLUS_LOCKSTEP", None)
    scheduler = _scheduler = Scheduler(graph, _report.note)
    import atexit

    # First in, last out: after the functions of the program.
    atexit.register(_at_exit)
    # Python calls these before it joins threads, the last one first.
    threading._register_atexit(_lockstep_threads.join_all)  # type: ignore[attr-defined]
    if hasattr(os, "register_at_fork"):
        os.register_at_fork(after_in_child=_leave)
    patches = _lockstep_threads.replacements(scheduler) + _lockstep_time.replacements(scheduler)
    patches += _lockstep_signals.replacements(scheduler, _report.note) + _busy_loops.install()
    seed = os.environ.get("PERIPLUS_SEED", "") or "0"
    process = os.environ.get("PERIPLUS_PROCESS") or _process_name(sys.argv)
    patches.append((os, "urandom", _entropy(f"{seed}/{process}")))
    _undo.extend(_lockstep_time.replace_everywhere(patches))
    # Random numbers are seeded, clocks replaced, in modules that may never be imported.
    _after_import("random", lambda module: _seed_random(module, f"{seed}/{process}"))
    _after_import("datetime", lambda module: _lockstep_time.patch_datetime(module, scheduler))
    _after_import("select", lambda module: _lockstep_time.patch_select(module, scheduler))
    _after_import("selectors", lambda module: _lockstep_time.patch_selectors(module, scheduler))
    _after_import("queue", _patch_queue)
    _after_import("uuid", _patch_uuid)
    sys.addaudithook(_report.audit)
    _waiting._scheduler, _waiting._link = scheduler, link
    _faults.dump_on_signal()
    _real_start_thread(_watch, (scheduler,))
    return scheduler


def _process_name(words: list[str]) -> str:
    """Name of the program with the words that rename its node: the same in each run, unlike paths of parameter files."""
    renames = [word for word in words[1:] if word.startswith(("__node:=", "__name:=", "__ns:="))]
    return " ".join([os.path.basename(words[0]) if words else "", *renames])


def _at_exit() -> None:
    scheduler = _scheduler
    if scheduler is None:
        return
    _report.print_summary()
    _report.is_quiet = True


def _leave() -> None:
    """In a forked child: nothing is in step any more."""
    global _scheduler
    _scheduler = None
    _waiting._scheduler = None
    _report.is_quiet = True
    _lockstep_threads.uninstall()
    for owner, name, value in reversed(_undo):
        setattr(owner, name, value)
    sys.meta_path[:] = [finder for finder in sys.meta_path if not isinstance(finder, _ImportHook)]


def _entropy(key: str) -> Callable[[int], bytes]:
    """A replacement of `os.urandom`: `uuid.uuid4`, `secrets` and numpy's generators draw from it."""
    blocks = 0

    def urandom(size: int, /) -> bytes:
        nonlocal blocks
        if size < 0:
            raise ValueError("negative argument not allowed")
        from hashlib import blake2b

        made = b""
        while len(made) < size:
            made += blake2b(f"{key}/{blocks}".encode()).digest()
            blocks += 1
        return made[:size]

    return urandom


def _seed_random(module: ModuleType, key: str) -> list[tuple[Any, str, Any]]:
    """Seeds `random`; `random.Random()` and `random.seed()` without a seed get the next of a fixed sequence."""
    real_seed: Any = module.Random.seed
    made = 0

    def seed(self: Any, a: Any = None, version: int = 2) -> None:
        nonlocal made
        if a is None:
            a = f"{key}/{made}"
            made += 1
        real_seed(self, a, version)

    module.Random.seed = seed
    module._inst.seed(key)
    module.__dict__["seed"] = module._inst.seed
    return [(module.Random, "seed", seed)]


def _patch_queue(module: ModuleType) -> list[tuple[Any, str, Any]]:
    """`queue.SimpleQueue` in Python: the one in C blocks where no other thread can get the turn."""
    return [(module, "SimpleQueue", module._PySimpleQueue)] if hasattr(module, "_PySimpleQueue") else []


def _patch_uuid(module: ModuleType) -> list[tuple[Any, str, Any]]:
    """`uuid1` from simulated time and a fixed node number instead of a function in C."""
    module._node = 0x0242AC110002  # type: ignore[attr-defined]
    return [(module, name, None) for name in ("_generate_time_safe", "_UuidCreate") if hasattr(module, name)]


class _ImportHook:
    """Calls a function after the first import of a module."""

    def __init__(self, name: str, function: Callable[[ModuleType], list[tuple[Any, str, Any]]]) -> None:
        self.name, self.function = name, function

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> importlib.machinery.ModuleSpec | None:
        if fullname != self.name:
            return None
        sys.meta_path.remove(self)
        spec = importlib.util.find_spec(fullname)
        if spec is not None and spec.loader is not None:
            spec.loader = _Loader(spec.loader, self.function)  # type: ignore[assignment]
        return spec


class _Loader:
    def __init__(self, loader: Any, function: Callable[[ModuleType], list[tuple[Any, str, Any]]]) -> None:
        self.loader, self.function = loader, function

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> ModuleType | None:
        return self.loader.create_module(spec)  # type: ignore[no-any-return]

    def exec_module(self, module: ModuleType) -> None:
        self.loader.exec_module(module)
        module.__loader__ = self.loader
        if module.__spec__ is not None:
            module.__spec__.loader = self.loader
        _undo.extend(_lockstep_time.replace_everywhere(self.function(module)))

    def __getattr__(self, name: str) -> Any:
        return getattr(self.loader, name)


def _after_import(name: str, function: Callable[[ModuleType], list[tuple[Any, str, Any]]]) -> None:
    module = sys.modules.get(name)
    if module is not None:
        _undo.extend(_lockstep_time.replace_everywhere(function(module)))
    else:
        sys.meta_path.insert(0, _ImportHook(name, function))


def _watch(scheduler: Scheduler) -> None:
    """Names a thread that keeps the turn: the simulation waits for it. Runs in a thread of its own, on the wall clock."""
    try:
        limit_s = float(os.environ.get("PERIPLUS_CALLBACK_TIMEOUT_S", "") or _faults.DEFAULT_TIMEOUT_S)
    except ValueError:
        limit_s = _faults.DEFAULT_TIMEOUT_S
    if limit_s <= 0:
        return
    seen, since_s, named = (-1, -1), _real_monotonic(), False
    while _scheduler is scheduler:
        _real_sleep(min(1.0, limit_s / 4))
        state = (scheduler.switches, scheduler.now_ns())
        if state != seen or scheduler.is_exchanging or scheduler.has_ended:
            seen, since_s, named = state, _real_monotonic(), False
        elif not named and _real_monotonic() - since_s > limit_s:
            named = True
            task = scheduler.current
            running = _faults._running.get(task.ident)
            name = f"{running[0]}" if running is not None else f"thread {task.name}"
            frame = sys._current_frames().get(task.ident)
            _faults._report(
                f"{name} has not come back for {limit_s:.0f} s of wall time; the simulation waits for it at "
                f"{state[1] / 1e9:.3f} s. It is here:\n{_tracebacks.format_stack(frame)}"
            )
