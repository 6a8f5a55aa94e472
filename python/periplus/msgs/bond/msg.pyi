from typing import ClassVar

import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Constants",
    "Status",
]

class Constants(Message):
    DEAD_PUBLISH_PERIOD: ClassVar[float]
    DEFAULT_CONNECT_TIMEOUT: ClassVar[float]
    DEFAULT_HEARTBEAT_TIMEOUT: ClassVar[float]
    DEFAULT_DISCONNECT_TIMEOUT: ClassVar[float]
    DEFAULT_HEARTBEAT_PERIOD: ClassVar[float]
    DISABLE_HEARTBEAT_TIMEOUT_PARAM: ClassVar[str]
    def __init__(self) -> None: ...

class Status(Message):
    header: _std_msgs_msg.Header
    id: str
    instance_id: str
    active: bool
    heartbeat_timeout: float
    heartbeat_period: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., id: str = ..., instance_id: str = ..., active: bool = ..., heartbeat_timeout: float = ..., heartbeat_period: float = ...) -> None: ...
