import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Status",
]

class Status(Message):
    header: _std_msgs_msg.Header
    id: str
    instance_id: str
    active: bool
    heartbeat_timeout: float
    heartbeat_period: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., id: str = ..., instance_id: str = ..., active: bool = ..., heartbeat_timeout: float = ..., heartbeat_period: float = ...) -> None: ...
