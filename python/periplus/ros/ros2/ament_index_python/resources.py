"""Resources of packages. Those of source trees are their names in `packages`."""

from __future__ import annotations

import os

from periplus.ros import _packages

from ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER
from ament_index_python.search_paths import get_search_paths


class InvalidResourceTypeNameError(Exception):
    """Name of a resource type that is not valid."""


class InvalidResourceNameError(Exception):
    """Name of a resource that is not valid."""


def _check(resource_type: str, resource_name: str | None = None) -> None:
    if not resource_type or os.sep in resource_type:
        raise InvalidResourceTypeNameError(f"Resource type '{resource_type}' is invalid")
    if resource_name is not None and (not resource_name or os.sep in resource_name):
        raise InvalidResourceNameError(f"Resource name '{resource_name}' is invalid")


def has_resource(resource_type: str, resource_name: str) -> str | bool:
    """Folder that has a resource, or False."""
    _check(resource_type, resource_name)
    if resource_type == "packages":
        package = _packages.find_package(resource_name)
        if package is not None:
            return os.path.dirname(package.folder)
    for prefix in get_search_paths():
        if os.path.isfile(os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name)):
            return prefix
    return False


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Content of a resource and the folder that has it; LookupError without one."""
    prefix = has_resource(resource_type, resource_name)
    if isinstance(prefix, str):
        path = os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name)
        if not os.path.isfile(path):
            return "", prefix
        with open(path, encoding="utf-8") as file:
            return file.read(), prefix
    raise LookupError(f"Could not find the resource '{resource_name}' of type '{resource_type}'")


def get_resources(resource_type: str) -> dict[str, str]:
    """Names of the resources of a type, with the folders that have them."""
    _check(resource_type)
    found: dict[str, str] = {}
    if resource_type == "packages":
        found.update({name: os.path.dirname(one.folder) for name, one in _packages.known_packages().items()})
    for prefix in get_search_paths():
        folder = os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type)
        for name in sorted(os.listdir(folder)) if os.path.isdir(folder) else []:
            if os.path.isfile(os.path.join(folder, name)) and not name.startswith("."):
                found.setdefault(name, prefix)
    return found


def get_resource_types() -> set[str]:
    """Names of all resource types."""
    found = {"packages"}
    for prefix in get_search_paths():
        folder = os.path.join(prefix, RESOURCE_INDEX_SUBFOLDER)
        found.update(os.listdir(folder) if os.path.isdir(folder) else [])
    return found
