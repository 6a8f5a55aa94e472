"""Share directories of packages that are not installed."""

from __future__ import annotations

import hashlib
import os
import tempfile
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._packages import Package

_folders: dict[str, str] = {}


def share_folder(package: Package) -> str:
    """The package's source folder, if a build would keep its layout; otherwise a folder of links in the build's layout.

    Links point to the source files, so that an edit needs no build. Files that a build does not install are linked too.
    """
    known = _folders.get(package.folder)
    if known is None:
        known = _folders[package.folder] = _make(package)
    return known


def _make(package: Package) -> str:
    moved = []
    for target, source in package.shared_files:
        in_place = os.path.normpath(os.path.join(package.folder, target))
        if in_place != source and os.path.exists(source):
            moved.append((target, source))
    if not moved:
        return package.folder
    key = hashlib.sha256(repr((package.folder, sorted(package.shared_files))).encode()).hexdigest()[:16]
    user = os.getuid() if hasattr(os, "getuid") else "user"
    root = os.path.join(tempfile.gettempdir(), f"periplus-share-{user}", key, "share", package.name)
    os.makedirs(root, mode=0o700, exist_ok=True)
    _link_all(root, package.folder, package.shared_files)
    return root


def _link_all(root: str, folder: str, pairs: list[tuple[str, str]]) -> None:
    for target, source in pairs:
        if not os.path.exists(source):
            continue
        if os.path.isdir(source):
            for inner, _, files in os.walk(source):
                base = os.path.normpath(os.path.join(root, target, os.path.relpath(inner, source)))
                for name in files:
                    _link(os.path.join(inner, name), os.path.join(base, name))
        else:
            _link(source, os.path.join(root, target))
    for entry in os.listdir(folder):
        if not entry.startswith(".") and not os.path.lexists(os.path.join(root, entry)):
            _link(os.path.join(folder, entry), os.path.join(root, entry))


def _link(source: str, target: str) -> None:
    if os.path.islink(target) and os.readlink(target) == source:
        return
    os.makedirs(os.path.dirname(target), exist_ok=True)
    # Several processes may make the same link at once.
    temporary = f"{target}.{os.getpid()}"
    os.symlink(source, temporary)
    os.replace(temporary, target)
