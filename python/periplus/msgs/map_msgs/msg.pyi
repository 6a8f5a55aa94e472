from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.sensor_msgs.msg as _sensor_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "OccupancyGridUpdate",
    "PointCloud2Update",
    "ProjectedMap",
    "ProjectedMapInfo",
]

class OccupancyGridUpdate(Message):
    header: _std_msgs_msg.Header
    x: int
    y: int
    width: int
    height: int
    @property
    def data(self) -> npt.NDArray[np.int8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., x: int = ..., y: int = ..., width: int = ..., height: int = ..., data: npt.ArrayLike = ...) -> None: ...

class PointCloud2Update(Message):
    ADD: ClassVar[int]
    DELETE: ClassVar[int]
    header: _std_msgs_msg.Header
    type: int
    points: _sensor_msgs_msg.PointCloud2
    def __init__(self, *, header: _std_msgs_msg.Header = ..., type: int = ..., points: _sensor_msgs_msg.PointCloud2 = ...) -> None: ...

class ProjectedMap(Message):
    map: _nav_msgs_msg.OccupancyGrid
    min_z: float
    max_z: float
    def __init__(self, *, map: _nav_msgs_msg.OccupancyGrid = ..., min_z: float = ..., max_z: float = ...) -> None: ...

class ProjectedMapInfo(Message):
    frame_id: str
    x: float
    y: float
    width: float
    height: float
    min_z: float
    max_z: float
    def __init__(self, *, frame_id: str = ..., x: float = ..., y: float = ..., width: float = ..., height: float = ..., min_z: float = ..., max_z: float = ...) -> None: ...
