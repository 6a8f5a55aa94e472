from typing import ClassVar

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "DoorMode",
    "DoorRequest",
    "DoorState",
]

class DoorMode(Message):
    MODE_CLOSED: ClassVar[int]
    MODE_MOVING: ClassVar[int]
    MODE_OPEN: ClassVar[int]
    MODE_OFFLINE: ClassVar[int]
    MODE_UNKNOWN: ClassVar[int]
    value: int
    def __init__(self, *, value: int = ...) -> None: ...

class DoorRequest(Message):
    request_time: _builtin_interfaces_msg.Time
    requester_id: str
    door_name: str
    requested_mode: DoorMode
    def __init__(self, *, request_time: _builtin_interfaces_msg.Time = ..., requester_id: str = ..., door_name: str = ..., requested_mode: DoorMode = ...) -> None: ...

class DoorState(Message):
    door_time: _builtin_interfaces_msg.Time
    door_name: str
    current_mode: DoorMode
    def __init__(self, *, door_time: _builtin_interfaces_msg.Time = ..., door_name: str = ..., current_mode: DoorMode = ...) -> None: ...
