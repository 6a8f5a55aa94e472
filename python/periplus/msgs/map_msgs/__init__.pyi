from periplus.msgs.map_msgs import msg as msg
from periplus.msgs.map_msgs import srv as srv

__all__ = ["msg", "srv"]
