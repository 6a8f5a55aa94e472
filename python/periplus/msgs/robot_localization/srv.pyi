from collections.abc import Iterable

import periplus.msgs.geographic_msgs.msg as _geographic_msgs_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "FromLL",
    "FromLLArray",
    "FromLLArray_Event",
    "FromLLArray_Request",
    "FromLLArray_Response",
    "FromLL_Event",
    "FromLL_Request",
    "FromLL_Response",
    "SetDatum",
    "SetDatum_Event",
    "SetDatum_Request",
    "SetDatum_Response",
    "ToLL",
    "ToLL_Event",
    "ToLL_Request",
    "ToLL_Response",
]

class FromLLArray_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FromLLArray_Request]: ...
    @request.setter
    def request(self, value: Iterable[FromLLArray_Request]) -> None: ...
    @property
    def response(self) -> list[FromLLArray_Response]: ...
    @response.setter
    def response(self, value: Iterable[FromLLArray_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FromLLArray_Request] = ..., response: Iterable[FromLLArray_Response] = ...) -> None: ...

class FromLLArray_Request(Message):
    @property
    def ll_points(self) -> list[_geographic_msgs_msg.GeoPoint]: ...
    @ll_points.setter
    def ll_points(self, value: Iterable[_geographic_msgs_msg.GeoPoint]) -> None: ...
    def __init__(self, *, ll_points: Iterable[_geographic_msgs_msg.GeoPoint] = ...) -> None: ...

class FromLLArray_Response(Message):
    @property
    def map_points(self) -> list[_geometry_msgs_msg.Point]: ...
    @map_points.setter
    def map_points(self, value: Iterable[_geometry_msgs_msg.Point]) -> None: ...
    def __init__(self, *, map_points: Iterable[_geometry_msgs_msg.Point] = ...) -> None: ...

class FromLL_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FromLL_Request]: ...
    @request.setter
    def request(self, value: Iterable[FromLL_Request]) -> None: ...
    @property
    def response(self) -> list[FromLL_Response]: ...
    @response.setter
    def response(self, value: Iterable[FromLL_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FromLL_Request] = ..., response: Iterable[FromLL_Response] = ...) -> None: ...

class FromLL_Request(Message):
    ll_point: _geographic_msgs_msg.GeoPoint
    def __init__(self, *, ll_point: _geographic_msgs_msg.GeoPoint = ...) -> None: ...

class FromLL_Response(Message):
    map_point: _geometry_msgs_msg.Point
    def __init__(self, *, map_point: _geometry_msgs_msg.Point = ...) -> None: ...

class SetDatum_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetDatum_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetDatum_Request]) -> None: ...
    @property
    def response(self) -> list[SetDatum_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetDatum_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetDatum_Request] = ..., response: Iterable[SetDatum_Response] = ...) -> None: ...

class SetDatum_Request(Message):
    geo_pose: _geographic_msgs_msg.GeoPose
    def __init__(self, *, geo_pose: _geographic_msgs_msg.GeoPose = ...) -> None: ...

class SetDatum_Response(Message):
    def __init__(self) -> None: ...

class ToLL_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ToLL_Request]: ...
    @request.setter
    def request(self, value: Iterable[ToLL_Request]) -> None: ...
    @property
    def response(self) -> list[ToLL_Response]: ...
    @response.setter
    def response(self, value: Iterable[ToLL_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ToLL_Request] = ..., response: Iterable[ToLL_Response] = ...) -> None: ...

class ToLL_Request(Message):
    map_point: _geometry_msgs_msg.Point
    def __init__(self, *, map_point: _geometry_msgs_msg.Point = ...) -> None: ...

class ToLL_Response(Message):
    ll_point: _geographic_msgs_msg.GeoPoint
    def __init__(self, *, ll_point: _geographic_msgs_msg.GeoPoint = ...) -> None: ...

class FromLL(Service):
    Request = FromLL_Request
    Response = FromLL_Response
    Event = FromLL_Event

class FromLLArray(Service):
    Request = FromLLArray_Request
    Response = FromLLArray_Response
    Event = FromLLArray_Event

class SetDatum(Service):
    Request = SetDatum_Request
    Response = SetDatum_Response
    Event = SetDatum_Event

class ToLL(Service):
    Request = ToLL_Request
    Response = ToLL_Response
    Event = ToLL_Event
