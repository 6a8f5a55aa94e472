"""Imports of Python packages of the same workspace that are not built."""

from __future__ import annotations

import importlib.machinery
import os
import sys
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence


class SourceModuleFinder:
    """Finds modules of source packages after every other finder has failed."""

    def find_spec(
        self, fullname: str, path: Sequence[str] | None = None, target: Any = None
    ) -> importlib.machinery.ModuleSpec | None:
        if "." in fullname or path is not None or fullname in sys.stdlib_module_names:
            return None
        for folder in python_folders(fullname):
            spec = importlib.machinery.PathFinder.find_spec(fullname, [folder])
            if spec is not None and spec.origin is not None:
                if folder not in sys.path:
                    sys.path.append(folder)
                return spec
        return None


def python_folders(module: str) -> list[str]:
    """Folders of known source packages that hold the Python module `module`."""
    from . import _packages

    found = []
    for package in _packages.known_packages().values():
        # Cheap looks first: reading setup.py starts a process.
        for folder in (package.folder, os.path.join(package.folder, "src"), os.path.join(package.folder, "python")):
            if os.path.isfile(os.path.join(folder, module, "__init__.py")) or os.path.isfile(os.path.join(folder, module + ".py")):
                found.append(folder)
    named = _packages.find_package(module)
    if named is not None and not found:
        try:
            found += named.python_paths
        except _packages.PackageError:
            pass
    return found


def install() -> None:
    """Adds the finder behind the one of `sys.path`, once."""
    if any(isinstance(finder, SourceModuleFinder) for finder in sys.meta_path):
        return
    after = [number for number, finder in enumerate(sys.meta_path) if finder is importlib.machinery.PathFinder]
    sys.meta_path.insert(after[-1] + 1 if after else len(sys.meta_path), SourceModuleFinder())
