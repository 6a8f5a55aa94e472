"""Stand-ins for `launch` and its kin in the process of the tests, where descriptions are read but not run."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

_ROOTS = ("launch", "launch_ros", "launch_xml", "launch_yaml", "nav2_common", "launch_testing_ros")


class Recorded:
    """Object that keeps the arguments it was made with."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        self.arguments = args
        self.keywords = kwargs

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return Recorded()

    def __call__(self, *args: Any, **kwargs: Any) -> Any:
        return Recorded(*args, **kwargs)

    def process_names(self) -> list[str]:
        """Names under which the process of this action may appear."""
        names = [self.keywords.get("name"), self.keywords.get("executable")]
        command = self.keywords.get("cmd")
        if isinstance(command, (list, tuple)):
            names += [one for one in command if isinstance(one, str)]
        return [str(one).rsplit("/", 1)[-1] for one in names if isinstance(one, str) and one]


class _Module(ModuleType):
    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        made = type(name, (Recorded,), {"__module__": self.__name__})
        setattr(self, name, made)
        return made


class _Finder(MetaPathFinder, Loader):
    def find_spec(
        self, fullname: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        return ModuleSpec(fullname, self, is_package=True) if fullname.split(".")[0] in _ROOTS else None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        pass


def install() -> None:
    """Lets Python import the stand-ins."""
    if not any(isinstance(finder, _Finder) for finder in sys.meta_path):
        sys.meta_path.insert(0, _Finder())
