import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "Clock",
]

class Clock(Message):
    clock: _builtin_interfaces_msg.Time
    def __init__(self, *, clock: _builtin_interfaces_msg.Time = ...) -> None: ...
