"""What keeps two runs in lockstep from being the same, named once each."""

from __future__ import annotations

import json
import os
import sys
from typing import TYPE_CHECKING, Any

from . import _tracebacks

if TYPE_CHECKING:
    from types import FrameType

#: Environment variable with the file that receives the findings as JSON at the end of the process.
FILE_VARIABLE = "PERIPLUS_LOCKSTEP_REPORT"
#: Kinds of findings that change results from run to run. The others only explain.
_HARMFUL = {
    "socket": "talks over a socket, which knows nothing of simulated time",
    "process": "starts a process, which is not in step with the simulation",
    "thread": "runs code in a thread that Python has not started",
    "entropy": "reads random numbers of the machine",
    "input": "reads the keyboard",
    "hash seed": "PYTHONHASHSEED is not set: the order of sets of strings differs from run to run",
    "signal": "sets a timer of the machine (signal.alarm or setitimer)",
}
_EXEC_EVENTS = ("os.system", "os.fork", "os.forkpty", "os.posix_spawn", "os.exec", "os.spawn", "os.startfile", "pty.spawn")


class Report:
    """The findings of a process."""

    def __init__(self) -> None:
        self.findings: dict[tuple[str, str], dict[str, str]] = {}
        self.is_quiet = False

    def note(self, kind: str, text: str, frame: FrameType | None = None) -> None:
        """Adds a finding at the user's line that is being executed; each line counts once for a kind."""
        user = _tracebacks.user_frame(frame if frame is not None else sys._getframe(1))
        where = _tracebacks.location(user)
        if (kind, where) not in self.findings:
            self.findings[(kind, where)] = {"kind": kind, "text": text, "where": where}
            if kind == "deadlock":
                self._print_deadlock()

    def harmful(self) -> list[dict[str, str]]:
        """The findings that make runs differ."""
        return [finding for finding in self.findings.values() if finding["kind"] in _HARMFUL]

    def _print_deadlock(self) -> None:
        lines = ["periplus: every thread of this program waits for another one:"]
        for ident, frame in sys._current_frames().items():
            if _tracebacks.user_frame(frame) is not None:
                lines.append(f"thread {ident}:\n{_tracebacks.format_stack(frame).rstrip()}")
        sys.stderr.write("\n".join(lines) + "\n")
        sys.stderr.flush()

    def audit(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Receives the events of `sys.addaudithook`; the names of most do not matter here."""
        if self.is_quiet:
            return
        if event == "open":
            path = arguments[0]
            if path in ("/dev/urandom", "/dev/random", "/dev/hwrng"):
                self.note("entropy", f"opens {path}", sys._getframe(1))
        elif event.startswith("socket."):
            self._audit_socket(event, arguments)
        elif event == "subprocess.Popen":
            self._note_user("process", f"starts {_short(arguments[1])}")
        elif event in _EXEC_EVENTS:
            self._note_user("process", f"{event}({_short(arguments[0]) if arguments else ''})")
        elif event == "builtins.input":
            self.note("input", "reads the keyboard by input()", sys._getframe(1))

    def _note_user(self, kind: str, text: str) -> None:
        """Adds a finding, unless Periplus or Python itself is the cause."""
        frame = sys._getframe(2)
        if _tracebacks.user_frame(frame) is not None:
            self.note(kind, text, frame)

    def _audit_socket(self, event: str, arguments: tuple[Any, ...]) -> None:
        if event in ("socket.connect", "socket.bind", "socket.sendto"):
            address = arguments[1]
            # Sockets of the file system stay within the machine, but other programs answer on them all the same.
            self._note_user("socket", f"{event}({_short(address)})")

    def print_summary(self) -> None:
        """Prints the findings on stderr and writes the file that the parent has asked for."""
        if os.environ.get("PYTHONHASHSEED", "random") == "random":
            self.findings[("hash seed", "")] = {"kind": "hash seed", "text": _HARMFUL["hash seed"], "where": ""}
        for finding in self.findings.values():
            kind = finding["kind"]
            where = f" at {finding['where']}" if finding["where"] not in ("", "?") else ""
            if kind in _HARMFUL:
                reason = "" if kind == "hash seed" else f": {_HARMFUL[kind]}"
                sys.stderr.write(f"periplus: runs may differ: {finding['text']}{where}{reason}\n")
            elif kind != "deadlock":
                sys.stderr.write(f"periplus: note: {finding['text']}{where}\n")
        sys.stderr.flush()
        path = os.environ.get(FILE_VARIABLE)
        if path:
            with open(path, "w", encoding="utf-8") as file:
                json.dump({"arguments": sys.argv, "findings": list(self.findings.values())}, file)


def _short(value: object) -> str:
    text = value if isinstance(value, str) else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
