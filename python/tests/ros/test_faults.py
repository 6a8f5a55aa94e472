"""Faults of callbacks are the user's to see: errors with their context, slow callbacks, executors that hang."""

import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from periplus.ros import _faults
from ros_programs import environment


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Callable[[float], None]:
    """Function that advances the clock of the monitors by seconds."""
    now_ns = [0]
    monkeypatch.setattr(_faults, "_steady_ns", lambda: now_ns[0])
    monkeypatch.setattr(_faults, "_monitors", [])
    monkeypatch.setattr(_faults, "_watching", True)

    def advance(seconds: float) -> None:
        now_ns[0] += round(seconds * 1e9)

    return advance


def call(monitor: _faults.CallbackMonitor, work: Callable[[], object]) -> None:
    before = monitor.start()
    try:
        work()
    finally:
        monitor.end(before)


def on_timer() -> None:
    pass


def lone(script: Path, **variables: str) -> str:
    """Standard error of a program in lockstep with a simulation that begins at 1000 s and ends at 1003 s."""
    command = [sys.executable, str(Path(__file__).with_name("lone_simulation.py")), script.name]
    done = subprocess.run(
        command, env=environment(LONE_END="1003", **variables), cwd=script.parent, capture_output=True, text=True, timeout=60
    )
    return done.stderr


def test_a_timer_slower_than_its_period_is_named_once_with_figures(clock: Callable[[float], None], capsys: pytest.CaptureFixture[str]) -> None:
    monitor = _faults.CallbackMonitor(on_timer, node="/wall", kind="timer", period_ns=50_000_000)
    for taken_s in (0.04, 0.08, 0.02, 0.1):
        call(monitor, lambda taken_s=taken_s: clock(taken_s))
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert lines[0].startswith("periplus: callback on_timer (")
    assert lines[0].endswith(" of the timer of node /wall took 80.0 ms, longer than its period of 50.0 ms: calls are skipped")
    _faults._print_summary()
    assert "2 of 4 calls took longer than the period, 90.0 ms on average, 100.0 ms at most" in capsys.readouterr().err


def test_a_subscription_that_is_always_behind_is_named(clock: Callable[[float], None], capsys: pytest.CaptureFixture[str]) -> None:
    monitor = _faults.CallbackMonitor(on_timer, node="/eye", kind="subscription", name="/image")
    for _ in range(30):
        call(monitor, lambda: clock(0.03))
        clock(0.07)
    assert capsys.readouterr().err == ""
    for _ in range(30):
        call(monitor, lambda: clock(0.03))
    lines = capsys.readouterr().err.splitlines()
    assert len(lines) == 1
    assert "of the subscription /image of node /eye took 30.0 ms, and messages come faster than that" in lines[0]


def test_nested_spins_are_timed_on_their_own(clock: Callable[[float], None], capsys: pytest.CaptureFixture[str]) -> None:
    outer = _faults.CallbackMonitor(on_timer, node="/n", kind="timer", period_ns=10_000_000)
    inner = _faults.CallbackMonitor(on_timer, node="/n", kind="timer", period_ns=10_000_000)
    call(outer, lambda: call(inner, lambda: clock(0.004)))
    assert (outer.calls, inner.calls, _faults._running) == (1, 1, {})
    assert capsys.readouterr().err == ""


def test_an_error_carries_node_topic_and_time() -> None:
    error = ValueError("no")
    _faults.callback_failed(error, node="/guard", kind="subscription", name="/scan", time_ns=12_340_000_000)
    text = _faults.format_exception(error)
    assert text.endswith("ValueError: no\nin a callback of the subscription /scan of node /guard at 12.340 s\n")


def test_a_callback_that_does_not_return_is_named_with_its_stack(tmp_path: Path) -> None:
    script = tmp_path / "stuck.py"
    script.write_text(
        "import time\nfrom periplus.ros import _faults\n"
        "def on_scan():\n    time.sleep(0.8)\n"
        "monitor = _faults.CallbackMonitor(on_scan, node='/n', kind='subscription', name='/scan')\n"
        "before = monitor.start()\non_scan()\nmonitor.end(before)\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)], env=environment(PERIPLUS_CALLBACK_TIMEOUT_S="0.2"), cwd=tmp_path,
        capture_output=True, text=True, timeout=60, check=True,
    )  # fmt: skip
    assert done.stderr.startswith("periplus: callback on_scan (stuck.py:3) of the subscription /scan of node /n has not returned for 0.")
    assert done.stderr.count("has not returned") == 1
    assert '/stuck.py", line 4, in on_scan' in done.stderr


def test_a_monitored_call_costs_little() -> None:
    monitor = _faults.CallbackMonitor(on_timer, node="/n", kind="timer", period_ns=10**9)
    begin = time.process_time()
    for _ in range(20_000):
        call(monitor, on_timer)
    assert (time.process_time() - begin) / 20_000 < 20e-6


@pytest.mark.parametrize(
    ("call", "advice"),
    [
        ("client.call(SetBool.Request())", "It waits for a response that its own executor would have to deliver"),
        ("node.create_rate(10).sleep()", "Rate.sleep() needs another thread that spins"),
        ("\n    future = client.call_async(SetBool.Request())\n    while not future.done(): pass", "It waits for a future"),
    ],
)
def test_a_callback_that_blocks_its_executor_is_named_in_lockstep(tmp_path: Path, call: str, advice: str) -> None:
    (tmp_path / "stuck.py").write_text(
        "import rclpy\nfrom std_srvs.srv import SetBool\nrclpy.init()\nnode = rclpy.create_node('n')\n"
        "client = node.create_client(SetBool, 'missing')\n"
        f"def on_timer():\n    {call}\nnode.create_timer(0.5, on_timer)\nnode.create_timer(30, lambda: None)\nrclpy.spin(node)\n"
    )
    errors = lone(tmp_path / "stuck.py")
    assert "periplus: callback on_timer (stuck.py:6) of the timer of node /n, called at 1000.500 s, has not returned" in errors
    assert advice in errors


def test_an_error_of_a_goal_has_its_context_and_no_frames_of_periplus(tmp_path: Path) -> None:
    (tmp_path / "goal.py").write_text(
        "import rclpy\nfrom example_interfaces.action import Fibonacci\nfrom rclpy.action import ActionClient, ActionServer\n"
        "rclpy.init()\nnode = rclpy.create_node('n')\n"
        "server = ActionServer(node, Fibonacci, 'fib', lambda handle: handle.request.ordr)\n"
        "goal = ActionClient(node, Fibonacci, 'fib').send_goal_async(Fibonacci.Goal())\n"
        "rclpy.spin_until_future_complete(node, goal)\n"
        "rclpy.spin_until_future_complete(node, goal.result().get_result_async())\n"
    )
    errors = lone(tmp_path / "goal.py")
    assert 'goal.py", line 6, in <lambda>' in errors
    assert "in a callback of the action /fib of node /n at 1000." in errors
    assert "Fibonacci_Goal has 'order'" in errors
    assert "periplus/ros" not in errors


def test_a_callback_with_wrong_arguments_is_named_with_its_line(tmp_path: Path) -> None:
    (tmp_path / "tick.py").write_text(
        "import rclpy\nrclpy.init()\nnode = rclpy.create_node('n')\n"
        "def tick(event):\n    pass\nnode.create_timer(0.5, tick)\nrclpy.spin(node)\n"
    )
    errors = lone(tmp_path / "tick.py")
    assert "in a callback of the timer of node /n at 1000.500 s: tick (tick.py:4)\n" in errors


def test_a_slow_or_wrong_timer_of_rospy_is_named(tmp_path: Path) -> None:
    (tmp_path / "timers.py").write_text(
        "import periplus.ros; periplus.ros.activate(generation=1, quiet=True)\n"
        "import rospy\nrospy.init_node('n')\ndef slow(event):\n    rospy.sleep(0.3)\ndef wrong():\n    pass\n"
        "rospy.Timer(rospy.Duration(0.1), slow)\nrospy.Timer(rospy.Duration(0.1), wrong)\nrospy.sleep(2)\n"
    )
    errors = lone(tmp_path / "timers.py")
    assert "callback slow (timers.py:4) of the timer of node /n took 300.0 ms, longer than its period of 100.0 ms" in errors
    assert "in a callback of the timer of node /n at 1000.100 s: wrong (timers.py:6)\n" in errors
    assert "periplus/ros" not in errors


def test_an_error_of_a_done_callback_names_the_client(tmp_path: Path) -> None:
    (tmp_path / "done.py").write_text(
        "import rclpy\nfrom std_srvs.srv import Trigger\nrclpy.init()\nnode = rclpy.create_node('n')\n"
        "node.create_service(Trigger, 'set', lambda request, response: response)\n"
        "future = node.create_client(Trigger, 'set').call_async(Trigger.Request())\n"
        "future.add_done_callback(lambda future: 1 / 0)\nrclpy.spin(node)\n"
    )
    assert "ZeroDivisionError: division by zero\nin a callback of the client /set of node /n at 1000." in lone(tmp_path / "done.py")


def test_a_callback_that_waits_for_its_own_lock_is_named_in_lockstep(tmp_path: Path) -> None:
    (tmp_path / "locks.py").write_text(
        "import periplus.ros; periplus.ros.activate(generation=1, quiet=True)\n"
        "import rospy, threading\nfrom std_msgs.msg import String\nrospy.init_node('n')\nlock = threading.Lock()\n"
        "def got(message):\n    with lock:\n        again()\ndef again():\n    with lock:\n        pass\n"
        "rospy.Subscriber('chatter', String, got)\n"
        "rospy.Publisher('chatter', String, queue_size=1, latch=True).publish('x')\nrospy.spin()\n"
    )
    errors = lone(tmp_path / "locks.py", PERIPLUS_CALLBACK_TIMEOUT_S="2")
    assert "callback got (locks.py:6) of the subscription /chatter of node /n, called at 1000." in errors
    assert "has not returned for 2.0 s. It is here:" in errors
    assert 'locks.py", line 10, in again' in errors
