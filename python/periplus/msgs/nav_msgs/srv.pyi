from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "GetMap",
    "GetMap_Event",
    "GetMap_Request",
    "GetMap_Response",
    "GetPlan",
    "GetPlan_Event",
    "GetPlan_Request",
    "GetPlan_Response",
    "LoadMap",
    "LoadMap_Event",
    "LoadMap_Request",
    "LoadMap_Response",
    "SetMap",
    "SetMap_Event",
    "SetMap_Request",
    "SetMap_Response",
]

class GetMap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetMap_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetMap_Request]) -> None: ...
    @property
    def response(self) -> list[GetMap_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetMap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetMap_Request] = ..., response: Iterable[GetMap_Response] = ...) -> None: ...

class GetMap_Request(Message):
    def __init__(self) -> None: ...

class GetMap_Response(Message):
    map: _nav_msgs_msg.OccupancyGrid
    def __init__(self, *, map: _nav_msgs_msg.OccupancyGrid = ...) -> None: ...

class GetPlan_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetPlan_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetPlan_Request]) -> None: ...
    @property
    def response(self) -> list[GetPlan_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetPlan_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetPlan_Request] = ..., response: Iterable[GetPlan_Response] = ...) -> None: ...

class GetPlan_Request(Message):
    start: _geometry_msgs_msg.PoseStamped
    goal: _geometry_msgs_msg.PoseStamped
    tolerance: float
    def __init__(self, *, start: _geometry_msgs_msg.PoseStamped = ..., goal: _geometry_msgs_msg.PoseStamped = ..., tolerance: float = ...) -> None: ...

class GetPlan_Response(Message):
    plan: _nav_msgs_msg.Path
    def __init__(self, *, plan: _nav_msgs_msg.Path = ...) -> None: ...

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

class SetMap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetMap_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetMap_Request]) -> None: ...
    @property
    def response(self) -> list[SetMap_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetMap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetMap_Request] = ..., response: Iterable[SetMap_Response] = ...) -> None: ...

class SetMap_Request(Message):
    map: _nav_msgs_msg.OccupancyGrid
    initial_pose: _geometry_msgs_msg.PoseWithCovarianceStamped
    def __init__(self, *, map: _nav_msgs_msg.OccupancyGrid = ..., initial_pose: _geometry_msgs_msg.PoseWithCovarianceStamped = ...) -> None: ...

class SetMap_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class GetMap(Service):
    Request = GetMap_Request
    Response = GetMap_Response
    Event = GetMap_Event

class GetPlan(Service):
    Request = GetPlan_Request
    Response = GetPlan_Response
    Event = GetPlan_Event

class LoadMap(Service):
    Request = LoadMap_Request
    Response = LoadMap_Response
    Event = LoadMap_Event

class SetMap(Service):
    Request = SetMap_Request
    Response = SetMap_Response
    Event = SetMap_Event
