"""Functions about loggers."""

from __future__ import annotations

from pathlib import Path

from rclpy import _log_output, _log_settings
from rclpy.impl.logging_severity import LoggingSeverity
from rclpy.impl.rcutils_logger import RcutilsLogger

__all__ = [
    "LoggingSeverity",
    "RcutilsLogger",
    "clear_config",
    "get_logger",
    "get_logger_effective_level",
    "get_logger_level",
    "get_logging_directory",
    "get_logging_severity_from_string",
    "initialize",
    "set_logger_level",
    "shutdown",
]

_root_logger = RcutilsLogger()


def get_logger(name: str) -> RcutilsLogger:
    """Logger with a name."""
    if not name:
        raise ValueError("Logger name must not be empty.")
    return _root_logger.get_child(name)


def initialize() -> None:
    """Does nothing: logging needs no preparation."""


def shutdown() -> None:
    """Does nothing: each message is written at once."""


def clear_config() -> None:
    """Forgets the levels of all loggers."""
    _log_settings.levels.clear()


def set_logger_level(name: str, level: int | LoggingSeverity, detailed_error: bool = False) -> None:
    """Sets the level of a logger."""
    _log_settings.levels.set(name, LoggingSeverity(level))


def get_logger_effective_level(name: str) -> LoggingSeverity:
    """Level of a logger or of its nearest ancestor with one."""
    return LoggingSeverity(_log_settings.levels.effective(name))


def get_logger_level(name: str) -> LoggingSeverity:
    """Level that was set for a logger, or UNSET."""
    return LoggingSeverity(_log_settings.levels.given(name))


def get_logging_severity_from_string(log_severity: str) -> LoggingSeverity:
    """Severity with a name. Raises `RuntimeError` for an unknown name."""
    number = _log_settings.SEVERITIES.get(log_severity.upper())
    if number is None:
        raise RuntimeError(f"Failed to get severity name: there is no severity {log_severity!r}")
    return LoggingSeverity(number)


def get_logging_directory() -> Path:
    """Folder of log files."""
    return Path(_log_output.logging_directory())
