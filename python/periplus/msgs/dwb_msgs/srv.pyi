from collections.abc import Iterable

import periplus.msgs.dwb_msgs.msg as _dwb_msgs_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav_2d_msgs.msg as _nav_2d_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "DebugLocalPlan",
    "DebugLocalPlan_Event",
    "DebugLocalPlan_Request",
    "DebugLocalPlan_Response",
    "GenerateTrajectory",
    "GenerateTrajectory_Event",
    "GenerateTrajectory_Request",
    "GenerateTrajectory_Response",
    "GenerateTwists",
    "GenerateTwists_Event",
    "GenerateTwists_Request",
    "GenerateTwists_Response",
    "GetCriticScore",
    "GetCriticScore_Event",
    "GetCriticScore_Request",
    "GetCriticScore_Response",
    "ScoreTrajectory",
    "ScoreTrajectory_Event",
    "ScoreTrajectory_Request",
    "ScoreTrajectory_Response",
]

class DebugLocalPlan_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DebugLocalPlan_Request]: ...
    @request.setter
    def request(self, value: Iterable[DebugLocalPlan_Request]) -> None: ...
    @property
    def response(self) -> list[DebugLocalPlan_Response]: ...
    @response.setter
    def response(self, value: Iterable[DebugLocalPlan_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DebugLocalPlan_Request] = ..., response: Iterable[DebugLocalPlan_Response] = ...) -> None: ...

class DebugLocalPlan_Request(Message):
    pose: _nav_2d_msgs_msg.Pose2DStamped
    velocity: _nav_2d_msgs_msg.Twist2D
    global_plan: _nav_2d_msgs_msg.Path2D
    def __init__(self, *, pose: _nav_2d_msgs_msg.Pose2DStamped = ..., velocity: _nav_2d_msgs_msg.Twist2D = ..., global_plan: _nav_2d_msgs_msg.Path2D = ...) -> None: ...

class DebugLocalPlan_Response(Message):
    results: _dwb_msgs_msg.LocalPlanEvaluation
    def __init__(self, *, results: _dwb_msgs_msg.LocalPlanEvaluation = ...) -> None: ...

class GenerateTrajectory_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GenerateTrajectory_Request]: ...
    @request.setter
    def request(self, value: Iterable[GenerateTrajectory_Request]) -> None: ...
    @property
    def response(self) -> list[GenerateTrajectory_Response]: ...
    @response.setter
    def response(self, value: Iterable[GenerateTrajectory_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GenerateTrajectory_Request] = ..., response: Iterable[GenerateTrajectory_Response] = ...) -> None: ...

class GenerateTrajectory_Request(Message):
    start_pose: _geometry_msgs_msg.Pose2D
    start_vel: _nav_2d_msgs_msg.Twist2D
    cmd_vel: _nav_2d_msgs_msg.Twist2D
    def __init__(self, *, start_pose: _geometry_msgs_msg.Pose2D = ..., start_vel: _nav_2d_msgs_msg.Twist2D = ..., cmd_vel: _nav_2d_msgs_msg.Twist2D = ...) -> None: ...

class GenerateTrajectory_Response(Message):
    traj: _dwb_msgs_msg.Trajectory2D
    def __init__(self, *, traj: _dwb_msgs_msg.Trajectory2D = ...) -> None: ...

class GenerateTwists_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GenerateTwists_Request]: ...
    @request.setter
    def request(self, value: Iterable[GenerateTwists_Request]) -> None: ...
    @property
    def response(self) -> list[GenerateTwists_Response]: ...
    @response.setter
    def response(self, value: Iterable[GenerateTwists_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GenerateTwists_Request] = ..., response: Iterable[GenerateTwists_Response] = ...) -> None: ...

class GenerateTwists_Request(Message):
    current_vel: _nav_2d_msgs_msg.Twist2D
    def __init__(self, *, current_vel: _nav_2d_msgs_msg.Twist2D = ...) -> None: ...

class GenerateTwists_Response(Message):
    @property
    def twists(self) -> list[_nav_2d_msgs_msg.Twist2D]: ...
    @twists.setter
    def twists(self, value: Iterable[_nav_2d_msgs_msg.Twist2D]) -> None: ...
    def __init__(self, *, twists: Iterable[_nav_2d_msgs_msg.Twist2D] = ...) -> None: ...

class GetCriticScore_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetCriticScore_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetCriticScore_Request]) -> None: ...
    @property
    def response(self) -> list[GetCriticScore_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetCriticScore_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetCriticScore_Request] = ..., response: Iterable[GetCriticScore_Response] = ...) -> None: ...

class GetCriticScore_Request(Message):
    pose: _nav_2d_msgs_msg.Pose2DStamped
    velocity: _nav_2d_msgs_msg.Twist2D
    global_plan: _nav_2d_msgs_msg.Path2D
    traj: _dwb_msgs_msg.Trajectory2D
    critic_name: str
    def __init__(self, *, pose: _nav_2d_msgs_msg.Pose2DStamped = ..., velocity: _nav_2d_msgs_msg.Twist2D = ..., global_plan: _nav_2d_msgs_msg.Path2D = ..., traj: _dwb_msgs_msg.Trajectory2D = ..., critic_name: str = ...) -> None: ...

class GetCriticScore_Response(Message):
    score: _dwb_msgs_msg.CriticScore
    def __init__(self, *, score: _dwb_msgs_msg.CriticScore = ...) -> None: ...

class ScoreTrajectory_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ScoreTrajectory_Request]: ...
    @request.setter
    def request(self, value: Iterable[ScoreTrajectory_Request]) -> None: ...
    @property
    def response(self) -> list[ScoreTrajectory_Response]: ...
    @response.setter
    def response(self, value: Iterable[ScoreTrajectory_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ScoreTrajectory_Request] = ..., response: Iterable[ScoreTrajectory_Response] = ...) -> None: ...

class ScoreTrajectory_Request(Message):
    pose: _nav_2d_msgs_msg.Pose2DStamped
    velocity: _nav_2d_msgs_msg.Twist2D
    global_plan: _nav_2d_msgs_msg.Path2D
    traj: _dwb_msgs_msg.Trajectory2D
    def __init__(self, *, pose: _nav_2d_msgs_msg.Pose2DStamped = ..., velocity: _nav_2d_msgs_msg.Twist2D = ..., global_plan: _nav_2d_msgs_msg.Path2D = ..., traj: _dwb_msgs_msg.Trajectory2D = ...) -> None: ...

class ScoreTrajectory_Response(Message):
    score: _dwb_msgs_msg.TrajectoryScore
    def __init__(self, *, score: _dwb_msgs_msg.TrajectoryScore = ...) -> None: ...

class DebugLocalPlan(Service):
    Request = DebugLocalPlan_Request
    Response = DebugLocalPlan_Response
    Event = DebugLocalPlan_Event

class GenerateTrajectory(Service):
    Request = GenerateTrajectory_Request
    Response = GenerateTrajectory_Response
    Event = GenerateTrajectory_Event

class GenerateTwists(Service):
    Request = GenerateTwists_Request
    Response = GenerateTwists_Response
    Event = GenerateTwists_Event

class GetCriticScore(Service):
    Request = GetCriticScore_Request
    Response = GetCriticScore_Response
    Event = GetCriticScore_Event

class ScoreTrajectory(Service):
    Request = ScoreTrajectory_Request
    Response = ScoreTrajectory_Response
    Event = ScoreTrajectory_Event
