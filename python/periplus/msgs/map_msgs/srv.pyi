from collections.abc import Iterable

import periplus.msgs.map_msgs.msg as _map_msgs_msg
import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.sensor_msgs.msg as _sensor_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "GetMapROI",
    "GetMapROI_Event",
    "GetMapROI_Request",
    "GetMapROI_Response",
    "GetPointMap",
    "GetPointMapROI",
    "GetPointMapROI_Event",
    "GetPointMapROI_Request",
    "GetPointMapROI_Response",
    "GetPointMap_Event",
    "GetPointMap_Request",
    "GetPointMap_Response",
    "ProjectedMapsInfo",
    "ProjectedMapsInfo_Event",
    "ProjectedMapsInfo_Request",
    "ProjectedMapsInfo_Response",
    "SaveMap",
    "SaveMap_Event",
    "SaveMap_Request",
    "SaveMap_Response",
    "SetMapProjections",
    "SetMapProjections_Event",
    "SetMapProjections_Request",
    "SetMapProjections_Response",
]

class GetMapROI_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetMapROI_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetMapROI_Request]) -> None: ...
    @property
    def response(self) -> list[GetMapROI_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetMapROI_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetMapROI_Request] = ..., response: Iterable[GetMapROI_Response] = ...) -> None: ...

class GetMapROI_Request(Message):
    x: float
    y: float
    l_x: float
    l_y: float
    def __init__(self, *, x: float = ..., y: float = ..., l_x: float = ..., l_y: float = ...) -> None: ...

class GetMapROI_Response(Message):
    sub_map: _nav_msgs_msg.OccupancyGrid
    def __init__(self, *, sub_map: _nav_msgs_msg.OccupancyGrid = ...) -> None: ...

class GetPointMapROI_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetPointMapROI_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetPointMapROI_Request]) -> None: ...
    @property
    def response(self) -> list[GetPointMapROI_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetPointMapROI_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetPointMapROI_Request] = ..., response: Iterable[GetPointMapROI_Response] = ...) -> None: ...

class GetPointMapROI_Request(Message):
    x: float
    y: float
    z: float
    r: float
    l_x: float
    l_y: float
    l_z: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ..., r: float = ..., l_x: float = ..., l_y: float = ..., l_z: float = ...) -> None: ...

class GetPointMapROI_Response(Message):
    sub_map: _sensor_msgs_msg.PointCloud2
    def __init__(self, *, sub_map: _sensor_msgs_msg.PointCloud2 = ...) -> None: ...

class GetPointMap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetPointMap_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetPointMap_Request]) -> None: ...
    @property
    def response(self) -> list[GetPointMap_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetPointMap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetPointMap_Request] = ..., response: Iterable[GetPointMap_Response] = ...) -> None: ...

class GetPointMap_Request(Message):
    def __init__(self) -> None: ...

class GetPointMap_Response(Message):
    map: _sensor_msgs_msg.PointCloud2
    def __init__(self, *, map: _sensor_msgs_msg.PointCloud2 = ...) -> None: ...

class ProjectedMapsInfo_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ProjectedMapsInfo_Request]: ...
    @request.setter
    def request(self, value: Iterable[ProjectedMapsInfo_Request]) -> None: ...
    @property
    def response(self) -> list[ProjectedMapsInfo_Response]: ...
    @response.setter
    def response(self, value: Iterable[ProjectedMapsInfo_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ProjectedMapsInfo_Request] = ..., response: Iterable[ProjectedMapsInfo_Response] = ...) -> None: ...

class ProjectedMapsInfo_Request(Message):
    @property
    def projected_maps_info(self) -> list[_map_msgs_msg.ProjectedMapInfo]: ...
    @projected_maps_info.setter
    def projected_maps_info(self, value: Iterable[_map_msgs_msg.ProjectedMapInfo]) -> None: ...
    def __init__(self, *, projected_maps_info: Iterable[_map_msgs_msg.ProjectedMapInfo] = ...) -> None: ...

class ProjectedMapsInfo_Response(Message):
    def __init__(self) -> None: ...

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
    filename: _std_msgs_msg.String
    def __init__(self, *, filename: _std_msgs_msg.String = ...) -> None: ...

class SaveMap_Response(Message):
    def __init__(self) -> None: ...

class SetMapProjections_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetMapProjections_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetMapProjections_Request]) -> None: ...
    @property
    def response(self) -> list[SetMapProjections_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetMapProjections_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetMapProjections_Request] = ..., response: Iterable[SetMapProjections_Response] = ...) -> None: ...

class SetMapProjections_Request(Message):
    def __init__(self) -> None: ...

class SetMapProjections_Response(Message):
    @property
    def projected_maps_info(self) -> list[_map_msgs_msg.ProjectedMapInfo]: ...
    @projected_maps_info.setter
    def projected_maps_info(self, value: Iterable[_map_msgs_msg.ProjectedMapInfo]) -> None: ...
    def __init__(self, *, projected_maps_info: Iterable[_map_msgs_msg.ProjectedMapInfo] = ...) -> None: ...

class GetMapROI(Service):
    Request = GetMapROI_Request
    Response = GetMapROI_Response
    Event = GetMapROI_Event

class GetPointMap(Service):
    Request = GetPointMap_Request
    Response = GetPointMap_Response
    Event = GetPointMap_Event

class GetPointMapROI(Service):
    Request = GetPointMapROI_Request
    Response = GetPointMapROI_Response
    Event = GetPointMapROI_Event

class ProjectedMapsInfo(Service):
    Request = ProjectedMapsInfo_Request
    Response = ProjectedMapsInfo_Response
    Event = ProjectedMapsInfo_Event

class SaveMap(Service):
    Request = SaveMap_Request
    Response = SaveMap_Response
    Event = SaveMap_Event

class SetMapProjections(Service):
    Request = SetMapProjections_Request
    Response = SetMapProjections_Response
    Event = SetMapProjections_Event
