from collections.abc import Iterable

import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.visualization_msgs.msg as _visualization_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "GetInteractiveMarkers",
    "GetInteractiveMarkers_Event",
    "GetInteractiveMarkers_Request",
    "GetInteractiveMarkers_Response",
]

class GetInteractiveMarkers_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetInteractiveMarkers_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetInteractiveMarkers_Request]) -> None: ...
    @property
    def response(self) -> list[GetInteractiveMarkers_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetInteractiveMarkers_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetInteractiveMarkers_Request] = ..., response: Iterable[GetInteractiveMarkers_Response] = ...) -> None: ...

class GetInteractiveMarkers_Request(Message):
    def __init__(self) -> None: ...

class GetInteractiveMarkers_Response(Message):
    sequence_number: int
    @property
    def markers(self) -> list[_visualization_msgs_msg.InteractiveMarker]: ...
    @markers.setter
    def markers(self, value: Iterable[_visualization_msgs_msg.InteractiveMarker]) -> None: ...
    def __init__(self, *, sequence_number: int = ..., markers: Iterable[_visualization_msgs_msg.InteractiveMarker] = ...) -> None: ...

class GetInteractiveMarkers(Service):
    Request = GetInteractiveMarkers_Request
    Response = GetInteractiveMarkers_Response
    Event = GetInteractiveMarkers_Event
