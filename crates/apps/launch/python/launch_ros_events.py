"""Events of ROS."""
from . import lifecycle, matchers  # noqa: F401
from .lifecycle import matches_node_name  # noqa: F401
