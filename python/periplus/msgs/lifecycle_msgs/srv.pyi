from collections.abc import Iterable

import periplus.msgs.lifecycle_msgs.msg as _lifecycle_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "ChangeState",
    "ChangeState_Event",
    "ChangeState_Request",
    "ChangeState_Response",
    "GetAvailableStates",
    "GetAvailableStates_Event",
    "GetAvailableStates_Request",
    "GetAvailableStates_Response",
    "GetAvailableTransitions",
    "GetAvailableTransitions_Event",
    "GetAvailableTransitions_Request",
    "GetAvailableTransitions_Response",
    "GetState",
    "GetState_Event",
    "GetState_Request",
    "GetState_Response",
]

class ChangeState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ChangeState_Request]: ...
    @request.setter
    def request(self, value: Iterable[ChangeState_Request]) -> None: ...
    @property
    def response(self) -> list[ChangeState_Response]: ...
    @response.setter
    def response(self, value: Iterable[ChangeState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ChangeState_Request] = ..., response: Iterable[ChangeState_Response] = ...) -> None: ...

class ChangeState_Request(Message):
    transition: _lifecycle_msgs_msg.Transition
    def __init__(self, *, transition: _lifecycle_msgs_msg.Transition = ...) -> None: ...

class ChangeState_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class GetAvailableStates_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetAvailableStates_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetAvailableStates_Request]) -> None: ...
    @property
    def response(self) -> list[GetAvailableStates_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetAvailableStates_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetAvailableStates_Request] = ..., response: Iterable[GetAvailableStates_Response] = ...) -> None: ...

class GetAvailableStates_Request(Message):
    def __init__(self) -> None: ...

class GetAvailableStates_Response(Message):
    @property
    def available_states(self) -> list[_lifecycle_msgs_msg.State]: ...
    @available_states.setter
    def available_states(self, value: Iterable[_lifecycle_msgs_msg.State]) -> None: ...
    def __init__(self, *, available_states: Iterable[_lifecycle_msgs_msg.State] = ...) -> None: ...

class GetAvailableTransitions_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetAvailableTransitions_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetAvailableTransitions_Request]) -> None: ...
    @property
    def response(self) -> list[GetAvailableTransitions_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetAvailableTransitions_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetAvailableTransitions_Request] = ..., response: Iterable[GetAvailableTransitions_Response] = ...) -> None: ...

class GetAvailableTransitions_Request(Message):
    def __init__(self) -> None: ...

class GetAvailableTransitions_Response(Message):
    @property
    def available_transitions(self) -> list[_lifecycle_msgs_msg.TransitionDescription]: ...
    @available_transitions.setter
    def available_transitions(self, value: Iterable[_lifecycle_msgs_msg.TransitionDescription]) -> None: ...
    def __init__(self, *, available_transitions: Iterable[_lifecycle_msgs_msg.TransitionDescription] = ...) -> None: ...

class GetState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetState_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetState_Request]) -> None: ...
    @property
    def response(self) -> list[GetState_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetState_Request] = ..., response: Iterable[GetState_Response] = ...) -> None: ...

class GetState_Request(Message):
    def __init__(self) -> None: ...

class GetState_Response(Message):
    current_state: _lifecycle_msgs_msg.State
    def __init__(self, *, current_state: _lifecycle_msgs_msg.State = ...) -> None: ...

class ChangeState(Service):
    Request = ChangeState_Request
    Response = ChangeState_Response
    Event = ChangeState_Event

class GetAvailableStates(Service):
    Request = GetAvailableStates_Request
    Response = GetAvailableStates_Response
    Event = GetAvailableStates_Event

class GetAvailableTransitions(Service):
    Request = GetAvailableTransitions_Request
    Response = GetAvailableTransitions_Response
    Event = GetAvailableTransitions_Event

class GetState(Service):
    Request = GetState_Request
    Response = GetState_Response
    Event = GetState_Event
