from periplus.msgs.dwb_msgs import msg as msg
from periplus.msgs.dwb_msgs import srv as srv

__all__ = ["msg", "srv"]
