"""Packages of the source tree."""

from __future__ import annotations

import os
import re
from typing import Any

from periplus.ros import _packages

__version__ = "1.5.0"


class ResourceNotFound(Exception):
    """A package that is in no source tree."""

    def __init__(self, msg: str, ros_paths: list[str] | None = None) -> None:
        super().__init__(msg)
        self.ros_paths = ros_paths

    def __str__(self) -> str:
        text = str(self.args[0])
        for number, path in enumerate(self.ros_paths or ()):
            text += f"\nROS path [{number}]={path}"
        return text


class InvalidManifest(Exception):
    """A package.xml that cannot be read."""


class Manifest:
    """What a package.xml says."""

    def __init__(self, name: str, folder: str) -> None:
        self.name = name
        self.filename = os.path.join(folder, "package.xml")
        with open(self.filename, encoding="utf-8", errors="replace") as file:
            text = re.sub(r"<!--.*?-->", "", file.read(), flags=re.S)
        self.version = _element(text, "version")
        self.description = _element(text, "description")
        self.license = _element(text, "license")
        self.author = _element(text, "author") or _element(text, "maintainer")
        self.depends = sorted(
            set(re.findall(r"<(?:build_|exec_|run_|build_export_)?depend\b[^>]*>\s*([^<\s]+)\s*<", text))
        )

    def get_export(self, tag: str, attr: str) -> list[str]:
        with open(self.filename, encoding="utf-8", errors="replace") as file:
            return re.findall(rf"<{re.escape(tag)}\b[^>]*\b{re.escape(attr)}=\"([^\"]*)\"", file.read())


def _element(text: str, name: str) -> str:
    found = re.search(rf"<{name}\b[^>]*>(.*?)</{name}>", text, re.S)
    return found.group(1).strip() if found else ""


class RosPack:
    """Finds packages by their names."""

    def __init__(self, ros_paths: list[str] | None = None) -> None:
        self._paths = ros_paths

    @staticmethod
    def get_instance(ros_paths: list[str] | None = None) -> RosPack:
        return RosPack(ros_paths)

    @property
    def ros_paths(self) -> list[str]:
        return list(self._paths) if self._paths else get_ros_paths()

    def _known(self) -> dict[str, Any]:
        found = dict(_packages.known_packages())
        paths = [one for one in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if one]
        more = _packages.find_packages(list(self._paths) if self._paths else paths)
        return {**more, **found} if not self._paths else more

    def list(self) -> list[str]:
        """Names of all packages."""
        return sorted(self._known())

    def get_path(self, name: str) -> str:
        """Folder of a package. Raises `ResourceNotFound` without one."""
        package = None if self._paths else _packages.find_package(name)
        if package is None:
            package = self._known().get(name)
        if package is None:
            raise ResourceNotFound(name, ros_paths=self.ros_paths)
        return str(package.folder)

    def get_manifest(self, name: str) -> Manifest:
        """What the package.xml of a package says."""
        return Manifest(name, self.get_path(name))

    def get_depends(self, name: str, implicit: bool = True) -> list[str]:
        """Names of the packages that a package needs."""
        found: list[str] = []
        wanted = list(self.get_manifest(name).depends)
        while wanted:
            one = wanted.pop(0)
            if one in found:
                continue
            found.append(one)
            if implicit and one in self._known():
                wanted += self.get_manifest(one).depends
        return found

    def get_depends_on(self, name: str, implicit: bool = True) -> list[str]:
        """Names of the packages that need a package."""
        return [one for one in self.list() if name in self.get_depends(one, implicit)]


class RosStack(RosPack):
    """Finds metapackages by their names."""


def get_ros_paths(env: Any = None) -> list[str]:
    """Folders that are searched for packages."""
    given = (env or os.environ).get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    return [*_packages.search_roots(), *(one for one in given if one)]


get_ros_package_path = get_ros_paths


def get_package_name(path: str) -> str | None:
    """Name of the package that a path is in, or None."""
    package = _packages.package_of(os.path.realpath(path))
    return package.name if package is not None else None


def on_ros_path(p: str) -> bool:
    """True for a path below a folder that is searched for packages."""
    full = os.path.realpath(p)
    return any(full.startswith(os.path.realpath(one)) for one in get_ros_paths())


def get_ros_root(env: Any = None) -> str | None:
    return (env or os.environ).get("ROS_ROOT")


def get_ros_home(env: Any = None) -> str:
    """Folder for files of ROS: ROS_HOME or ~/.ros."""
    return str((env or os.environ).get("ROS_HOME") or os.path.join(os.path.expanduser("~"), ".ros"))


def get_log_dir(env: Any = None) -> str:
    """Folder for logs."""
    return str((env or os.environ).get("ROS_LOG_DIR") or os.path.join(get_ros_home(env), "log"))


def get_test_results_dir(env: Any = None) -> str:
    """Folder for results of tests."""
    return str((env or os.environ).get("ROS_TEST_RESULTS_DIR") or os.path.join(get_ros_home(env), "test_results"))
