"""Runs small scripts with an expected outcome (`../shared/python/rclpy_cases`): with Periplus, in lockstep, with real rclpy."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ros_programs import environment, own_domain

FOLDER = Path(os.environ.get("PERIPLUS_RCLPY_CASES") or Path(__file__).parents[4] / "shared" / "python" / "rclpy_cases")
_WORKERS = 4
#: Factor on the time limit of a case: the tests share the machine.
_PATIENCE = 3


@dataclass(frozen=True)
class Outcome:
    """What a program did."""

    exit_code: int | None
    out: str
    err: str

    def differences(self, expect: dict[str, Any]) -> list[str]:
        """Differences from what the case expects."""
        found = []
        if self.exit_code != expect.get("exit", 0):
            found.append(f"exit code {self.exit_code}, not {expect.get('exit', 0)}")
        if "stdout" in expect and self.out.rstrip("\n").splitlines() != expect["stdout"]:
            found.append("stdout:\n  " + "\n  ".join(self.out.splitlines()) + "\nexpected:\n  " + "\n  ".join(expect["stdout"]))
        for stream, text in (("stdout", self.out), ("stderr", self.err)):
            found += [f"{stream} lacks /{one}/" for one in expect.get(f"{stream}_regex", []) if not re.search(one, text, re.M)]
            found += [f"{stream} lacks {one!r}" for one in expect.get(f"{stream}_has", []) if one not in text]
        if found:
            found.append("stderr:\n  " + "\n  ".join(self.err.splitlines()[-25:]))
        return found


def load() -> list[dict[str, Any]]:
    """All cases, sorted by name; none without the folder."""
    return [json.loads(path.read_text()) for path in sorted(FOLDER.glob("*.json"))]


class Runner:
    """Runs cases, several at once, and keeps their outcomes."""

    def __init__(self, cases: list[dict[str, Any]], mode: str) -> None:
        self.mode = mode
        self._pool = ThreadPoolExecutor(_WORKERS)
        self._outcomes: dict[str, Future[Outcome]] = {case["id"]: self._pool.submit(self.run, case) for case in cases}

    def outcome(self, case: dict[str, Any]) -> Outcome:
        """The outcome of a case; waits for it."""
        return self._outcomes[case["id"]].result()

    def close(self) -> None:
        """Ends the runs that have not begun."""
        self._pool.shutdown(cancel_futures=True)

    def run(self, case: dict[str, Any]) -> Outcome:
        """Runs one case; one that hangs with real rclpy is run once more, as a signal can come just before its wait begins."""
        outcome = self._run_once(case)
        return self._run_once(case) if self.mode == "real" and outcome.exit_code is None else outcome

    def _run_once(self, case: dict[str, Any]) -> Outcome:
        """Runs one case in an empty folder."""
        with own_domain() as domain, tempfile.TemporaryDirectory(prefix="rclpy-case-") as folder:
            script = Path(folder, "script.py")
            script.write_text("\n".join(case["script"]) + "\n")
            for name, text in case.get("files", {}).items():
                Path(folder, name).write_text(text if isinstance(text, str) else "\n".join(text))
            command = [*self._command(), script.name, *case.get("args", [])]
            try:
                done = subprocess.run(
                    command, cwd=folder, env=self._environment(folder, {**domain, **case.get("env", {})}),
                    stdin=subprocess.DEVNULL, capture_output=True, text=True,
                    timeout=case.get("timeout_s", 20) * _PATIENCE, check=False,
                )  # fmt: skip
            except subprocess.TimeoutExpired as error:
                return Outcome(None, _text(error.stdout), _text(error.stderr))
            return Outcome(done.returncode, done.stdout, done.stderr)

    def _command(self) -> list[str]:
        if self.mode == "real":
            return [os.environ["PERIPLUS_REAL_RCLPY"]]
        if self.mode == "lockstep":
            return [sys.executable, str(Path(__file__).with_name("lone_simulation.py"))]
        return [sys.executable, "-m", "periplus.ros.run"]

    def _environment(self, folder: str, variables: dict[str, str]) -> dict[str, str]:
        made = environment(**variables)
        if self.mode == "real":
            # The interpreter with real rclpy must not see the package under test.
            made.pop("PYTHONPATH", None)
            made.update(ROS_LOG_DIR=folder, RMW_IMPLEMENTATION="rmw_fastrtps_cpp")
        return made


def _text(data: bytes | str | None) -> str:
    return data.decode(errors="replace") if isinstance(data, bytes) else data or ""
