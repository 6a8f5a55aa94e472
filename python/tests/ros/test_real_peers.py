"""Programs on Periplus's rclpy and on real rclpy talk to each other over the network, in both directions.

`PERIPLUS_REAL_RCLPY` is an interpreter with rclpy from PyPI or a ROS installation.
"""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from ros_programs import environment

FOLDER = Path(__file__).with_name("peers")
REAL = os.environ.get("PERIPLUS_REAL_RCLPY")
EXPECTED = """\
latched ['kept']
pongs ['é0', 'é1', 'é2', 'é3', 'é4']
scan True [1.0, inf, 2.5]
service False was True
parameters ['names', 'speed', 'use_sim_time']
values 0.5 ['a', 'b']
set [True, False] Wrong parameter type, expected 'Type.STRING_ARRAY' got 'Type.INTEGER'
speed 0.75
action True 4 [0, 1, 1, 2, 3, 5] 6
cancelled 1 5
node True
"""

if REAL is None:
    pytest.skip("NO PEER: set PERIPLUS_REAL_RCLPY to an interpreter with real rclpy", allow_module_level=True)


def command(side: str) -> list[str]:
    return [REAL or ""] if side == "real" else [sys.executable, "-m", "periplus.ros.run"]


def variables(side: str, domain: int, folder: Path) -> dict[str, str]:
    made = environment(ROS_DOMAIN_ID=str(domain), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST", ROS_LOG_DIR=str(folder))
    made["PYTHONIOENCODING"] = "utf-8"
    if side == "real":
        # It must not see the package under test.
        made.pop("PYTHONPATH", None)
        made["RMW_IMPLEMENTATION"] = "rmw_fastrtps_cpp"
    return made


@pytest.mark.parametrize(("server", "client"), [("own", "real"), ("real", "own"), ("own", "own"), ("real", "real")])
def test_both_sides_understand_each_other(server: str, client: str, tmp_path: Path) -> None:
    domain = 150 + 2 * (server == "real") + (client == "real")
    serving = subprocess.Popen(
        [*command(server), str(FOLDER / "server.py")], cwd=FOLDER, env=variables(server, domain, tmp_path),
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        assert serving.stdout is not None
        assert serving.stdout.readline() == "ready\n"
        asking = subprocess.run(
            [*command(client), str(FOLDER / "client.py")], cwd=FOLDER, env=variables(client, domain, tmp_path),
            capture_output=True, text=True, timeout=120, check=False,
        )  # fmt: skip
        assert asking.stdout == EXPECTED, asking.stderr[-4000:]
        assert asking.returncode == 0
    finally:
        serving.terminate()
        serving.wait(20)
