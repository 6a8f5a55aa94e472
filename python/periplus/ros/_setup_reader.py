"""Keywords that a package's `setup.py` passes to `setup()`, read by running the file with a `setup()` that only records.

Run as a program: `python _setup_reader.py FOLDER` prints JSON. The file runs in a process of its own with its folder as current
folder, so that `glob`, `os.path.join` and helper functions in it work. Nothing is built or installed.
"""

from __future__ import annotations

import fnmatch
import importlib.abc
import importlib.machinery
import json
import os
import runpy
import sys
import types
from typing import Any

_KEPT = ("name", "version", "packages", "package_dir", "py_modules", "data_files", "entry_points", "scripts", "package_data")


def find_packages(where: str = ".", exclude: Any = (), include: Any = ("*",)) -> list[str]:
    """Dotted names of the folders with an `__init__.py` below `where`."""
    found = []
    for folder, names, files in os.walk(where):
        names[:] = sorted(name for name in names if "." not in name and name != "__pycache__")
        relative = os.path.relpath(folder, where)
        if relative == ".":
            continue
        if "__init__.py" not in files:
            names[:] = []
            continue
        dotted = relative.replace(os.sep, ".")
        if any(fnmatch.fnmatchcase(dotted, pattern) for pattern in include) and not any(
            fnmatch.fnmatchcase(dotted, pattern) for pattern in exclude
        ):
            found.append(dotted)
    return found


class _Anything:
    """Substitute for any member of a missing module: callable, has every attribute, is empty."""

    def __call__(self, *_: Any, **__: Any) -> _Anything:
        return self

    def __getattr__(self, name: str) -> _Anything:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __iter__(self) -> Any:
        return iter(())

    def __mro_entries__(self, _: Any) -> tuple[type, ...]:
        return (object,)


class _MissingModules(importlib.abc.MetaPathFinder, importlib.abc.Loader):
    """Imports modules that are not installed as empty ones: a build helper must not hide the entry points."""

    def find_spec(self, fullname: str, path: Any = None, target: Any = None) -> importlib.machinery.ModuleSpec:
        return importlib.machinery.ModuleSpec(fullname, self, is_package=True)

    def create_module(self, spec: importlib.machinery.ModuleSpec) -> types.ModuleType:
        return _stub(spec.name)

    def exec_module(self, module: types.ModuleType) -> None:
        pass


class _StubModule(types.ModuleType):
    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return _Anything()


def _stub(name: str, **members: Any) -> types.ModuleType:
    module = _StubModule(name)
    module.__path__ = []
    module.__dict__.update(members)
    return module


def read(folder: str) -> dict[str, Any]:
    """Runs `setup.py` of `folder` and returns the keywords of its last `setup()`."""
    recorded: dict[str, Any] = {}

    def setup(**keywords: Any) -> None:
        recorded.update(keywords)

    class Command:
        def __getattr__(self, name: str) -> Any:
            return _Anything()

    namespace = {"setup": setup, "find_packages": find_packages, "find_namespace_packages": find_packages, "Command": Command}
    sys.modules["setuptools"] = _stub("setuptools", Extension=_Anything(), **namespace)
    sys.modules["distutils"] = _stub("distutils")
    sys.modules["distutils.core"] = _stub("distutils.core", Extension=_Anything(), **namespace)
    sys.modules["catkin_pkg"] = _stub("catkin_pkg")
    # catkin: the keywords go through this function first.
    sys.modules["catkin_pkg.python_setup"] = _stub(
        "catkin_pkg.python_setup", generate_distutils_setup=lambda **keywords: keywords
    )
    sys.meta_path.append(_MissingModules())
    os.chdir(folder)
    sys.path.insert(0, folder)
    sys.argv[:] = ["setup.py", "install"]
    runpy.run_path(os.path.join(folder, "setup.py"), run_name="__main__")
    return {key: _plain(recorded[key]) for key in _KEPT if key in recorded}


def _plain(value: Any) -> Any:
    """`value` as JSON has it."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, (str, int, float, bool)) or value is None:
        return value
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "__iter__"):
        return [_plain(item) for item in value]
    return None


def main(folder: str) -> int:
    # Prints of the user's file must not end up in the JSON.
    answer = os.fdopen(os.dup(1), "w", encoding="utf-8")
    os.dup2(2, 1)
    try:
        result = read(folder)
    except SystemExit as error:
        result = {"error": f"setup.py ended with exit code {error.code}"}
    except BaseException as error:  # noqa: BLE001 - whatever the user's file raises is the answer
        trace, line = error.__traceback__, getattr(error, "lineno", None)
        while trace is not None:
            if os.path.basename(trace.tb_frame.f_code.co_filename) == "setup.py":
                line = trace.tb_lineno
            trace = trace.tb_next
        result = {"error": f"{type(error).__name__}: {error}", "line": line}
    json.dump(result, answer)
    answer.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1])))
