"""`.cfg` files of source trees: they are run, and what they declare becomes a module `package.cfg.NameConfig`."""

from __future__ import annotations

import os
from functools import cache
from typing import Any


@cache
def files(package: str) -> tuple[str, ...]:
    """Paths of the `.cfg` files of a package."""
    from periplus.ros import _packages

    found = _packages.find_package(package)
    if found is None:
        return ()
    folder = os.path.join(found.folder, "cfg")
    if not os.path.isdir(folder):
        return ()
    return tuple(os.path.join(folder, one) for one in sorted(os.listdir(folder)) if one.endswith(".cfg"))


@cache
def modules(package: str) -> dict[str, str]:
    """Names of the configuration modules of a package with their files."""
    return {os.path.basename(path)[:-4] + "Config": path for path in files(package)}


def config_module(package: str, name: str) -> dict[str, Any]:
    """Contents of the module of a `.cfg` file. Raises `ImportError` with the line if the file fails."""
    path = modules(package)[name]
    generator = _run(path)
    groups = generator.group.to_dict()
    defaults: dict[str, Any] = {}
    low: dict[str, Any] = {}
    high: dict[str, Any] = {}
    types: dict[str, str] = {}
    level: dict[str, int] = {}
    for group in generator.groups:
        for one in group.parameters:
            key = one["name"]
            defaults[key], low[key], high[key] = one["default"], one["min"], one["max"]
            types[key], level[key] = one["type"], one["level"]
    whole = 0
    for one in level.values():
        whole |= one
    return {
        "config_description": groups,
        "min": low,
        "max": high,
        "defaults": defaults,
        "level": level,
        "type": types,
        "all_level": whole,
        **{f"{name[:-6]}_{key}": value for key, value in generator._constants.items()},
    }


def _run(path: str) -> Any:
    from dynamic_reconfigure.parameter_generator import ParameterGenerator

    ParameterGenerator.finished.clear()
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            code = compile(file.read(), path, "exec")
        exec(code, {"__name__": "__main__", "__file__": path, "exit": _exit})
    except SystemExit:
        pass
    except Exception as error:
        line = _line_of(error, path)
        raise ImportError(f"{path}{line}: {type(error).__name__}: {error}") from None
    if not ParameterGenerator.finished:
        raise ImportError(f"{path}: the file declares nothing: it does not call gen.generate(...)")
    return ParameterGenerator.finished[-1][0]


def _exit(code: Any = None) -> None:
    raise SystemExit(code)


def _line_of(error: BaseException, path: str) -> str:
    if isinstance(error, SyntaxError):
        return f":{error.lineno}"
    trace, line = error.__traceback__, None
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == path:
            line = trace.tb_lineno
        trace = trace.tb_next
    return f":{line}" if line else ""
