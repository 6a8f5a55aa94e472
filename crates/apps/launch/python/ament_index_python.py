"""Replacement of `ament_index_python`: packages are found by their package.xml."""
import os

from . import packages  # noqa: F401
from .packages import (  # noqa: F401
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_package_share_path,
    get_packages_with_prefixes,
)

AMENT_PREFIX_PATH_ENV_VAR = "AMENT_PREFIX_PATH"
RESOURCE_INDEX_SUBFOLDER = "share/ament_index/resource_index"


class InvalidResourceTypeNameError(ValueError):
    """A type of resources that can have no name like this."""


class InvalidResourceNameError(ValueError):
    """A resource that can have no name like this."""


def get_search_paths():
    paths = os.environ.get(AMENT_PREFIX_PATH_ENV_VAR, "").split(os.pathsep)
    return [path for path in paths if os.path.isdir(path)]


def _resource(resource_type, resource_name):
    for path in get_search_paths():
        file = os.path.join(path, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name)
        if os.path.isfile(file):
            return file, path
    return None


def has_resource(resource_type, resource_name):
    if resource_type == "packages" and resource_name in get_packages_with_prefixes():
        return get_package_prefix(resource_name)
    found = _resource(resource_type, resource_name)
    return found[1] if found else False


def get_resource(resource_type, resource_name):
    if resource_type == "packages" and resource_name in get_packages_with_prefixes():
        return "", get_package_prefix(resource_name)
    found = _resource(resource_type, resource_name)
    if found is None:
        raise LookupError(
            f"Could not find the resource '{resource_name}' of type '{resource_type}'"
        )
    with open(found[0], encoding="utf-8") as file:
        return file.read(), found[1]


def get_resources(resource_type):
    if resource_type == "packages":
        return get_packages_with_prefixes()
    resources = {}
    for path in get_search_paths():
        folder = os.path.join(path, RESOURCE_INDEX_SUBFOLDER, resource_type)
        if os.path.isdir(folder):
            for name in os.listdir(folder):
                resources.setdefault(name, path)
    return resources


def get_resource_types():
    types = {"packages"}
    for path in get_search_paths():
        folder = os.path.join(path, RESOURCE_INDEX_SUBFOLDER)
        if os.path.isdir(folder):
            types.update(os.listdir(folder))
    return types


# `packages` has these names too.
packages.get_resource = get_resource
packages.get_resources = get_resources
packages.get_search_paths = get_search_paths
