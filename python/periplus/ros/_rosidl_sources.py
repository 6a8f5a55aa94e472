"""Message packages of the user's source trees: their `.msg`, `.srv` and `.action` files, read without a build."""

from __future__ import annotations

import os
import re
import shutil
import tempfile

from periplus import _native
from periplus.ros import _packages, _rosidl

_KINDS = ("action", "msg", "srv")

# Folders of the packages that are loaded, by name.
_loaded: dict[str, str] = {}


class MessageDefinitionError(ImportError):
    """A definition of the user's that cannot be read; the text names its file and line."""


def has_interfaces(folder: str) -> bool:
    """True for a package folder with definitions in `msg`, `srv` or `action`."""
    for kind in _KINDS:
        try:
            names = os.listdir(os.path.join(folder, kind))
        except OSError:
            continue
        if any(name.endswith((f".{kind}", ".idl")) for name in names):
            return True
    return os.path.isdir(os.path.join(folder, "idl"))


def is_loaded(name: str) -> bool:
    """True for a package that `load` has read."""
    return name in _loaded


def load(name: str) -> bool:
    """Loads the package `name` of the source trees, and those that it needs. False if there is none with definitions.

    Raises:
        MessageDefinitionError: A definition cannot be read.
    """
    if name in _loaded:
        return True
    package = _packages.find_package(name)
    if package is None or not has_interfaces(package.folder):
        return False
    wanted: dict[str, str] = {}
    _collect(package, wanted)
    _load_folders({**_loaded, **wanted}, name)
    _loaded.update(wanted)
    return True


def _collect(package: _packages.Package, wanted: dict[str, str]) -> None:
    wanted[package.name] = package.folder
    for needed in _dependencies(package.folder):
        if needed in wanted or needed in _loaded:
            continue
        other = _packages.find_package(needed)
        if other is not None and has_interfaces(other.folder):
            _collect(other, wanted)


def _dependencies(folder: str) -> list[str]:
    with open(os.path.join(folder, "package.xml"), encoding="utf-8", errors="replace") as file:
        text = re.sub(r"<!--.*?-->", "", file.read(), flags=re.S)
    return re.findall(r"<(?:build_|exec_|run_|build_export_)?depend\b[^>]*>\s*([^<\s]+)\s*<", text)


def _load_folders(folders: dict[str, str], name: str) -> None:
    """Reads all packages at once, through a folder of links to them."""
    _refuse_idl(folders[name], name)
    stage = os.path.realpath(tempfile.mkdtemp(prefix="periplus-messages-"))
    try:
        for package, folder in folders.items():
            os.symlink(folder, os.path.join(stage, package), target_is_directory=True)
        loaded = _native.load_messages(stage)
    except _native.FileError as error:
        text = str(error)
        for package, folder in folders.items():
            text = text.replace(os.path.join(stage, package) + os.sep, folder + os.sep)
        raise MessageDefinitionError(f"message package {name!r} cannot be read:\n{text}", name=name) from None
    finally:
        shutil.rmtree(stage, ignore_errors=True)
    _rosidl.forget(loaded)


def _refuse_idl(folder: str, name: str) -> None:
    for kind in (*_KINDS, "idl"):
        path = os.path.join(folder, kind)
        names = sorted(os.listdir(path)) if os.path.isdir(path) else []
        for file in names:
            if file.endswith(".idl") and (kind == "idl" or f"{file[:-4]}.{kind}" not in names):
                raise MessageDefinitionError(
                    f"{os.path.join(path, file)}:1: message package {name!r} has a definition in IDL. Periplus reads .msg, .srv "
                    "and .action files: write the definition as one of these",
                    name=name,
                )
