"""Assertions about the output and the ends of processes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

from launch_testing._records import (
    IoHandler,
    NoMatchingProcessException as NoMatchingProcessException,
    ProcInfoHandler,
    has,
)

EXIT_OK, EXIT_SIGINT, EXIT_SIGQUIT, EXIT_SIGKILL, EXIT_SIGSEGV = 0, 130, 131, 137, 139


def assertExitCodes(  # noqa: N802
    proc_info: ProcInfoHandler, allowable_exit_codes: Sequence[int] = (EXIT_OK,), process: Any = None, cmd_args: Any = None
) -> None:
    """All processes, or one, ended with one of these exit codes."""
    ends = list(proc_info) if process is None else [proc_info[process]]
    bad = [end for end in ends if end.returncode not in allowable_exit_codes]
    if bad:
        raise AssertionError(f"expected an exit code of {list(allowable_exit_codes)}; {', '.join(map(repr, bad))}")


def assertInStdout(  # noqa: N802
    proc_output: IoHandler, expected_output: Any, process: Any, cmd_args: Any = None, *, output_filter: Any = None,
    strict_proc_matching: bool = True, strip_ansi_escape_sequences: bool = True,
) -> None:  # fmt: skip
    """The output of a process has a text, several in this order, or a match of a pattern."""
    text = proc_output.text(process)
    if not has(text if output_filter is None else output_filter(text), expected_output):
        raise AssertionError(f"{expected_output!r} is not in the output of {process!r}:\n{text}")


assertInStderr = assertInStdout  # noqa: N816
assertInStream = assertInStdout  # noqa: N816


class SequentialTextChecker:
    """Texts that follow each other in an output."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._position = 0

    def assertInStdout(self, expected: Any) -> None:  # noqa: N802
        """The rest of the output has a text or a match of a pattern."""
        if isinstance(expected, str):
            found = self._text.find(expected, self._position)
            end = found + len(expected)
        else:
            match = expected.search(self._text, self._position)
            found, end = (-1, 0) if match is None else (match.start(), match.end())
        if found < 0:
            raise AssertionError(f"{expected!r} does not follow in:\n{self._text[self._position :]}")
        self._position = end


@contextmanager
def assertSequentialStdout(proc_output: IoHandler, process: Any, cmd_args: Any = None) -> Iterator[SequentialTextChecker]:  # noqa: N802
    """Checks texts in their order."""
    yield SequentialTextChecker(proc_output.text(process))
