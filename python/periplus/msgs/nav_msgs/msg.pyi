from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Goals",
    "GridCells",
    "MapMetaData",
    "OccupancyGrid",
    "Odometry",
    "Path",
]

class Goals(Message):
    header: _std_msgs_msg.Header
    @property
    def goals(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @goals.setter
    def goals(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., goals: Iterable[_geometry_msgs_msg.PoseStamped] = ...) -> None: ...

class GridCells(Message):
    header: _std_msgs_msg.Header
    cell_width: float
    cell_height: float
    @property
    def cells(self) -> list[_geometry_msgs_msg.Point]: ...
    @cells.setter
    def cells(self, value: Iterable[_geometry_msgs_msg.Point]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., cell_width: float = ..., cell_height: float = ..., cells: Iterable[_geometry_msgs_msg.Point] = ...) -> None: ...

class MapMetaData(Message):
    map_load_time: _builtin_interfaces_msg.Time
    resolution: float
    width: int
    height: int
    origin: _geometry_msgs_msg.Pose
    def __init__(self, *, map_load_time: _builtin_interfaces_msg.Time = ..., resolution: float = ..., width: int = ..., height: int = ..., origin: _geometry_msgs_msg.Pose = ...) -> None: ...

class OccupancyGrid(Message):
    header: _std_msgs_msg.Header
    info: MapMetaData
    @property
    def data(self) -> npt.NDArray[np.int8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., info: MapMetaData = ..., data: npt.ArrayLike = ...) -> None: ...

class Odometry(Message):
    header: _std_msgs_msg.Header
    child_frame_id: str
    pose: _geometry_msgs_msg.PoseWithCovariance
    twist: _geometry_msgs_msg.TwistWithCovariance
    def __init__(self, *, header: _std_msgs_msg.Header = ..., child_frame_id: str = ..., pose: _geometry_msgs_msg.PoseWithCovariance = ..., twist: _geometry_msgs_msg.TwistWithCovariance = ...) -> None: ...

class Path(Message):
    header: _std_msgs_msg.Header
    @property
    def poses(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., poses: Iterable[_geometry_msgs_msg.PoseStamped] = ...) -> None: ...
