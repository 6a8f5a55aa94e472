from periplus.msgs.nav2_msgs import msg as msg
from periplus.msgs.nav2_msgs import srv as srv

__all__ = ["msg", "srv"]
