from collections.abc import Iterable

import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.type_description_interfaces.msg as _type_description_interfaces_msg
from periplus.msgs import Message, Service

__all__ = [
    "GetTypeDescription",
    "GetTypeDescription_Event",
    "GetTypeDescription_Request",
    "GetTypeDescription_Response",
]

class GetTypeDescription_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetTypeDescription_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetTypeDescription_Request]) -> None: ...
    @property
    def response(self) -> list[GetTypeDescription_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetTypeDescription_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetTypeDescription_Request] = ..., response: Iterable[GetTypeDescription_Response] = ...) -> None: ...

class GetTypeDescription_Request(Message):
    type_name: str
    type_hash: str
    include_type_sources: bool
    def __init__(self, *, type_name: str = ..., type_hash: str = ..., include_type_sources: bool = ...) -> None: ...

class GetTypeDescription_Response(Message):
    successful: bool
    failure_reason: str
    type_description: _type_description_interfaces_msg.TypeDescription
    @property
    def type_sources(self) -> list[_type_description_interfaces_msg.TypeSource]: ...
    @type_sources.setter
    def type_sources(self, value: Iterable[_type_description_interfaces_msg.TypeSource]) -> None: ...
    @property
    def extra_information(self) -> list[_type_description_interfaces_msg.KeyValue]: ...
    @extra_information.setter
    def extra_information(self, value: Iterable[_type_description_interfaces_msg.KeyValue]) -> None: ...
    def __init__(self, *, successful: bool = ..., failure_reason: str = ..., type_description: _type_description_interfaces_msg.TypeDescription = ..., type_sources: Iterable[_type_description_interfaces_msg.TypeSource] = ..., extra_information: Iterable[_type_description_interfaces_msg.KeyValue] = ...) -> None: ...

class GetTypeDescription(Service):
    Request = GetTypeDescription_Request
    Response = GetTypeDescription_Response
    Event = GetTypeDescription_Event
