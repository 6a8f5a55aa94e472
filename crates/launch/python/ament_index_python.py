"""Stands in for `ament_index_python`: packages are found by their package.xml."""
from . import packages  # noqa: F401
from .packages import (  # noqa: F401
    PackageNotFoundError,
    get_package_prefix,
    get_package_share_directory,
    get_package_share_path,
)
