"""The packages of `own_nodes` run from their source tree, each node with its documented effect: live, and in lockstep twice alike."""

import signal
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest
from ros_programs import environment, own_domain

FOLDER = Path(__file__).parent
NODES = {"guard": [], "wall": [], "beacon": ["1.5"], "follower": [], "lamp": [], "square": []}

def run_live(name: str, folder: Path) -> tuple[str, str]:
    """Runs a node and its check in two processes; returns what the check printed, and both outputs."""
    with own_domain() as domain:
        variables = environment(**domain, ROS_LOG_DIR=str(folder), PERIPLUS_PACKAGES=str(FOLDER / "own_nodes"))
        node = subprocess.Popen(
            [sys.executable, "-m", "periplus.ros.run", "trail_nodes", name, *NODES[name]],
            cwd=folder, env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        try:
            check = subprocess.run(
                [sys.executable, str(FOLDER / "own_node_checks.py"), name],
                cwd=folder, env=variables, capture_output=True, text=True, timeout=150, check=False,
            )  # fmt: skip
        finally:
            node.send_signal(signal.SIGINT)
            try:
                out = node.communicate(timeout=20)[0]
            except subprocess.TimeoutExpired:
                node.kill()
                out = node.communicate()[0] + "\nit did not end after Ctrl-C"
    return check.stdout.strip(), f"{check.stdout}{check.stderr}\n--- the node:\n{out}"


@pytest.fixture(scope="module")
def live_runs(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, "Future[tuple[str, str]]"]]:
    """The live runs of all nodes, several at once: most of their time is waiting."""
    with ThreadPoolExecutor(3) as pool:
        yield {name: pool.submit(run_live, name, tmp_path_factory.mktemp(name)) for name in NODES}


@pytest.mark.parametrize("name", NODES)
def test_live(name: str, live_runs: dict[str, "Future[tuple[str, str]]"]) -> None:
    answer, outputs = live_runs[name].result()
    assert answer == "ok", outputs
    assert "did not end" not in outputs


@pytest.mark.parametrize("name", NODES)
def test_in_lockstep(name: str, tmp_path: Path) -> None:
    variables = environment(PERIPLUS_PACKAGES=str(FOLDER / "own_nodes"))
    command = [sys.executable, str(FOLDER / "lone_simulation.py"), str(FOLDER / "own_node_checks.py"), name, "together"]
    runs = [
        subprocess.Popen(command, cwd=tmp_path, env=variables, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    answers = [one.communicate(timeout=120) for one in runs]
    assert answers[0][0].splitlines()[-1:] == ["ok"], answers[0]
    assert answers[0] == answers[1]
