from periplus.msgs.diagnostic_msgs import msg as msg
from periplus.msgs.diagnostic_msgs import srv as srv

__all__ = ["msg", "srv"]
