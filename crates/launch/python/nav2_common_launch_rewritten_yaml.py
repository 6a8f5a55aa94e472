"""One substitution, by the name of its module."""
from nav2_common.launch import RewrittenYaml  # noqa: F401
