from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "BehaviorTreeLog",
    "BehaviorTreeStatusChange",
    "CollisionDetectorState",
    "CollisionMonitorState",
    "Costmap",
    "CostmapFilterInfo",
    "CostmapMetaData",
    "CostmapUpdate",
    "MissedWaypoint",
    "Particle",
    "ParticleCloud",
    "SpeedLimit",
    "VoxelGrid",
]

class BehaviorTreeLog(Message):
    timestamp: _builtin_interfaces_msg.Time
    @property
    def event_log(self) -> list[BehaviorTreeStatusChange]: ...
    @event_log.setter
    def event_log(self, value: Iterable[BehaviorTreeStatusChange]) -> None: ...
    def __init__(self, *, timestamp: _builtin_interfaces_msg.Time = ..., event_log: Iterable[BehaviorTreeStatusChange] = ...) -> None: ...

class BehaviorTreeStatusChange(Message):
    timestamp: _builtin_interfaces_msg.Time
    node_name: str
    uid: int
    previous_status: str
    current_status: str
    def __init__(self, *, timestamp: _builtin_interfaces_msg.Time = ..., node_name: str = ..., uid: int = ..., previous_status: str = ..., current_status: str = ...) -> None: ...

class CollisionDetectorState(Message):
    @property
    def polygons(self) -> list[str]: ...
    @polygons.setter
    def polygons(self, value: Iterable[str]) -> None: ...
    @property
    def detections(self) -> npt.NDArray[np.bool_]: ...
    @detections.setter
    def detections(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, polygons: Iterable[str] = ..., detections: npt.ArrayLike = ...) -> None: ...

class CollisionMonitorState(Message):
    DO_NOTHING: ClassVar[int]
    STOP: ClassVar[int]
    SLOWDOWN: ClassVar[int]
    APPROACH: ClassVar[int]
    LIMIT: ClassVar[int]
    action_type: int
    polygon_name: str
    def __init__(self, *, action_type: int = ..., polygon_name: str = ...) -> None: ...

class Costmap(Message):
    header: _std_msgs_msg.Header
    metadata: CostmapMetaData
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., metadata: CostmapMetaData = ..., data: npt.ArrayLike = ...) -> None: ...

class CostmapFilterInfo(Message):
    header: _std_msgs_msg.Header
    type: int
    filter_mask_topic: str
    base: float
    multiplier: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., type: int = ..., filter_mask_topic: str = ..., base: float = ..., multiplier: float = ...) -> None: ...

class CostmapMetaData(Message):
    map_load_time: _builtin_interfaces_msg.Time
    update_time: _builtin_interfaces_msg.Time
    layer: str
    resolution: float
    size_x: int
    size_y: int
    origin: _geometry_msgs_msg.Pose
    def __init__(self, *, map_load_time: _builtin_interfaces_msg.Time = ..., update_time: _builtin_interfaces_msg.Time = ..., layer: str = ..., resolution: float = ..., size_x: int = ..., size_y: int = ..., origin: _geometry_msgs_msg.Pose = ...) -> None: ...

class CostmapUpdate(Message):
    header: _std_msgs_msg.Header
    x: int
    y: int
    size_x: int
    size_y: int
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., x: int = ..., y: int = ..., size_x: int = ..., size_y: int = ..., data: npt.ArrayLike = ...) -> None: ...

class MissedWaypoint(Message):
    index: int
    goal: _geometry_msgs_msg.PoseStamped
    error_code: int
    def __init__(self, *, index: int = ..., goal: _geometry_msgs_msg.PoseStamped = ..., error_code: int = ...) -> None: ...

class Particle(Message):
    pose: _geometry_msgs_msg.Pose
    weight: float
    def __init__(self, *, pose: _geometry_msgs_msg.Pose = ..., weight: float = ...) -> None: ...

class ParticleCloud(Message):
    header: _std_msgs_msg.Header
    @property
    def particles(self) -> list[Particle]: ...
    @particles.setter
    def particles(self, value: Iterable[Particle]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., particles: Iterable[Particle] = ...) -> None: ...

class SpeedLimit(Message):
    header: _std_msgs_msg.Header
    percentage: bool
    speed_limit: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., percentage: bool = ..., speed_limit: float = ...) -> None: ...

class VoxelGrid(Message):
    header: _std_msgs_msg.Header
    @property
    def data(self) -> npt.NDArray[np.uint32]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    origin: _geometry_msgs_msg.Point32
    resolutions: _geometry_msgs_msg.Vector3
    size_x: int
    size_y: int
    size_z: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., data: npt.ArrayLike = ..., origin: _geometry_msgs_msg.Point32 = ..., resolutions: _geometry_msgs_msg.Vector3 = ..., size_x: int = ..., size_y: int = ..., size_z: int = ...) -> None: ...
