from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav2_msgs.msg as _nav2_msgs_msg
import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "AddExclusionZone",
    "AddExclusionZone_Event",
    "AddExclusionZone_Request",
    "AddExclusionZone_Response",
    "AddShapes",
    "AddShapes_Event",
    "AddShapes_Request",
    "AddShapes_Response",
    "ClearCostmapAroundPose",
    "ClearCostmapAroundPose_Event",
    "ClearCostmapAroundPose_Request",
    "ClearCostmapAroundPose_Response",
    "ClearCostmapAroundRobot",
    "ClearCostmapAroundRobot_Event",
    "ClearCostmapAroundRobot_Request",
    "ClearCostmapAroundRobot_Response",
    "ClearCostmapExceptRegion",
    "ClearCostmapExceptRegion_Event",
    "ClearCostmapExceptRegion_Request",
    "ClearCostmapExceptRegion_Response",
    "ClearEntireCostmap",
    "ClearEntireCostmap_Event",
    "ClearEntireCostmap_Request",
    "ClearEntireCostmap_Response",
    "DynamicEdges",
    "DynamicEdges_Event",
    "DynamicEdges_Request",
    "DynamicEdges_Response",
    "GetCost",
    "GetCost_Event",
    "GetCost_Request",
    "GetCost_Response",
    "GetCostmap",
    "GetCostmap_Event",
    "GetCostmap_Request",
    "GetCostmap_Response",
    "GetCosts",
    "GetCosts_Event",
    "GetCosts_Request",
    "GetCosts_Response",
    "GetShapes",
    "GetShapes_Event",
    "GetShapes_Request",
    "GetShapes_Response",
    "IsPathValid",
    "IsPathValid_Event",
    "IsPathValid_Request",
    "IsPathValid_Response",
    "LoadMap",
    "LoadMap_Event",
    "LoadMap_Request",
    "LoadMap_Response",
    "ManageLifecycleNodes",
    "ManageLifecycleNodes_Event",
    "ManageLifecycleNodes_Request",
    "ManageLifecycleNodes_Response",
    "ReloadDockDatabase",
    "ReloadDockDatabase_Event",
    "ReloadDockDatabase_Request",
    "ReloadDockDatabase_Response",
    "RemoveExclusionZone",
    "RemoveExclusionZone_Event",
    "RemoveExclusionZone_Request",
    "RemoveExclusionZone_Response",
    "RemoveShapes",
    "RemoveShapes_Event",
    "RemoveShapes_Request",
    "RemoveShapes_Response",
    "SaveMap",
    "SaveMap_Event",
    "SaveMap_Request",
    "SaveMap_Response",
    "SetInitialPose",
    "SetInitialPose_Event",
    "SetInitialPose_Request",
    "SetInitialPose_Response",
    "SetRouteGraph",
    "SetRouteGraph_Event",
    "SetRouteGraph_Request",
    "SetRouteGraph_Response",
    "Toggle",
    "Toggle_Event",
    "Toggle_Request",
    "Toggle_Response",
]

class AddExclusionZone_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AddExclusionZone_Request]: ...
    @request.setter
    def request(self, value: Iterable[AddExclusionZone_Request]) -> None: ...
    @property
    def response(self) -> list[AddExclusionZone_Response]: ...
    @response.setter
    def response(self, value: Iterable[AddExclusionZone_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AddExclusionZone_Request] = ..., response: Iterable[AddExclusionZone_Response] = ...) -> None: ...

class AddExclusionZone_Request(Message):
    zone: _nav2_msgs_msg.ExclusionZoneDescription
    def __init__(self, *, zone: _nav2_msgs_msg.ExclusionZoneDescription = ...) -> None: ...

class AddExclusionZone_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class AddShapes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AddShapes_Request]: ...
    @request.setter
    def request(self, value: Iterable[AddShapes_Request]) -> None: ...
    @property
    def response(self) -> list[AddShapes_Response]: ...
    @response.setter
    def response(self, value: Iterable[AddShapes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AddShapes_Request] = ..., response: Iterable[AddShapes_Response] = ...) -> None: ...

class AddShapes_Request(Message):
    @property
    def circles(self) -> list[_nav2_msgs_msg.CircleObject]: ...
    @circles.setter
    def circles(self, value: Iterable[_nav2_msgs_msg.CircleObject]) -> None: ...
    @property
    def polygons(self) -> list[_nav2_msgs_msg.PolygonObject]: ...
    @polygons.setter
    def polygons(self, value: Iterable[_nav2_msgs_msg.PolygonObject]) -> None: ...
    def __init__(self, *, circles: Iterable[_nav2_msgs_msg.CircleObject] = ..., polygons: Iterable[_nav2_msgs_msg.PolygonObject] = ...) -> None: ...

class AddShapes_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ClearCostmapAroundPose_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ClearCostmapAroundPose_Request]: ...
    @request.setter
    def request(self, value: Iterable[ClearCostmapAroundPose_Request]) -> None: ...
    @property
    def response(self) -> list[ClearCostmapAroundPose_Response]: ...
    @response.setter
    def response(self, value: Iterable[ClearCostmapAroundPose_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ClearCostmapAroundPose_Request] = ..., response: Iterable[ClearCostmapAroundPose_Response] = ...) -> None: ...

class ClearCostmapAroundPose_Request(Message):
    pose: _geometry_msgs_msg.PoseStamped
    reset_distance: float
    def __init__(self, *, pose: _geometry_msgs_msg.PoseStamped = ..., reset_distance: float = ...) -> None: ...

class ClearCostmapAroundPose_Response(Message):
    response: _std_msgs_msg.Empty
    def __init__(self, *, response: _std_msgs_msg.Empty = ...) -> None: ...

class ClearCostmapAroundRobot_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ClearCostmapAroundRobot_Request]: ...
    @request.setter
    def request(self, value: Iterable[ClearCostmapAroundRobot_Request]) -> None: ...
    @property
    def response(self) -> list[ClearCostmapAroundRobot_Response]: ...
    @response.setter
    def response(self, value: Iterable[ClearCostmapAroundRobot_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ClearCostmapAroundRobot_Request] = ..., response: Iterable[ClearCostmapAroundRobot_Response] = ...) -> None: ...

class ClearCostmapAroundRobot_Request(Message):
    reset_distance: float
    def __init__(self, *, reset_distance: float = ...) -> None: ...

class ClearCostmapAroundRobot_Response(Message):
    response: _std_msgs_msg.Empty
    def __init__(self, *, response: _std_msgs_msg.Empty = ...) -> None: ...

class ClearCostmapExceptRegion_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ClearCostmapExceptRegion_Request]: ...
    @request.setter
    def request(self, value: Iterable[ClearCostmapExceptRegion_Request]) -> None: ...
    @property
    def response(self) -> list[ClearCostmapExceptRegion_Response]: ...
    @response.setter
    def response(self, value: Iterable[ClearCostmapExceptRegion_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ClearCostmapExceptRegion_Request] = ..., response: Iterable[ClearCostmapExceptRegion_Response] = ...) -> None: ...

class ClearCostmapExceptRegion_Request(Message):
    reset_distance: float
    def __init__(self, *, reset_distance: float = ...) -> None: ...

class ClearCostmapExceptRegion_Response(Message):
    response: _std_msgs_msg.Empty
    def __init__(self, *, response: _std_msgs_msg.Empty = ...) -> None: ...

class ClearEntireCostmap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ClearEntireCostmap_Request]: ...
    @request.setter
    def request(self, value: Iterable[ClearEntireCostmap_Request]) -> None: ...
    @property
    def response(self) -> list[ClearEntireCostmap_Response]: ...
    @response.setter
    def response(self, value: Iterable[ClearEntireCostmap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ClearEntireCostmap_Request] = ..., response: Iterable[ClearEntireCostmap_Response] = ...) -> None: ...

class ClearEntireCostmap_Request(Message):
    request: _std_msgs_msg.Empty
    def __init__(self, *, request: _std_msgs_msg.Empty = ...) -> None: ...

class ClearEntireCostmap_Response(Message):
    response: _std_msgs_msg.Empty
    def __init__(self, *, response: _std_msgs_msg.Empty = ...) -> None: ...

class DynamicEdges_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DynamicEdges_Request]: ...
    @request.setter
    def request(self, value: Iterable[DynamicEdges_Request]) -> None: ...
    @property
    def response(self) -> list[DynamicEdges_Response]: ...
    @response.setter
    def response(self, value: Iterable[DynamicEdges_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DynamicEdges_Request] = ..., response: Iterable[DynamicEdges_Response] = ...) -> None: ...

class DynamicEdges_Request(Message):
    @property
    def closed_edges(self) -> npt.NDArray[np.uint16]: ...
    @closed_edges.setter
    def closed_edges(self, value: npt.ArrayLike) -> None: ...
    @property
    def opened_edges(self) -> npt.NDArray[np.uint16]: ...
    @opened_edges.setter
    def opened_edges(self, value: npt.ArrayLike) -> None: ...
    @property
    def adjust_edges(self) -> list[_nav2_msgs_msg.EdgeCost]: ...
    @adjust_edges.setter
    def adjust_edges(self, value: Iterable[_nav2_msgs_msg.EdgeCost]) -> None: ...
    def __init__(self, *, closed_edges: npt.ArrayLike = ..., opened_edges: npt.ArrayLike = ..., adjust_edges: Iterable[_nav2_msgs_msg.EdgeCost] = ...) -> None: ...

class DynamicEdges_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class GetCost_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetCost_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetCost_Request]) -> None: ...
    @property
    def response(self) -> list[GetCost_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetCost_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetCost_Request] = ..., response: Iterable[GetCost_Response] = ...) -> None: ...

class GetCost_Request(Message):
    use_footprint: bool
    x: float
    y: float
    theta: float
    def __init__(self, *, use_footprint: bool = ..., x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class GetCost_Response(Message):
    cost: float
    def __init__(self, *, cost: float = ...) -> None: ...

class GetCostmap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetCostmap_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetCostmap_Request]) -> None: ...
    @property
    def response(self) -> list[GetCostmap_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetCostmap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetCostmap_Request] = ..., response: Iterable[GetCostmap_Response] = ...) -> None: ...

class GetCostmap_Request(Message):
    specs: _nav2_msgs_msg.CostmapMetaData
    def __init__(self, *, specs: _nav2_msgs_msg.CostmapMetaData = ...) -> None: ...

class GetCostmap_Response(Message):
    map: _nav2_msgs_msg.Costmap
    def __init__(self, *, map: _nav2_msgs_msg.Costmap = ...) -> None: ...

class GetCosts_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetCosts_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetCosts_Request]) -> None: ...
    @property
    def response(self) -> list[GetCosts_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetCosts_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetCosts_Request] = ..., response: Iterable[GetCosts_Response] = ...) -> None: ...

class GetCosts_Request(Message):
    use_footprint: bool
    @property
    def poses(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    def __init__(self, *, use_footprint: bool = ..., poses: Iterable[_geometry_msgs_msg.PoseStamped] = ...) -> None: ...

class GetCosts_Response(Message):
    @property
    def costs(self) -> npt.NDArray[np.float32]: ...
    @costs.setter
    def costs(self, value: npt.ArrayLike) -> None: ...
    success: bool
    def __init__(self, *, costs: npt.ArrayLike = ..., success: bool = ...) -> None: ...

class GetShapes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetShapes_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetShapes_Request]) -> None: ...
    @property
    def response(self) -> list[GetShapes_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetShapes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetShapes_Request] = ..., response: Iterable[GetShapes_Response] = ...) -> None: ...

class GetShapes_Request(Message):
    def __init__(self) -> None: ...

class GetShapes_Response(Message):
    @property
    def circles(self) -> list[_nav2_msgs_msg.CircleObject]: ...
    @circles.setter
    def circles(self, value: Iterable[_nav2_msgs_msg.CircleObject]) -> None: ...
    @property
    def polygons(self) -> list[_nav2_msgs_msg.PolygonObject]: ...
    @polygons.setter
    def polygons(self, value: Iterable[_nav2_msgs_msg.PolygonObject]) -> None: ...
    def __init__(self, *, circles: Iterable[_nav2_msgs_msg.CircleObject] = ..., polygons: Iterable[_nav2_msgs_msg.PolygonObject] = ...) -> None: ...

class IsPathValid_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[IsPathValid_Request]: ...
    @request.setter
    def request(self, value: Iterable[IsPathValid_Request]) -> None: ...
    @property
    def response(self) -> list[IsPathValid_Response]: ...
    @response.setter
    def response(self, value: Iterable[IsPathValid_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[IsPathValid_Request] = ..., response: Iterable[IsPathValid_Response] = ...) -> None: ...

class IsPathValid_Request(Message):
    path: _nav_msgs_msg.Path
    def __init__(self, *, path: _nav_msgs_msg.Path = ...) -> None: ...

class IsPathValid_Response(Message):
    is_valid: bool
    @property
    def invalid_pose_indices(self) -> npt.NDArray[np.int32]: ...
    @invalid_pose_indices.setter
    def invalid_pose_indices(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, is_valid: bool = ..., invalid_pose_indices: npt.ArrayLike = ...) -> None: ...

class LoadMap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LoadMap_Request]: ...
    @request.setter
    def request(self, value: Iterable[LoadMap_Request]) -> None: ...
    @property
    def response(self) -> list[LoadMap_Response]: ...
    @response.setter
    def response(self, value: Iterable[LoadMap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LoadMap_Request] = ..., response: Iterable[LoadMap_Response] = ...) -> None: ...

class LoadMap_Request(Message):
    map_url: str
    def __init__(self, *, map_url: str = ...) -> None: ...

class LoadMap_Response(Message):
    RESULT_SUCCESS: ClassVar[int]
    RESULT_MAP_DOES_NOT_EXIST: ClassVar[int]
    RESULT_INVALID_MAP_DATA: ClassVar[int]
    RESULT_INVALID_MAP_METADATA: ClassVar[int]
    RESULT_UNDEFINED_FAILURE: ClassVar[int]
    map: _nav_msgs_msg.OccupancyGrid
    result: int
    def __init__(self, *, map: _nav_msgs_msg.OccupancyGrid = ..., result: int = ...) -> None: ...

class ManageLifecycleNodes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ManageLifecycleNodes_Request]: ...
    @request.setter
    def request(self, value: Iterable[ManageLifecycleNodes_Request]) -> None: ...
    @property
    def response(self) -> list[ManageLifecycleNodes_Response]: ...
    @response.setter
    def response(self, value: Iterable[ManageLifecycleNodes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ManageLifecycleNodes_Request] = ..., response: Iterable[ManageLifecycleNodes_Response] = ...) -> None: ...

class ManageLifecycleNodes_Request(Message):
    STARTUP: ClassVar[int]
    PAUSE: ClassVar[int]
    RESUME: ClassVar[int]
    RESET: ClassVar[int]
    SHUTDOWN: ClassVar[int]
    CONFIGURE: ClassVar[int]
    CLEANUP: ClassVar[int]
    command: int
    def __init__(self, *, command: int = ...) -> None: ...

class ManageLifecycleNodes_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class ReloadDockDatabase_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ReloadDockDatabase_Request]: ...
    @request.setter
    def request(self, value: Iterable[ReloadDockDatabase_Request]) -> None: ...
    @property
    def response(self) -> list[ReloadDockDatabase_Response]: ...
    @response.setter
    def response(self, value: Iterable[ReloadDockDatabase_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ReloadDockDatabase_Request] = ..., response: Iterable[ReloadDockDatabase_Response] = ...) -> None: ...

class ReloadDockDatabase_Request(Message):
    filepath: str
    def __init__(self, *, filepath: str = ...) -> None: ...

class ReloadDockDatabase_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class RemoveExclusionZone_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[RemoveExclusionZone_Request]: ...
    @request.setter
    def request(self, value: Iterable[RemoveExclusionZone_Request]) -> None: ...
    @property
    def response(self) -> list[RemoveExclusionZone_Response]: ...
    @response.setter
    def response(self, value: Iterable[RemoveExclusionZone_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[RemoveExclusionZone_Request] = ..., response: Iterable[RemoveExclusionZone_Response] = ...) -> None: ...

class RemoveExclusionZone_Request(Message):
    zone_name: str
    remove_all: bool
    def __init__(self, *, zone_name: str = ..., remove_all: bool = ...) -> None: ...

class RemoveExclusionZone_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class RemoveShapes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[RemoveShapes_Request]: ...
    @request.setter
    def request(self, value: Iterable[RemoveShapes_Request]) -> None: ...
    @property
    def response(self) -> list[RemoveShapes_Response]: ...
    @response.setter
    def response(self, value: Iterable[RemoveShapes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[RemoveShapes_Request] = ..., response: Iterable[RemoveShapes_Response] = ...) -> None: ...

class RemoveShapes_Request(Message):
    all_objects: bool
    @property
    def uuids(self) -> list[_unique_identifier_msgs_msg.UUID]: ...
    @uuids.setter
    def uuids(self, value: Iterable[_unique_identifier_msgs_msg.UUID]) -> None: ...
    def __init__(self, *, all_objects: bool = ..., uuids: Iterable[_unique_identifier_msgs_msg.UUID] = ...) -> None: ...

class RemoveShapes_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SaveMap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SaveMap_Request]: ...
    @request.setter
    def request(self, value: Iterable[SaveMap_Request]) -> None: ...
    @property
    def response(self) -> list[SaveMap_Response]: ...
    @response.setter
    def response(self, value: Iterable[SaveMap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SaveMap_Request] = ..., response: Iterable[SaveMap_Response] = ...) -> None: ...

class SaveMap_Request(Message):
    map_topic: str
    map_url: str
    image_format: str
    map_mode: str
    free_thresh: float
    occupied_thresh: float
    def __init__(self, *, map_topic: str = ..., map_url: str = ..., image_format: str = ..., map_mode: str = ..., free_thresh: float = ..., occupied_thresh: float = ...) -> None: ...

class SaveMap_Response(Message):
    result: bool
    def __init__(self, *, result: bool = ...) -> None: ...

class SetInitialPose_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetInitialPose_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetInitialPose_Request]) -> None: ...
    @property
    def response(self) -> list[SetInitialPose_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetInitialPose_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetInitialPose_Request] = ..., response: Iterable[SetInitialPose_Response] = ...) -> None: ...

class SetInitialPose_Request(Message):
    pose: _geometry_msgs_msg.PoseWithCovarianceStamped
    def __init__(self, *, pose: _geometry_msgs_msg.PoseWithCovarianceStamped = ...) -> None: ...

class SetInitialPose_Response(Message):
    def __init__(self) -> None: ...

class SetRouteGraph_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetRouteGraph_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetRouteGraph_Request]) -> None: ...
    @property
    def response(self) -> list[SetRouteGraph_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetRouteGraph_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetRouteGraph_Request] = ..., response: Iterable[SetRouteGraph_Response] = ...) -> None: ...

class SetRouteGraph_Request(Message):
    graph_filepath: str
    def __init__(self, *, graph_filepath: str = ...) -> None: ...

class SetRouteGraph_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class Toggle_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Toggle_Request]: ...
    @request.setter
    def request(self, value: Iterable[Toggle_Request]) -> None: ...
    @property
    def response(self) -> list[Toggle_Response]: ...
    @response.setter
    def response(self, value: Iterable[Toggle_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Toggle_Request] = ..., response: Iterable[Toggle_Response] = ...) -> None: ...

class Toggle_Request(Message):
    enable: bool
    def __init__(self, *, enable: bool = ...) -> None: ...

class Toggle_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class AddExclusionZone(Service):
    Request = AddExclusionZone_Request
    Response = AddExclusionZone_Response
    Event = AddExclusionZone_Event

class AddShapes(Service):
    Request = AddShapes_Request
    Response = AddShapes_Response
    Event = AddShapes_Event

class ClearCostmapAroundPose(Service):
    Request = ClearCostmapAroundPose_Request
    Response = ClearCostmapAroundPose_Response
    Event = ClearCostmapAroundPose_Event

class ClearCostmapAroundRobot(Service):
    Request = ClearCostmapAroundRobot_Request
    Response = ClearCostmapAroundRobot_Response
    Event = ClearCostmapAroundRobot_Event

class ClearCostmapExceptRegion(Service):
    Request = ClearCostmapExceptRegion_Request
    Response = ClearCostmapExceptRegion_Response
    Event = ClearCostmapExceptRegion_Event

class ClearEntireCostmap(Service):
    Request = ClearEntireCostmap_Request
    Response = ClearEntireCostmap_Response
    Event = ClearEntireCostmap_Event

class DynamicEdges(Service):
    Request = DynamicEdges_Request
    Response = DynamicEdges_Response
    Event = DynamicEdges_Event

class GetCost(Service):
    Request = GetCost_Request
    Response = GetCost_Response
    Event = GetCost_Event

class GetCostmap(Service):
    Request = GetCostmap_Request
    Response = GetCostmap_Response
    Event = GetCostmap_Event

class GetCosts(Service):
    Request = GetCosts_Request
    Response = GetCosts_Response
    Event = GetCosts_Event

class GetShapes(Service):
    Request = GetShapes_Request
    Response = GetShapes_Response
    Event = GetShapes_Event

class IsPathValid(Service):
    Request = IsPathValid_Request
    Response = IsPathValid_Response
    Event = IsPathValid_Event

class LoadMap(Service):
    Request = LoadMap_Request
    Response = LoadMap_Response
    Event = LoadMap_Event

class ManageLifecycleNodes(Service):
    Request = ManageLifecycleNodes_Request
    Response = ManageLifecycleNodes_Response
    Event = ManageLifecycleNodes_Event

class ReloadDockDatabase(Service):
    Request = ReloadDockDatabase_Request
    Response = ReloadDockDatabase_Response
    Event = ReloadDockDatabase_Event

class RemoveExclusionZone(Service):
    Request = RemoveExclusionZone_Request
    Response = RemoveExclusionZone_Response
    Event = RemoveExclusionZone_Event

class RemoveShapes(Service):
    Request = RemoveShapes_Request
    Response = RemoveShapes_Response
    Event = RemoveShapes_Event

class SaveMap(Service):
    Request = SaveMap_Request
    Response = SaveMap_Response
    Event = SaveMap_Event

class SetInitialPose(Service):
    Request = SetInitialPose_Request
    Response = SetInitialPose_Response
    Event = SetInitialPose_Event

class SetRouteGraph(Service):
    Request = SetRouteGraph_Request
    Response = SetRouteGraph_Response
    Event = SetRouteGraph_Event

class Toggle(Service):
    Request = Toggle_Request
    Response = Toggle_Response
    Event = Toggle_Event
