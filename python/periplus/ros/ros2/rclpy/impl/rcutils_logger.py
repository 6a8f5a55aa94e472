"""Loggers."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from rclpy import _log_output
from rclpy._log_settings import levels
from rclpy.impl.logging_severity import LoggingSeverity

if TYPE_CHECKING:
    from types import FrameType

_OPTIONS = ["throttle_duration_sec", "throttle_time_source_type", "skip_first", "once"]
_getframe = sys._getframe


class _CallSite:
    """State of a logger for one call in the program: severity and filters must stay the same."""

    __slots__ = ("code", "severity", "filters", "given", "throttle_ns", "clock", "last_ns", "was_skipped", "was_logged")

    def __init__(self, code: Any, severity: int, options: dict[str, Any]) -> None:
        self.code = code  # keeps the code object, and so its id, alive
        self.severity = severity
        self.filters = _filters(options)
        self.given = options
        self.throttle_ns: int | None = None
        self.clock: Any = None
        self.last_ns: int | None = None
        self.was_skipped = self.was_logged = False
        if "throttle" in self.filters:
            self._set_throttle(options)

    def _set_throttle(self, options: dict[str, Any]) -> None:
        from rclpy.clock import Clock

        self.throttle_ns = int(options["throttle_duration_sec"] * 1e9)
        self.clock = options.get("throttle_time_source_type")
        if self.clock is None:
            self.clock = Clock()
        elif not isinstance(self.clock, Clock):
            raise ValueError(f'Received throttle_time_source_type of "{self.clock}" is not a clock instance')

    def check(self, severity: int, options: dict[str, Any]) -> None:
        """Refuses other arguments than those of the first call."""
        if severity != self.severity:
            raise ValueError("Logger severity cannot be changed between calls.")
        if options == self.given:
            return
        if _filters(options) != self.filters:
            raise ValueError("Requested logging filters cannot be changed between calls.")
        if options.get("throttle_duration_sec") != self.given.get("throttle_duration_sec"):
            raise ValueError("Logging filter parameters cannot be changed between calls.")

    def passes(self) -> bool:
        """Outcome of the filters for one message, in the order throttle, skip_first, once."""
        if self.throttle_ns is not None:
            now_ns = self.clock._now_ns()
            if self.last_ns is not None and 0 <= now_ns - self.last_ns < self.throttle_ns:
                return False
            self.last_ns = now_ns
        if "skip_first" in self.filters and not self.was_skipped:
            self.was_skipped = True
            return False
        if "once" in self.filters:
            if self.was_logged:
                return False
            self.was_logged = True
        return True


def _filters(options: dict[str, Any]) -> list[str]:
    """Filters that the options ask for."""
    found = []
    for name in options:
        if name not in _OPTIONS:
            raise TypeError(f'parameter "{name}" is not one of the recognized logging options "{_OPTIONS}"')
    if options.get("throttle_duration_sec") is not None:
        found.append("throttle")
    elif options.get("throttle_time_source_type") is not None:
        raise TypeError(
            'required parameter "throttle_duration_sec" not specified but is required for the the logging filter "throttle"'
        )
    if options.get("skip_first"):
        found.append("skip_first")
    if options.get("once"):
        found.append("once")
    return found


class RcutilsLogger:
    """Writes messages to the console, the log file and, for loggers of nodes, the topic `/rosout`."""

    def __init__(self, name: str = "") -> None:
        self.name = name
        self._call_sites: dict[tuple[int, int], _CallSite] = {}
        self._revision = -1
        self._level = 0

    def get_child(self, name: str) -> RcutilsLogger:
        """Logger whose name is this name, a dot and `name`, and whose level is this one's unless it is set."""
        if not name:
            raise ValueError("Child logger name must not be empty.")
        child = RcutilsLogger(f"{self.name}.{name}" if self.name else name)
        publish = _log_output.rosout.get(self.name)
        if publish is not None:
            _log_output.rosout.setdefault(child.name, publish)
        return child

    def set_level(self, level: int | LoggingSeverity) -> None:
        """Sets the level: messages below it are dropped. UNSET takes that of the parent."""
        levels.set(self.name, LoggingSeverity(level))

    def get_effective_level(self) -> LoggingSeverity:
        """Level of the logger or of its nearest ancestor with one."""
        return LoggingSeverity(levels.effective(self.name))

    def is_enabled_for(self, severity: int | LoggingSeverity) -> bool:
        """True if messages of a severity are not dropped."""
        return LoggingSeverity(severity) >= levels.effective(self.name)

    def _log(self, severity: int, message: Any, options: dict[str, Any], frame: FrameType) -> bool:
        if self._revision != levels.revision:
            self._revision = levels.revision
            self._level = levels.effective(self.name)
        if severity < self._level:
            return False
        code = frame.f_code
        key = (id(code), frame.f_lasti)
        site = self._call_sites.get(key)
        if site is None:
            if options.pop("name", self.name) != self.name:
                raise ValueError("Logger name cannot be changed between calls.")
            site = self._call_sites[key] = _CallSite(code, severity, options)
        elif severity != site.severity or options != site.given:
            if options.pop("name", self.name) != self.name:
                raise ValueError("Logger name cannot be changed between calls.")
            site.check(severity, options)
        if site.filters and not site.passes():
            return False
        if message is None:
            message = "(null)"
        elif not isinstance(message, str):
            if not isinstance(message, bytes):
                raise TypeError(
                    f"{code.co_filename}:{frame.f_lineno}: the message of a logger must be a str, not "
                    f"{type(message).__name__}; write str(...) or an f-string"
                )
            message = message.decode(errors="replace")
        _log_output.write(severity, self.name, message, code.co_filename, code.co_name, frame.f_lineno)
        return True

    def log(self, message: str, severity: int | LoggingSeverity, **kwargs: Any) -> bool:
        """Logs a message. Returns False if it is dropped.

        Keywords, which count for each call in the program by itself: `once`, `skip_first`, `throttle_duration_sec` with
        `throttle_time_source_type` (a clock).
        """
        return self._log(LoggingSeverity(severity), message, kwargs, _getframe(1))

    def debug(self, message: str, **kwargs: Any) -> bool:
        """Logs a message with severity DEBUG. See `log`."""
        return self._log(10, message, kwargs, _getframe(1))

    def info(self, message: str, **kwargs: Any) -> bool:
        """Logs a message with severity INFO. See `log`."""
        return self._log(20, message, kwargs, _getframe(1))

    def warning(self, message: str, **kwargs: Any) -> bool:
        """Logs a message with severity WARN. See `log`."""
        return self._log(30, message, kwargs, _getframe(1))

    warn = warning

    def error(self, message: str, **kwargs: Any) -> bool:
        """Logs a message with severity ERROR. See `log`."""
        return self._log(40, message, kwargs, _getframe(1))

    def fatal(self, message: str, **kwargs: Any) -> bool:
        """Logs a message with severity FATAL. See `log`."""
        return self._log(50, message, kwargs, _getframe(1))
