"""Whole programs: Ctrl-C, SIGTERM, log output."""

import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import pytest
from ros_programs import environment


def start(folder: Path, program: str, *arguments: str, **variables: str) -> "subprocess.Popen[str]":
    script = folder / "program.py"
    script.write_text("import periplus.ros\nperiplus.ros.activate(quiet=True)\n" + textwrap.dedent(program))
    variables = {"ROS_DOMAIN_ID": "231", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "ROS_LOG_DIR": str(folder / "log"), **variables}
    return subprocess.Popen(
        [sys.executable, str(script), *arguments], cwd=folder, env=environment(**variables),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def run(folder: Path, program: str, *arguments: str, **variables: str) -> tuple[str, str, int]:
    process = start(folder, program, *arguments, **variables)
    out, errors = process.communicate(timeout=60)
    return out, errors, process.returncode


SPINNING = """
import rclpy
from rclpy.executors import *
rclpy.init(); node = rclpy.create_node("n"); publisher = node.create_publisher(__import__("std_msgs.msg").msg.String, "t", 1)
executor = {executor}; executor.add_node(node)
print("ready", flush=True)
try:
    executor.spin()
    print("returned", rclpy.ok())
except BaseException as error:
    print(type(error).__name__, rclpy.ok())
try:
    publisher.publish(publisher.msg_type()); print("published")
except Exception as error:
    print(type(error).__name__, error)
try:
    rclpy.shutdown(); print("shut down")
except Exception as error:
    print(type(error).__name__)
rclpy.try_shutdown()
"""


@pytest.mark.parametrize(
    ("executor", "number", "first"),
    [
        ("SingleThreadedExecutor()", signal.SIGINT, "KeyboardInterrupt False"),
        ("SingleThreadedExecutor()", signal.SIGTERM, "ExternalShutdownException False"),
        ("MultiThreadedExecutor(2)", signal.SIGINT, "KeyboardInterrupt False"),
        ("MultiThreadedExecutor(2)", signal.SIGTERM, "returned False"),
    ],
)
def test_signals_shut_down(tmp_path: Path, executor: str, number: int, first: str) -> None:
    process = start(tmp_path, SPINNING.format(executor=executor))
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.2)
    process.send_signal(number)
    out, errors = process.communicate(timeout=30)
    assert out.splitlines() == [first, "RCLError Failed to publish: publisher's context is invalid", "RCLError"], errors
    assert process.returncode == 0


def test_second_init_and_with_statement(tmp_path: Path) -> None:
    out, errors, code = run(
        tmp_path,
        """
        import rclpy
        with rclpy.init():
            try:
                rclpy.init()
            except RuntimeError as error:
                print(error)
            print(rclpy.ok())
        print(rclpy.ok()); rclpy.init(); print(rclpy.ok()); rclpy.shutdown()
        """,
    )
    assert (out.splitlines(), code) == (["Context.init() must only be called once", "True", "False", "True"], 0), errors


def test_console_format_and_colors(tmp_path: Path) -> None:
    program = """
        import rclpy.logging
        log = rclpy.logging.get_logger("robot")
        def say():
            log.warn("careful"); log.error("broken")
        say()
        """
    _, errors, _ = run(tmp_path, program)
    assert re.fullmatch(r"\[WARN\] \[\d+\.\d{9}\] \[robot\]: careful\n\[ERROR\] \[\d+\.\d{9}\] \[robot\]: broken\n", errors)
    form = "{severity}|{name}|{message}|{function_name}|{line_number}|{unknown}"
    _, errors, _ = run(tmp_path, program, RCUTILS_CONSOLE_OUTPUT_FORMAT=form, RCUTILS_COLORIZED_OUTPUT="1")
    assert errors.splitlines()[0] == "\x1b[33mWARN|robot|careful|say|7|{unknown}\x1b[0m"
    out, errors, _ = run(tmp_path, program, RCUTILS_LOGGING_USE_STDOUT="1")
    assert (out.count("robot"), errors) == (2, "")


def test_log_file_and_rosout(tmp_path: Path) -> None:
    out, errors, _ = run(
        tmp_path,
        """
        import rclpy, time
        from rcl_interfaces.msg import Log
        rclpy.init(); node = rclpy.create_node("talker", namespace="ns"); got = []
        node.create_subscription(Log, "/rosout", got.append, 10)
        node.get_logger().info("hello"); node.get_logger().debug("hidden"); rclpy.logging.get_logger("free").info("alone")
        node.get_logger().get_child("part").error("from a part")
        end = time.time() + 20
        while len(got) < 2 and time.time() < end:
            rclpy.spin_once(node, timeout_sec=0.1)
        print([(one.name, one.level, one.msg, one.function, one.line) for one in got])
        rclpy.shutdown()
        """,
    )
    assert out == "[('ns.talker', 20, 'hello', '<module>', 8), ('ns.talker.part', 40, 'from a part', '<module>', 9)]\n", errors
    (file,) = (tmp_path / "log").iterdir()
    assert [line.split("]: ")[1] for line in file.read_text().splitlines()] == ["hello", "alone", "from a part"]


def test_throttle_counts_by_a_clock(tmp_path: Path) -> None:
    out, errors, _ = run(
        tmp_path,
        """
        import rclpy.logging
        from rclpy.clock import ROSClock
        from rclpy.time import Time, ClockType
        clock, log, said = ROSClock(), rclpy.logging.get_logger("robot"), []
        clock._set_ros_time_is_active(True)
        for second in (10, 10.5, 11, 11.5, 3):
            clock.set_ros_time_override(Time(seconds=second, clock_type=ClockType.ROS_TIME))
            said.append(log.info("x", throttle_duration_sec=1, throttle_time_source_type=clock))
        print(said)
        """,
    )
    assert out == "[True, False, True, False, True]\n", errors


def test_rclpy_does_not_load_numpy_by_itself(tmp_path: Path) -> None:
    # The native module is loaded first: what it loads is not counted.
    out, errors, _ = run(
        tmp_path,
        """
        import sys
        import periplus._native
        sys.modules.pop("numpy", None)
        import rclpy.node, rclpy.executors, rclpy.qos
        print("numpy" in sys.modules, "inspect" in sys.modules and "unittest" in sys.modules)
        """,
    )
    assert out == "False False\n", errors
