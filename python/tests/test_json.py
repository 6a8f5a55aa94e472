"""What commands print with `--json`, against their schemas, by the validator of PyPI."""

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

jsonschema = pytest.importorskip("jsonschema", reason="jsonschema is not installed")

ROOT = Path(__file__).parents[2]
ROBOT = str(ROOT / "robots/sam_bot/urdf/sam_bot.urdf.xacro")
WORLD = str(ROOT / "worlds/demo_room.sdf")
DRIVE = str(ROOT / "worlds/drives/circle.yaml")
SCENARIO = str(ROOT / "scenarios/costmap_demo_room.scenario.yaml")
#: Used by no other test.
DOMAIN = "84"
TOPICS = "--topics=/(tf|tf_static|scan|odom|map|pose|rosout|robot_description|model_states)$"


def run(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "periplus", *words]
    environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
    return subprocess.run(
        command, capture_output=True, text=True, timeout=120, cwd=cwd, env=environment
    )


def closed(schema: Any) -> Any:
    """The schema without properties that it does not name: a new one must be described."""
    if isinstance(schema, dict):
        schema = {key: closed(value) for key, value in schema.items()}
        if "properties" in schema:
            schema.setdefault("additionalProperties", False)
        return schema
    return [closed(value) for value in schema] if isinstance(schema, list) else schema


def values(printed: str) -> list[Any]:
    """One value, or one per line."""
    try:
        return [json.loads(printed)]
    except json.JSONDecodeError:
        return [json.loads(line) for line in printed.splitlines()]


def check(command: str, printed: str) -> None:
    schema = json.loads(run("schema", *command.split()).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(closed(schema))
    found = values(printed)
    assert found, f"`periplus {command}` printed nothing"
    for value in found:
        validator.validate(value)


#: Commands that read files: words after the command, and the exit code.
ON_FILES: list[tuple[str, list[str], int]] = [
    ("bag check", ["run.mcap"], 0),
    ("bag info", ["run.mcap"], 0),
    ("check", [ROBOT, "wrong.sdf"], 0),
    ("check", [ROBOT, str(ROOT / "viewer/package.json")], 1),
    ("compare", ["run.mcap", "run.mcap"], 0),
    ("conformance", [str(ROOT / "conformance/cases")], 0),
    ("convert", [ROBOT, "--to", "harmonic", "--out", "harmonic"], 0),
    ("dataset", [WORLD, "--robot", ROBOT, "--duration", "1", "--format", "lidar", "--out", "set"], 0),
    ("doctor", [ROBOT], 1),
    ("doctor", ["--self"], 0),
    ("interface list", [], 0),
    ("interface package", ["std_srvs"], 0),
    ("interface packages", [], 0),
    ("interface proto", ["std_srvs/srv/SetBool"], 0),
    ("interface show", ["sensor_msgs/msg/LaserScan"], 0),
    ("launch", [str(ROOT / "robots/sam_bot/launch/display.launch.py"), "--duration", "1"], 0),
    ("look", [ROBOT, "--output", "look.png"], 0),
    ("map convert", ["map/map.yaml", "--output", "other"], 0),
    ("map diff", ["map/map.yaml", "map/map.yaml"], 0),
    ("map info", ["map/map.yaml"], 0),
    ("navigate", [WORLD, "--robot", ROBOT, "--pose", "0,0,0", "--goal", "0.5,0"], 0),
    ("report", ["run.mcap"], 0),
    ("scenario", [SCENARIO], 0),
    ("score", ["run.mcap"], 0),
    ("sim", [WORLD, "--robot", ROBOT, "--duration", "1", "--record", "sim.mcap"], 0),
    ("sweep", [SCENARIO, "--seeds", "1", "--out", "sweep"], 0),
    ("tf tree", ["run.mcap"], 0),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a recording, its map and a world with a mistake."""
    folder = tmp_path_factory.mktemp("json")
    words = ["sim", WORLD, "--robot", ROBOT, "publish_odom_tf:=true", "--cmd", DRIVE, "--slam"]
    words += ["--duration", "6", "--quiet", "--record", "run.mcap", "--record-truth", TOPICS]
    made = run(*words, "--slam-out", "map", cwd=folder)
    assert made.returncode == 0, made.stderr
    wrong = '<sdf version="1.9"><world name="a"><gravityy>1</gravityy></world></sdf>'
    (folder / "wrong.sdf").write_text(wrong)
    return folder


@pytest.mark.parametrize(("command", "words", "code"), ON_FILES)
def test_output_on_files_is_as_its_schema(
    folder: Path, command: str, words: list[str], code: int
) -> None:
    result = run(*command.split(), *words, "--json", cwd=folder)
    assert result.returncode == code, result.stderr
    check(command, result.stdout)


CALIBRATION = """\
- {at: 0.0, linear: 0.3, angular: 0.0}
- {at: 3.0, linear: 0.2, angular: 0.7}
- {at: 10.0, linear: 0.25, angular: -0.6}
- {at: 18.0, linear: 0.0, angular: 0.8}
- {at: 22.0, linear: 0.35, angular: 0.3}
"""


def test_output_of_a_calibration_is_as_its_schema(folder: Path) -> None:
    (folder / "drive.yaml").write_text(CALIBRATION)
    words = ["sim", WORLD, "--robot", ROBOT, "--cmd", "drive.yaml", "--duration", "30", "--quiet"]
    made = run(*words, "--record", "long.mcap", "--topics=/(tf|scan|joint_states|tf_static)$", cwd=folder)
    assert made.returncode == 0, made.stderr
    result = run("calibrate", "long.mcap", "--robot", ROBOT, "--json", cwd=folder)
    assert result.returncode == 0, result.stderr
    check("calibrate", result.stdout)


#: Commands on a running system, and the number of lines after which a stream is ended (0: it ends by itself).
ON_A_SYSTEM: list[tuple[str, list[str], int]] = [
    ("action find", ["nav2_msgs/action/NavigateToPose"], 0),
    ("action info", ["/navigate_to_pose"], 0),
    ("action list", [], 0),
    (
        "action send_goal",
        ["/spin", "nav2_msgs/action/Spin", "{target_yaw: 0.1}", "--feedback"],
        0,
    ),
    ("action type", ["/navigate_to_pose"], 0),
    ("lifecycle get", ["/slam_toolbox"], 0),
    ("lifecycle list", ["/slam_toolbox"], 0),
    ("lifecycle nodes", [], 0),
    ("node info", ["/slam_toolbox"], 0),
    ("node list", [], 0),
    ("param describe", ["/slam_toolbox", "resolution"], 0),
    ("param dump", ["/slam_toolbox"], 0),
    ("param get", ["/slam_toolbox", "resolution"], 0),
    ("param list", ["/slam_toolbox"], 0),
    ("param load", ["/slam_toolbox", "parameters.yaml"], 0),
    ("param set", ["/slam_toolbox", "use_sim_time", "true"], 0),
    ("service call", ["/slam_toolbox/list_parameters", "rcl_interfaces/srv/ListParameters"], 0),
    ("service find", ["rcl_interfaces/srv/GetParameters"], 0),
    ("service info", ["/slam_toolbox/get_parameters"], 0),
    ("service list", [], 0),
    ("service type", ["/slam_toolbox/get_parameters"], 0),
    ("tf echo", ["odom", "base_link"], 1),
    ("tf monitor", [], 1),
    ("topic bw", ["/scan"], 1),
    ("topic delay", ["/scan"], 1),
    ("topic echo", ["/scan", "--once"], 0),
    ("topic find", ["sensor_msgs/msg/LaserScan"], 0),
    ("topic hz", ["/scan"], 1),
    ("topic info", ["/scan"], 0),
    ("topic list", [], 0),
    ("topic pub", ["/cmd_vel", "geometry_msgs/msg/Twist", "{}", "--once"], 0),
    ("topic type", ["/scan"], 0),
]
#: The schema of `service echo` asks for an object only, since no service of the system sends events.
NOT_RUN = {"service echo"}
#: Run by the tests with their names.
ELSEWHERE = {"calibrate", "lifecycle set", "param delete"}


def test_every_schema_is_compared_with_what_its_command_prints() -> None:
    listed = set(run("schema").stdout.splitlines())
    covered = {command for command, _, _ in ON_FILES + ON_A_SYSTEM}
    assert listed == covered | NOT_RUN | ELSEWHERE


@pytest.fixture(scope="module")
def system() -> Iterator[None]:
    """A robot with SLAM and navigation in real time, on the loopback interface."""
    words = ["sim", WORLD, "--robot", ROBOT, "--rtf", "1", "--ros2", "loopback"]
    command = [sys.executable, "-m", "periplus", *words, "--slam", "--navigation"]
    environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
    process = subprocess.Popen(
        command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    )
    try:
        for _ in range(60):
            if "/navigate_to_pose" in run("action", "list").stdout:
                break
            assert process.poll() is None, process.communicate()[1]
            time.sleep(1.0)
        else:
            pytest.fail("the simulation offers no `/navigate_to_pose` after a minute")
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)


def lines_of(words: list[str], count: int) -> str:
    """The first lines of a stream."""
    environment = {**os.environ, "ROS_DOMAIN_ID": DOMAIN}
    with subprocess.Popen(
        [sys.executable, "-m", "periplus", *words],
        env=environment,
        stdout=subprocess.PIPE,
        text=True,
    ) as process:
        assert process.stdout is not None
        lines = [process.stdout.readline() for _ in range(count)]
        process.kill()
    return "".join(lines)


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
@pytest.mark.parametrize(("command", "words", "count"), ON_A_SYSTEM)
def test_output_on_a_system_is_as_its_schema(
    system: None, tmp_path: Path, command: str, words: list[str], count: int
) -> None:
    (tmp_path / "parameters.yaml").write_text(
        "slam_toolbox: {ros__parameters: {use_sim_time: true}}\n"
    )
    words = [*command.split(), *words, "--json"]
    if count == 0:
        result = run(*words, cwd=tmp_path)
        assert result.returncode == 0, result.stderr
        check(command, result.stdout)
    else:
        check(command, lines_of(words, count))


@pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
def test_refusals_on_a_system_are_as_their_schemas(system: None) -> None:
    result = run("param", "delete", "/slam_toolbox", "resolution", "--json")
    assert result.returncode == 1
    check("param delete", result.stdout)
    result = run("lifecycle", "set", "/slam_toolbox", "deactivate", "--json")
    assert result.returncode == 0, result.stderr
    check("lifecycle set", result.stdout)
