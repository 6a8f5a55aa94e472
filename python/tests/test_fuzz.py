"""A short run of the fuzzer of the whole package: no abort, no hang, no panic."""

import subprocess
import sys
from pathlib import Path

TOOL = Path(__file__).parents[1] / "tools" / "fuzz_api.py"


def test_random_calls_never_abort() -> None:
    command = [sys.executable, "-W", "ignore", str(TOOL), "--seconds", "15", "--seed", "4"]
    result = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert result.returncode == 0, result.stderr[-3000:]
    assert "calls of" in result.stdout
