"""Import of message packages with the conventions of ROS 1: `std_msgs.msg`, `std_srvs.srv`, `my_package.cfg`."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

_KINDS = ("msg", "srv")
#: Packages with a module `msg` or `service` of their own.
_PYTHON_ONLY = frozenset(("genpy", "rospy"))


class _Loader(Loader):
    def create_module(self, spec: ModuleSpec) -> ModuleType:
        if "." not in spec.name:
            return ModuleType(spec.name, f"Message package {spec.name}.")
        return KindModule(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        pass


class _ConfigLoader(Loader):
    """Runs a `.cfg` file of dynamic_reconfigure and gives its module the names that programs use."""

    def create_module(self, spec: ModuleSpec) -> None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        from dynamic_reconfigure import _cfg_files

        package, _, name = module.__name__.split(".")
        module.__dict__.update(_cfg_files.config_module(package, name))


_loader = _Loader()
_config_loader = _ConfigLoader()


class _Finder(MetaPathFinder):
    """Finds the message modules of all packages, before any folder of that name."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        package, _, rest = fullname.partition(".")
        if package in _PYTHON_ONLY:
            return None
        if rest in _KINDS:
            from periplus.ros import _genpy_sources

            if not _genpy_sources.names(package, rest):
                return None
            return ModuleSpec(fullname, _loader, origin="periplus", is_package=True)
        if rest == "cfg" or rest.startswith("cfg.") and rest.count(".") == 1:
            return _config_spec(fullname, package, rest)
        return None


def _config_spec(fullname: str, package: str, rest: str) -> ModuleSpec | None:
    from dynamic_reconfigure import _cfg_files

    if rest == "cfg":
        if not _cfg_files.files(package):
            return None
        return ModuleSpec(fullname, _EmptyLoader(), origin="periplus", is_package=True)
    if rest[4:] not in _cfg_files.modules(package):
        return None
    return ModuleSpec(fullname, _config_loader, origin=_cfg_files.modules(package)[rest[4:]])


class _EmptyLoader(Loader):
    def create_module(self, spec: ModuleSpec) -> None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        pass


class _LastFinder(MetaPathFinder):
    """Finds packages that have nothing but messages."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if "." in fullname or fullname.startswith("_") or fullname in sys.stdlib_module_names:
            return None
        from periplus.ros import _genpy_sources, _packages

        if _genpy_sources.is_known(fullname):
            return ModuleSpec(fullname, _loader, origin="periplus", is_package=True)
        package = _packages.find_package(fullname)
        if package is not None:
            import os

            found = PathFinder.find_spec(fullname, [os.path.join(package.folder, "src")])
            if found is not None and found.origin is not None:
                return found
            if os.path.isdir(os.path.join(package.folder, "cfg")):
                return ModuleSpec(fullname, _loader, origin="periplus", is_package=True)
        return None


class KindModule(ModuleType):
    """Module of the messages or services of a package, such as `std_msgs.msg`."""

    def __init__(self, name: str) -> None:
        super().__init__(name, f"Types of `{name.replace('.', '/')}`.")
        self.__path__: list[str] = []

    def __getattr__(self, name: str) -> Any:
        package, _, kind = self.__name__.partition(".")
        if name == "__all__":
            found: Any = self._names()
        elif name.startswith("__"):
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")
        elif name not in self._names():
            raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}{self._hint(name)}")
        else:
            found = _class_of(package, kind, name)
        self.__dict__[name] = found
        return found

    def _names(self) -> list[str]:
        from periplus.ros import _genpy_sources

        package, _, kind = self.__name__.partition(".")
        names = _genpy_sources.names(package, kind)
        if kind == "msg":
            return names
        return [one + ending for one in names for ending in ("", "Request", "Response")]

    def _hint(self, name: str) -> str:
        from difflib import get_close_matches

        near = get_close_matches(name, self._names(), 1, 0.75)
        return f". Did you mean {near[0]!r}?" if near else ""

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self._names()})


def _class_of(package: str, kind: str, name: str) -> Any:
    from periplus.ros import _genpy, _genpy_sources

    if kind == "msg":
        return _genpy.message_class(f"{package}/msg/{name}")
    services = _genpy_sources.names(package, "srv")
    if name in services:
        return _genpy.service_class(package, name)
    for ending in ("Request", "Response"):
        if name.endswith(ending) and name[: -len(ending)] in services:
            return _genpy.message_class(f"{package}/srv/{name[: -len(ending)]}_{ending}")
    raise AttributeError(name)


def install() -> None:
    """Lets Python import message packages with the conventions of ROS 1."""
    if any(isinstance(finder, _Finder) for finder in sys.meta_path):
        return
    sys.meta_path.insert(0, _Finder())
    sys.meta_path.append(_LastFinder())


def uninstall() -> None:
    """Takes the import hook away; modules that were imported stay."""
    sys.meta_path[:] = [one for one in sys.meta_path if not isinstance(one, (_Finder, _LastFinder))]
