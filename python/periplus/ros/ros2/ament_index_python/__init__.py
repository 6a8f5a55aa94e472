"""Folders of packages: source trees, and installed ones by `AMENT_PREFIX_PATH`."""

from ament_index_python.constants import (
    AMENT_PREFIX_PATH_ENV_VAR as AMENT_PREFIX_PATH_ENV_VAR,
    RESOURCE_INDEX_SUBFOLDER as RESOURCE_INDEX_SUBFOLDER,
)
from ament_index_python.packages import (
    PackageNotFoundError as PackageNotFoundError,
    get_package_prefix as get_package_prefix,
    get_package_share_directory as get_package_share_directory,
    get_package_share_path as get_package_share_path,
    get_packages_with_prefixes as get_packages_with_prefixes,
)
from ament_index_python.resources import (
    InvalidResourceNameError as InvalidResourceNameError,
    InvalidResourceTypeNameError as InvalidResourceTypeNameError,
    get_resource as get_resource,
    get_resource_types as get_resource_types,
    get_resources as get_resources,
    has_resource as has_resource,
)
from ament_index_python.search_paths import get_search_paths as get_search_paths
