"""Log functions: console and /rosout."""

from __future__ import annotations

import hashlib
import os
import sys
from typing import Any

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16
_NAMES = {DEBUG: "DEBUG", INFO: "INFO", WARN: "WARN", ERROR: "ERROR", FATAL: "FATAL"}
_COLOURS = {DEBUG: "\033[32m", WARN: "\033[33m", ERROR: "\033[31m", FATAL: "\033[31m"}
_ROS2_LEVELS = {DEBUG: 10, INFO: 20, WARN: 30, ERROR: 40, FATAL: 50}
_FORMAT = "[${severity}] [${time}]: ${message}"


class _Log:
    """Level and publisher of the log."""

    def __init__(self) -> None:
        self.level = INFO
        self.levels: dict[str, int] = {}
        self.publisher: Any = None
        self.message_class: Any = None
        self.last: dict[Any, Any] = {}


log = _Log()


def set_level(level: int, logger: str = "") -> None:
    """Sets the lowest level that is written."""
    if logger in ("", "rosout"):
        log.level = level
    else:
        log.levels[logger] = level


def _text(msg: object, args: tuple[Any, ...]) -> str:
    text = str(msg)
    if args:
        text = text % (args[0] if len(args) == 1 and isinstance(args[0], dict) and args[0] else args)
    return text


def _write(level: int, msg: object, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    logger = kwargs.pop("logger_name", None)
    kwargs.pop("exc_info", None)
    if level < log.levels.get(logger or "", log.level):
        return
    text = _text(msg, args)
    frame = sys._getframe(2)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    _console(level, text, frame, logger)
    _publish(level, text, frame)


def _console(level: int, text: str, frame: Any, logger: str | None) -> None:
    stream = sys.stdout if level < WARN else sys.stderr
    if stream is None:
        return
    format_text = os.environ.get("ROSCONSOLE_FORMAT", _FORMAT)
    line = format_text.replace("${severity}", _NAMES[level]).replace("${time}", _stamp())
    if "${" in line.replace("${message}", ""):
        line = _rare_parts(line, frame, logger)
    line = line.replace("${message}", text)
    colour = _COLOURS.get(level)
    if colour is not None and stream.isatty():
        line = f"{colour}{line}\033[0m"
    try:
        stream.write(line + "\n")
        stream.flush()
    except (OSError, ValueError):
        pass


def _stamp() -> str:
    import time

    from rospy import rostime

    wall = f"{time.time():.6f}"
    if rostime.is_simulated():
        return f"{wall}, {rostime.now_ns() / 1e9:.6f}"
    return wall


def _rare_parts(line: str, frame: Any, logger: str | None) -> str:
    import threading
    import time

    from rospy import rostime
    from rospy.names import get_name

    simulated = rostime.now_ns() / 1e9 if rostime.is_rostime_initialized() else time.time()
    for key, value in (
        ("walltime", f"{time.time():.6f}"),
        ("time:", ""),
        ("node", get_name()),
        ("file", frame.f_code.co_filename),
        ("line", frame.f_lineno),
        ("function", frame.f_code.co_name),
        ("thread", threading.current_thread().name),
        ("logger", logger or "rosout"),
        ("rostime", f"{simulated:.6f}"),
    ):
        line = line.replace("${" + key + "}", str(value))
    return line


def _publish(level: int, text: str, frame: Any) -> None:
    if log.publisher is None:
        return
    from rospy import rostime
    from rospy.names import get_name

    message = log.message_class()
    now = rostime.now_ns()
    message.stamp.secs, message.stamp.nsecs = divmod(now, 10**9)
    message.level = _ROS2_LEVELS[level]
    message.name = get_name().strip("/").replace("/", ".")
    message.msg = text
    message.file = frame.f_code.co_filename
    message.function = frame.f_code.co_name
    message.line = frame.f_lineno
    try:
        log.publisher.publish(message)
    except Exception as error:
        log.publisher = None
        sys.stderr.write(f"/rosout is off: {error}\n")


def logdebug(msg: object, *args: Any, **kwargs: Any) -> None:
    """Logs at level DEBUG (not shown by default)."""
    _write(DEBUG, msg, args, kwargs)


def loginfo(msg: object, *args: Any, **kwargs: Any) -> None:
    """Logs at level INFO, to stdout."""
    _write(INFO, msg, args, kwargs)


def logwarn(msg: object, *args: Any, **kwargs: Any) -> None:
    """Logs at level WARN, to stderr."""
    _write(WARN, msg, args, kwargs)


def logerr(msg: object, *args: Any, **kwargs: Any) -> None:
    """Logs at level ERROR, to stderr."""
    _write(ERROR, msg, args, kwargs)


def logfatal(msg: object, *args: Any, **kwargs: Any) -> None:
    """Logs at level FATAL, to stderr."""
    _write(FATAL, msg, args, kwargs)


logout = loginfo
logerror = logerr


def _caller() -> tuple[str, int]:
    frame = sys._getframe(2)
    return frame.f_code.co_filename, frame.f_lineno


def _due(key: Any, period: float) -> bool:
    """True if the period has passed since the last True for this key, or time went back."""
    from rospy import rostime

    now = rostime.now_ns()
    last = log.last.get(key)
    if last is not None and 0 <= now - last < period * 1e9:
        return False
    log.last[key] = now
    return True


def _throttle(level: int) -> Any:
    def function(period: float, msg: object, *args: Any, **kwargs: Any) -> None:
        if _due((level, *_caller()), period):
            _write(level, msg, args, kwargs)

    function.__doc__ = f"Logs at level {_NAMES[level]}, at most once in `period` seconds for each line of the program."
    return function


def _throttle_identical(level: int) -> Any:
    def function(period: float, msg: object, *args: Any, **kwargs: Any) -> None:
        text = hashlib.sha1(_text(msg, args).encode()).hexdigest()
        key = (level, "identical", *_caller())
        if log.last.get((key, "text")) != text:
            log.last.pop(key, None)
            log.last[(key, "text")] = text
        if _due(key, period):
            _write(level, msg, args, kwargs)

    function.__doc__ = f"Logs at level {_NAMES[level]}; an equal text of the same line at most once in `period` seconds."
    return function


def _once(level: int) -> Any:
    def function(msg: object, *args: Any, **kwargs: Any) -> None:
        key = (level, "once", *_caller())
        if key not in log.last:
            log.last[key] = 0
            _write(level, msg, args, kwargs)

    function.__doc__ = f"Logs at level {_NAMES[level]}, once for each line of the program."
    return function


logdebug_throttle, loginfo_throttle, logwarn_throttle = _throttle(DEBUG), _throttle(INFO), _throttle(WARN)
logerr_throttle, logfatal_throttle = _throttle(ERROR), _throttle(FATAL)
logdebug_throttle_identical, loginfo_throttle_identical = _throttle_identical(DEBUG), _throttle_identical(INFO)
logwarn_throttle_identical, logerr_throttle_identical = _throttle_identical(WARN), _throttle_identical(ERROR)
logfatal_throttle_identical = _throttle_identical(FATAL)
logdebug_once, loginfo_once, logwarn_once, logerr_once, logfatal_once = (
    _once(DEBUG),
    _once(INFO),
    _once(WARN),
    _once(ERROR),
    _once(FATAL),
)
