from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.rcl_interfaces.msg as _rcl_interfaces_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "DescribeParameters",
    "DescribeParameters_Event",
    "DescribeParameters_Request",
    "DescribeParameters_Response",
    "GetLoggerLevels",
    "GetLoggerLevels_Event",
    "GetLoggerLevels_Request",
    "GetLoggerLevels_Response",
    "GetParameterTypes",
    "GetParameterTypes_Event",
    "GetParameterTypes_Request",
    "GetParameterTypes_Response",
    "GetParameters",
    "GetParameters_Event",
    "GetParameters_Request",
    "GetParameters_Response",
    "ListParameters",
    "ListParameters_Event",
    "ListParameters_Request",
    "ListParameters_Response",
    "SetLoggerLevels",
    "SetLoggerLevels_Event",
    "SetLoggerLevels_Request",
    "SetLoggerLevels_Response",
    "SetParameters",
    "SetParametersAtomically",
    "SetParametersAtomically_Event",
    "SetParametersAtomically_Request",
    "SetParametersAtomically_Response",
    "SetParameters_Event",
    "SetParameters_Request",
    "SetParameters_Response",
]

class DescribeParameters_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DescribeParameters_Request]: ...
    @request.setter
    def request(self, value: Iterable[DescribeParameters_Request]) -> None: ...
    @property
    def response(self) -> list[DescribeParameters_Response]: ...
    @response.setter
    def response(self, value: Iterable[DescribeParameters_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DescribeParameters_Request] = ..., response: Iterable[DescribeParameters_Response] = ...) -> None: ...

class DescribeParameters_Request(Message):
    @property
    def names(self) -> list[str]: ...
    @names.setter
    def names(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, names: Iterable[str] = ...) -> None: ...

class DescribeParameters_Response(Message):
    @property
    def descriptors(self) -> list[_rcl_interfaces_msg.ParameterDescriptor]: ...
    @descriptors.setter
    def descriptors(self, value: Iterable[_rcl_interfaces_msg.ParameterDescriptor]) -> None: ...
    def __init__(self, *, descriptors: Iterable[_rcl_interfaces_msg.ParameterDescriptor] = ...) -> None: ...

class GetLoggerLevels_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetLoggerLevels_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetLoggerLevels_Request]) -> None: ...
    @property
    def response(self) -> list[GetLoggerLevels_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetLoggerLevels_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetLoggerLevels_Request] = ..., response: Iterable[GetLoggerLevels_Response] = ...) -> None: ...

class GetLoggerLevels_Request(Message):
    @property
    def names(self) -> list[str]: ...
    @names.setter
    def names(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, names: Iterable[str] = ...) -> None: ...

class GetLoggerLevels_Response(Message):
    @property
    def levels(self) -> list[_rcl_interfaces_msg.LoggerLevel]: ...
    @levels.setter
    def levels(self, value: Iterable[_rcl_interfaces_msg.LoggerLevel]) -> None: ...
    def __init__(self, *, levels: Iterable[_rcl_interfaces_msg.LoggerLevel] = ...) -> None: ...

class GetParameterTypes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetParameterTypes_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetParameterTypes_Request]) -> None: ...
    @property
    def response(self) -> list[GetParameterTypes_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetParameterTypes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetParameterTypes_Request] = ..., response: Iterable[GetParameterTypes_Response] = ...) -> None: ...

class GetParameterTypes_Request(Message):
    @property
    def names(self) -> list[str]: ...
    @names.setter
    def names(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, names: Iterable[str] = ...) -> None: ...

class GetParameterTypes_Response(Message):
    @property
    def types(self) -> npt.NDArray[np.uint8]: ...
    @types.setter
    def types(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, types: npt.ArrayLike = ...) -> None: ...

class GetParameters_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetParameters_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetParameters_Request]) -> None: ...
    @property
    def response(self) -> list[GetParameters_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetParameters_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetParameters_Request] = ..., response: Iterable[GetParameters_Response] = ...) -> None: ...

class GetParameters_Request(Message):
    @property
    def names(self) -> list[str]: ...
    @names.setter
    def names(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, names: Iterable[str] = ...) -> None: ...

class GetParameters_Response(Message):
    @property
    def values(self) -> list[_rcl_interfaces_msg.ParameterValue]: ...
    @values.setter
    def values(self, value: Iterable[_rcl_interfaces_msg.ParameterValue]) -> None: ...
    def __init__(self, *, values: Iterable[_rcl_interfaces_msg.ParameterValue] = ...) -> None: ...

class ListParameters_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ListParameters_Request]: ...
    @request.setter
    def request(self, value: Iterable[ListParameters_Request]) -> None: ...
    @property
    def response(self) -> list[ListParameters_Response]: ...
    @response.setter
    def response(self, value: Iterable[ListParameters_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ListParameters_Request] = ..., response: Iterable[ListParameters_Response] = ...) -> None: ...

class ListParameters_Request(Message):
    DEPTH_RECURSIVE: ClassVar[int]
    @property
    def prefixes(self) -> list[str]: ...
    @prefixes.setter
    def prefixes(self, value: Iterable[str]) -> None: ...
    depth: int
    def __init__(self, *, prefixes: Iterable[str] = ..., depth: int = ...) -> None: ...

class ListParameters_Response(Message):
    result: _rcl_interfaces_msg.ListParametersResult
    def __init__(self, *, result: _rcl_interfaces_msg.ListParametersResult = ...) -> None: ...

class SetLoggerLevels_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetLoggerLevels_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetLoggerLevels_Request]) -> None: ...
    @property
    def response(self) -> list[SetLoggerLevels_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetLoggerLevels_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetLoggerLevels_Request] = ..., response: Iterable[SetLoggerLevels_Response] = ...) -> None: ...

class SetLoggerLevels_Request(Message):
    @property
    def levels(self) -> list[_rcl_interfaces_msg.LoggerLevel]: ...
    @levels.setter
    def levels(self, value: Iterable[_rcl_interfaces_msg.LoggerLevel]) -> None: ...
    def __init__(self, *, levels: Iterable[_rcl_interfaces_msg.LoggerLevel] = ...) -> None: ...

class SetLoggerLevels_Response(Message):
    @property
    def results(self) -> list[_rcl_interfaces_msg.SetLoggerLevelsResult]: ...
    @results.setter
    def results(self, value: Iterable[_rcl_interfaces_msg.SetLoggerLevelsResult]) -> None: ...
    def __init__(self, *, results: Iterable[_rcl_interfaces_msg.SetLoggerLevelsResult] = ...) -> None: ...

class SetParametersAtomically_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetParametersAtomically_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetParametersAtomically_Request]) -> None: ...
    @property
    def response(self) -> list[SetParametersAtomically_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetParametersAtomically_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetParametersAtomically_Request] = ..., response: Iterable[SetParametersAtomically_Response] = ...) -> None: ...

class SetParametersAtomically_Request(Message):
    @property
    def parameters(self) -> list[_rcl_interfaces_msg.Parameter]: ...
    @parameters.setter
    def parameters(self, value: Iterable[_rcl_interfaces_msg.Parameter]) -> None: ...
    def __init__(self, *, parameters: Iterable[_rcl_interfaces_msg.Parameter] = ...) -> None: ...

class SetParametersAtomically_Response(Message):
    result: _rcl_interfaces_msg.SetParametersResult
    def __init__(self, *, result: _rcl_interfaces_msg.SetParametersResult = ...) -> None: ...

class SetParameters_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetParameters_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetParameters_Request]) -> None: ...
    @property
    def response(self) -> list[SetParameters_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetParameters_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetParameters_Request] = ..., response: Iterable[SetParameters_Response] = ...) -> None: ...

class SetParameters_Request(Message):
    @property
    def parameters(self) -> list[_rcl_interfaces_msg.Parameter]: ...
    @parameters.setter
    def parameters(self, value: Iterable[_rcl_interfaces_msg.Parameter]) -> None: ...
    def __init__(self, *, parameters: Iterable[_rcl_interfaces_msg.Parameter] = ...) -> None: ...

class SetParameters_Response(Message):
    @property
    def results(self) -> list[_rcl_interfaces_msg.SetParametersResult]: ...
    @results.setter
    def results(self, value: Iterable[_rcl_interfaces_msg.SetParametersResult]) -> None: ...
    def __init__(self, *, results: Iterable[_rcl_interfaces_msg.SetParametersResult] = ...) -> None: ...

class DescribeParameters(Service):
    Request = DescribeParameters_Request
    Response = DescribeParameters_Response
    Event = DescribeParameters_Event

class GetLoggerLevels(Service):
    Request = GetLoggerLevels_Request
    Response = GetLoggerLevels_Response
    Event = GetLoggerLevels_Event

class GetParameterTypes(Service):
    Request = GetParameterTypes_Request
    Response = GetParameterTypes_Response
    Event = GetParameterTypes_Event

class GetParameters(Service):
    Request = GetParameters_Request
    Response = GetParameters_Response
    Event = GetParameters_Event

class ListParameters(Service):
    Request = ListParameters_Request
    Response = ListParameters_Response
    Event = ListParameters_Event

class SetLoggerLevels(Service):
    Request = SetLoggerLevels_Request
    Response = SetLoggerLevels_Response
    Event = SetLoggerLevels_Event

class SetParameters(Service):
    Request = SetParameters_Request
    Response = SetParameters_Response
    Event = SetParameters_Event

class SetParametersAtomically(Service):
    Request = SetParametersAtomically_Request
    Response = SetParametersAtomically_Response
    Event = SetParametersAtomically_Event
