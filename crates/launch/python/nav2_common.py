"""Stands in for `nav2_common`."""
from . import launch  # noqa: F401
