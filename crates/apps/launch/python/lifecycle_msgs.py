"""Replacement of `lifecycle_msgs`."""
from . import msg  # noqa: F401
