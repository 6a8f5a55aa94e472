"""Folders of packages."""

from __future__ import annotations

from rospkg import ResourceNotFound as InvalidROSPkgException
from rospkg import RosPack
from rospkg import get_package_name as get_dir_pkg_name


def get_pkg_dir(package: str, required: bool = True, ros_root: str | None = None) -> str | None:
    """Folder of a package."""
    try:
        return RosPack().get_path(package)
    except InvalidROSPkgException:
        if required:
            raise
        return None


def get_dir_pkg(d: str) -> tuple[str | None, str | None]:
    """Folder and name of the package that a folder is in."""
    name = get_dir_pkg_name(d)
    return (get_pkg_dir(name), name) if name else (None, None)


def list_pkgs() -> list[str]:
    """Names of all packages."""
    return RosPack().list()


class ROSPkgException(Exception):
    """A package or a file of it that cannot be found."""


def find_node(pkg: str, node_type: str, rospack: object = None) -> list[str]:
    """Paths of the programs of a package with a name."""
    return _find(pkg, node_type, needs_execution=True)


def find_resource(pkg: str, resource_name: str, filter_fn: object = None, rospack: object = None) -> list[str]:
    """Paths of the files of a package with a name."""
    return _find(pkg, resource_name, needs_execution=False)


def _find(pkg: str, name: str, *, needs_execution: bool) -> list[str]:
    import os

    folder = get_pkg_dir(pkg)
    assert folder is not None
    found = []
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(one for one in folders if not one.startswith("."))
        path = os.path.join(place, name)
        if name in files and (not needs_execution or os.access(path, os.X_OK)):
            found.append(path)
    return found
