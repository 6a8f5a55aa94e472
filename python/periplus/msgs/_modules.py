"""Modules of the message packages, such as ``periplus.msgs.sensor_msgs.msg``, made on import."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

from periplus import _native
from periplus.msgs import _base

_PREFIX = "periplus.msgs."
_KINDS = ("action", "msg", "srv")

# Packages with the names of their classes by kind; None until it is needed.
_index: dict[str, dict[str, list[str]]] | None = None


def _packages() -> dict[str, dict[str, list[str]]]:
    global _index
    if _index is None:
        made: dict[str, dict[str, set[str]]] = {}
        for full_name in _native.message_types() + _native.message_services():
            package, kind, name = full_name.split("/")
            made.setdefault(package, {}).setdefault(kind, set()).add(name)
        _index = {
            package: {kind: sorted(names) for kind, names in kinds.items()}
            for package, kinds in sorted(made.items())
        }
    return _index


def packages() -> list[str]:
    """Names of all packages."""
    return list(_packages())


def has_package(name: str) -> bool:
    """True if there is a package of this name."""
    return name in _packages()


def forget(changed: Iterable[str]) -> None:
    """Drop the modules of packages whose types have changed."""
    global _index
    _index = None
    for package in changed:
        for name in (package, *(f"{package}.{kind}" for kind in _KINDS)):
            sys.modules.pop(_PREFIX + name, None)
        sys.modules["periplus.msgs"].__dict__.pop(package, None)


class _Finder(MetaPathFinder, Loader):
    """Finds the modules of message packages."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if not fullname.startswith(_PREFIX):
            return None
        package, _, kind = fullname.removeprefix(_PREFIX).partition(".")
        kinds = _packages().get(package)
        if package.startswith("_") or kinds is None or (kind and kind not in kinds):
            return None
        return ModuleSpec(fullname, self, origin="periplus", is_package=not kind)

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        package, _, kind = spec.name.removeprefix(_PREFIX).partition(".")
        return _Module(spec.name, package, kind)

    def exec_module(self, module: ModuleType) -> None:
        pass


class _Module(ModuleType):
    """Module of a package, or of its messages, services or actions."""

    def __init__(self, name: str, package: str, kind: str) -> None:
        what = f"`{package}`" if not kind else f"`{package}/{kind}`"
        super().__init__(name, f"Types of {what}.")
        self.__dict__["_package"] = package
        self.__dict__["_kind"] = kind
        kinds = _packages()[package]
        self.__dict__["__all__"] = list(kinds[kind]) if kind else list(kinds)

    def __getattr__(self, name: str) -> Any:
        package, kind = self.__dict__["_package"], self.__dict__["_kind"]
        if name not in self.__dict__["__all__"]:
            if name.startswith("__"):
                raise AttributeError(name)
            near = _closest(name, self.__dict__["__all__"])
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}{near}")
        if not kind:
            import importlib

            return importlib.import_module(f"{self.__name__}.{name}")
        made: Any
        if f"{package}/{kind}/{name}" not in _services():
            made = _native.message_class(f"{package}/{kind}/{name}")
        elif kind == "srv":
            made = _base.make_service(package, kind, name)
        else:
            made = _base.make_action(package, name)
        self.__dict__[name] = made
        return made

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["__all__"]})


def _services() -> set[str]:
    return set(_native.message_services())


def _closest(name: str, known: list[str]) -> str:
    from difflib import get_close_matches

    near = get_close_matches(name, known, 1)
    return f", did you mean {near[0]!r}?" if near else ""


def install() -> None:
    """Let Python import the modules of message packages."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())
