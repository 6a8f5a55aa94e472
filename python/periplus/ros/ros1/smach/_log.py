"""Log and shutdown of state machines, which programs may replace."""

from __future__ import annotations

import sys
from collections.abc import Callable
from typing import Any, ClassVar


class _Hooks:
    """Functions that programs may replace."""

    shutdown_check: Callable[[], bool] | None = None
    loggers: ClassVar[dict[str, Callable[..., Any]]] = {}


def _default_shutdown() -> bool:
    rospy = sys.modules.get("rospy")
    return bool(rospy.is_shutdown()) if rospy is not None else False


def set_shutdown_check(cb: Callable[[], bool]) -> None:
    """Sets the function that says when to stop."""
    _Hooks.shutdown_check = cb


def get_shutdown_check() -> Callable[[], bool]:
    return _Hooks.shutdown_check or _default_shutdown


def is_shutdown() -> bool:
    """True if machines are to stop."""
    return get_shutdown_check()()


def set_loggers(info: Any, warn: Any, debug: Any, error: Any) -> None:
    """Sets the log functions."""
    _Hooks.loggers.update(info=info, warn=warn, debug=debug, error=error)


def _log(level: str, msg: object) -> None:
    own = _Hooks.loggers.get(level)
    if own is not None:
        own(msg)
        return
    rospy = sys.modules.get("rospy")
    name = {"info": "loginfo", "warn": "logwarn", "debug": "logdebug", "error": "logerr"}[level]
    if rospy is not None:
        getattr(rospy, name)("%s", msg)
    elif level != "debug":
        print(f"[ {level.upper()} ] : {msg}")


def loginfo(msg: object) -> None:
    _log("info", msg)


def logwarn(msg: object) -> None:
    _log("warn", msg)


def logdebug(msg: object) -> None:
    _log("debug", msg)


def logerr(msg: object) -> None:
    _log("error", msg)
