"""The packages of `own_nodes` run from their source tree, each node with its documented effect: live, and in lockstep twice alike."""

import signal
import subprocess
import sys
from pathlib import Path

import pytest
from ros_programs import environment

FOLDER = Path(__file__).parent
NODES = {"guard": [], "wall": [], "beacon": ["1.5"], "follower": [], "lamp": [], "square": []}


@pytest.mark.parametrize("name", NODES)
def test_live(name: str, tmp_path: Path) -> None:
    domain = str(140 + list(NODES).index(name))
    variables = environment(
        ROS_DOMAIN_ID=domain, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", ROS_LOG_DIR=str(tmp_path),
        PERIPLUS_PACKAGES=str(FOLDER / "own_nodes"),
    )  # fmt: skip
    node = subprocess.Popen(
        [sys.executable, "-m", "periplus.ros.run", "trail_nodes", name, *NODES[name]],
        cwd=tmp_path, env=variables, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        check = subprocess.run(
            [sys.executable, str(FOLDER / "own_node_checks.py"), name],
            cwd=tmp_path, env=variables, capture_output=True, text=True, timeout=150, check=False,
        )  # fmt: skip
    finally:
        node.send_signal(signal.SIGINT)
        try:
            out = node.communicate(timeout=20)[0]
        except subprocess.TimeoutExpired:
            node.kill()
            out = node.communicate()[0] + "\nit did not end after Ctrl-C"
    assert (check.returncode, check.stdout.strip()) == (0, "ok"), f"{check.stdout}{check.stderr}\n--- the node:\n{out}"
    assert "did not end" not in out


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
