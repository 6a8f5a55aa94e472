"""Loops that wait for a variable of another thread end in lockstep, in the program and in its modules."""

from pathlib import Path

import pytest
from test_lockstep import run

PROGRAM = """
import threading, time
found = []
threading.Timer(0.5, found.append, (1,)).start()
{}
print(time.time())
"""


@pytest.mark.parametrize(
    "loop",
    [
        "while len(found) < 1:\n    pass",
        "while not found: continue",
        "while True:\n    if found:\n        found.clear()\n        break",
        "import waiter; waiter.Waiter(found).wait()",
    ],
)
def test_a_loop_that_waits_for_a_variable_ends(tmp_path: Path, loop: str) -> None:
    (tmp_path / "waiter.py").write_text(
        "class Waiter:\n    def __init__(self, found):\n        self.found = found\n"
        "    def wait(self):\n        while not self.found:\n            pass\n"
    )
    out, _ = run(tmp_path, PROGRAM.format(loop))
    assert 0.5 <= float(out) < 0.51
    assert not list(tmp_path.glob("__pycache__/waiter*")), "live runs would read it"


def test_a_loop_that_computes_costs_no_simulated_time(tmp_path: Path) -> None:
    out, _ = run(tmp_path, "import time\nleft = 100000\nwhile left:\n    left -= 1\nprint(time.time())")
    assert float(out) == 0.0
