"""Output and ends of the processes under test."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Callable
from typing import Any

from periplus.ros import _waiting

_LINE = re.compile(r"(?:(?:error|warning): )?\[([^\]]+)\] ?(.*)")
_START = re.compile(r"\+ .*?: (/?[\w/.\-]+): the ")
_END = re.compile(r"has ended: (exit status|signal): (\d+)")


class NoMatchingProcessException(Exception):
    """Process that is not in the launch."""


class ProcessEnd:
    """End of a process."""

    def __init__(self, process_name: str, returncode: int | None) -> None:
        self.process_name = process_name
        self.returncode = returncode

    def __repr__(self) -> str:
        return f"{self.process_name}: exit code {self.returncode}"


class Launch:
    """Output of a launch, by process."""

    def __init__(self) -> None:
        self.changed: threading.Condition = _waiting.Condition()
        self.lines: list[tuple[str, str]] = []
        self.processes: dict[str, int | None] = {}
        self.last_start_s = time.monotonic()
        self.has_ended = False

    def add(self, line: str) -> None:
        """Adds a line of the launch."""
        with self.changed:
            start = _START.match(line)
            match = _LINE.match(line)
            if start is not None:
                self.processes.setdefault(start.group(1).rsplit("/", 1)[-1], None)
                self.last_start_s = time.monotonic()
            elif match is not None:
                name, text = match.groups()
                end = _END.fullmatch(text)
                if end is None:
                    self.lines.append((name, text))
                    self.processes.setdefault(name, None)
                else:
                    code = int(end.group(2))
                    self.processes[name] = code if end.group(1) == "exit status" else -code
            self.changed.notify_all()

    def end(self) -> None:
        """Marks the end; processes that were running were stopped."""
        with self.changed:
            self.has_ended = True
            for name, code in self.processes.items():
                self.processes[name] = 0 if code is None else code
            self.changed.notify_all()

    def wait(self, is_true: Callable[[], bool], timeout_s: float | None) -> bool:
        """True once a condition holds, False after the timeout or the end of the launch."""
        end_s = None if timeout_s is None else time.monotonic() + timeout_s
        with self.changed:
            while not is_true():
                left_s = None if end_s is None else end_s - time.monotonic()
                if self.has_ended or (left_s is not None and left_s <= 0):
                    return False
                self.changed.wait(0.2 if left_s is None else min(left_s, 0.2))
        return True

    def names(self, process: Any) -> list[str]:
        """Names of the processes that an action or a name means; all for None."""
        if process is None:
            return list(self.processes)
        wanted = [process] if isinstance(process, str) else process.process_names()
        found = [
            name
            for name in self.processes
            if any(name == one or re.fullmatch(re.escape(name) + r"-\d+", one) or (isinstance(process, str) and one in name) for one in wanted)
        ]
        if not found:
            known = ", ".join(self.processes) or "none"
            raise NoMatchingProcessException(f"no process {wanted[0] if wanted else process!r} in the launch; it has: {known}")
        return found


class IoHandler:
    """Output of the processes."""

    def __init__(self, launch: Launch) -> None:
        self._launch = launch

    def text(self, process: Any = None) -> str:
        """Output so far."""
        with self._launch.changed:
            names = set(self._launch.names(process))
            return "".join(line + "\n" for name, line in self._launch.lines if name in names)

    def assertWaitFor(  # noqa: N802
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        output_filter: Any = None,
        timeout: float = 10.0,
        stream: str = "stdout",
        strict_proc_matching: bool = True,
    ) -> None:
        """Waits until the output has a text, several in this order, or a match of a pattern."""

        def is_there() -> bool:
            try:
                text = self.text(process)
            except NoMatchingProcessException:
                return False
            return has(text if output_filter is None else output_filter(text), expected_output)

        if not self._launch.wait(is_there, timeout):
            raise AssertionError(f"Waiting for output timed out after {timeout} s: {expected_output!r}\n{self._shown()}")

    def _shown(self) -> str:
        with self._launch.changed:
            lines = [f"  [{name}] {line}" for name, line in self._launch.lines[-20:]]
        return "the last lines were:\n" + "\n".join(lines) if lines else "there was no output"

    def __iter__(self) -> Any:
        return iter([f"[{name}] {line}" for name, line in self._launch.lines])

    def process_names(self) -> list[str]:
        """Names of the processes."""
        return self._launch.names(None)


class ProcInfoHandler:
    """Ends of the processes."""

    def __init__(self, launch: Launch) -> None:
        self._launch = launch

    def __iter__(self) -> Any:
        return iter([ProcessEnd(name, code) for name, code in self._launch.processes.items()])

    def __getitem__(self, process: Any) -> ProcessEnd:
        name = self._launch.names(process)[0]
        return ProcessEnd(name, self._launch.processes[name])

    def process_names(self) -> list[str]:
        """Names of the processes."""
        return self._launch.names(None)

    def assertWaitForStartup(self, process: Any, cmd_args: Any = None, *, timeout: float = 10.0) -> None:  # noqa: N802
        """Waits for the start of a process."""

        def is_there() -> bool:
            try:
                return bool(self._launch.names(process))
            except NoMatchingProcessException:
                return False

        if not self._launch.wait(is_there, timeout):
            raise AssertionError(f"Timed out waiting for process {process!r} to start")

    def assertWaitForShutdown(self, process: Any, cmd_args: Any = None, *, timeout: float = 10.0) -> None:  # noqa: N802
        """Waits for the end of a process."""

        def is_over() -> bool:
            return all(self._launch.processes[name] is not None for name in self._launch.names(process))

        if not self._launch.wait(is_over, timeout) and not is_over():
            raise AssertionError(f"Timed out waiting for process {process!r} to finish")


def has(text: str, expected: Any) -> bool:
    """True if a text has another text, several in this order, or a match of a pattern."""
    if isinstance(expected, str):
        return expected in text
    if hasattr(expected, "search"):
        return expected.search(text) is not None
    position = 0
    for one in expected:
        if isinstance(one, str):
            found = text.find(one, position)
            if found < 0:
                return False
            position = found + len(one)
        else:
            match = one.search(text, position)
            if match is None:
                return False
            position = match.end()
    return True
