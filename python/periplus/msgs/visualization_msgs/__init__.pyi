from periplus.msgs.visualization_msgs import msg as msg
from periplus.msgs.visualization_msgs import srv as srv

__all__ = ["msg", "srv"]
