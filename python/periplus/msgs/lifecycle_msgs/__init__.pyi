from periplus.msgs.lifecycle_msgs import msg as msg
from periplus.msgs.lifecycle_msgs import srv as srv

__all__ = ["msg", "srv"]
