from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "ServiceEventInfo",
]

class ServiceEventInfo(Message):
    REQUEST_SENT: ClassVar[int]
    REQUEST_RECEIVED: ClassVar[int]
    RESPONSE_SENT: ClassVar[int]
    RESPONSE_RECEIVED: ClassVar[int]
    event_type: int
    stamp: _builtin_interfaces_msg.Time
    @property
    def client_gid(self) -> npt.NDArray[np.uint8]: ...
    @client_gid.setter
    def client_gid(self, value: npt.ArrayLike) -> None: ...
    sequence_number: int
    def __init__(self, *, event_type: int = ..., stamp: _builtin_interfaces_msg.Time = ..., client_gid: npt.ArrayLike = ..., sequence_number: int = ...) -> None: ...
