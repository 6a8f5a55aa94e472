"""Clocks of Python that show simulated time."""

from __future__ import annotations

import sys
import time
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from ._scheduler import Scheduler

_real_localtime, _real_gmtime = time.localtime, time.gmtime
_real_ctime, _real_asctime, _real_strftime = time.ctime, time.asctime, time.strftime


def replacements(scheduler: Scheduler) -> list[tuple[Any, str, Any]]:
    """The functions of `time`: (module, name, new function)."""

    def now_ns() -> int:
        scheduler.poll()
        return scheduler.now_ns()

    def now_s() -> float:
        scheduler.poll()
        return scheduler.now_ns() / 1e9

    def cpu_ns() -> int:
        scheduler.note("clock", "time.process_time and time.thread_time show simulated time")
        return now_ns()

    def cpu_s() -> float:
        return cpu_ns() / 1e9

    def sleep(seconds: float, /) -> None:
        if not isinstance(seconds, int):
            seconds = float(seconds)
        if seconds < 0:
            raise ValueError("sleep length must be non-negative")
        scheduler.sleep_ns(round(seconds * 1_000_000_000))

    def clock_gettime(clk_id: int, /) -> float:
        return now_s()

    def clock_gettime_ns(clk_id: int, /) -> int:
        return now_ns()

    def localtime(seconds: float | None = None, /) -> time.struct_time:
        return _real_localtime(now_s() if seconds is None else seconds)

    def gmtime(seconds: float | None = None, /) -> time.struct_time:
        return _real_gmtime(now_s() if seconds is None else seconds)

    def ctime(seconds: float | None = None, /) -> str:
        return _real_ctime(now_s() if seconds is None else seconds)

    def asctime(t: Any = None, /) -> str:
        return _real_asctime(localtime() if t is None else t)

    def strftime(format: str, t: Any = None, /) -> str:
        return _real_strftime(format, localtime() if t is None else t)

    functions: dict[str, Callable[..., Any]] = {
        "time": now_s,
        "monotonic": now_s,
        "perf_counter": now_s,
        "time_ns": now_ns,
        "monotonic_ns": now_ns,
        "perf_counter_ns": now_ns,
        "process_time": cpu_s,
        "thread_time": cpu_s,
        "process_time_ns": cpu_ns,
        "thread_time_ns": cpu_ns,
        "sleep": sleep,
        "clock_gettime": clock_gettime,
        "clock_gettime_ns": clock_gettime_ns,
        "localtime": localtime,
        "gmtime": gmtime,
        "ctime": ctime,
        "asctime": asctime,
        "strftime": strftime,
    }
    return [(time, name, function) for name, function in functions.items() if hasattr(time, name)]


def patch_datetime(module: ModuleType, scheduler: Scheduler) -> list[tuple[Any, str, Any]]:
    """`datetime.datetime` and `date` whose `now`, `utcnow` and `today` show simulated time."""
    real_datetime: Any = module.datetime
    real_date: Any = module.date

    class _Meta(type):
        # Objects that the C code has made are instances of the true classes.
        def __instancecheck__(cls, instance: Any) -> bool:
            return isinstance(instance, real_datetime if issubclass(cls, real_datetime) else real_date)

        def __subclasscheck__(cls, other: type) -> bool:
            return issubclass(other, real_datetime if real_datetime in type.mro(cls) else real_date)

    def now_s() -> float:
        scheduler.poll()
        return scheduler.now_ns() / 1e9

    class datetime(real_datetime, metaclass=_Meta):  # type: ignore[misc]  # noqa: N801
        @classmethod
        def now(cls, tz: Any = None) -> Any:
            return cls.fromtimestamp(now_s(), tz)

        @classmethod
        def utcnow(cls) -> Any:
            return cls.fromtimestamp(now_s(), module.timezone.utc).replace(tzinfo=None)

        @classmethod
        def today(cls) -> Any:
            return cls.fromtimestamp(now_s())

    class date(real_date, metaclass=_Meta):  # type: ignore[misc]  # noqa: N801
        @classmethod
        def today(cls) -> Any:
            return cls.fromtimestamp(now_s())

    for made in (datetime, date):
        made.__module__, made.__qualname__ = "datetime", made.__name__
    return [(module, "datetime", datetime), (module, "date", date)]


def patch_select(module: ModuleType, scheduler: Scheduler) -> list[tuple[Any, str, Any]]:
    """`select.select`, whose timeout is simulated time."""
    real_select: Any = module.select

    def select(rlist: Any, wlist: Any, xlist: Any, timeout: float | None = None, /) -> Any:
        rlist, wlist, xlist = list(rlist), list(wlist), list(xlist)
        if timeout is not None and timeout < 0:
            raise ValueError("timeout must be non-negative")

        def look() -> Any:
            found = real_select(rlist, wlist, xlist, 0)
            return found if any(found) else None

        if any(one is sys.stdin or one == 0 for one in rlist):
            scheduler.note("input", "waits for the keyboard by select()")
        limit_ns = None if timeout is None else round(timeout * 1e9)
        return scheduler.select(look, limit_ns) or ([], [], [])

    return [(module, "select", select)]


def patch_selectors(module: ModuleType, scheduler: Scheduler) -> list[tuple[Any, str, Any]]:
    """The selectors that `asyncio` and socket servers wait with."""
    patches: list[tuple[Any, str, Any]] = []
    for name in ("SelectSelector", "PollSelector", "EpollSelector", "KqueueSelector", "DevpollSelector"):
        selector: Any = getattr(module, name, None)
        if selector is None:
            continue
        patches.append((selector, "select", _selector_method(selector.select, scheduler)))
    return patches


def _selector_method(real: Any, scheduler: Scheduler) -> Any:
    def select(self: Any, timeout: float | None = None) -> Any:
        limit_ns = None if timeout is None else max(0, round(timeout * 1e9))
        return scheduler.select(lambda: real(self, 0), limit_ns)

    return select


def replace_everywhere(patches: list[tuple[Any, str, Any]]) -> list[tuple[Any, str, Any]]:
    """Sets attributes, also where a module has imported the old value by name. Returns what undoes it."""
    undo: list[tuple[Any, str, Any]] = []
    by_identity: dict[int, tuple[Any, Any]] = {}
    for owner, name, value in patches:
        old = getattr(owner, name)
        undo.append((owner, name, old))
        if not isinstance(owner, type):
            by_identity[id(old)] = (old, value)
        setattr(owner, name, value)
    for module_name, module in list(sys.modules.items()):
        if module_name.startswith("periplus.ros.") or module_name == "__main__":
            continue
        if not isinstance(module, ModuleType):
            continue
        members = module.__dict__
        for name, value in list(members.items()):
            found = by_identity.get(id(value))
            if found is not None and found[0] is value:
                undo.append((module, name, value))
                members[name] = found[1]
    return undo
