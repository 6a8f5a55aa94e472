from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Message

__all__ = [
    "GoalInfo",
    "GoalStatus",
    "GoalStatusArray",
]

class GoalInfo(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class GoalStatus(Message):
    STATUS_UNKNOWN: ClassVar[int]
    STATUS_ACCEPTED: ClassVar[int]
    STATUS_EXECUTING: ClassVar[int]
    STATUS_CANCELING: ClassVar[int]
    STATUS_SUCCEEDED: ClassVar[int]
    STATUS_CANCELED: ClassVar[int]
    STATUS_ABORTED: ClassVar[int]
    goal_info: GoalInfo
    status: int
    def __init__(self, *, goal_info: GoalInfo = ..., status: int = ...) -> None: ...

class GoalStatusArray(Message):
    @property
    def status_list(self) -> list[GoalStatus]: ...
    @status_list.setter
    def status_list(self, value: Iterable[GoalStatus]) -> None: ...
    def __init__(self, *, status_list: Iterable[GoalStatus] = ...) -> None: ...
