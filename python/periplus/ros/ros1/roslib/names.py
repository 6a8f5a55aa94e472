"""Names of ROS 1, under their old module name."""

from rosgraph.names import *  # noqa: F403
from rosgraph.names import __all__
