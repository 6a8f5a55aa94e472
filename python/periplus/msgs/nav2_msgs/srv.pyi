from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav2_msgs.msg as _nav2_msgs_msg
import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
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
    "SaveMap",
    "SaveMap_Event",
    "SaveMap_Request",
    "SaveMap_Response",
    "SetInitialPose",
    "SetInitialPose_Event",
    "SetInitialPose_Request",
    "SetInitialPose_Response",
]

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

class SaveMap(Service):
    Request = SaveMap_Request
    Response = SaveMap_Response
    Event = SaveMap_Event

class SetInitialPose(Service):
    Request = SetInitialPose_Request
    Response = SetInitialPose_Response
    Event = SetInitialPose_Event
