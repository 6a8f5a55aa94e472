from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

import periplus.msgs.action_msgs.msg as _action_msgs_msg
import periplus.msgs.action_msgs.srv as _action_msgs_srv
import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Action, Message, Service

__all__ = [
    "Fibonacci",
    "Fibonacci_Feedback",
    "Fibonacci_FeedbackMessage",
    "Fibonacci_GetResult_Event",
    "Fibonacci_GetResult_Request",
    "Fibonacci_GetResult_Response",
    "Fibonacci_Goal",
    "Fibonacci_Result",
    "Fibonacci_SendGoal_Event",
    "Fibonacci_SendGoal_Request",
    "Fibonacci_SendGoal_Response",
]

class Fibonacci_Feedback(Message):
    @property
    def sequence(self) -> npt.NDArray[np.int32]: ...
    @sequence.setter
    def sequence(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, sequence: npt.ArrayLike = ...) -> None: ...

class Fibonacci_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: Fibonacci_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: Fibonacci_Feedback = ...) -> None: ...

class Fibonacci_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Fibonacci_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[Fibonacci_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[Fibonacci_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[Fibonacci_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Fibonacci_GetResult_Request] = ..., response: Iterable[Fibonacci_GetResult_Response] = ...) -> None: ...

class Fibonacci_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class Fibonacci_GetResult_Response(Message):
    status: int
    result: Fibonacci_Result
    def __init__(self, *, status: int = ..., result: Fibonacci_Result = ...) -> None: ...

class Fibonacci_Goal(Message):
    order: int
    def __init__(self, *, order: int = ...) -> None: ...

class Fibonacci_Result(Message):
    @property
    def sequence(self) -> npt.NDArray[np.int32]: ...
    @sequence.setter
    def sequence(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, sequence: npt.ArrayLike = ...) -> None: ...

class Fibonacci_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Fibonacci_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[Fibonacci_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[Fibonacci_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[Fibonacci_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Fibonacci_SendGoal_Request] = ..., response: Iterable[Fibonacci_SendGoal_Response] = ...) -> None: ...

class Fibonacci_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: Fibonacci_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: Fibonacci_Goal = ...) -> None: ...

class Fibonacci_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class Fibonacci(Action):
    Goal = Fibonacci_Goal
    Result = Fibonacci_Result
    Feedback = Fibonacci_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = Fibonacci_SendGoal_Request
            Response = Fibonacci_SendGoal_Response
            Event = Fibonacci_SendGoal_Event
        class GetResultService(Service):
            Request = Fibonacci_GetResult_Request
            Response = Fibonacci_GetResult_Response
            Event = Fibonacci_GetResult_Event
        FeedbackMessage = Fibonacci_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray
