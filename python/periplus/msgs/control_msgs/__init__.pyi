from periplus.msgs.control_msgs import action as action
from periplus.msgs.control_msgs import msg as msg
from periplus.msgs.control_msgs import srv as srv

__all__ = ["action", "msg", "srv"]
