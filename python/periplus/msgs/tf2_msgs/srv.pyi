from collections.abc import Iterable

import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "FrameGraph",
    "FrameGraph_Event",
    "FrameGraph_Request",
    "FrameGraph_Response",
]

class FrameGraph_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FrameGraph_Request]: ...
    @request.setter
    def request(self, value: Iterable[FrameGraph_Request]) -> None: ...
    @property
    def response(self) -> list[FrameGraph_Response]: ...
    @response.setter
    def response(self, value: Iterable[FrameGraph_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FrameGraph_Request] = ..., response: Iterable[FrameGraph_Response] = ...) -> None: ...

class FrameGraph_Request(Message):
    def __init__(self) -> None: ...

class FrameGraph_Response(Message):
    frame_yaml: str
    def __init__(self, *, frame_yaml: str = ...) -> None: ...

class FrameGraph(Service):
    Request = FrameGraph_Request
    Response = FrameGraph_Response
    Event = FrameGraph_Event
