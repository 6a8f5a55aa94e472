"""Runs every example; each checks its own results."""

import runpy
from pathlib import Path

import pytest

EXAMPLES = sorted(Path(__file__).parent.glob("[0-9]*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=[path.stem for path in EXAMPLES])
def test_example(path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    runpy.run_path(str(path), run_name="__main__")
