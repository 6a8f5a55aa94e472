"""Tests of running nodes."""

import subprocess
import sys
from pathlib import Path

from ros_programs import environment

DESCRIPTION = '''
import sys
import time
import unittest

import launch_testing
import launch_testing.actions
import rclpy
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from std_msgs.msg import String

def generate_test_description():
    talker = ExecuteProcess(cmd=[sys.executable, TALKER], name="talker", output="screen")
    short = ExecuteProcess(cmd=["sh", "-c", "echo short; exit 3"], name="short")
    return LaunchDescription([talker, short, launch_testing.actions.ReadyToTest()]), {"talker": talker}


class TestTalker(unittest.TestCase):
    def test_output(self, proc_output, talker):
        proc_output.assertWaitFor("said 3", process=talker, timeout=20)

    def test_topic(self):
        rclpy.init(args=[])
        node = rclpy.create_node("listener")
        heard = []
        node.create_subscription(String, "chatter", heard.append, 10)
        end = time.time() + 20
        while not heard and time.time() < end:
            rclpy.spin_once(node, timeout_sec=0.1)
        self.assertTrue(heard)
        rclpy.shutdown()

    def test_end(self, proc_info):
        proc_info.assertWaitForShutdown(process="short", timeout=20)


@launch_testing.post_shutdown_test()
class TestAfter(unittest.TestCase):
    def test_exit_codes(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info, [3], process="short")
        launch_testing.asserts.assertExitCodes(proc_info, process="talker")

    def test_text(self, proc_output):
        with launch_testing.asserts.assertSequentialStdout(proc_output, "talker") as checker:
            checker.assertInStdout("said 1")
            checker.assertInStdout("said 2")
'''

TALKER = """
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "chatter", 10)
count = 0

def tick():
    global count
    count += 1
    publisher.publish(String(data="hi"))
    print("said", count, flush=True)

node.create_timer(0.05, tick)
try:
    rclpy.spin(node)
except KeyboardInterrupt:
    pass
"""


def run(folder: Path, text: str) -> subprocess.CompletedProcess[str]:
    (folder / "talker.py").write_text(TALKER)
    (folder / "node_test.py").write_text(text.replace("TALKER]", repr(str(folder / "talker.py")) + "]"))
    code = "import periplus.ros; periplus.ros.activate(quiet=True); import sys; from launch_testing._runner import main; sys.exit(main(sys.argv[1:]))"
    return subprocess.run(
        [sys.executable, "-c", code, "node_test.py"], cwd=folder, env=environment(ROS_DOMAIN_ID="131", ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST"), capture_output=True, text=True, check=False, timeout=100
    )


def test_passing_tests(tmp_path: Path) -> None:
    done = run(tmp_path, DESCRIPTION)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr.count("ok\n") == 5


def test_a_failing_test_fails_the_run(tmp_path: Path) -> None:
    done = run(tmp_path, DESCRIPTION.replace('"said 3", process=talker, timeout=20', '"never", process=talker, timeout=0.5'))
    assert done.returncode == 1
    assert "Waiting for output timed out after 0.5 s: 'never'" in done.stderr and "[talker] said 1" in done.stderr
