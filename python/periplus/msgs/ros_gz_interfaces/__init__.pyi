from periplus.msgs.ros_gz_interfaces import msg as msg
from periplus.msgs.ros_gz_interfaces import srv as srv

__all__ = ["msg", "srv"]
