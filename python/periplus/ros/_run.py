"""Programs of users as `python FILE.py` and `ros2 run PACKAGE PROGRAM` start them, with the ROS modules of Periplus."""

from __future__ import annotations

import os
import re
import sys
import types
from dataclasses import dataclass
from typing import Any, NoReturn

from . import _packages

USAGE = """usage: periplus run [--real-ros] FILE.py [ARGUMENTS] [--ros-args ...]
       periplus run [--real-ros] PACKAGE PROGRAM [ARGUMENTS] [--ros-args ...]"""
#: Exit code for a program that was not found or could not be read.
_NOT_STARTED = 2
_ROS1_IMPORT = re.compile(rb"^[ \t]*(?:import|from)[ \t]+(?:rospy|roslib|dynamic_reconfigure|actionlib|tf)\b", re.M)
_ROS2_IMPORT = re.compile(rb"^[ \t]*(?:import|from)[ \t]+(?:rclpy|ament_index_python|tf2_geometry_msgs)\b", re.M)


@dataclass(frozen=True)
class Program:
    """What is to be run."""

    #: The file whose imports decide the ROS generation; of an entry point, the file of its module (None without one).
    file: str | None
    package: _packages.Package | None
    #: `module:function`, or None for a script.
    entry_point: str | None
    #: First word of `sys.argv`.
    name: str


def main(words: list[str]) -> int:
    """Runs the program that the words name; returns its exit code, or leaves by SystemExit as the program does."""
    real_ros = False
    while words and words[0].startswith("-"):
        if words[0] == "--real-ros":
            real_ros = True
        elif words[0] in ("-h", "--help"):
            print(USAGE)
            return 0
        else:
            print(f"periplus run: unknown option {words[0]}\n{USAGE}", file=sys.stderr)
            return _NOT_STARTED
        words = words[1:]
    if words and words[-1] == "--real-ros":
        real_ros, words = True, words[:-1]
    if not words:
        print(USAGE, file=sys.stderr)
        return _NOT_STARTED
    try:
        program, arguments = resolve(words)
        generation = _generation(program)
        from . import activate

        activate(real_ros=real_ros, generation=generation, quiet="PERIPLUS_QUIET" in os.environ)
    except (_packages.PackageError, ModuleNotFoundError, RuntimeError) as error:
        print(f"periplus run: {error}", file=sys.stderr)
        return _NOT_STARTED
    _prepare(program, arguments)
    from . import _faults

    _faults.install()
    if os.environ.get("PERIPLUS_LOCKSTEP") and not real_ros:
        from . import _lockstep

        _lockstep.start(os.environ["PERIPLUS_LOCKSTEP"])
    if program.entry_point is None:
        assert program.file is not None
        run_script(program.file)
        return 0
    run_entry_point(program)


def resolve(words: list[str]) -> tuple[Program, list[str]]:
    """The program and its arguments.

    Raises:
        PackageError: There is no such file, package or program; the text lists what there is.
    """
    first = words[0]
    if os.path.isfile(first):
        path = os.path.abspath(first)
        _packages.set_script(path)
        return Program(path, _packages.package_of(path), None, first), words[1:]
    if os.path.isdir(first) and os.path.isfile(os.path.join(first, "package.xml")) and os.sep in first:
        package = _packages.read_package(first)
        first = package.name if package else first
    if first.endswith(".py") or os.sep in first:
        raise _packages.PackageError(_no_file(first))
    package = _packages.find_package(first)
    if package is None:
        raise _packages.PackageError(_no_package(first))
    if len(words) < 2 or words[1].startswith("-"):
        names = ", ".join(sorted(package.executables)) or "none"
        raise _packages.PackageError(f"which program of package {first}? It has: {names}")
    found = package.executable(words[1])
    _packages.set_script(found.script or os.path.join(package.folder, "package.xml"))
    name = found.script or os.path.join(package.folder, "lib", package.name, found.name)
    file = found.script or _module_file(package, (found.entry_point or "").split(":")[0])
    return Program(file, package, found.entry_point, name), words[2:]


def _no_file(path: str) -> str:
    import difflib

    folder = os.path.dirname(path) or "."
    if not os.path.isdir(folder):
        return f"no folder {folder} (for {path})"
    close = difflib.get_close_matches(os.path.basename(path), os.listdir(folder), 1)
    return f"no file {path}" + (f". Did you mean {os.path.join(os.path.dirname(path), close[0])}?" if close else "")


def _no_package(name: str) -> str:
    import difflib

    known = sorted(_packages.known_packages())
    roots = ", ".join(_packages.search_roots())
    close = difflib.get_close_matches(name, known, 1)
    text = f"no package {name!r} (folder with a package.xml of this name) in {roots}."
    if close:
        return text + f" Did you mean {close[0]!r}?"
    if known:
        text += " There are: " + ", ".join(known[:20]) + (" ..." if len(known) > 20 else "") + "."
    return text + f" Run it in your workspace, or name the folder in {_packages.SEARCH_VARIABLE}"


def _module_file(package: _packages.Package, module: str) -> str | None:
    parts = module.split(".")
    for folder in package.python_paths:
        base = os.path.join(folder, *parts)
        for path in (base + ".py", os.path.join(base, "__init__.py")):
            if os.path.isfile(path):
                return path
    return None


def _generation(program: Program) -> int:
    """1 for programs that import rospy, otherwise 2."""
    data = b""
    if program.file is not None:
        with open(program.file, "rb") as file:
            data = file.read()
    if _ROS2_IMPORT.search(data):
        return 2
    if _ROS1_IMPORT.search(data):
        return 1
    return 1 if program.package is not None and program.package.build_type == "catkin" else 2


def _prepare(program: Program, arguments: list[str]) -> None:
    """Sets `sys.argv` and the head of `sys.path` as Python does for a script."""
    sys.argv[:] = [program.name, *arguments]
    # `python -m` puts the current folder first.
    if sys.path and sys.path[0] in ("", os.getcwd()):
        del sys.path[0]
    if program.entry_point is None:
        assert program.file is not None
        sys.path.insert(0, os.path.dirname(os.path.realpath(program.file)))
    if program.package is not None:
        front = 1 if program.entry_point is None else 0
        try:
            paths = program.package.python_paths
        except _packages.PackageError:
            # A script runs without its setup.py.
            paths = [program.package.folder]
        for path in reversed([path for path in paths if path not in sys.path]):
            sys.path.insert(front, path)
    from . import _source_modules

    _source_modules.install()


def run_script(path: str) -> None:
    """Runs a script as `__main__`. Its errors are printed without frames of Periplus and end the process with exit code 1."""
    with open(path, "rb") as file:
        source = file.read()
    if not _is_python(path, source):
        _run_foreign(path)
    module = types.ModuleType("__main__")
    namespace = module.__dict__
    from importlib.machinery import SourceFileLoader

    namespace.update(
        __file__=path, __builtins__=__builtins__, __cached__=None, __spec__=None, __loader__=SourceFileLoader("__main__", path)
    )
    sys.modules["__main__"] = module

    def run() -> None:
        exec(_compile(source, path), namespace)

    _guarded(run)


def _compile(source: bytes, path: str) -> types.CodeType:
    from . import _waiting

    if _waiting.in_lockstep():
        from . import _busy_loops

        return _busy_loops.compile_source(source, path)
    return compile(source, path, "exec", dont_inherit=True)


def _is_python(path: str, source: bytes) -> bool:
    first = source.split(b"\n", 1)[0]
    return path.endswith(".py") or not first.startswith(b"#!") or b"python" in first


def _run_foreign(path: str) -> NoReturn:
    if not os.access(path, os.X_OK):
        print(f"periplus run: {path} is no Python file and not executable (chmod +x {path})", file=sys.stderr)
        sys.exit(_NOT_STARTED)
    os.execv(path, [path, *sys.argv[1:]])


def run_entry_point(program: Program) -> NoReturn:
    """Calls an entry point; its return value is the exit code, as in the script that pip writes."""
    assert program.entry_point is not None
    module_name, _, attribute = program.entry_point.partition(":")
    result: list[Any] = []

    def run() -> None:
        import importlib

        try:
            function: Any = importlib.import_module(module_name)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{module_name}.".startswith(f"{error.name}."):
                raise
            _no_entry_module(program, error.name)
        for name in attribute.split("."):
            try:
                function = getattr(function, name)
            except AttributeError:
                _no_entry_point(program, function, name)
        result.append(function())

    _guarded(run)
    sys.exit(result[0] if result else None)


def _no_entry_module(program: Program, name: str) -> NoReturn:
    """Ends the process: the module of an entry point, or a package above it, does not exist."""
    import difflib
    import pkgutil

    parent, _, last = name.rpartition(".")
    # A folder without an `__init__.py` is a package too.
    module = sys.modules.get(parent)
    paths = sys.path if module is None else list(getattr(module, "__path__", ()))
    close = difflib.get_close_matches(last, [one.name for one in pkgutil.iter_modules(paths)], 1)
    folder = program.package.folder if program.package else "?"
    text = f"there is no Python module {name}, in which setup.py of {folder} has the program ({program.entry_point})."
    if close:
        text += f" Did you mean {parent + '.' if parent else ''}{close[0]}?"
    print(f"periplus run: {text}", file=sys.stderr)
    sys.exit(_NOT_STARTED)


def _no_entry_point(program: Program, module: Any, name: str) -> NoReturn:
    names = [key for key, value in vars(module).items() if callable(value) and not key.startswith("_")]
    folder = program.package.folder if program.package else "?"
    file = getattr(module, "__file__", module)
    text = f"{file} has no {name}, which setup.py of {folder} names as the program ({program.entry_point})."
    if names:
        text += " It has: " + ", ".join(names)
    print(f"periplus run: {text}", file=sys.stderr)
    sys.exit(_NOT_STARTED)


def _guarded(function: Any) -> None:
    """Calls `function`; an error is printed as Python does, from the user's first frame on, and ends the process."""
    try:
        function()
    except SystemExit:
        raise
    except BaseException as error:
        sys.last_type, sys.last_value, sys.last_traceback = type(error), error, error.__traceback__
        try:
            sys.excepthook(type(error), error, error.__traceback__)
        except Exception:
            sys.__excepthook__(type(error), error, error.__traceback__)
        if isinstance(error, KeyboardInterrupt):
            _end_by_interrupt()
        sys.exit(1)


def _end_by_interrupt() -> NoReturn:
    """Ends with exit code 130, as a Python program that Ctrl-C ends. atexit functions run."""
    sys.exit(130)
