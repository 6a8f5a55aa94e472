from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "AddSubmap",
    "AddSubmap_Event",
    "AddSubmap_Request",
    "AddSubmap_Response",
    "Clear",
    "ClearQueue",
    "ClearQueue_Event",
    "ClearQueue_Request",
    "ClearQueue_Response",
    "Clear_Event",
    "Clear_Request",
    "Clear_Response",
    "DeserializePoseGraph",
    "DeserializePoseGraph_Event",
    "DeserializePoseGraph_Request",
    "DeserializePoseGraph_Response",
    "LoopClosure",
    "LoopClosure_Event",
    "LoopClosure_Request",
    "LoopClosure_Response",
    "MergeMaps",
    "MergeMaps_Event",
    "MergeMaps_Request",
    "MergeMaps_Response",
    "Pause",
    "Pause_Event",
    "Pause_Request",
    "Pause_Response",
    "Reset",
    "Reset_Event",
    "Reset_Request",
    "Reset_Response",
    "SaveMap",
    "SaveMap_Event",
    "SaveMap_Request",
    "SaveMap_Response",
    "SerializePoseGraph",
    "SerializePoseGraph_Event",
    "SerializePoseGraph_Request",
    "SerializePoseGraph_Response",
    "ToggleInteractive",
    "ToggleInteractive_Event",
    "ToggleInteractive_Request",
    "ToggleInteractive_Response",
]

class AddSubmap_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AddSubmap_Request]: ...
    @request.setter
    def request(self, value: Iterable[AddSubmap_Request]) -> None: ...
    @property
    def response(self) -> list[AddSubmap_Response]: ...
    @response.setter
    def response(self, value: Iterable[AddSubmap_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AddSubmap_Request] = ..., response: Iterable[AddSubmap_Response] = ...) -> None: ...

class AddSubmap_Request(Message):
    filename: str
    def __init__(self, *, filename: str = ...) -> None: ...

class AddSubmap_Response(Message):
    def __init__(self) -> None: ...

class ClearQueue_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ClearQueue_Request]: ...
    @request.setter
    def request(self, value: Iterable[ClearQueue_Request]) -> None: ...
    @property
    def response(self) -> list[ClearQueue_Response]: ...
    @response.setter
    def response(self, value: Iterable[ClearQueue_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ClearQueue_Request] = ..., response: Iterable[ClearQueue_Response] = ...) -> None: ...

class ClearQueue_Request(Message):
    def __init__(self) -> None: ...

class ClearQueue_Response(Message):
    status: bool
    def __init__(self, *, status: bool = ...) -> None: ...

class Clear_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Clear_Request]: ...
    @request.setter
    def request(self, value: Iterable[Clear_Request]) -> None: ...
    @property
    def response(self) -> list[Clear_Response]: ...
    @response.setter
    def response(self, value: Iterable[Clear_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Clear_Request] = ..., response: Iterable[Clear_Response] = ...) -> None: ...

class Clear_Request(Message):
    def __init__(self) -> None: ...

class Clear_Response(Message):
    def __init__(self) -> None: ...

class DeserializePoseGraph_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DeserializePoseGraph_Request]: ...
    @request.setter
    def request(self, value: Iterable[DeserializePoseGraph_Request]) -> None: ...
    @property
    def response(self) -> list[DeserializePoseGraph_Response]: ...
    @response.setter
    def response(self, value: Iterable[DeserializePoseGraph_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DeserializePoseGraph_Request] = ..., response: Iterable[DeserializePoseGraph_Response] = ...) -> None: ...

class DeserializePoseGraph_Request(Message):
    UNSET: ClassVar[int]
    START_AT_FIRST_NODE: ClassVar[int]
    START_AT_GIVEN_POSE: ClassVar[int]
    LOCALIZE_AT_POSE: ClassVar[int]
    filename: str
    match_type: int
    initial_pose: _geometry_msgs_msg.Pose2D
    def __init__(self, *, filename: str = ..., match_type: int = ..., initial_pose: _geometry_msgs_msg.Pose2D = ...) -> None: ...

class DeserializePoseGraph_Response(Message):
    def __init__(self) -> None: ...

class LoopClosure_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LoopClosure_Request]: ...
    @request.setter
    def request(self, value: Iterable[LoopClosure_Request]) -> None: ...
    @property
    def response(self) -> list[LoopClosure_Response]: ...
    @response.setter
    def response(self, value: Iterable[LoopClosure_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LoopClosure_Request] = ..., response: Iterable[LoopClosure_Response] = ...) -> None: ...

class LoopClosure_Request(Message):
    def __init__(self) -> None: ...

class LoopClosure_Response(Message):
    def __init__(self) -> None: ...

class MergeMaps_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[MergeMaps_Request]: ...
    @request.setter
    def request(self, value: Iterable[MergeMaps_Request]) -> None: ...
    @property
    def response(self) -> list[MergeMaps_Response]: ...
    @response.setter
    def response(self, value: Iterable[MergeMaps_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[MergeMaps_Request] = ..., response: Iterable[MergeMaps_Response] = ...) -> None: ...

class MergeMaps_Request(Message):
    def __init__(self) -> None: ...

class MergeMaps_Response(Message):
    def __init__(self) -> None: ...

class Pause_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Pause_Request]: ...
    @request.setter
    def request(self, value: Iterable[Pause_Request]) -> None: ...
    @property
    def response(self) -> list[Pause_Response]: ...
    @response.setter
    def response(self, value: Iterable[Pause_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Pause_Request] = ..., response: Iterable[Pause_Response] = ...) -> None: ...

class Pause_Request(Message):
    def __init__(self) -> None: ...

class Pause_Response(Message):
    status: bool
    def __init__(self, *, status: bool = ...) -> None: ...

class Reset_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Reset_Request]: ...
    @request.setter
    def request(self, value: Iterable[Reset_Request]) -> None: ...
    @property
    def response(self) -> list[Reset_Response]: ...
    @response.setter
    def response(self, value: Iterable[Reset_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Reset_Request] = ..., response: Iterable[Reset_Response] = ...) -> None: ...

class Reset_Request(Message):
    pause_new_measurements: bool
    def __init__(self, *, pause_new_measurements: bool = ...) -> None: ...

class Reset_Response(Message):
    RESULT_SUCCESS: ClassVar[int]
    result: int
    def __init__(self, *, result: int = ...) -> None: ...

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
    name: _std_msgs_msg.String
    def __init__(self, *, name: _std_msgs_msg.String = ...) -> None: ...

class SaveMap_Response(Message):
    RESULT_SUCCESS: ClassVar[int]
    RESULT_NO_MAP_RECEIEVD: ClassVar[int]
    RESULT_UNDEFINED_FAILURE: ClassVar[int]
    result: int
    def __init__(self, *, result: int = ...) -> None: ...

class SerializePoseGraph_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SerializePoseGraph_Request]: ...
    @request.setter
    def request(self, value: Iterable[SerializePoseGraph_Request]) -> None: ...
    @property
    def response(self) -> list[SerializePoseGraph_Response]: ...
    @response.setter
    def response(self, value: Iterable[SerializePoseGraph_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SerializePoseGraph_Request] = ..., response: Iterable[SerializePoseGraph_Response] = ...) -> None: ...

class SerializePoseGraph_Request(Message):
    filename: str
    def __init__(self, *, filename: str = ...) -> None: ...

class SerializePoseGraph_Response(Message):
    RESULT_SUCCESS: ClassVar[int]
    RESULT_FAILED_TO_WRITE_FILE: ClassVar[int]
    result: int
    def __init__(self, *, result: int = ...) -> None: ...

class ToggleInteractive_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ToggleInteractive_Request]: ...
    @request.setter
    def request(self, value: Iterable[ToggleInteractive_Request]) -> None: ...
    @property
    def response(self) -> list[ToggleInteractive_Response]: ...
    @response.setter
    def response(self, value: Iterable[ToggleInteractive_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ToggleInteractive_Request] = ..., response: Iterable[ToggleInteractive_Response] = ...) -> None: ...

class ToggleInteractive_Request(Message):
    def __init__(self) -> None: ...

class ToggleInteractive_Response(Message):
    def __init__(self) -> None: ...

class AddSubmap(Service):
    Request = AddSubmap_Request
    Response = AddSubmap_Response
    Event = AddSubmap_Event

class Clear(Service):
    Request = Clear_Request
    Response = Clear_Response
    Event = Clear_Event

class ClearQueue(Service):
    Request = ClearQueue_Request
    Response = ClearQueue_Response
    Event = ClearQueue_Event

class DeserializePoseGraph(Service):
    Request = DeserializePoseGraph_Request
    Response = DeserializePoseGraph_Response
    Event = DeserializePoseGraph_Event

class LoopClosure(Service):
    Request = LoopClosure_Request
    Response = LoopClosure_Response
    Event = LoopClosure_Event

class MergeMaps(Service):
    Request = MergeMaps_Request
    Response = MergeMaps_Response
    Event = MergeMaps_Event

class Pause(Service):
    Request = Pause_Request
    Response = Pause_Response
    Event = Pause_Event

class Reset(Service):
    Request = Reset_Request
    Response = Reset_Response
    Event = Reset_Event

class SaveMap(Service):
    Request = SaveMap_Request
    Response = SaveMap_Response
    Event = SaveMap_Event

class SerializePoseGraph(Service):
    Request = SerializePoseGraph_Request
    Response = SerializePoseGraph_Response
    Event = SerializePoseGraph_Event

class ToggleInteractive(Service):
    Request = ToggleInteractive_Request
    Response = ToggleInteractive_Response
    Event = ToggleInteractive_Event
