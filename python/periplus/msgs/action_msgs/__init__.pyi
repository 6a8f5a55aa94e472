from periplus.msgs.action_msgs import msg as msg
from periplus.msgs.action_msgs import srv as srv

__all__ = ["msg", "srv"]
