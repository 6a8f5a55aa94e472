from periplus.msgs.nav_msgs import msg as msg
from periplus.msgs.nav_msgs import srv as srv

__all__ = ["msg", "srv"]
