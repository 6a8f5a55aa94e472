from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "DiagnosticArray",
    "DiagnosticStatus",
    "KeyValue",
]

class DiagnosticArray(Message):
    header: _std_msgs_msg.Header
    @property
    def status(self) -> list[DiagnosticStatus]: ...
    @status.setter
    def status(self, value: Iterable[DiagnosticStatus]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., status: Iterable[DiagnosticStatus] = ...) -> None: ...

class DiagnosticStatus(Message):
    OK: ClassVar[bytes]
    WARN: ClassVar[bytes]
    ERROR: ClassVar[bytes]
    STALE: ClassVar[bytes]
    @property
    def level(self) -> bytes: ...
    @level.setter
    def level(self, value: bytes | int) -> None: ...
    name: str
    message: str
    hardware_id: str
    @property
    def values(self) -> list[KeyValue]: ...
    @values.setter
    def values(self, value: Iterable[KeyValue]) -> None: ...
    def __init__(self, *, level: bytes | int = ..., name: str = ..., message: str = ..., hardware_id: str = ..., values: Iterable[KeyValue] = ...) -> None: ...

class KeyValue(Message):
    key: str
    value: str
    def __init__(self, *, key: str = ..., value: str = ...) -> None: ...
