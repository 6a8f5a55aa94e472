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
