"""A program in lockstep gives the same trace in each run, and its sleeps cost nothing."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from ros_programs import environment

FOLDER = Path(__file__).parent
PROGRAM = """
import asyncio, concurrent.futures, datetime, queue, random, threading, time, uuid

log = []

def trace(*words):
    log.append((round(time.time(), 6), threading.current_thread().name, *words))

items = queue.Queue(maxsize=2)

def producer(number):
    for count in range(4):
        items.put((number, count))
        time.sleep(random.random())

def consumer():
    while (item := items.get()) is not None:
        trace("got", item)

producers = [threading.Thread(target=producer, args=(number,), name=f"p{number}") for number in range(3)]
eater = threading.Thread(target=consumer, name="eater")
for thread in (eater, *producers):
    thread.start()
for thread in producers:
    thread.join()
items.put(None)
eater.join()

ready, condition = [], threading.Condition()

def waiter():
    with condition:
        while not ready:
            trace("waits", condition.wait(0.3))
        trace("ready")

waiters = [threading.Thread(target=waiter, name=f"w{number}") for number in range(3)]
for thread in waiters:
    thread.start()
time.sleep(0.7)
with condition:
    ready.append(1)
    condition.notify_all()
for thread in waiters:
    thread.join()

gate, turns = threading.Semaphore(2), threading.Barrier(3)

def guest(number):
    turns.wait()
    with gate:
        time.sleep(0.1 * number)
        trace("guest")

with concurrent.futures.ThreadPoolExecutor(3) as pool:
    list(pool.map(guest, range(3)))

async def main():
    results = queue.SimpleQueue()
    loop = asyncio.get_running_loop()
    threading.Timer(0.25, lambda: loop.call_soon_threadsafe(results.put, "timer")).start()
    await asyncio.gather(asyncio.sleep(1), loop.run_in_executor(None, time.sleep, 2))
    trace(results.get(), str(uuid.uuid4()))

asyncio.run(main())
trace(str(datetime.datetime.now(datetime.timezone.utc)), random.random(), random.Random().random())
print(*log, sep="\\n")
"""


def start(tmp_path: Path, program: str, **variables: str) -> "subprocess.Popen[str]":
    script = tmp_path / "script.py"
    # A process that was started before may be reading it.
    if not script.exists() or script.read_text() != program:
        script.write_text(program)
    return subprocess.Popen(
        [sys.executable, str(FOLDER / "fake_simulation.py"), str(script)],
        env=environment(**variables), cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def run(tmp_path: Path, program: str, exit_code: int = 0, **variables: str) -> "tuple[str, str]":
    process = start(tmp_path, program, **variables)
    out, errors = process.communicate(timeout=60)
    assert process.returncode == exit_code, errors
    return out, errors


def test_the_same_trace_in_each_run(tmp_path: Path) -> None:
    first, errors = run(tmp_path, PROGRAM)
    assert len(first.splitlines()) > 20
    assert errors == ""
    # Two at once, so that the machine orders their threads differently.
    processes = [start(tmp_path, PROGRAM) for _ in range(2)]
    answers = [process.communicate(timeout=60) for process in processes]
    assert answers == [(first, ""), (first, "")]


def test_seed_and_name_of_the_process_choose_the_random_numbers(tmp_path: Path) -> None:
    program = "import os, random, uuid; import numpy as np\nprint(random.random(), uuid.uuid4(), np.random.rand(), np.random.default_rng().random())"
    settings = ({}, {"PERIPLUS_SEED": "1"}, {"PERIPLUS_SEED": "1", "PERIPLUS_PROCESS": "left"})
    answers = [run(tmp_path, program, **one)[0] for one in settings]
    words = [word for answer in answers for word in answer.split()]
    assert len(set(words)) == len(words) == 12
    assert run(tmp_path, program, **settings[2])[0] == answers[2]


def test_sleep_costs_nothing(tmp_path: Path) -> None:
    begin = time.perf_counter()
    out, _ = run(tmp_path, "import time; time.sleep(1e6); print(time.time(), time.monotonic())")
    assert out == "1000000.0 1000000.0\n"
    assert time.perf_counter() - begin < 30


def test_messages_end_a_wait_and_time_stands_still_between_them(tmp_path: Path) -> None:
    program = """
import sys, time
from periplus.ros import _waiting
graph = sys.modules["fake_graph"]
for _ in range(3):
    before = graph.events
    print(_waiting.wait(graph, before, 2_000_000_000) - before, time.time())
"""
    out, _ = run(tmp_path, program, FAKE_MESSAGES="1500000000,1500000000,9000000000")
    assert out.splitlines() == ["2 1.5", "0 3.5", "0 5.5"]


def test_two_threads_wait_for_messages_and_one_for_a_lock(tmp_path: Path) -> None:
    program = """
import sys, threading, time
from periplus.ros import _waiting
graph = sys.modules["fake_graph"]
lock, log = threading.Lock(), []
def receive(name):
    for _ in range(2):
        _waiting.wait(graph, graph.events)
        with lock:
            log.append((name, time.time()))
            time.sleep(0.25)
threads = [threading.Thread(target=receive, args=(name,)) for name in "ab"]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(log)
"""
    out, _ = run(tmp_path, program, FAKE_MESSAGES="1000000000,2000000000")
    assert out.strip() == "[('a', 1.0), ('b', 1.25), ('a', 2.0), ('b', 2.25)]"


def test_the_end_of_the_simulation_is_ctrl_c(tmp_path: Path) -> None:
    program = """
import threading, time
def background():
    while True:
        time.sleep(0.1)
threading.Thread(target=background, daemon=True).start()
try:
    threading.Event().wait()
except KeyboardInterrupt:
    print("interrupted", time.time())
finally:
    time.sleep(3)
    print("cleaned up", time.time())
"""
    out, _ = run(tmp_path, program, FAKE_END="5000000000")
    assert out.splitlines() == ["interrupted 5.0", "cleaned up 8.0"]


def test_an_uncaught_end_of_the_simulation_is_silent(tmp_path: Path) -> None:
    _, errors = run(tmp_path, "import time\ntime.sleep(100)", 130, FAKE_END="5000000000")
    assert errors == ""


def test_errors_after_the_end_of_the_simulation_name_the_program_alone(tmp_path: Path) -> None:
    program = """
import time
try:
    time.sleep(100)
finally:
    1 / 0
"""
    _, errors = run(tmp_path, program, 1, FAKE_END="5000000000")
    assert "script.py" in errors and "ZeroDivisionError" in errors
    assert "ConnectionError" not in errors and "periplus/ros" not in errors


def test_ctrl_c_reaches_a_main_thread_that_waits_for_a_lock(tmp_path: Path) -> None:
    program = """
import threading
lock = threading.Lock(); lock.acquire()
print("waits", flush=True)
try:
    lock.acquire()
except KeyboardInterrupt:
    print("interrupted", lock.locked())
"""
    process = start(tmp_path, program)
    assert process.stdout is not None
    assert process.stdout.readline() == "waits\n"
    time.sleep(0.2)
    process.send_signal(signal.SIGINT)
    out, errors = process.communicate(timeout=30)
    assert out == "interrupted True\n", errors


@pytest.mark.parametrize("loop", ["pass", "time.sleep(0)", "threading.Lock().acquire()", "_waiting.wait(graph, graph.events, 0)"])
def test_a_busy_loop_ends(tmp_path: Path, loop: str) -> None:
    program = f"""
import sys, threading, time
from periplus.ros import _waiting
graph = sys.modules["fake_graph"]
while time.time() < 0.2:
    {loop}
print(time.time())
"""
    out, errors = run(tmp_path, program)
    assert 0.2 <= float(out) < 0.21
    assert ("script.py:5 (<module>)" in errors) == (loop in ("pass", "threading.Lock().acquire()"))


def test_what_makes_runs_differ_is_named(tmp_path: Path) -> None:
    program = """
import os, socket, subprocess, sys
def talk():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as s:
        s.sendto(b"x", ("127.0.0.1", 9))
for _ in range(3):
    talk()
subprocess.run([sys.executable, "-c", "import os; assert 'PERIPLUS_LOCKSTEP' not in os.environ"], check=True)
open("/dev/urandom", "rb").read(1)
"""
    report = tmp_path / "report.json"
    _, errors = run(tmp_path, program, PERIPLUS_LOCKSTEP_REPORT=str(report), PYTHONHASHSEED="random")
    lines = errors.splitlines()
    assert len(lines) == 4
    assert "socket.sendto(('127.0.0.1', 9)) at script.py:5 (talk)" in lines[0]
    assert "script.py:8 (<module>): starts a process" in lines[1]
    assert "opens /dev/urandom at script.py:9" in lines[2]
    assert "PYTHONHASHSEED" in lines[3]
    assert [finding["kind"] for finding in json.loads(report.read_text())["findings"]] == ["socket", "process", "entropy", "hash seed"]


def test_threads_that_wait_for_each_other_are_named(tmp_path: Path) -> None:
    program = """
import threading
def wait_for_ever():
    threading.Event().wait()
threading.Thread(target=wait_for_ever, daemon=True).start()
threading.Event().wait()
"""
    _, errors = run(tmp_path, program, 130, FAKE_END="1000000000")
    assert "every thread of this program waits for another one" in errors
    assert "script.py\", line 4, in wait_for_ever" in errors
    assert "script.py\", line 6, in <module>" in errors


def test_a_thread_that_keeps_the_simulation_waiting_is_named(tmp_path: Path) -> None:
    program = """
import sys
def compute():
    count = 0
    while not sys.modules.get("stop"):
        count += 1
        if count > 60_000_000: return
compute()
"""
    _, errors = run(tmp_path, program, PERIPLUS_CALLBACK_TIMEOUT_S="0.3")
    assert "thread MainThread has not come back for 0 s of wall time; the simulation waits for it at 0.000 s" in errors
    assert "in compute" in errors


def test_a_signal_handler_that_sets_an_event(tmp_path: Path) -> None:
    program = """
import signal, sys, threading, time
stop = threading.Event()
signal.signal(signal.SIGTERM, lambda number, frame: stop.set())
print(signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL, flush=True)
stop.wait()
print("stopped", time.time())
"""
    process = start(tmp_path, program)
    assert process.stdout is not None
    assert process.stdout.readline() == "True\n"
    time.sleep(0.3)
    process.send_signal(signal.SIGTERM)
    out, errors = process.communicate(timeout=30)
    assert out == "stopped 0.0\n", errors


def test_sigusr1_prints_the_stacks(tmp_path: Path) -> None:
    process = start(tmp_path, "import sys\ndef spin():\n    print('spins', flush=True)\n    while True:\n        pass\nspin()\n")
    assert process.stdout is not None
    assert process.stdout.readline() == "spins\n"
    process.send_signal(signal.SIGUSR1)
    time.sleep(0.3)
    process.kill()
    assert re.search(r'script.py", line \d in spin', process.communicate(timeout=30)[1])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs os.fork")
def test_a_forked_child_is_not_in_step(tmp_path: Path) -> None:
    program = """
import os, threading, time
lock = threading.Lock()
pid = os.fork()
if pid == 0:
    with lock:
        thread = threading.Thread(target=time.sleep, args=(0.01,))
        thread.start(); thread.join()
    os._exit(5 if time.time() > 1e9 else 6)
print(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]), time.time())
"""
    out, errors = run(tmp_path, program)
    assert out == "5 0.0\n"
    assert "os.fork() at script.py:4" in errors


def test_a_look_at_the_keyboard_is_named(tmp_path: Path) -> None:
    program = "import select, sys\ndef key():\n    return select.select([sys.stdin], [], [], 0.1)[0]\nkey()\n"
    _, errors = run(tmp_path, program)
    assert "runs may differ: waits for the keyboard by select() at script.py:3 (key)" in errors
