from collections.abc import Iterable

import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "Empty",
    "Empty_Event",
    "Empty_Request",
    "Empty_Response",
    "SetBool",
    "SetBool_Event",
    "SetBool_Request",
    "SetBool_Response",
    "Trigger",
    "Trigger_Event",
    "Trigger_Request",
    "Trigger_Response",
]

class Empty_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Empty_Request]: ...
    @request.setter
    def request(self, value: Iterable[Empty_Request]) -> None: ...
    @property
    def response(self) -> list[Empty_Response]: ...
    @response.setter
    def response(self, value: Iterable[Empty_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Empty_Request] = ..., response: Iterable[Empty_Response] = ...) -> None: ...

class Empty_Request(Message):
    def __init__(self) -> None: ...

class Empty_Response(Message):
    def __init__(self) -> None: ...

class SetBool_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetBool_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetBool_Request]) -> None: ...
    @property
    def response(self) -> list[SetBool_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetBool_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetBool_Request] = ..., response: Iterable[SetBool_Response] = ...) -> None: ...

class SetBool_Request(Message):
    data: bool
    def __init__(self, *, data: bool = ...) -> None: ...

class SetBool_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class Trigger_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Trigger_Request]: ...
    @request.setter
    def request(self, value: Iterable[Trigger_Request]) -> None: ...
    @property
    def response(self) -> list[Trigger_Response]: ...
    @response.setter
    def response(self, value: Iterable[Trigger_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Trigger_Request] = ..., response: Iterable[Trigger_Response] = ...) -> None: ...

class Trigger_Request(Message):
    def __init__(self) -> None: ...

class Trigger_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class Empty(Service):
    Request = Empty_Request
    Response = Empty_Response
    Event = Empty_Event

class SetBool(Service):
    Request = SetBool_Request
    Response = SetBool_Response
    Event = SetBool_Event

class Trigger(Service):
    Request = Trigger_Request
    Response = Trigger_Response
    Event = Trigger_Event
