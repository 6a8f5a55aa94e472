import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "GeoPoint",
    "GeoPointStamped",
    "GeoPose",
    "GeoPoseStamped",
]

class GeoPoint(Message):
    latitude: float
    longitude: float
    altitude: float
    def __init__(self, *, latitude: float = ..., longitude: float = ..., altitude: float = ...) -> None: ...

class GeoPointStamped(Message):
    header: _std_msgs_msg.Header
    position: GeoPoint
    def __init__(self, *, header: _std_msgs_msg.Header = ..., position: GeoPoint = ...) -> None: ...

class GeoPose(Message):
    position: GeoPoint
    orientation: _geometry_msgs_msg.Quaternion
    def __init__(self, *, position: GeoPoint = ..., orientation: _geometry_msgs_msg.Quaternion = ...) -> None: ...

class GeoPoseStamped(Message):
    header: _std_msgs_msg.Header
    pose: GeoPose
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: GeoPose = ...) -> None: ...
