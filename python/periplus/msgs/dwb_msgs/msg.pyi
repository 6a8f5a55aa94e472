from collections.abc import Iterable

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav_2d_msgs.msg as _nav_2d_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "CriticScore",
    "LocalPlanEvaluation",
    "Trajectory2D",
    "TrajectoryScore",
]

class CriticScore(Message):
    name: str
    raw_score: float
    scale: float
    def __init__(self, *, name: str = ..., raw_score: float = ..., scale: float = ...) -> None: ...

class LocalPlanEvaluation(Message):
    header: _std_msgs_msg.Header
    @property
    def twists(self) -> list[TrajectoryScore]: ...
    @twists.setter
    def twists(self, value: Iterable[TrajectoryScore]) -> None: ...
    best_index: int
    worst_index: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., twists: Iterable[TrajectoryScore] = ..., best_index: int = ..., worst_index: int = ...) -> None: ...

class Trajectory2D(Message):
    velocity: _nav_2d_msgs_msg.Twist2D
    @property
    def time_offsets(self) -> list[_builtin_interfaces_msg.Duration]: ...
    @time_offsets.setter
    def time_offsets(self, value: Iterable[_builtin_interfaces_msg.Duration]) -> None: ...
    @property
    def poses(self) -> list[_geometry_msgs_msg.Pose2D]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.Pose2D]) -> None: ...
    def __init__(self, *, velocity: _nav_2d_msgs_msg.Twist2D = ..., time_offsets: Iterable[_builtin_interfaces_msg.Duration] = ..., poses: Iterable[_geometry_msgs_msg.Pose2D] = ...) -> None: ...

class TrajectoryScore(Message):
    traj: Trajectory2D
    @property
    def scores(self) -> list[CriticScore]: ...
    @scores.setter
    def scores(self, value: Iterable[CriticScore]) -> None: ...
    total: float
    def __init__(self, *, traj: Trajectory2D = ..., scores: Iterable[CriticScore] = ..., total: float = ...) -> None: ...
