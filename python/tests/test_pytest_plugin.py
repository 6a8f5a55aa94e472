"""The plugin of pytest, run in a pytest of its own."""

from __future__ import annotations

import textwrap
from pathlib import Path
from xml.etree import ElementTree

import pytest

pytest_plugins = ["pytester"]

ROOT = Path(__file__).parents[2]
FILES = f'WORLD = "{ROOT}/worlds/demo_room.sdf"\nROBOT = "{ROOT}/robots/sam_bot/urdf/sam_bot.urdf.xacro"\n'


@pytest.fixture
def suite(pytester: pytest.Pytester) -> pytest.Pytester:
    """A folder with tests of users."""
    pytester.makepyfile(
        FILES
        + textwrap.dedent(
            """
            import pytest

            def drive(scenario, fault):
                run = scenario(WORLD, ROBOT, physics="kinematic", timeout=2)
                run.drive([{"at": 0, "until": 2, "linear": 0.3}])
                if fault:
                    run.fault("dropout", topic="/scan")
                return run.rate("/scan", 5).no_collision()

            @pytest.mark.parametrize("fault", [False, True])
            def test_scans(scenario, fault):
                drive(scenario, fault).check()

            def test_seed(scenario, record_property):
                assert drive(scenario, False).run().seed == 7

            @pytest.mark.periplus(world=WORLD, robot=ROBOT, physics="kinematic")
            def test_parts(simulation, ros, robot):
                assert robot == ROBOT
                scan = ros.wait_for("/scan")
                assert len(scan.ranges) == 360
                assert ros.rate("/scan", over_s=1.0) == pytest.approx(5, abs=1)
                assert simulation.time_s > 1.0

            @pytest.mark.periplus(world=WORLD, robot=ROBOT, physics="kinematic")
            def test_nodes(simulation, ros):
                from geometry_msgs.msg import Twist
                from sensor_msgs.msg import LaserScan

                node = ros.node("wanderer")
                ticks, scans = [], []
                commands = node.create_publisher(Twist, "/cmd_vel", 1)

                def tick():
                    ticks.append(node.get_clock().now().nanoseconds)
                    command = Twist()
                    command.linear.x = 0.2
                    commands.publish(command)

                node.create_timer(0.25, tick)
                node.create_subscription(LaserScan, "/scan", scans.append, 10)
                x = simulation.model("sam_bot").pose.x
                ros.spin(2.0)
                # Simulated time: 2 s / 0.25 s ticks, and 0.2 m/s from the first of them on.
                assert len(ticks) in (7, 8) and ticks[1] - ticks[0] == 250_000_000
                assert len(scans) in (10, 11)
                moved = simulation.model("sam_bot").pose.x - x
                assert moved == pytest.approx(0.35, abs=0.06)
                assert ros.spin_until(lambda: len(scans) > 14)
                with pytest.raises(AssertionError, match="did not hold within 0.5 s of simulated time"):
                    ros.spin_until(lambda: False, timeout_s=0.5)

            @pytest.mark.periplus(world=WORLD, robot=ROBOT, physics="kinematic", slam=False)
            def test_goal(navigation):
                assert navigation.go_to((0.5, 0.0, 0.0)).reached

            def test_demo_world(world, simulation):
                simulation.run(0.1)
                assert len(simulation.models) > 1
                pytest.fail("keep the recording")
            """
        )
    )
    scenario = f"""
        world: {ROOT}/worlds/demo_room.sdf
        robot: {ROOT}/robots/sam_bot/urdf/sam_bot.urdf.xacro
        physics: kinematic
        timeout: 1
        assertions: [no_collision, min_clearance: 0.1]
    """
    (pytester.path / "room.scenario.yaml").write_text(textwrap.dedent(scenario))
    wrong = textwrap.dedent(scenario).replace("min_clearance", "min_clearence")
    (pytester.path / "wrong.scenario.yaml").write_text(wrong)
    return pytester


def test_tests_of_users(suite: pytest.Pytester) -> None:
    arguments = ["--periplus-seed=7", "--periplus-artifacts=kept", "--junitxml=results.xml"]
    result = suite.runpytest_subprocess(*arguments)
    result.assert_outcomes(passed=6, failed=3)
    output = result.stdout.str()
    assert "did you mean" in output or "min_clearance" in output
    assert "run it again: periplus scenario" in output
    kept = sorted(path.name for path in (suite.path / "kept").iterdir())
    assert [name for name in kept if "True" in name], kept
    assert not [name for name in kept if "False" in name], kept
    demo = next(path for path in (suite.path / "kept").iterdir() if "test_demo_world" in path.name)
    assert {"run.mcap", "picture.png"} == {path.name for path in demo.iterdir()}
    cases = ElementTree.parse(suite.path / "results.xml").getroot().iter("testcase")
    scores = {case.get("name"): {one.get("name") for one in case.iter("property")} for case in cases}
    assert {"seed", "length_m", "min_clearance_m"} <= scores["test_seed"]
    assert {"seed", "length_m"} <= scores["room"]
