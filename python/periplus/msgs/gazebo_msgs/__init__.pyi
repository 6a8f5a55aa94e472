from periplus.msgs.gazebo_msgs import msg as msg
from periplus.msgs.gazebo_msgs import srv as srv

__all__ = ["msg", "srv"]
