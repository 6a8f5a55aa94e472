from periplus.msgs.rcl_interfaces import msg as msg
from periplus.msgs.rcl_interfaces import srv as srv

__all__ = ["msg", "srv"]
