from periplus.msgs.nav2_msgs import action as action
from periplus.msgs.nav2_msgs import msg as msg
from periplus.msgs.nav2_msgs import srv as srv

__all__ = ["action", "msg", "srv"]
