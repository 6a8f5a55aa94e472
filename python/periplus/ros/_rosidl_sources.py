"""Message packages of the user's source trees: their `.msg`, `.srv` and `.action` files, read without a build."""

from __future__ import annotations

import os
import re
import shutil
import tempfile

from periplus import _native
from periplus.ros import _packages, _rosidl
from periplus.ros._rosidl_modules import BUNDLED_FOLDER, bundled

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


def load(name: str, *, search: bool = True) -> bool:
    """Loads the package `name` and those that it needs: of the source trees, or of those that come with Periplus.

    False if there is none with definitions. `search=False` leaves out the source trees.

    Raises:
        MessageDefinitionError: A definition cannot be read.
    """
    if name in _loaded:
        return True
    wanted: dict[str, str] = {}
    _collect(name, wanted, search)
    if name not in wanted:
        return False
    _load_folders({**_loaded, **wanted}, name)
    _loaded.update(wanted)
    return True


def _folder(name: str, search: bool) -> str | None:
    package = _packages.find_package(name) if search else None
    if package is not None and has_interfaces(package.folder):
        return package.folder
    return os.path.join(BUNDLED_FOLDER, name) if name in bundled() else None


def _collect(name: str, wanted: dict[str, str], search: bool) -> None:
    folder = _folder(name, search)
    if folder is None:
        return
    wanted[name] = folder
    for needed in _dependencies(folder):
        if needed not in wanted and needed not in _loaded:
            _collect(needed, wanted, search)


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
            _link(folder, os.path.join(stage, package))
        loaded = _native.load_messages(stage)
    except _native.FileError as error:
        text = str(error)
        for package, folder in folders.items():
            text = text.replace(os.path.join(stage, package) + os.sep, folder + os.sep)
        raise MessageDefinitionError(f"message package {name!r} cannot be read:\n{text}", name=name) from None
    finally:
        shutil.rmtree(stage, ignore_errors=True)
    _rosidl.forget(loaded)


def _link(folder: str, target: str) -> None:
    try:
        os.symlink(folder, target, target_is_directory=True)
    except OSError:
        # Windows without the right to make links.
        os.mkdir(target)
        shutil.copy(os.path.join(folder, "package.xml"), target)
        for kind in _KINDS:
            if os.path.isdir(os.path.join(folder, kind)):
                shutil.copytree(os.path.join(folder, kind), os.path.join(target, kind))


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
