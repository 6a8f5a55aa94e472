from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.action_msgs.msg as _action_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "CancelGoal",
    "CancelGoal_Event",
    "CancelGoal_Request",
    "CancelGoal_Response",
]

class CancelGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[CancelGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[CancelGoal_Request]) -> None: ...
    @property
    def response(self) -> list[CancelGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[CancelGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[CancelGoal_Request] = ..., response: Iterable[CancelGoal_Response] = ...) -> None: ...

class CancelGoal_Request(Message):
    goal_info: _action_msgs_msg.GoalInfo
    def __init__(self, *, goal_info: _action_msgs_msg.GoalInfo = ...) -> None: ...

class CancelGoal_Response(Message):
    ERROR_NONE: ClassVar[int]
    ERROR_REJECTED: ClassVar[int]
    ERROR_UNKNOWN_GOAL_ID: ClassVar[int]
    ERROR_GOAL_TERMINATED: ClassVar[int]
    return_code: int
    @property
    def goals_canceling(self) -> list[_action_msgs_msg.GoalInfo]: ...
    @goals_canceling.setter
    def goals_canceling(self, value: Iterable[_action_msgs_msg.GoalInfo]) -> None: ...
    def __init__(self, *, return_code: int = ..., goals_canceling: Iterable[_action_msgs_msg.GoalInfo] = ...) -> None: ...

class CancelGoal(Service):
    Request = CancelGoal_Request
    Response = CancelGoal_Response
    Event = CancelGoal_Event
