from periplus.msgs.controller_manager_msgs import msg as msg
from periplus.msgs.controller_manager_msgs import srv as srv

__all__ = ["msg", "srv"]
