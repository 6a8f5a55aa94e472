"""The program on the front page of the Python documentation runs as it is printed."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "python.md"


def test_the_ten_lines_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    monkeypatch.chdir(tmp_path)
    program = re.search(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.S)
    assert program is not None
    exec(compile(program.group(1), str(PAGE), "exec"), {})
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")


def test_the_readme_shows_the_same_program() -> None:
    readme = PAGE.parents[1] / "python" / "README.md"
    blocks = [
        re.search(r"```python\n(.*?)```", path.read_text(encoding="utf-8"), re.S)
        for path in (PAGE, readme)
    ]
    assert blocks[0] is not None and blocks[1] is not None
    assert blocks[0].group(1) == blocks[1].group(1)
