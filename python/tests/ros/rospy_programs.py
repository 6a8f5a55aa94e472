"""Programs for rospy that tests run: in lockstep without a network, or live."""

import os
import subprocess
import sys
from pathlib import Path
from textwrap import dedent

from ros_programs import environment

FOLDER = Path(__file__).parent
_HEAD = "import periplus.ros; periplus.ros.activate(generation=1, quiet=True)\n"


def run_in_lockstep(folder: Path, source: str, *arguments: str, **variables: str) -> str:
    """Output of a program in simulated time. Fails with what it wrote to stderr."""
    program = folder / "program.py"
    program.write_text(_HEAD + dedent(source))
    run = subprocess.run(
        [sys.executable, str(FOLDER / "lone_simulation.py"), str(program), *arguments],
        cwd=folder,
        env=environment(**variables),
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    return run.stdout


def live_environment(**variables: str) -> dict[str, str]:
    """A network of its own on this machine."""
    domain = str(20 + os.getpid() % 80)
    return environment(ROS_DOMAIN_ID=domain, ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", **variables)


def start_live(folder: Path, name: str, source: str, *arguments: str, **variables: str) -> subprocess.Popen[str]:
    """Starts a program by `periplus run`."""
    program = folder / f"{name}.py"
    program.write_text(dedent(source))
    return subprocess.Popen(
        [sys.executable, "-u", "-m", "periplus.ros.run", str(program), *arguments],
        cwd=folder,
        env=live_environment(**variables),
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
