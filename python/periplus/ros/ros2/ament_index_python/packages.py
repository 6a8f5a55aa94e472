"""Folders of packages."""

from __future__ import annotations

import os
import re
from pathlib import Path

from periplus.ros import _packages

from ament_index_python.resources import get_resources, has_resource
from ament_index_python.search_paths import get_search_paths


class PackageNotFoundError(KeyError):
    """Package that was not found."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def _not_found(name: str) -> PackageNotFoundError:
    from difflib import get_close_matches

    roots = [*_packages.search_roots(), *get_search_paths()]
    text = f"package '{name}' not found, searching: [{', '.join(repr(root) for root in roots)}]"
    near = get_close_matches(name, list(_packages.known_packages()), 1)
    return PackageNotFoundError(f"{text}. Did you mean '{near[0]}'?" if near else text)


def get_packages_with_prefixes() -> dict[str, str]:
    """Names of all packages, with the folders that have them."""
    return get_resources("packages")


def get_package_prefix(package_name: str) -> str:
    """Folder `P` such that the package's files are in `P/share/<package>`; PackageNotFoundError without the package."""
    if re.fullmatch("[A-Za-z0-9_-]+", package_name or "") is None:
        raise ValueError(f"'{package_name}' is not a valid package name")
    package = _packages.find_package(package_name)
    if package is not None:
        share = package.share_folder
        tail = os.path.join("share", package_name)
        return share[: -len(tail) - 1] if share.endswith(os.sep + tail) else os.path.dirname(package.folder)
    prefix = has_resource("packages", package_name)
    if not isinstance(prefix, str):
        raise _not_found(package_name)
    return prefix


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Folder of the package's files; PackageNotFoundError without the package."""
    prefix = get_package_prefix(package_name)
    package = _packages.find_package(package_name)
    return package.share_folder if package is not None else os.path.join(prefix, "share", package_name)


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Folder of the package's files; PackageNotFoundError without the package."""
    return Path(get_package_share_directory(package_name, print_warning))
