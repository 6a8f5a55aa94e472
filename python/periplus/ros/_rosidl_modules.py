"""Import of message packages by their ROS names: `std_msgs.msg`, `std_srvs.srv`, packages of the user's source tree."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec, PathFinder
from types import ModuleType
from typing import Any

from periplus import _native

_KINDS = ("action", "msg", "srv")
_SUFFIXES = ("_msgs", "_srvs", "_interfaces")

# Packages whose definitions are the same everywhere. A source tree is not searched for them.
_CORE = frozenset((
    "action_msgs", "builtin_interfaces", "diagnostic_msgs", "example_interfaces", "geometry_msgs", "lifecycle_msgs", "nav_msgs",
    "rcl_interfaces", "rosgraph_msgs", "sensor_msgs", "service_msgs", "shape_msgs", "std_msgs", "std_srvs", "tf2_msgs",
    "trajectory_msgs", "type_description_interfaces", "unique_identifier_msgs", "visualization_msgs",
))  # fmt: skip

#: Folder of the packages whose definitions come with Periplus as files.
BUNDLED_FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "interfaces")

_bundled: frozenset[str] | None = None

# Packages with the names of their classes by kind; None until it is needed.
_index: dict[str, dict[str, list[str]]] | None = None
_wholes: frozenset[str] = frozenset()


def bundled() -> frozenset[str]:
    """Names of the packages in `BUNDLED_FOLDER`."""
    global _bundled
    if _bundled is None:
        _bundled = frozenset(entry.name for entry in os.scandir(BUNDLED_FOLDER) if entry.is_dir())
    return _bundled


def packages() -> dict[str, dict[str, list[str]]]:
    """Names of the classes of each package, by kind."""
    global _index, _wholes
    if _index is None:
        _wholes = frozenset(_native.message_services())
        made: dict[str, dict[str, set[str]]] = {}
        for full_name in (*_native.message_types(), *_wholes):
            package, kind, name = full_name.split("/")
            made.setdefault(package, {}).setdefault(kind, set()).add(name)
        _index = {package: {kind: sorted(names) for kind, names in kinds.items()} for package, kinds in made.items()}
    return _index


_is_loading = False


def _load(name: str) -> bool:
    """Loads a package of the source trees, or one that comes with Periplus as files; True if there is one."""
    global _index, _is_loading
    if _is_loading:
        return False
    _is_loading = True
    try:
        from periplus.ros import _rosidl_sources

        if not _rosidl_sources.is_loaded(name):
            if not _rosidl_sources.load(name, search=name not in _CORE):
                return False
            _index = None
    finally:
        _is_loading = False
    return True


class _Loader(Loader):
    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return _MODULES[spec.name.count(".")](spec.name)

    def exec_module(self, module: ModuleType) -> None:
        pass


_loader = _Loader()


def _spec(name: str, is_package: bool) -> ModuleSpec:
    return ModuleSpec(name, _loader, origin="periplus", is_package=is_package)


class _Finder(MetaPathFinder):
    """Finds the packages that Periplus has, and the types of all packages."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        package, _, rest = fullname.partition(".")
        if not rest:
            if package not in packages() and package not in bundled() or _is_users_module(package):
                return None
            if package not in _CORE or package in bundled():
                _load(package)
            return _spec(fullname, True)
        kind, _, module = rest.partition(".")
        if kind not in _KINDS:
            return None
        if not module:
            if package not in _CORE and package not in _loaded_builtin() and not _load(package):
                return None
            return _spec(fullname, True) if kind in packages().get(package, {}) else None
        parent = sys.modules.get(f"{package}.{kind}")
        return _spec(fullname, False) if isinstance(parent, KindModule) and module in parent.files() else None


def _loaded_builtin() -> dict[str, Any]:
    """Packages whose top module is ours, so that the search of the source tree is over."""
    known = packages()
    return {name: None for name in known if isinstance(sys.modules.get(name), PackageModule)}


def _is_users_module(name: str) -> bool:
    """True for a Python module of the user's that has the name of a message package, such as `bond.py`."""
    if name.endswith(_SUFFIXES):
        return False
    found = PathFinder.find_spec(name)
    if found is None or found.origin is None or found.loader is None:
        return False
    folder = os.path.dirname(found.origin)
    is_package = os.path.basename(found.origin) == "__init__.py"
    return not (is_package and any(os.path.isfile(os.path.join(folder, kind, "__init__.py")) for kind in _KINDS))


class _LastFinder(MetaPathFinder):
    """Finds packages of the user's source tree that no other finder knows."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if "." in fullname or fullname.startswith("_") or fullname in sys.stdlib_module_names:
            return None
        if _load(fullname) and fullname in packages():
            return _spec(fullname, True)
        if fullname.endswith(_SUFFIXES):
            raise ModuleNotFoundError(_missing(fullname), name=fullname)
        return None


def _missing(name: str) -> str:
    from difflib import get_close_matches

    text = f"No module named {name!r}: Periplus has no message package of this name, and no folder with its package.xml was found"
    near = get_close_matches(name, [*packages(), *bundled()], 1, 0.75)
    if near:
        return f"{text}. Did you mean {near[0]!r}?"
    return f"{text}. Put the package beside your own, or name its folder in PERIPLUS_PACKAGES"


class PackageModule(ModuleType):
    """Module of a package, such as `std_msgs`."""

    def __init__(self, name: str) -> None:
        super().__init__(name, f"Types of `{name}`.")

    def __getattr__(self, name: str) -> Any:
        if name in _KINDS and name in packages()[self.__name__]:
            import importlib

            return importlib.import_module(f"{self.__name__}.{name}")
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *packages()[self.__name__]})


class KindModule(ModuleType):
    """Module of the messages, services or actions of a package, such as `std_msgs.msg`."""

    def __init__(self, name: str) -> None:
        super().__init__(name, f"Types of `{name.replace('.', '/')}`.")
        package, _, kind = name.partition(".")
        self.__dict__["_type_names"] = names = packages()[package][kind]
        wholes = [one for one in names if f"{package}/{kind}/{one}" in _wholes]
        self.__dict__["__all__"] = wholes if kind != "msg" else list(names)

    def __getattr__(self, name: str) -> Any:
        if name in self.__dict__["_type_names"]:
            made = self.__dict__[name] = _class_of(self.__name__, name)
            return made
        if name.startswith("_") and not name.startswith("__") and name in self.files():
            import importlib

            return importlib.import_module(f"{self.__name__}.{name}")
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")

    def __dir__(self) -> list[str]:
        return sorted({*self.__dict__, *self.__dict__["_type_names"]})

    def files(self) -> dict[str, list[str]]:
        """Modules of single types, such as `_string`, with the names of their classes."""
        made: dict[str, list[str]] | None = self.__dict__.get("_files")
        if made is None:
            from periplus.ros._rosidl import _whole, snake_case

            kind = self.__name__.partition(".")[2]
            made = self.__dict__["_files"] = {}
            for name in self.__dict__["_type_names"]:
                made.setdefault("_" + snake_case(_whole(name, kind)), []).append(name)
        return made


class FileModule(ModuleType):
    """Module of one type, such as `std_msgs.msg._string`."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        parent, _, module = name.rpartition(".")
        self.__dict__["__all__"] = sys.modules[parent].files()[module]

    def __getattr__(self, name: str) -> Any:
        parent = sys.modules[self.__name__.rpartition(".")[0]]
        if name in self.__dict__["__all__"]:
            made = self.__dict__[name] = getattr(parent, name)
            return made
        if name.startswith("Metaclass_") and name.removeprefix("Metaclass_") in self.__dict__["__all__"]:
            return type(getattr(parent, name.removeprefix("Metaclass_")))
        raise AttributeError(f"module {self.__name__!r} has no attribute {name!r}")


_MODULES: tuple[type[ModuleType], ...] = (PackageModule, KindModule, FileModule)


def _class_of(module: str, name: str) -> type:
    from periplus.ros import _rosidl

    package, _, kind = module.partition(".")
    type_name = f"{package}/{kind}/{name}"
    if type_name not in _wholes:
        return _rosidl.message_class(type_name)
    return _rosidl.service_class(type_name) if kind == "srv" else _rosidl.action_class(type_name)


def install(generation: int = 2) -> None:
    """Lets Python import message packages by their ROS names (generation 2)."""
    if generation != 2 or any(isinstance(finder, _Finder) for finder in sys.meta_path):
        return
    sys.meta_path.insert(0, _Finder())
    sys.meta_path.append(_LastFinder())


def uninstall() -> None:
    """Takes the import hook away; modules that were imported stay."""
    sys.meta_path[:] = [one for one in sys.meta_path if not isinstance(one, (_Finder, _LastFinder))]
