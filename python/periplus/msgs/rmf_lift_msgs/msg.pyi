from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "LiftRequest",
    "LiftState",
]

class LiftRequest(Message):
    REQUEST_END_SESSION: ClassVar[int]
    REQUEST_AGV_MODE: ClassVar[int]
    REQUEST_HUMAN_MODE: ClassVar[int]
    DOOR_CLOSED: ClassVar[int]
    DOOR_OPEN: ClassVar[int]
    lift_name: str
    request_time: _builtin_interfaces_msg.Time
    session_id: str
    request_type: int
    destination_floor: str
    door_state: int
    def __init__(self, *, lift_name: str = ..., request_time: _builtin_interfaces_msg.Time = ..., session_id: str = ..., request_type: int = ..., destination_floor: str = ..., door_state: int = ...) -> None: ...

class LiftState(Message):
    DOOR_CLOSED: ClassVar[int]
    DOOR_MOVING: ClassVar[int]
    DOOR_OPEN: ClassVar[int]
    MOTION_STOPPED: ClassVar[int]
    MOTION_UP: ClassVar[int]
    MOTION_DOWN: ClassVar[int]
    MOTION_UNKNOWN: ClassVar[int]
    MODE_UNKNOWN: ClassVar[int]
    MODE_HUMAN: ClassVar[int]
    MODE_AGV: ClassVar[int]
    MODE_FIRE: ClassVar[int]
    MODE_OFFLINE: ClassVar[int]
    MODE_EMERGENCY: ClassVar[int]
    lift_time: _builtin_interfaces_msg.Time
    lift_name: str
    @property
    def available_floors(self) -> list[str]: ...
    @available_floors.setter
    def available_floors(self, value: Iterable[str]) -> None: ...
    current_floor: str
    destination_floor: str
    door_state: int
    motion_state: int
    @property
    def available_modes(self) -> npt.NDArray[np.uint8]: ...
    @available_modes.setter
    def available_modes(self, value: npt.ArrayLike) -> None: ...
    current_mode: int
    session_id: str
    def __init__(self, *, lift_time: _builtin_interfaces_msg.Time = ..., lift_name: str = ..., available_floors: Iterable[str] = ..., current_floor: str = ..., destination_floor: str = ..., door_state: int = ..., motion_state: int = ..., available_modes: npt.ArrayLike = ..., current_mode: int = ..., session_id: str = ...) -> None: ...
