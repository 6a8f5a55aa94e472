from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "GoalID",
    "GoalStatus",
    "GoalStatusArray",
]

class GoalID(Message):
    stamp: _builtin_interfaces_msg.Time
    id: str
    def __init__(self, *, stamp: _builtin_interfaces_msg.Time = ..., id: str = ...) -> None: ...

class GoalStatus(Message):
    PENDING: ClassVar[int]
    ACTIVE: ClassVar[int]
    PREEMPTED: ClassVar[int]
    SUCCEEDED: ClassVar[int]
    ABORTED: ClassVar[int]
    REJECTED: ClassVar[int]
    PREEMPTING: ClassVar[int]
    RECALLING: ClassVar[int]
    RECALLED: ClassVar[int]
    LOST: ClassVar[int]
    goal_id: GoalID
    status: int
    text: str
    def __init__(self, *, goal_id: GoalID = ..., status: int = ..., text: str = ...) -> None: ...

class GoalStatusArray(Message):
    header: _std_msgs_msg.Header
    @property
    def status_list(self) -> list[GoalStatus]: ...
    @status_list.setter
    def status_list(self, value: Iterable[GoalStatus]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., status_list: Iterable[GoalStatus] = ...) -> None: ...
