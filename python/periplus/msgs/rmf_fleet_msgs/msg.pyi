from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "DestinationRequest",
    "FleetState",
    "Location",
    "ModeParameter",
    "ModeRequest",
    "PathRequest",
    "PauseRequest",
    "RobotMode",
    "RobotState",
]

class DestinationRequest(Message):
    fleet_name: str
    robot_name: str
    destination: Location
    task_id: str
    def __init__(self, *, fleet_name: str = ..., robot_name: str = ..., destination: Location = ..., task_id: str = ...) -> None: ...

class FleetState(Message):
    name: str
    @property
    def robots(self) -> list[RobotState]: ...
    @robots.setter
    def robots(self, value: Iterable[RobotState]) -> None: ...
    def __init__(self, *, name: str = ..., robots: Iterable[RobotState] = ...) -> None: ...

class Location(Message):
    t: _builtin_interfaces_msg.Time
    x: float
    y: float
    yaw: float
    obey_approach_speed_limit: bool
    approach_speed_limit: float
    level_name: str
    index: int
    def __init__(self, *, t: _builtin_interfaces_msg.Time = ..., x: float = ..., y: float = ..., yaw: float = ..., obey_approach_speed_limit: bool = ..., approach_speed_limit: float = ..., level_name: str = ..., index: int = ...) -> None: ...

class ModeParameter(Message):
    name: str
    value: str
    def __init__(self, *, name: str = ..., value: str = ...) -> None: ...

class ModeRequest(Message):
    fleet_name: str
    robot_name: str
    mode: RobotMode
    task_id: str
    @property
    def parameters(self) -> list[ModeParameter]: ...
    @parameters.setter
    def parameters(self, value: Iterable[ModeParameter]) -> None: ...
    def __init__(self, *, fleet_name: str = ..., robot_name: str = ..., mode: RobotMode = ..., task_id: str = ..., parameters: Iterable[ModeParameter] = ...) -> None: ...

class PathRequest(Message):
    fleet_name: str
    robot_name: str
    @property
    def path(self) -> list[Location]: ...
    @path.setter
    def path(self, value: Iterable[Location]) -> None: ...
    task_id: str
    def __init__(self, *, fleet_name: str = ..., robot_name: str = ..., path: Iterable[Location] = ..., task_id: str = ...) -> None: ...

class PauseRequest(Message):
    TYPE_PAUSE_IMMEDIATELY: ClassVar[int]
    TYPE_PAUSE_AT_CHECKPOINT: ClassVar[int]
    TYPE_RESUME: ClassVar[int]
    fleet_name: str
    robot_name: str
    mode_request_id: int
    type: int
    at_checkpoint: int
    def __init__(self, *, fleet_name: str = ..., robot_name: str = ..., mode_request_id: int = ..., type: int = ..., at_checkpoint: int = ...) -> None: ...

class RobotMode(Message):
    MODE_IDLE: ClassVar[int]
    MODE_CHARGING: ClassVar[int]
    MODE_MOVING: ClassVar[int]
    MODE_PAUSED: ClassVar[int]
    MODE_WAITING: ClassVar[int]
    MODE_EMERGENCY: ClassVar[int]
    MODE_GOING_HOME: ClassVar[int]
    MODE_DOCKING: ClassVar[int]
    MODE_ADAPTER_ERROR: ClassVar[int]
    MODE_CLEANING: ClassVar[int]
    MODE_PERFORMING_ACTION: ClassVar[int]
    MODE_ACTION_COMPLETED: ClassVar[int]
    mode: int
    mode_request_id: int
    performing_action: str
    def __init__(self, *, mode: int = ..., mode_request_id: int = ..., performing_action: str = ...) -> None: ...

class RobotState(Message):
    name: str
    model: str
    task_id: str
    seq: int
    mode: RobotMode
    battery_percent: float
    location: Location
    @property
    def path(self) -> list[Location]: ...
    @path.setter
    def path(self, value: Iterable[Location]) -> None: ...
    def __init__(self, *, name: str = ..., model: str = ..., task_id: str = ..., seq: int = ..., mode: RobotMode = ..., battery_percent: float = ..., location: Location = ..., path: Iterable[Location] = ...) -> None: ...
