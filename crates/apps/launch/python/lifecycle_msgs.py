"""Stands in for `lifecycle_msgs`."""
from . import msg  # noqa: F401
