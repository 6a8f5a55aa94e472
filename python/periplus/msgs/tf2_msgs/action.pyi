from collections.abc import Iterable

import periplus.msgs.action_msgs.msg as _action_msgs_msg
import periplus.msgs.action_msgs.srv as _action_msgs_srv
import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.tf2_msgs.msg as _tf2_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Action, Message, Service

__all__ = [
    "LookupTransform",
    "LookupTransform_Feedback",
    "LookupTransform_FeedbackMessage",
    "LookupTransform_GetResult_Event",
    "LookupTransform_GetResult_Request",
    "LookupTransform_GetResult_Response",
    "LookupTransform_Goal",
    "LookupTransform_Result",
    "LookupTransform_SendGoal_Event",
    "LookupTransform_SendGoal_Request",
    "LookupTransform_SendGoal_Response",
]

class LookupTransform_Feedback(Message):
    def __init__(self) -> None: ...

class LookupTransform_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: LookupTransform_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: LookupTransform_Feedback = ...) -> None: ...

class LookupTransform_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LookupTransform_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[LookupTransform_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[LookupTransform_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[LookupTransform_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LookupTransform_GetResult_Request] = ..., response: Iterable[LookupTransform_GetResult_Response] = ...) -> None: ...

class LookupTransform_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class LookupTransform_GetResult_Response(Message):
    status: int
    result: LookupTransform_Result
    def __init__(self, *, status: int = ..., result: LookupTransform_Result = ...) -> None: ...

class LookupTransform_Goal(Message):
    target_frame: str
    source_frame: str
    source_time: _builtin_interfaces_msg.Time
    timeout: _builtin_interfaces_msg.Duration
    target_time: _builtin_interfaces_msg.Time
    fixed_frame: str
    advanced: bool
    def __init__(self, *, target_frame: str = ..., source_frame: str = ..., source_time: _builtin_interfaces_msg.Time = ..., timeout: _builtin_interfaces_msg.Duration = ..., target_time: _builtin_interfaces_msg.Time = ..., fixed_frame: str = ..., advanced: bool = ...) -> None: ...

class LookupTransform_Result(Message):
    transform: _geometry_msgs_msg.TransformStamped
    error: _tf2_msgs_msg.TF2Error
    def __init__(self, *, transform: _geometry_msgs_msg.TransformStamped = ..., error: _tf2_msgs_msg.TF2Error = ...) -> None: ...

class LookupTransform_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LookupTransform_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[LookupTransform_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[LookupTransform_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[LookupTransform_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LookupTransform_SendGoal_Request] = ..., response: Iterable[LookupTransform_SendGoal_Response] = ...) -> None: ...

class LookupTransform_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: LookupTransform_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: LookupTransform_Goal = ...) -> None: ...

class LookupTransform_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class LookupTransform(Action):
    Goal = LookupTransform_Goal
    Result = LookupTransform_Result
    Feedback = LookupTransform_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = LookupTransform_SendGoal_Request
            Response = LookupTransform_SendGoal_Response
            Event = LookupTransform_SendGoal_Event
        class GetResultService(Service):
            Request = LookupTransform_GetResult_Request
            Response = LookupTransform_GetResult_Response
            Event = LookupTransform_GetResult_Event
        FeedbackMessage = LookupTransform_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray
