"""The command in the package."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest


def run(*words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "periplus", *words]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def test_the_version_is_that_of_the_package() -> None:
    import periplus

    result = run("--version")
    assert (result.returncode, result.stdout) == (0, f"periplus {periplus.__version__}\n")


@pytest.mark.parametrize(
    ("words", "code"), [(("--help",), 0), (("--bad",), 2), (("sim", "none.sdf"), 1)]
)
def test_exit_codes(words: tuple[str, ...], code: int) -> None:
    result = run(*words)
    assert result.returncode == code
    assert (result.stderr if code else result.stdout) != ""


def test_the_demo_writes_equal_bytes_each_time(tmp_path: Path) -> None:
    for name in ("one", "other"):
        out = str(tmp_path / name)
        result = run("demo", "--headless", "--duration", "3", "--out", out)
        assert result.returncode == 0, result.stderr
    one, other = (tmp_path / name / "demo.mcap" for name in ("one", "other"))
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 0), (signal.SIGTERM, 143)])
def test_signals_end_a_run_in_good_order(
    tmp_path: Path, number: signal.Signals, code: int
) -> None:
    out = tmp_path / "out"
    words = ["demo", "--no-browser", "--page=0", "--out", str(out)]
    process = subprocess.Popen(
        [sys.executable, "-m", "periplus", *words], stderr=subprocess.PIPE, text=True
    )
    assert process.stderr is not None
    # The page is announced once the run can be ended.
    assert "http" in process.stderr.readline()
    time.sleep(1.0)
    os.kill(process.pid, number)
    _, rest = process.communicate(timeout=60)
    assert process.returncode == code, rest
    assert "Traceback" not in rest
    assert (out / "demo.mcap").stat().st_size > 0


def test_the_programs_of_a_launch_file_start_this_package(tmp_path: Path) -> None:
    file = tmp_path / "hello.launch.xml"
    file.write_text('<launch><executable cmd="xacro --help" name="help" output="screen"/></launch>')
    result = run("launch", str(file), "--duration", "1")
    assert "Traceback" not in result.stderr
    assert "xacro" in result.stdout + result.stderr
