from periplus.msgs.sensor_msgs import msg as msg
from periplus.msgs.sensor_msgs import srv as srv

__all__ = ["msg", "srv"]
