from collections.abc import Iterable

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Path2D",
    "Pose2D32",
    "Pose2DStamped",
    "Twist2D",
    "Twist2D32",
    "Twist2DStamped",
]

class Path2D(Message):
    header: _std_msgs_msg.Header
    @property
    def poses(self) -> list[_geometry_msgs_msg.Pose2D]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.Pose2D]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., poses: Iterable[_geometry_msgs_msg.Pose2D] = ...) -> None: ...

class Pose2D32(Message):
    x: float
    y: float
    theta: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class Pose2DStamped(Message):
    header: _std_msgs_msg.Header
    pose: _geometry_msgs_msg.Pose2D
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: _geometry_msgs_msg.Pose2D = ...) -> None: ...

class Twist2D(Message):
    x: float
    y: float
    theta: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class Twist2D32(Message):
    x: float
    y: float
    theta: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class Twist2DStamped(Message):
    header: _std_msgs_msg.Header
    velocity: Twist2D
    def __init__(self, *, header: _std_msgs_msg.Header = ..., velocity: Twist2D = ...) -> None: ...
