"""Console, file and topic of log messages."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING, Any

from rclpy._clock_source import source
from rclpy._log_settings import NAMES, outputs

if TYPE_CHECKING:
    from collections.abc import Callable

_DEFAULT_FORMAT = "[{severity}] [{time}] [{name}]: {message}"
_COLORS = {10: "\x1b[32m", 20: "\x1b[0m", 30: "\x1b[33m", 40: "\x1b[31m", 50: "\x1b[31m"}

# Publishers of /rosout by the name of the logger: functions of (nanoseconds, severity, name, text, file, function, line).
rosout: dict[str, Callable[..., None]] = {}


def _date_time(nanoseconds: int) -> str:
    import time

    date = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(nanoseconds // 10**9))
    return f"{date}.{nanoseconds // 10**6 % 1000:03d}"


_FIELDS: dict[str, Callable[..., str]] = {
    "severity": lambda ns, severity, name, text, file, function, line: NAMES[severity],
    "name": lambda ns, severity, name, text, file, function, line: name,
    "message": lambda ns, severity, name, text, file, function, line: text,
    "file_name": lambda ns, severity, name, text, file, function, line: file,
    "function_name": lambda ns, severity, name, text, file, function, line: function,
    "line_number": lambda ns, severity, name, text, file, function, line: str(line),
    "time": lambda ns, severity, name, text, file, function, line: f"{ns // 10**9}.{ns % 10**9:09d}",
    "time_as_nanoseconds": lambda ns, severity, name, text, file, function, line: str(ns),
    "date_time_with_ms": lambda ns, severity, name, text, file, function, line: _date_time(ns),
}


def _parse(form: str) -> list[str | Callable[..., str]]:
    """The parts of RCUTILS_CONSOLE_OUTPUT_FORMAT: texts, and functions for the fields."""
    import re

    parts: list[str | Callable[..., str]] = []
    for part in re.split(r"(\{\w+\})", form.replace("\\n", "\n").replace("\\t", "\t")):
        field = _FIELDS.get(part[1:-1]) if part.startswith("{") else None
        if field is not None:
            parts.append(field)
        elif part:
            parts.append(part)
    return parts


class _Console:
    """The stream of messages, set up by the RCUTILS_* variables at the first message."""

    def __init__(self) -> None:
        self._ready = False
        self._stream = 2
        self._colors = False
        self._parts: list[str | Callable[..., str]] | None = None

    def _set_up(self) -> None:
        self._ready = True
        self._stream = 1 if os.environ.get("RCUTILS_LOGGING_USE_STDOUT") == "1" else 2
        color = os.environ.get("RCUTILS_COLORIZED_OUTPUT", "")
        try:
            self._colors = color == "1" if color in ("0", "1") else os.isatty(self._stream)
        except OSError:
            self._colors = False
        form = os.environ.get("RCUTILS_CONSOLE_OUTPUT_FORMAT", "")
        if form and form != _DEFAULT_FORMAT:
            self._parts = _parse(form)

    def write(self, severity: int, plain: str, values: tuple[Any, ...]) -> None:
        if not self._ready:
            self._set_up()
        text = plain
        if self._parts is not None:
            text = "".join(part if isinstance(part, str) else part(*values) for part in self._parts)
        if self._colors:
            text = f"{_COLORS.get(severity, '')}{text}\x1b[0m"
        _flush_before(self._stream)
        data = (text + "\n").encode(errors="replace")
        try:
            while data:
                data = data[os.write(self._stream, data) :]
        except OSError:
            pass


def _flush_before(stream: int) -> None:
    """Keeps the order of messages and of what the program prints itself."""
    python = sys.stdout if stream == 1 else sys.stderr
    try:
        if python is not None:
            python.flush()
    except (OSError, ValueError):
        pass


class _File:
    """The log file of the process, opened at the first message."""

    def __init__(self) -> None:
        self._file: Any = None
        self._failed = False

    def write(self, plain: str) -> None:
        if self._file is None:
            if self._failed:
                return
            self._failed = True
            try:
                self._file = self._open()
            except OSError:
                return
        try:
            self._file.write(plain + "\n")
            self._file.flush()
        except (OSError, ValueError):
            self._file = None

    @staticmethod
    def _open() -> Any:
        import atexit
        import time

        folder = logging_directory()
        os.makedirs(folder, exist_ok=True)
        prefix = outputs.file_prefix or os.path.basename(sys.executable) or "python3"
        name = f"{prefix}_{os.getpid()}_{time.time_ns() // 10**6}.log"
        file = open(os.path.join(folder, name), "a", encoding="utf-8", errors="replace")  # noqa: SIM115
        atexit.register(file.close)
        return file


def logging_directory() -> str:
    """Folder of log files: ROS_LOG_DIR, or `log` in ROS_HOME, or `~/.ros/log`."""
    folder = os.environ.get("ROS_LOG_DIR", "")
    if not folder:
        home = os.environ.get("ROS_HOME", "") or os.path.join(os.path.expanduser("~"), ".ros")
        folder = os.path.join(home, "log")
    return os.path.abspath(os.path.expanduser(folder))


_console = _Console()
_file = _File()


def write(severity: int, name: str, text: str, file: str, function: str, line: int) -> None:
    """Writes one message to all outputs."""
    nanoseconds = source.system_ns()
    plain = f"[{NAMES[severity]}] [{nanoseconds // 10**9}.{nanoseconds % 10**9:09d}] [{name}]: {text}"
    if outputs.console:
        _console.write(severity, plain, (nanoseconds, severity, name, text, file, function, line))
    if outputs.file:
        _file.write(plain)
    if rosout:
        publish = rosout.get(name)
        if publish is not None:
            publish(nanoseconds, severity, name, text, file, function, line)


def report(severity: int, name: str, text: str) -> None:
    """Logs a message of the modules themselves."""
    from rclpy._log_settings import levels

    if severity >= levels.effective(name):
        write(severity, name, text, "", "", 0)
