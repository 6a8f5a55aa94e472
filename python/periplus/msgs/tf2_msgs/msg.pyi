from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
from periplus.msgs import Message

__all__ = [
    "TF2Error",
    "TFMessage",
]

class TF2Error(Message):
    NO_ERROR: ClassVar[int]
    LOOKUP_ERROR: ClassVar[int]
    CONNECTIVITY_ERROR: ClassVar[int]
    EXTRAPOLATION_ERROR: ClassVar[int]
    INVALID_ARGUMENT_ERROR: ClassVar[int]
    TIMEOUT_ERROR: ClassVar[int]
    TRANSFORM_ERROR: ClassVar[int]
    error: int
    error_string: str
    def __init__(self, *, error: int = ..., error_string: str = ...) -> None: ...

class TFMessage(Message):
    @property
    def transforms(self) -> list[_geometry_msgs_msg.TransformStamped]: ...
    @transforms.setter
    def transforms(self, value: Iterable[_geometry_msgs_msg.TransformStamped]) -> None: ...
    def __init__(self, *, transforms: Iterable[_geometry_msgs_msg.TransformStamped] = ...) -> None: ...
