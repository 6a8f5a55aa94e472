"""Launch of a test description, and its tests."""

from __future__ import annotations

import importlib.util
import inspect
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from types import ModuleType
from typing import Any

import periplus
from periplus.ros import _waiting

from launch_testing import _placeholders
from launch_testing._records import IoHandler, Launch, ProcInfoHandler

# Time without the start of another process after which all have started [s].
_SETTLED_S = 0.3
_READY_TIMEOUT_S = 30.0
_STOP_TIMEOUT_S = 15.0

_WRAPPER = """import importlib.util, sys
try:
    import periplus.ros
    periplus.ros.activate(quiet=True)
except ImportError:
    pass
sys.path.insert(0, {folder!r})
_spec = importlib.util.spec_from_file_location("launch_test_file", {path!r})
_module = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(_module)


def generate_launch_description():
    made = _module.generate_test_description({call})
    return made[0] if isinstance(made, tuple) else made
"""


def main(words: list[str]) -> int:
    """Runs the tests of a file; 0 if all have passed."""
    files = [word for word in words if ":=" not in word and not word.startswith("-")]
    arguments = [word for word in words if ":=" in word]
    if len(files) != 1:
        print("usage: python -m launch_testing FILE [NAME:=VALUE ...]", file=sys.stderr)
        return 2
    path = os.path.abspath(files[0])
    if not os.path.isfile(path):
        print(f"launch_testing: there is no file {path}", file=sys.stderr)
        return 2
    _placeholders.install()
    module = _load(path)
    generate = getattr(module, "generate_test_description", None)
    if generate is None:
        print(f"launch_testing: {path} has no function `generate_test_description`", file=sys.stderr)
        return 2
    results = [_run(path, module, generate, given, arguments) for given in getattr(generate, "__parameters__", [{}])]
    return 0 if all(results) else 1


def _load(path: str) -> ModuleType:
    sys.path.insert(0, os.path.dirname(path))
    spec = importlib.util.spec_from_file_location("launch_test_file", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["launch_test_file"] = module
    spec.loader.exec_module(module)
    return module


def _call(generate: Any, given: dict[str, Any]) -> dict[str, Any]:
    keywords = dict(given)
    if "ready_fn" in inspect.signature(generate).parameters:
        keywords["ready_fn"] = lambda: None
    made = generate(**keywords)
    return dict(made[1]) if isinstance(made, tuple) and len(made) > 1 else {}


def _run(path: str, module: ModuleType, generate: Any, given: dict[str, Any], arguments: list[str]) -> bool:
    context = {**_call(generate, given), **given}
    launch = Launch()
    context.update(proc_output=IoHandler(launch), proc_info=ProcInfoHandler(launch), test_args=_values(arguments), launch_service=None)
    active, after = _tests(module, context)
    words = [f"{name}={value!r}" for name, value in given.items()]
    if "ready_fn" in inspect.signature(generate).parameters:
        words.append("ready_fn=lambda: None")
    with tempfile.TemporaryDirectory(prefix="periplus-launch-test-") as folder:
        wrapper = os.path.join(folder, os.path.basename(path).removesuffix(".py") + ".launch.py")
        with open(wrapper, "w", encoding="utf-8") as file:
            file.write(_WRAPPER.format(folder=os.path.dirname(path), path=path, call=", ".join(words)))
        process = _start(wrapper, arguments)
        reader = _waiting.start_thread(lambda: _read(process, launch), "launch_output")
        try:
            _wait_until_ready(launch, getattr(generate, "__ready_timeout_s__", _READY_TIMEOUT_S))
            passed = _run_tests(active)
        finally:
            _stop(process)
            reader.join(_STOP_TIMEOUT_S)
            launch.end()
    return _run_tests(after) and passed


def _values(arguments: list[str]) -> dict[str, str]:
    pairs = (one.partition(":=") for one in arguments)
    return {name: value for name, _, value in pairs}


def _start(wrapper: str, arguments: list[str]) -> subprocess.Popen[str]:
    own = os.path.dirname(os.path.dirname(os.path.abspath(periplus.__file__)))
    environment = dict(os.environ, PYTHONUNBUFFERED="1")
    environment["PYTHONPATH"] = os.pathsep.join([own, *filter(None, [environment.get("PYTHONPATH")])])
    environment["PATH"] = os.pathsep.join([os.path.dirname(sys.executable), environment.get("PATH", "")])
    return subprocess.Popen(
        [sys.executable, "-m", "periplus", "launch", wrapper, *arguments],
        env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True, errors="replace", start_new_session=True,
    )  # fmt: skip


def _read(process: subprocess.Popen[str], launch: Launch) -> None:
    assert process.stdout is not None
    for line in process.stdout:
        print(line, end="", flush=True)
        launch.add(line.rstrip("\n"))
    launch.end()


def _wait_until_ready(launch: Launch, timeout_s: float) -> None:
    def is_ready() -> bool:
        return bool(launch.processes) and time.monotonic() - launch.last_start_s > _SETTLED_S

    if not launch.wait(is_ready, timeout_s) and not launch.processes:
        print(f"launch_testing: no process has started within {timeout_s} s", file=sys.stderr)


def _stop(process: subprocess.Popen[str]) -> None:
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
        if process.poll() is None:
            process.send_signal(number)
            try:
                process.wait(_STOP_TIMEOUT_S)
            except subprocess.TimeoutExpired:
                continue


def _tests(module: ModuleType, context: dict[str, Any]) -> tuple[unittest.TestSuite, unittest.TestSuite]:
    """Tests that run with the processes, and after their ends."""
    suites = unittest.TestSuite(), unittest.TestSuite()
    for value in list(vars(module).values()):
        if isinstance(value, type) and issubclass(value, unittest.TestCase) and value.__module__ == module.__name__:
            for name, one in context.items():
                setattr(value, name, one)
            for test in unittest.defaultTestLoader.loadTestsFromTestCase(value):
                assert isinstance(test, unittest.TestCase)
                name = test.id().rpartition(".")[2]
                setattr(test, name, _bound(getattr(test, name), context))
                suites[bool(getattr(value, "__post_shutdown_test__", False))].addTest(test)
    return suites


def _bound(method: Any, context: dict[str, Any]) -> Any:
    """Method with the arguments that it names."""
    wanted = [name for name in inspect.signature(method).parameters if name in context]

    def call() -> Any:
        return method(**{name: context[name] for name in wanted})

    call.__doc__ = method.__doc__
    return call


def _run_tests(suite: unittest.TestSuite) -> bool:
    return unittest.TextTestRunner(verbosity=2).run(suite).wasSuccessful()
