"""The graph, as programs of ROS 1 ask a master for it."""

from rosgraph import names
from rosgraph.master import Master, MasterError, MasterException, is_online, myargv

__all__ = ["Master", "MasterError", "MasterException", "is_master_online", "is_online", "myargv", "names"]

is_master_online = is_online
