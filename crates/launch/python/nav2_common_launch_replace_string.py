"""One substitution, by the name of its module."""
from nav2_common.launch import ReplaceString  # noqa: F401
