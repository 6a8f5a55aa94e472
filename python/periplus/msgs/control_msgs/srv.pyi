from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "QueryTrajectoryState",
    "QueryTrajectoryState_Event",
    "QueryTrajectoryState_Request",
    "QueryTrajectoryState_Response",
    "SetOdometry",
    "SetOdometry_Event",
    "SetOdometry_Request",
    "SetOdometry_Response",
]

class QueryTrajectoryState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[QueryTrajectoryState_Request]: ...
    @request.setter
    def request(self, value: Iterable[QueryTrajectoryState_Request]) -> None: ...
    @property
    def response(self) -> list[QueryTrajectoryState_Response]: ...
    @response.setter
    def response(self, value: Iterable[QueryTrajectoryState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[QueryTrajectoryState_Request] = ..., response: Iterable[QueryTrajectoryState_Response] = ...) -> None: ...

class QueryTrajectoryState_Request(Message):
    time: _builtin_interfaces_msg.Time
    def __init__(self, *, time: _builtin_interfaces_msg.Time = ...) -> None: ...

class QueryTrajectoryState_Response(Message):
    success: bool
    message: str
    @property
    def name(self) -> list[str]: ...
    @name.setter
    def name(self, value: Iterable[str]) -> None: ...
    @property
    def position(self) -> npt.NDArray[np.float64]: ...
    @position.setter
    def position(self, value: npt.ArrayLike) -> None: ...
    @property
    def velocity(self) -> npt.NDArray[np.float64]: ...
    @velocity.setter
    def velocity(self, value: npt.ArrayLike) -> None: ...
    @property
    def acceleration(self) -> npt.NDArray[np.float64]: ...
    @acceleration.setter
    def acceleration(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, success: bool = ..., message: str = ..., name: Iterable[str] = ..., position: npt.ArrayLike = ..., velocity: npt.ArrayLike = ..., acceleration: npt.ArrayLike = ...) -> None: ...

class SetOdometry_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetOdometry_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetOdometry_Request]) -> None: ...
    @property
    def response(self) -> list[SetOdometry_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetOdometry_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetOdometry_Request] = ..., response: Iterable[SetOdometry_Response] = ...) -> None: ...

class SetOdometry_Request(Message):
    x: float
    y: float
    z: float
    roll: float
    pitch: float
    yaw: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ..., roll: float = ..., pitch: float = ..., yaw: float = ...) -> None: ...

class SetOdometry_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class QueryTrajectoryState(Service):
    Request = QueryTrajectoryState_Request
    Response = QueryTrajectoryState_Response
    Event = QueryTrajectoryState_Event

class SetOdometry(Service):
    Request = SetOdometry_Request
    Response = SetOdometry_Response
    Event = SetOdometry_Event
