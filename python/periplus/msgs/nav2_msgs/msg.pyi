from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Message

__all__ = [
    "BehaviorTreeLog",
    "BehaviorTreeStatusChange",
    "CircleObject",
    "CollisionDetectorState",
    "CollisionMonitorState",
    "Costmap",
    "CostmapFilterInfo",
    "CostmapMetaData",
    "CostmapUpdate",
    "CriticsStats",
    "EdgeCost",
    "ExclusionZoneDescription",
    "MissedWaypoint",
    "Particle",
    "ParticleCloud",
    "PolygonObject",
    "Route",
    "RouteEdge",
    "RouteNode",
    "SpeedLimit",
    "TrackingFeedback",
    "VoxelGrid",
    "WaypointStatus",
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

class CircleObject(Message):
    header: _std_msgs_msg.Header
    uuid: _unique_identifier_msgs_msg.UUID
    center: _geometry_msgs_msg.Point32
    radius: float
    fill: bool
    value: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., uuid: _unique_identifier_msgs_msg.UUID = ..., center: _geometry_msgs_msg.Point32 = ..., radius: float = ..., fill: bool = ..., value: int = ...) -> None: ...

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

class CriticsStats(Message):
    stamp: _builtin_interfaces_msg.Time
    @property
    def critics(self) -> list[str]: ...
    @critics.setter
    def critics(self, value: Iterable[str]) -> None: ...
    @property
    def changed(self) -> npt.NDArray[np.bool_]: ...
    @changed.setter
    def changed(self, value: npt.ArrayLike) -> None: ...
    @property
    def costs_sum(self) -> npt.NDArray[np.float32]: ...
    @costs_sum.setter
    def costs_sum(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, stamp: _builtin_interfaces_msg.Time = ..., critics: Iterable[str] = ..., changed: npt.ArrayLike = ..., costs_sum: npt.ArrayLike = ...) -> None: ...

class EdgeCost(Message):
    edgeid: int
    cost: float
    def __init__(self, *, edgeid: int = ..., cost: float = ...) -> None: ...

class ExclusionZoneDescription(Message):
    zone_name: str
    type: str
    frame_id: str
    @property
    def points(self) -> list[_geometry_msgs_msg.Point32]: ...
    @points.setter
    def points(self, value: Iterable[_geometry_msgs_msg.Point32]) -> None: ...
    radius: float
    min_height: float
    max_height: float
    enabled: bool
    visualize: bool
    frame_hold_timeout: float
    def __init__(self, *, zone_name: str = ..., type: str = ..., frame_id: str = ..., points: Iterable[_geometry_msgs_msg.Point32] = ..., radius: float = ..., min_height: float = ..., max_height: float = ..., enabled: bool = ..., visualize: bool = ..., frame_hold_timeout: float = ...) -> None: ...

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

class PolygonObject(Message):
    header: _std_msgs_msg.Header
    uuid: _unique_identifier_msgs_msg.UUID
    @property
    def points(self) -> list[_geometry_msgs_msg.Point32]: ...
    @points.setter
    def points(self, value: Iterable[_geometry_msgs_msg.Point32]) -> None: ...
    closed: bool
    value: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., uuid: _unique_identifier_msgs_msg.UUID = ..., points: Iterable[_geometry_msgs_msg.Point32] = ..., closed: bool = ..., value: int = ...) -> None: ...

class Route(Message):
    header: _std_msgs_msg.Header
    route_cost: float
    @property
    def nodes(self) -> list[RouteNode]: ...
    @nodes.setter
    def nodes(self, value: Iterable[RouteNode]) -> None: ...
    @property
    def edges(self) -> list[RouteEdge]: ...
    @edges.setter
    def edges(self, value: Iterable[RouteEdge]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., route_cost: float = ..., nodes: Iterable[RouteNode] = ..., edges: Iterable[RouteEdge] = ...) -> None: ...

class RouteEdge(Message):
    edgeid: int
    start: _geometry_msgs_msg.Point
    end: _geometry_msgs_msg.Point
    def __init__(self, *, edgeid: int = ..., start: _geometry_msgs_msg.Point = ..., end: _geometry_msgs_msg.Point = ...) -> None: ...

class RouteNode(Message):
    nodeid: int
    position: _geometry_msgs_msg.Point
    def __init__(self, *, nodeid: int = ..., position: _geometry_msgs_msg.Point = ...) -> None: ...

class SpeedLimit(Message):
    header: _std_msgs_msg.Header
    percentage: bool
    speed_limit: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., percentage: bool = ..., speed_limit: float = ...) -> None: ...

class TrackingFeedback(Message):
    header: _std_msgs_msg.Header
    position_tracking_error: float
    heading_tracking_error: float
    current_path_index: int
    robot_pose: _geometry_msgs_msg.PoseStamped
    distance_to_goal: float
    speed: float
    remaining_path_length: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., position_tracking_error: float = ..., heading_tracking_error: float = ..., current_path_index: int = ..., robot_pose: _geometry_msgs_msg.PoseStamped = ..., distance_to_goal: float = ..., speed: float = ..., remaining_path_length: float = ...) -> None: ...

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

class WaypointStatus(Message):
    PENDING: ClassVar[int]
    COMPLETED: ClassVar[int]
    SKIPPED: ClassVar[int]
    FAILED: ClassVar[int]
    waypoint_status: int
    waypoint_index: int
    waypoint_pose: _geometry_msgs_msg.PoseStamped
    error_code: int
    error_msg: str
    def __init__(self, *, waypoint_status: int = ..., waypoint_index: int = ..., waypoint_pose: _geometry_msgs_msg.PoseStamped = ..., error_code: int = ..., error_msg: str = ...) -> None: ...
