"""Replacement of `osrf_pycommon`: processes are run by the plan."""
from . import process_utils  # noqa: F401
