from collections.abc import Iterable

import periplus.msgs.sensor_msgs.msg as _sensor_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "SetCameraInfo",
    "SetCameraInfo_Event",
    "SetCameraInfo_Request",
    "SetCameraInfo_Response",
]

class SetCameraInfo_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetCameraInfo_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetCameraInfo_Request]) -> None: ...
    @property
    def response(self) -> list[SetCameraInfo_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetCameraInfo_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetCameraInfo_Request] = ..., response: Iterable[SetCameraInfo_Response] = ...) -> None: ...

class SetCameraInfo_Request(Message):
    camera_info: _sensor_msgs_msg.CameraInfo
    def __init__(self, *, camera_info: _sensor_msgs_msg.CameraInfo = ...) -> None: ...

class SetCameraInfo_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetCameraInfo(Service):
    Request = SetCameraInfo_Request
    Response = SetCameraInfo_Response
    Event = SetCameraInfo_Event
