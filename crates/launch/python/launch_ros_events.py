"""Events of ROS."""
from . import lifecycle  # noqa: F401


def matches_node_name(node_name):
    return None
