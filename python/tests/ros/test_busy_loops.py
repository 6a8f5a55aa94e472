"""Loops that wait for a variable of another thread end in lockstep, in the program and in its modules."""

import ast
from pathlib import Path

import pytest
from periplus.ros._loop_kinds import loop_kind
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
        "count = 0\nwhile not found:\n    count += 1\n    print(end='')",
        "count = 0\nwhile True:\n    if found:\n        break\n    count += 1",
        "def look():\n    return not found\nwhile look():\n    pass",
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


def test_a_loop_that_may_wait_costs_little_simulated_time(tmp_path: Path) -> None:
    out, _ = run(tmp_path, "import time\nleft = [1] * 120000\ndef work():\n    left.pop()\n    return left\nwhile work():\n    x = 1\nprint(time.time())")
    assert 0.0 < float(out) < 0.004


@pytest.mark.parametrize(
    ("kind", "source"),
    [
        ("waits", "while not done: pass"),
        ("waits", "while not node.scan:\n    print('waiting')\n    count += 1"),
        ("waits", "while True:\n    if self.stopped: return\n    total = total + 1"),
        ("waits", "while self.pose is None:\n    self.get_logger().info('no pose')"),
        ("works", "while left:\n    left -= 1"),
        ("works", "while queue:\n    item = queue.pop()"),
        ("works", "while open_cells:\n    best = heapq.heappop(open_cells)"),
        ("works", "while self.row < 3:\n    self.row += 1"),
        ("works", "while grid[x] == 0:\n    grid[x] = 1"),
        ("works", "while a[i] != key:\n    i = (i + 1) % n"),
        ("works", "while True:\n    line = file.readline()\n    if not line: break"),
        ("works", "while True:\n    item = yield"),
        ("unknown", "while not self.done:\n    self.step()"),
        ("unknown", "while True:\n    step()"),
        ("unknown", "while cells:\n    expand()"),
    ],
)
def test_kinds_of_loops(kind: str, source: str) -> None:
    (loop,) = ast.parse(source).body
    assert isinstance(loop, ast.While)
    assert loop_kind(loop).value == kind
