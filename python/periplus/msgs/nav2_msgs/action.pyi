from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.action_msgs.msg as _action_msgs_msg
import periplus.msgs.action_msgs.srv as _action_msgs_srv
import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geographic_msgs.msg as _geographic_msgs_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.nav2_msgs.msg as _nav2_msgs_msg
import periplus.msgs.nav_msgs.msg as _nav_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Action, Message, Service

__all__ = [
    "AssistedTeleop",
    "AssistedTeleop_Feedback",
    "AssistedTeleop_FeedbackMessage",
    "AssistedTeleop_GetResult_Event",
    "AssistedTeleop_GetResult_Request",
    "AssistedTeleop_GetResult_Response",
    "AssistedTeleop_Goal",
    "AssistedTeleop_Result",
    "AssistedTeleop_SendGoal_Event",
    "AssistedTeleop_SendGoal_Request",
    "AssistedTeleop_SendGoal_Response",
    "BackUp",
    "BackUp_Feedback",
    "BackUp_FeedbackMessage",
    "BackUp_GetResult_Event",
    "BackUp_GetResult_Request",
    "BackUp_GetResult_Response",
    "BackUp_Goal",
    "BackUp_Result",
    "BackUp_SendGoal_Event",
    "BackUp_SendGoal_Request",
    "BackUp_SendGoal_Response",
    "ComputeAndTrackRoute",
    "ComputeAndTrackRoute_Feedback",
    "ComputeAndTrackRoute_FeedbackMessage",
    "ComputeAndTrackRoute_GetResult_Event",
    "ComputeAndTrackRoute_GetResult_Request",
    "ComputeAndTrackRoute_GetResult_Response",
    "ComputeAndTrackRoute_Goal",
    "ComputeAndTrackRoute_Result",
    "ComputeAndTrackRoute_SendGoal_Event",
    "ComputeAndTrackRoute_SendGoal_Request",
    "ComputeAndTrackRoute_SendGoal_Response",
    "ComputePathThroughPoses",
    "ComputePathThroughPoses_Feedback",
    "ComputePathThroughPoses_FeedbackMessage",
    "ComputePathThroughPoses_GetResult_Event",
    "ComputePathThroughPoses_GetResult_Request",
    "ComputePathThroughPoses_GetResult_Response",
    "ComputePathThroughPoses_Goal",
    "ComputePathThroughPoses_Result",
    "ComputePathThroughPoses_SendGoal_Event",
    "ComputePathThroughPoses_SendGoal_Request",
    "ComputePathThroughPoses_SendGoal_Response",
    "ComputePathToPose",
    "ComputePathToPose_Feedback",
    "ComputePathToPose_FeedbackMessage",
    "ComputePathToPose_GetResult_Event",
    "ComputePathToPose_GetResult_Request",
    "ComputePathToPose_GetResult_Response",
    "ComputePathToPose_Goal",
    "ComputePathToPose_Result",
    "ComputePathToPose_SendGoal_Event",
    "ComputePathToPose_SendGoal_Request",
    "ComputePathToPose_SendGoal_Response",
    "ComputeRoute",
    "ComputeRoute_Feedback",
    "ComputeRoute_FeedbackMessage",
    "ComputeRoute_GetResult_Event",
    "ComputeRoute_GetResult_Request",
    "ComputeRoute_GetResult_Response",
    "ComputeRoute_Goal",
    "ComputeRoute_Result",
    "ComputeRoute_SendGoal_Event",
    "ComputeRoute_SendGoal_Request",
    "ComputeRoute_SendGoal_Response",
    "DockRobot",
    "DockRobot_Feedback",
    "DockRobot_FeedbackMessage",
    "DockRobot_GetResult_Event",
    "DockRobot_GetResult_Request",
    "DockRobot_GetResult_Response",
    "DockRobot_Goal",
    "DockRobot_Result",
    "DockRobot_SendGoal_Event",
    "DockRobot_SendGoal_Request",
    "DockRobot_SendGoal_Response",
    "DriveOnHeading",
    "DriveOnHeading_Feedback",
    "DriveOnHeading_FeedbackMessage",
    "DriveOnHeading_GetResult_Event",
    "DriveOnHeading_GetResult_Request",
    "DriveOnHeading_GetResult_Response",
    "DriveOnHeading_Goal",
    "DriveOnHeading_Result",
    "DriveOnHeading_SendGoal_Event",
    "DriveOnHeading_SendGoal_Request",
    "DriveOnHeading_SendGoal_Response",
    "FollowGPSWaypoints",
    "FollowGPSWaypoints_Feedback",
    "FollowGPSWaypoints_FeedbackMessage",
    "FollowGPSWaypoints_GetResult_Event",
    "FollowGPSWaypoints_GetResult_Request",
    "FollowGPSWaypoints_GetResult_Response",
    "FollowGPSWaypoints_Goal",
    "FollowGPSWaypoints_Result",
    "FollowGPSWaypoints_SendGoal_Event",
    "FollowGPSWaypoints_SendGoal_Request",
    "FollowGPSWaypoints_SendGoal_Response",
    "FollowObject",
    "FollowObject_Feedback",
    "FollowObject_FeedbackMessage",
    "FollowObject_GetResult_Event",
    "FollowObject_GetResult_Request",
    "FollowObject_GetResult_Response",
    "FollowObject_Goal",
    "FollowObject_Result",
    "FollowObject_SendGoal_Event",
    "FollowObject_SendGoal_Request",
    "FollowObject_SendGoal_Response",
    "FollowPath",
    "FollowPath_Feedback",
    "FollowPath_FeedbackMessage",
    "FollowPath_GetResult_Event",
    "FollowPath_GetResult_Request",
    "FollowPath_GetResult_Response",
    "FollowPath_Goal",
    "FollowPath_Result",
    "FollowPath_SendGoal_Event",
    "FollowPath_SendGoal_Request",
    "FollowPath_SendGoal_Response",
    "FollowWaypoints",
    "FollowWaypoints_Feedback",
    "FollowWaypoints_FeedbackMessage",
    "FollowWaypoints_GetResult_Event",
    "FollowWaypoints_GetResult_Request",
    "FollowWaypoints_GetResult_Response",
    "FollowWaypoints_Goal",
    "FollowWaypoints_Result",
    "FollowWaypoints_SendGoal_Event",
    "FollowWaypoints_SendGoal_Request",
    "FollowWaypoints_SendGoal_Response",
    "NavigateThroughPoses",
    "NavigateThroughPoses_Feedback",
    "NavigateThroughPoses_FeedbackMessage",
    "NavigateThroughPoses_GetResult_Event",
    "NavigateThroughPoses_GetResult_Request",
    "NavigateThroughPoses_GetResult_Response",
    "NavigateThroughPoses_Goal",
    "NavigateThroughPoses_Result",
    "NavigateThroughPoses_SendGoal_Event",
    "NavigateThroughPoses_SendGoal_Request",
    "NavigateThroughPoses_SendGoal_Response",
    "NavigateToPose",
    "NavigateToPose_Feedback",
    "NavigateToPose_FeedbackMessage",
    "NavigateToPose_GetResult_Event",
    "NavigateToPose_GetResult_Request",
    "NavigateToPose_GetResult_Response",
    "NavigateToPose_Goal",
    "NavigateToPose_Result",
    "NavigateToPose_SendGoal_Event",
    "NavigateToPose_SendGoal_Request",
    "NavigateToPose_SendGoal_Response",
    "SmoothPath",
    "SmoothPath_Feedback",
    "SmoothPath_FeedbackMessage",
    "SmoothPath_GetResult_Event",
    "SmoothPath_GetResult_Request",
    "SmoothPath_GetResult_Response",
    "SmoothPath_Goal",
    "SmoothPath_Result",
    "SmoothPath_SendGoal_Event",
    "SmoothPath_SendGoal_Request",
    "SmoothPath_SendGoal_Response",
    "Spin",
    "Spin_Feedback",
    "Spin_FeedbackMessage",
    "Spin_GetResult_Event",
    "Spin_GetResult_Request",
    "Spin_GetResult_Response",
    "Spin_Goal",
    "Spin_Result",
    "Spin_SendGoal_Event",
    "Spin_SendGoal_Request",
    "Spin_SendGoal_Response",
    "UndockRobot",
    "UndockRobot_Feedback",
    "UndockRobot_FeedbackMessage",
    "UndockRobot_GetResult_Event",
    "UndockRobot_GetResult_Request",
    "UndockRobot_GetResult_Response",
    "UndockRobot_Goal",
    "UndockRobot_Result",
    "UndockRobot_SendGoal_Event",
    "UndockRobot_SendGoal_Request",
    "UndockRobot_SendGoal_Response",
    "Wait",
    "Wait_Feedback",
    "Wait_FeedbackMessage",
    "Wait_GetResult_Event",
    "Wait_GetResult_Request",
    "Wait_GetResult_Response",
    "Wait_Goal",
    "Wait_Result",
    "Wait_SendGoal_Event",
    "Wait_SendGoal_Request",
    "Wait_SendGoal_Response",
]

class AssistedTeleop_Feedback(Message):
    current_teleop_duration: _builtin_interfaces_msg.Duration
    def __init__(self, *, current_teleop_duration: _builtin_interfaces_msg.Duration = ...) -> None: ...

class AssistedTeleop_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: AssistedTeleop_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: AssistedTeleop_Feedback = ...) -> None: ...

class AssistedTeleop_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AssistedTeleop_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[AssistedTeleop_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[AssistedTeleop_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[AssistedTeleop_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AssistedTeleop_GetResult_Request] = ..., response: Iterable[AssistedTeleop_GetResult_Response] = ...) -> None: ...

class AssistedTeleop_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class AssistedTeleop_GetResult_Response(Message):
    status: int
    result: AssistedTeleop_Result
    def __init__(self, *, status: int = ..., result: AssistedTeleop_Result = ...) -> None: ...

class AssistedTeleop_Goal(Message):
    time_allowance: _builtin_interfaces_msg.Duration
    def __init__(self, *, time_allowance: _builtin_interfaces_msg.Duration = ...) -> None: ...

class AssistedTeleop_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TIMEOUT: ClassVar[int]
    TF_ERROR: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class AssistedTeleop_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AssistedTeleop_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[AssistedTeleop_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[AssistedTeleop_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[AssistedTeleop_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AssistedTeleop_SendGoal_Request] = ..., response: Iterable[AssistedTeleop_SendGoal_Response] = ...) -> None: ...

class AssistedTeleop_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: AssistedTeleop_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: AssistedTeleop_Goal = ...) -> None: ...

class AssistedTeleop_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class BackUp_Feedback(Message):
    distance_traveled: float
    def __init__(self, *, distance_traveled: float = ...) -> None: ...

class BackUp_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: BackUp_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: BackUp_Feedback = ...) -> None: ...

class BackUp_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[BackUp_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[BackUp_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[BackUp_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[BackUp_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[BackUp_GetResult_Request] = ..., response: Iterable[BackUp_GetResult_Response] = ...) -> None: ...

class BackUp_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class BackUp_GetResult_Response(Message):
    status: int
    result: BackUp_Result
    def __init__(self, *, status: int = ..., result: BackUp_Result = ...) -> None: ...

class BackUp_Goal(Message):
    target: _geometry_msgs_msg.Point
    speed: float
    time_allowance: _builtin_interfaces_msg.Duration
    def __init__(self, *, target: _geometry_msgs_msg.Point = ..., speed: float = ..., time_allowance: _builtin_interfaces_msg.Duration = ...) -> None: ...

class BackUp_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TIMEOUT: ClassVar[int]
    TF_ERROR: ClassVar[int]
    INVALID_INPUT: ClassVar[int]
    COLLISION_AHEAD: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class BackUp_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[BackUp_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[BackUp_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[BackUp_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[BackUp_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[BackUp_SendGoal_Request] = ..., response: Iterable[BackUp_SendGoal_Response] = ...) -> None: ...

class BackUp_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: BackUp_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: BackUp_Goal = ...) -> None: ...

class BackUp_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class ComputeAndTrackRoute_Feedback(Message):
    last_node_id: int
    next_node_id: int
    current_edge_id: int
    route: _nav2_msgs_msg.Route
    path: _nav_msgs_msg.Path
    @property
    def operations_triggered(self) -> list[str]: ...
    @operations_triggered.setter
    def operations_triggered(self, value: Iterable[str]) -> None: ...
    rerouted: bool
    def __init__(self, *, last_node_id: int = ..., next_node_id: int = ..., current_edge_id: int = ..., route: _nav2_msgs_msg.Route = ..., path: _nav_msgs_msg.Path = ..., operations_triggered: Iterable[str] = ..., rerouted: bool = ...) -> None: ...

class ComputeAndTrackRoute_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: ComputeAndTrackRoute_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: ComputeAndTrackRoute_Feedback = ...) -> None: ...

class ComputeAndTrackRoute_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputeAndTrackRoute_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputeAndTrackRoute_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[ComputeAndTrackRoute_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputeAndTrackRoute_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputeAndTrackRoute_GetResult_Request] = ..., response: Iterable[ComputeAndTrackRoute_GetResult_Response] = ...) -> None: ...

class ComputeAndTrackRoute_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class ComputeAndTrackRoute_GetResult_Response(Message):
    status: int
    result: ComputeAndTrackRoute_Result
    def __init__(self, *, status: int = ..., result: ComputeAndTrackRoute_Result = ...) -> None: ...

class ComputeAndTrackRoute_Goal(Message):
    start_id: int
    start: _geometry_msgs_msg.PoseStamped
    goal_id: int
    goal: _geometry_msgs_msg.PoseStamped
    use_start: bool
    use_poses: bool
    def __init__(self, *, start_id: int = ..., start: _geometry_msgs_msg.PoseStamped = ..., goal_id: int = ..., goal: _geometry_msgs_msg.PoseStamped = ..., use_start: bool = ..., use_poses: bool = ...) -> None: ...

class ComputeAndTrackRoute_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TF_ERROR: ClassVar[int]
    NO_VALID_GRAPH: ClassVar[int]
    INDETERMINANT_NODES_ON_GRAPH: ClassVar[int]
    TIMEOUT: ClassVar[int]
    NO_VALID_ROUTE: ClassVar[int]
    OPERATION_FAILED: ClassVar[int]
    INVALID_EDGE_SCORER_USE: ClassVar[int]
    execution_duration: _builtin_interfaces_msg.Duration
    error_code: int
    def __init__(self, *, execution_duration: _builtin_interfaces_msg.Duration = ..., error_code: int = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputeAndTrackRoute_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputeAndTrackRoute_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[ComputeAndTrackRoute_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputeAndTrackRoute_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputeAndTrackRoute_SendGoal_Request] = ..., response: Iterable[ComputeAndTrackRoute_SendGoal_Response] = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: ComputeAndTrackRoute_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: ComputeAndTrackRoute_Goal = ...) -> None: ...

class ComputeAndTrackRoute_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class ComputePathThroughPoses_Feedback(Message):
    def __init__(self) -> None: ...

class ComputePathThroughPoses_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: ComputePathThroughPoses_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: ComputePathThroughPoses_Feedback = ...) -> None: ...

class ComputePathThroughPoses_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputePathThroughPoses_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputePathThroughPoses_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[ComputePathThroughPoses_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputePathThroughPoses_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputePathThroughPoses_GetResult_Request] = ..., response: Iterable[ComputePathThroughPoses_GetResult_Response] = ...) -> None: ...

class ComputePathThroughPoses_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class ComputePathThroughPoses_GetResult_Response(Message):
    status: int
    result: ComputePathThroughPoses_Result
    def __init__(self, *, status: int = ..., result: ComputePathThroughPoses_Result = ...) -> None: ...

class ComputePathThroughPoses_Goal(Message):
    @property
    def goals(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @goals.setter
    def goals(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    start: _geometry_msgs_msg.PoseStamped
    planner_id: str
    use_start: bool
    def __init__(self, *, goals: Iterable[_geometry_msgs_msg.PoseStamped] = ..., start: _geometry_msgs_msg.PoseStamped = ..., planner_id: str = ..., use_start: bool = ...) -> None: ...

class ComputePathThroughPoses_Result(Message):
    ALL_GOALS: ClassVar[int]
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    INVALID_PLANNER: ClassVar[int]
    TF_ERROR: ClassVar[int]
    START_OUTSIDE_MAP: ClassVar[int]
    GOAL_OUTSIDE_MAP: ClassVar[int]
    START_OCCUPIED: ClassVar[int]
    GOAL_OCCUPIED: ClassVar[int]
    TIMEOUT: ClassVar[int]
    NO_VALID_PATH: ClassVar[int]
    NO_VIAPOINTS_GIVEN: ClassVar[int]
    path: _nav_msgs_msg.Path
    planning_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, path: _nav_msgs_msg.Path = ..., planning_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class ComputePathThroughPoses_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputePathThroughPoses_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputePathThroughPoses_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[ComputePathThroughPoses_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputePathThroughPoses_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputePathThroughPoses_SendGoal_Request] = ..., response: Iterable[ComputePathThroughPoses_SendGoal_Response] = ...) -> None: ...

class ComputePathThroughPoses_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: ComputePathThroughPoses_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: ComputePathThroughPoses_Goal = ...) -> None: ...

class ComputePathThroughPoses_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class ComputePathToPose_Feedback(Message):
    def __init__(self) -> None: ...

class ComputePathToPose_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: ComputePathToPose_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: ComputePathToPose_Feedback = ...) -> None: ...

class ComputePathToPose_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputePathToPose_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputePathToPose_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[ComputePathToPose_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputePathToPose_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputePathToPose_GetResult_Request] = ..., response: Iterable[ComputePathToPose_GetResult_Response] = ...) -> None: ...

class ComputePathToPose_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class ComputePathToPose_GetResult_Response(Message):
    status: int
    result: ComputePathToPose_Result
    def __init__(self, *, status: int = ..., result: ComputePathToPose_Result = ...) -> None: ...

class ComputePathToPose_Goal(Message):
    goal: _geometry_msgs_msg.PoseStamped
    start: _geometry_msgs_msg.PoseStamped
    planner_id: str
    use_start: bool
    def __init__(self, *, goal: _geometry_msgs_msg.PoseStamped = ..., start: _geometry_msgs_msg.PoseStamped = ..., planner_id: str = ..., use_start: bool = ...) -> None: ...

class ComputePathToPose_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    INVALID_PLANNER: ClassVar[int]
    TF_ERROR: ClassVar[int]
    START_OUTSIDE_MAP: ClassVar[int]
    GOAL_OUTSIDE_MAP: ClassVar[int]
    START_OCCUPIED: ClassVar[int]
    GOAL_OCCUPIED: ClassVar[int]
    TIMEOUT: ClassVar[int]
    NO_VALID_PATH: ClassVar[int]
    path: _nav_msgs_msg.Path
    planning_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, path: _nav_msgs_msg.Path = ..., planning_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class ComputePathToPose_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputePathToPose_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputePathToPose_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[ComputePathToPose_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputePathToPose_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputePathToPose_SendGoal_Request] = ..., response: Iterable[ComputePathToPose_SendGoal_Response] = ...) -> None: ...

class ComputePathToPose_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: ComputePathToPose_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: ComputePathToPose_Goal = ...) -> None: ...

class ComputePathToPose_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class ComputeRoute_Feedback(Message):
    def __init__(self) -> None: ...

class ComputeRoute_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: ComputeRoute_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: ComputeRoute_Feedback = ...) -> None: ...

class ComputeRoute_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputeRoute_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputeRoute_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[ComputeRoute_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputeRoute_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputeRoute_GetResult_Request] = ..., response: Iterable[ComputeRoute_GetResult_Response] = ...) -> None: ...

class ComputeRoute_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class ComputeRoute_GetResult_Response(Message):
    status: int
    result: ComputeRoute_Result
    def __init__(self, *, status: int = ..., result: ComputeRoute_Result = ...) -> None: ...

class ComputeRoute_Goal(Message):
    start_id: int
    start: _geometry_msgs_msg.PoseStamped
    goal_id: int
    goal: _geometry_msgs_msg.PoseStamped
    use_start: bool
    use_poses: bool
    def __init__(self, *, start_id: int = ..., start: _geometry_msgs_msg.PoseStamped = ..., goal_id: int = ..., goal: _geometry_msgs_msg.PoseStamped = ..., use_start: bool = ..., use_poses: bool = ...) -> None: ...

class ComputeRoute_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TF_ERROR: ClassVar[int]
    NO_VALID_GRAPH: ClassVar[int]
    INDETERMINANT_NODES_ON_GRAPH: ClassVar[int]
    TIMEOUT: ClassVar[int]
    NO_VALID_ROUTE: ClassVar[int]
    INVALID_EDGE_SCORER_USE: ClassVar[int]
    planning_time: _builtin_interfaces_msg.Duration
    path: _nav_msgs_msg.Path
    route: _nav2_msgs_msg.Route
    error_code: int
    def __init__(self, *, planning_time: _builtin_interfaces_msg.Duration = ..., path: _nav_msgs_msg.Path = ..., route: _nav2_msgs_msg.Route = ..., error_code: int = ...) -> None: ...

class ComputeRoute_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ComputeRoute_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[ComputeRoute_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[ComputeRoute_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[ComputeRoute_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ComputeRoute_SendGoal_Request] = ..., response: Iterable[ComputeRoute_SendGoal_Response] = ...) -> None: ...

class ComputeRoute_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: ComputeRoute_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: ComputeRoute_Goal = ...) -> None: ...

class ComputeRoute_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class DockRobot_Feedback(Message):
    NONE: ClassVar[int]
    NAV_TO_STAGING_POSE: ClassVar[int]
    INITIAL_PERCEPTION: ClassVar[int]
    CONTROLLING: ClassVar[int]
    WAIT_FOR_CHARGE: ClassVar[int]
    RETRY: ClassVar[int]
    state: int
    docking_time: _builtin_interfaces_msg.Duration
    num_retries: int
    def __init__(self, *, state: int = ..., docking_time: _builtin_interfaces_msg.Duration = ..., num_retries: int = ...) -> None: ...

class DockRobot_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: DockRobot_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: DockRobot_Feedback = ...) -> None: ...

class DockRobot_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DockRobot_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[DockRobot_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[DockRobot_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[DockRobot_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DockRobot_GetResult_Request] = ..., response: Iterable[DockRobot_GetResult_Response] = ...) -> None: ...

class DockRobot_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class DockRobot_GetResult_Response(Message):
    status: int
    result: DockRobot_Result
    def __init__(self, *, status: int = ..., result: DockRobot_Result = ...) -> None: ...

class DockRobot_Goal(Message):
    use_dock_id: bool
    dock_id: str
    dock_pose: _geometry_msgs_msg.PoseStamped
    dock_type: str
    max_staging_time: float
    navigate_to_staging_pose: bool
    def __init__(self, *, use_dock_id: bool = ..., dock_id: str = ..., dock_pose: _geometry_msgs_msg.PoseStamped = ..., dock_type: str = ..., max_staging_time: float = ..., navigate_to_staging_pose: bool = ...) -> None: ...

class DockRobot_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    DOCK_NOT_IN_DB: ClassVar[int]
    DOCK_NOT_VALID: ClassVar[int]
    FAILED_TO_STAGE: ClassVar[int]
    FAILED_TO_DETECT_DOCK: ClassVar[int]
    FAILED_TO_CONTROL: ClassVar[int]
    FAILED_TO_CHARGE: ClassVar[int]
    TIMEOUT: ClassVar[int]
    UNKNOWN: ClassVar[int]
    success: bool
    error_code: int
    num_retries: int
    error_msg: str
    def __init__(self, *, success: bool = ..., error_code: int = ..., num_retries: int = ..., error_msg: str = ...) -> None: ...

class DockRobot_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DockRobot_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[DockRobot_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[DockRobot_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[DockRobot_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DockRobot_SendGoal_Request] = ..., response: Iterable[DockRobot_SendGoal_Response] = ...) -> None: ...

class DockRobot_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: DockRobot_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: DockRobot_Goal = ...) -> None: ...

class DockRobot_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class DriveOnHeading_Feedback(Message):
    distance_traveled: float
    def __init__(self, *, distance_traveled: float = ...) -> None: ...

class DriveOnHeading_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: DriveOnHeading_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: DriveOnHeading_Feedback = ...) -> None: ...

class DriveOnHeading_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DriveOnHeading_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[DriveOnHeading_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[DriveOnHeading_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[DriveOnHeading_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DriveOnHeading_GetResult_Request] = ..., response: Iterable[DriveOnHeading_GetResult_Response] = ...) -> None: ...

class DriveOnHeading_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class DriveOnHeading_GetResult_Response(Message):
    status: int
    result: DriveOnHeading_Result
    def __init__(self, *, status: int = ..., result: DriveOnHeading_Result = ...) -> None: ...

class DriveOnHeading_Goal(Message):
    target: _geometry_msgs_msg.Point
    speed: float
    time_allowance: _builtin_interfaces_msg.Duration
    def __init__(self, *, target: _geometry_msgs_msg.Point = ..., speed: float = ..., time_allowance: _builtin_interfaces_msg.Duration = ...) -> None: ...

class DriveOnHeading_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TIMEOUT: ClassVar[int]
    TF_ERROR: ClassVar[int]
    COLLISION_AHEAD: ClassVar[int]
    INVALID_INPUT: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class DriveOnHeading_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DriveOnHeading_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[DriveOnHeading_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[DriveOnHeading_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[DriveOnHeading_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DriveOnHeading_SendGoal_Request] = ..., response: Iterable[DriveOnHeading_SendGoal_Response] = ...) -> None: ...

class DriveOnHeading_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: DriveOnHeading_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: DriveOnHeading_Goal = ...) -> None: ...

class DriveOnHeading_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class FollowGPSWaypoints_Feedback(Message):
    current_waypoint: int
    def __init__(self, *, current_waypoint: int = ...) -> None: ...

class FollowGPSWaypoints_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: FollowGPSWaypoints_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: FollowGPSWaypoints_Feedback = ...) -> None: ...

class FollowGPSWaypoints_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowGPSWaypoints_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowGPSWaypoints_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[FollowGPSWaypoints_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowGPSWaypoints_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowGPSWaypoints_GetResult_Request] = ..., response: Iterable[FollowGPSWaypoints_GetResult_Response] = ...) -> None: ...

class FollowGPSWaypoints_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class FollowGPSWaypoints_GetResult_Response(Message):
    status: int
    result: FollowGPSWaypoints_Result
    def __init__(self, *, status: int = ..., result: FollowGPSWaypoints_Result = ...) -> None: ...

class FollowGPSWaypoints_Goal(Message):
    number_of_loops: int
    goal_index: int
    @property
    def gps_poses(self) -> list[_geographic_msgs_msg.GeoPose]: ...
    @gps_poses.setter
    def gps_poses(self, value: Iterable[_geographic_msgs_msg.GeoPose]) -> None: ...
    def __init__(self, *, number_of_loops: int = ..., goal_index: int = ..., gps_poses: Iterable[_geographic_msgs_msg.GeoPose] = ...) -> None: ...

class FollowGPSWaypoints_Result(Message):
    NONE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TASK_EXECUTOR_FAILED: ClassVar[int]
    NO_WAYPOINTS_GIVEN: ClassVar[int]
    STOP_ON_MISSED_WAYPOINT: ClassVar[int]
    @property
    def missed_waypoints(self) -> list[_nav2_msgs_msg.MissedWaypoint]: ...
    @missed_waypoints.setter
    def missed_waypoints(self, value: Iterable[_nav2_msgs_msg.MissedWaypoint]) -> None: ...
    error_code: int
    error_msg: str
    def __init__(self, *, missed_waypoints: Iterable[_nav2_msgs_msg.MissedWaypoint] = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class FollowGPSWaypoints_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowGPSWaypoints_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowGPSWaypoints_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[FollowGPSWaypoints_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowGPSWaypoints_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowGPSWaypoints_SendGoal_Request] = ..., response: Iterable[FollowGPSWaypoints_SendGoal_Response] = ...) -> None: ...

class FollowGPSWaypoints_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: FollowGPSWaypoints_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: FollowGPSWaypoints_Goal = ...) -> None: ...

class FollowGPSWaypoints_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class FollowObject_Feedback(Message):
    NONE: ClassVar[int]
    INITIAL_PERCEPTION: ClassVar[int]
    CONTROLLING: ClassVar[int]
    STOPPING: ClassVar[int]
    RETRY: ClassVar[int]
    state: int
    following_time: _builtin_interfaces_msg.Duration
    num_retries: int
    def __init__(self, *, state: int = ..., following_time: _builtin_interfaces_msg.Duration = ..., num_retries: int = ...) -> None: ...

class FollowObject_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: FollowObject_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: FollowObject_Feedback = ...) -> None: ...

class FollowObject_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowObject_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowObject_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[FollowObject_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowObject_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowObject_GetResult_Request] = ..., response: Iterable[FollowObject_GetResult_Response] = ...) -> None: ...

class FollowObject_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class FollowObject_GetResult_Response(Message):
    status: int
    result: FollowObject_Result
    def __init__(self, *, status: int = ..., result: FollowObject_Result = ...) -> None: ...

class FollowObject_Goal(Message):
    pose_topic: str
    tracked_frame: str
    max_duration: _builtin_interfaces_msg.Duration
    def __init__(self, *, pose_topic: str = ..., tracked_frame: str = ..., max_duration: _builtin_interfaces_msg.Duration = ...) -> None: ...

class FollowObject_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    TF_ERROR: ClassVar[int]
    FAILED_TO_DETECT_OBJECT: ClassVar[int]
    FAILED_TO_CONTROL: ClassVar[int]
    TIMEOUT: ClassVar[int]
    UNKNOWN: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    num_retries: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., num_retries: int = ..., error_msg: str = ...) -> None: ...

class FollowObject_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowObject_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowObject_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[FollowObject_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowObject_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowObject_SendGoal_Request] = ..., response: Iterable[FollowObject_SendGoal_Response] = ...) -> None: ...

class FollowObject_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: FollowObject_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: FollowObject_Goal = ...) -> None: ...

class FollowObject_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class FollowPath_Feedback(Message):
    distance_to_goal: float
    speed: float
    def __init__(self, *, distance_to_goal: float = ..., speed: float = ...) -> None: ...

class FollowPath_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: FollowPath_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: FollowPath_Feedback = ...) -> None: ...

class FollowPath_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowPath_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowPath_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[FollowPath_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowPath_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowPath_GetResult_Request] = ..., response: Iterable[FollowPath_GetResult_Response] = ...) -> None: ...

class FollowPath_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class FollowPath_GetResult_Response(Message):
    status: int
    result: FollowPath_Result
    def __init__(self, *, status: int = ..., result: FollowPath_Result = ...) -> None: ...

class FollowPath_Goal(Message):
    path: _nav_msgs_msg.Path
    controller_id: str
    goal_checker_id: str
    progress_checker_id: str
    def __init__(self, *, path: _nav_msgs_msg.Path = ..., controller_id: str = ..., goal_checker_id: str = ..., progress_checker_id: str = ...) -> None: ...

class FollowPath_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    INVALID_CONTROLLER: ClassVar[int]
    TF_ERROR: ClassVar[int]
    INVALID_PATH: ClassVar[int]
    PATIENCE_EXCEEDED: ClassVar[int]
    FAILED_TO_MAKE_PROGRESS: ClassVar[int]
    NO_VALID_CONTROL: ClassVar[int]
    CONTROLLER_TIMED_OUT: ClassVar[int]
    TIMEOUT: ClassVar[int]
    result: _std_msgs_msg.Empty
    error_code: int
    error_msg: str
    def __init__(self, *, result: _std_msgs_msg.Empty = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class FollowPath_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowPath_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowPath_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[FollowPath_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowPath_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowPath_SendGoal_Request] = ..., response: Iterable[FollowPath_SendGoal_Response] = ...) -> None: ...

class FollowPath_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: FollowPath_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: FollowPath_Goal = ...) -> None: ...

class FollowPath_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class FollowWaypoints_Feedback(Message):
    current_waypoint: int
    def __init__(self, *, current_waypoint: int = ...) -> None: ...

class FollowWaypoints_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: FollowWaypoints_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: FollowWaypoints_Feedback = ...) -> None: ...

class FollowWaypoints_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowWaypoints_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowWaypoints_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[FollowWaypoints_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowWaypoints_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowWaypoints_GetResult_Request] = ..., response: Iterable[FollowWaypoints_GetResult_Response] = ...) -> None: ...

class FollowWaypoints_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class FollowWaypoints_GetResult_Response(Message):
    status: int
    result: FollowWaypoints_Result
    def __init__(self, *, status: int = ..., result: FollowWaypoints_Result = ...) -> None: ...

class FollowWaypoints_Goal(Message):
    number_of_loops: int
    goal_index: int
    @property
    def poses(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    def __init__(self, *, number_of_loops: int = ..., goal_index: int = ..., poses: Iterable[_geometry_msgs_msg.PoseStamped] = ...) -> None: ...

class FollowWaypoints_Result(Message):
    NONE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TASK_EXECUTOR_FAILED: ClassVar[int]
    NO_VALID_WAYPOINTS: ClassVar[int]
    STOP_ON_MISSED_WAYPOINT: ClassVar[int]
    @property
    def missed_waypoints(self) -> list[_nav2_msgs_msg.MissedWaypoint]: ...
    @missed_waypoints.setter
    def missed_waypoints(self, value: Iterable[_nav2_msgs_msg.MissedWaypoint]) -> None: ...
    error_code: int
    error_msg: str
    def __init__(self, *, missed_waypoints: Iterable[_nav2_msgs_msg.MissedWaypoint] = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class FollowWaypoints_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowWaypoints_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowWaypoints_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[FollowWaypoints_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowWaypoints_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowWaypoints_SendGoal_Request] = ..., response: Iterable[FollowWaypoints_SendGoal_Response] = ...) -> None: ...

class FollowWaypoints_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: FollowWaypoints_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: FollowWaypoints_Goal = ...) -> None: ...

class FollowWaypoints_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class NavigateThroughPoses_Feedback(Message):
    current_pose: _geometry_msgs_msg.PoseStamped
    navigation_time: _builtin_interfaces_msg.Duration
    estimated_time_remaining: _builtin_interfaces_msg.Duration
    number_of_recoveries: int
    distance_remaining: float
    number_of_poses_remaining: int
    def __init__(self, *, current_pose: _geometry_msgs_msg.PoseStamped = ..., navigation_time: _builtin_interfaces_msg.Duration = ..., estimated_time_remaining: _builtin_interfaces_msg.Duration = ..., number_of_recoveries: int = ..., distance_remaining: float = ..., number_of_poses_remaining: int = ...) -> None: ...

class NavigateThroughPoses_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: NavigateThroughPoses_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: NavigateThroughPoses_Feedback = ...) -> None: ...

class NavigateThroughPoses_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[NavigateThroughPoses_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[NavigateThroughPoses_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[NavigateThroughPoses_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[NavigateThroughPoses_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[NavigateThroughPoses_GetResult_Request] = ..., response: Iterable[NavigateThroughPoses_GetResult_Response] = ...) -> None: ...

class NavigateThroughPoses_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class NavigateThroughPoses_GetResult_Response(Message):
    status: int
    result: NavigateThroughPoses_Result
    def __init__(self, *, status: int = ..., result: NavigateThroughPoses_Result = ...) -> None: ...

class NavigateThroughPoses_Goal(Message):
    @property
    def poses(self) -> list[_geometry_msgs_msg.PoseStamped]: ...
    @poses.setter
    def poses(self, value: Iterable[_geometry_msgs_msg.PoseStamped]) -> None: ...
    behavior_tree: str
    def __init__(self, *, poses: Iterable[_geometry_msgs_msg.PoseStamped] = ..., behavior_tree: str = ...) -> None: ...

class NavigateThroughPoses_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    FAILED_TO_LOAD_BEHAVIOR_TREE: ClassVar[int]
    TF_ERROR: ClassVar[int]
    TIMEOUT: ClassVar[int]
    error_code: int
    error_msg: str
    def __init__(self, *, error_code: int = ..., error_msg: str = ...) -> None: ...

class NavigateThroughPoses_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[NavigateThroughPoses_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[NavigateThroughPoses_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[NavigateThroughPoses_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[NavigateThroughPoses_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[NavigateThroughPoses_SendGoal_Request] = ..., response: Iterable[NavigateThroughPoses_SendGoal_Response] = ...) -> None: ...

class NavigateThroughPoses_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: NavigateThroughPoses_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: NavigateThroughPoses_Goal = ...) -> None: ...

class NavigateThroughPoses_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class NavigateToPose_Feedback(Message):
    current_pose: _geometry_msgs_msg.PoseStamped
    navigation_time: _builtin_interfaces_msg.Duration
    estimated_time_remaining: _builtin_interfaces_msg.Duration
    number_of_recoveries: int
    distance_remaining: float
    def __init__(self, *, current_pose: _geometry_msgs_msg.PoseStamped = ..., navigation_time: _builtin_interfaces_msg.Duration = ..., estimated_time_remaining: _builtin_interfaces_msg.Duration = ..., number_of_recoveries: int = ..., distance_remaining: float = ...) -> None: ...

class NavigateToPose_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: NavigateToPose_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: NavigateToPose_Feedback = ...) -> None: ...

class NavigateToPose_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[NavigateToPose_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[NavigateToPose_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[NavigateToPose_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[NavigateToPose_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[NavigateToPose_GetResult_Request] = ..., response: Iterable[NavigateToPose_GetResult_Response] = ...) -> None: ...

class NavigateToPose_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class NavigateToPose_GetResult_Response(Message):
    status: int
    result: NavigateToPose_Result
    def __init__(self, *, status: int = ..., result: NavigateToPose_Result = ...) -> None: ...

class NavigateToPose_Goal(Message):
    pose: _geometry_msgs_msg.PoseStamped
    behavior_tree: str
    def __init__(self, *, pose: _geometry_msgs_msg.PoseStamped = ..., behavior_tree: str = ...) -> None: ...

class NavigateToPose_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    FAILED_TO_LOAD_BEHAVIOR_TREE: ClassVar[int]
    TF_ERROR: ClassVar[int]
    TIMEOUT: ClassVar[int]
    error_code: int
    error_msg: str
    def __init__(self, *, error_code: int = ..., error_msg: str = ...) -> None: ...

class NavigateToPose_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[NavigateToPose_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[NavigateToPose_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[NavigateToPose_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[NavigateToPose_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[NavigateToPose_SendGoal_Request] = ..., response: Iterable[NavigateToPose_SendGoal_Response] = ...) -> None: ...

class NavigateToPose_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: NavigateToPose_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: NavigateToPose_Goal = ...) -> None: ...

class NavigateToPose_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class SmoothPath_Feedback(Message):
    def __init__(self) -> None: ...

class SmoothPath_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: SmoothPath_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: SmoothPath_Feedback = ...) -> None: ...

class SmoothPath_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SmoothPath_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[SmoothPath_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[SmoothPath_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[SmoothPath_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SmoothPath_GetResult_Request] = ..., response: Iterable[SmoothPath_GetResult_Response] = ...) -> None: ...

class SmoothPath_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class SmoothPath_GetResult_Response(Message):
    status: int
    result: SmoothPath_Result
    def __init__(self, *, status: int = ..., result: SmoothPath_Result = ...) -> None: ...

class SmoothPath_Goal(Message):
    path: _nav_msgs_msg.Path
    smoother_id: str
    max_smoothing_duration: _builtin_interfaces_msg.Duration
    check_for_collisions: bool
    def __init__(self, *, path: _nav_msgs_msg.Path = ..., smoother_id: str = ..., max_smoothing_duration: _builtin_interfaces_msg.Duration = ..., check_for_collisions: bool = ...) -> None: ...

class SmoothPath_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    INVALID_SMOOTHER: ClassVar[int]
    TIMEOUT: ClassVar[int]
    SMOOTHED_PATH_IN_COLLISION: ClassVar[int]
    FAILED_TO_SMOOTH_PATH: ClassVar[int]
    INVALID_PATH: ClassVar[int]
    path: _nav_msgs_msg.Path
    smoothing_duration: _builtin_interfaces_msg.Duration
    was_completed: bool
    error_code: int
    error_msg: str
    def __init__(self, *, path: _nav_msgs_msg.Path = ..., smoothing_duration: _builtin_interfaces_msg.Duration = ..., was_completed: bool = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class SmoothPath_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SmoothPath_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[SmoothPath_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[SmoothPath_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[SmoothPath_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SmoothPath_SendGoal_Request] = ..., response: Iterable[SmoothPath_SendGoal_Response] = ...) -> None: ...

class SmoothPath_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: SmoothPath_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: SmoothPath_Goal = ...) -> None: ...

class SmoothPath_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class Spin_Feedback(Message):
    angular_distance_traveled: float
    def __init__(self, *, angular_distance_traveled: float = ...) -> None: ...

class Spin_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: Spin_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: Spin_Feedback = ...) -> None: ...

class Spin_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Spin_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[Spin_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[Spin_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[Spin_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Spin_GetResult_Request] = ..., response: Iterable[Spin_GetResult_Response] = ...) -> None: ...

class Spin_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class Spin_GetResult_Response(Message):
    status: int
    result: Spin_Result
    def __init__(self, *, status: int = ..., result: Spin_Result = ...) -> None: ...

class Spin_Goal(Message):
    target_yaw: float
    time_allowance: _builtin_interfaces_msg.Duration
    def __init__(self, *, target_yaw: float = ..., time_allowance: _builtin_interfaces_msg.Duration = ...) -> None: ...

class Spin_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TIMEOUT: ClassVar[int]
    TF_ERROR: ClassVar[int]
    COLLISION_AHEAD: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class Spin_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Spin_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[Spin_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[Spin_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[Spin_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Spin_SendGoal_Request] = ..., response: Iterable[Spin_SendGoal_Response] = ...) -> None: ...

class Spin_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: Spin_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: Spin_Goal = ...) -> None: ...

class Spin_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class UndockRobot_Feedback(Message):
    def __init__(self) -> None: ...

class UndockRobot_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: UndockRobot_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: UndockRobot_Feedback = ...) -> None: ...

class UndockRobot_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[UndockRobot_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[UndockRobot_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[UndockRobot_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[UndockRobot_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[UndockRobot_GetResult_Request] = ..., response: Iterable[UndockRobot_GetResult_Response] = ...) -> None: ...

class UndockRobot_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class UndockRobot_GetResult_Response(Message):
    status: int
    result: UndockRobot_Result
    def __init__(self, *, status: int = ..., result: UndockRobot_Result = ...) -> None: ...

class UndockRobot_Goal(Message):
    dock_type: str
    max_undocking_time: float
    def __init__(self, *, dock_type: str = ..., max_undocking_time: float = ...) -> None: ...

class UndockRobot_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    DOCK_NOT_VALID: ClassVar[int]
    FAILED_TO_CONTROL: ClassVar[int]
    TIMEOUT: ClassVar[int]
    UNKNOWN: ClassVar[int]
    success: bool
    error_code: int
    error_msg: str
    def __init__(self, *, success: bool = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class UndockRobot_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[UndockRobot_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[UndockRobot_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[UndockRobot_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[UndockRobot_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[UndockRobot_SendGoal_Request] = ..., response: Iterable[UndockRobot_SendGoal_Response] = ...) -> None: ...

class UndockRobot_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: UndockRobot_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: UndockRobot_Goal = ...) -> None: ...

class UndockRobot_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class Wait_Feedback(Message):
    time_left: _builtin_interfaces_msg.Duration
    def __init__(self, *, time_left: _builtin_interfaces_msg.Duration = ...) -> None: ...

class Wait_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: Wait_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: Wait_Feedback = ...) -> None: ...

class Wait_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Wait_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[Wait_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[Wait_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[Wait_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Wait_GetResult_Request] = ..., response: Iterable[Wait_GetResult_Response] = ...) -> None: ...

class Wait_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class Wait_GetResult_Response(Message):
    status: int
    result: Wait_Result
    def __init__(self, *, status: int = ..., result: Wait_Result = ...) -> None: ...

class Wait_Goal(Message):
    time: _builtin_interfaces_msg.Duration
    def __init__(self, *, time: _builtin_interfaces_msg.Duration = ...) -> None: ...

class Wait_Result(Message):
    NONE: ClassVar[int]
    GOAL_REJECTED: ClassVar[int]
    SEND_GOAL_FAILURE: ClassVar[int]
    UNKNOWN: ClassVar[int]
    TIMEOUT: ClassVar[int]
    total_elapsed_time: _builtin_interfaces_msg.Duration
    error_code: int
    error_msg: str
    def __init__(self, *, total_elapsed_time: _builtin_interfaces_msg.Duration = ..., error_code: int = ..., error_msg: str = ...) -> None: ...

class Wait_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[Wait_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[Wait_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[Wait_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[Wait_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[Wait_SendGoal_Request] = ..., response: Iterable[Wait_SendGoal_Response] = ...) -> None: ...

class Wait_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: Wait_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: Wait_Goal = ...) -> None: ...

class Wait_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class AssistedTeleop(Action):
    Goal = AssistedTeleop_Goal
    Result = AssistedTeleop_Result
    Feedback = AssistedTeleop_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = AssistedTeleop_SendGoal_Request
            Response = AssistedTeleop_SendGoal_Response
            Event = AssistedTeleop_SendGoal_Event
        class GetResultService(Service):
            Request = AssistedTeleop_GetResult_Request
            Response = AssistedTeleop_GetResult_Response
            Event = AssistedTeleop_GetResult_Event
        FeedbackMessage = AssistedTeleop_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class BackUp(Action):
    Goal = BackUp_Goal
    Result = BackUp_Result
    Feedback = BackUp_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = BackUp_SendGoal_Request
            Response = BackUp_SendGoal_Response
            Event = BackUp_SendGoal_Event
        class GetResultService(Service):
            Request = BackUp_GetResult_Request
            Response = BackUp_GetResult_Response
            Event = BackUp_GetResult_Event
        FeedbackMessage = BackUp_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class ComputeAndTrackRoute(Action):
    Goal = ComputeAndTrackRoute_Goal
    Result = ComputeAndTrackRoute_Result
    Feedback = ComputeAndTrackRoute_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = ComputeAndTrackRoute_SendGoal_Request
            Response = ComputeAndTrackRoute_SendGoal_Response
            Event = ComputeAndTrackRoute_SendGoal_Event
        class GetResultService(Service):
            Request = ComputeAndTrackRoute_GetResult_Request
            Response = ComputeAndTrackRoute_GetResult_Response
            Event = ComputeAndTrackRoute_GetResult_Event
        FeedbackMessage = ComputeAndTrackRoute_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class ComputePathThroughPoses(Action):
    Goal = ComputePathThroughPoses_Goal
    Result = ComputePathThroughPoses_Result
    Feedback = ComputePathThroughPoses_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = ComputePathThroughPoses_SendGoal_Request
            Response = ComputePathThroughPoses_SendGoal_Response
            Event = ComputePathThroughPoses_SendGoal_Event
        class GetResultService(Service):
            Request = ComputePathThroughPoses_GetResult_Request
            Response = ComputePathThroughPoses_GetResult_Response
            Event = ComputePathThroughPoses_GetResult_Event
        FeedbackMessage = ComputePathThroughPoses_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class ComputePathToPose(Action):
    Goal = ComputePathToPose_Goal
    Result = ComputePathToPose_Result
    Feedback = ComputePathToPose_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = ComputePathToPose_SendGoal_Request
            Response = ComputePathToPose_SendGoal_Response
            Event = ComputePathToPose_SendGoal_Event
        class GetResultService(Service):
            Request = ComputePathToPose_GetResult_Request
            Response = ComputePathToPose_GetResult_Response
            Event = ComputePathToPose_GetResult_Event
        FeedbackMessage = ComputePathToPose_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class ComputeRoute(Action):
    Goal = ComputeRoute_Goal
    Result = ComputeRoute_Result
    Feedback = ComputeRoute_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = ComputeRoute_SendGoal_Request
            Response = ComputeRoute_SendGoal_Response
            Event = ComputeRoute_SendGoal_Event
        class GetResultService(Service):
            Request = ComputeRoute_GetResult_Request
            Response = ComputeRoute_GetResult_Response
            Event = ComputeRoute_GetResult_Event
        FeedbackMessage = ComputeRoute_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class DockRobot(Action):
    Goal = DockRobot_Goal
    Result = DockRobot_Result
    Feedback = DockRobot_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = DockRobot_SendGoal_Request
            Response = DockRobot_SendGoal_Response
            Event = DockRobot_SendGoal_Event
        class GetResultService(Service):
            Request = DockRobot_GetResult_Request
            Response = DockRobot_GetResult_Response
            Event = DockRobot_GetResult_Event
        FeedbackMessage = DockRobot_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class DriveOnHeading(Action):
    Goal = DriveOnHeading_Goal
    Result = DriveOnHeading_Result
    Feedback = DriveOnHeading_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = DriveOnHeading_SendGoal_Request
            Response = DriveOnHeading_SendGoal_Response
            Event = DriveOnHeading_SendGoal_Event
        class GetResultService(Service):
            Request = DriveOnHeading_GetResult_Request
            Response = DriveOnHeading_GetResult_Response
            Event = DriveOnHeading_GetResult_Event
        FeedbackMessage = DriveOnHeading_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class FollowGPSWaypoints(Action):
    Goal = FollowGPSWaypoints_Goal
    Result = FollowGPSWaypoints_Result
    Feedback = FollowGPSWaypoints_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = FollowGPSWaypoints_SendGoal_Request
            Response = FollowGPSWaypoints_SendGoal_Response
            Event = FollowGPSWaypoints_SendGoal_Event
        class GetResultService(Service):
            Request = FollowGPSWaypoints_GetResult_Request
            Response = FollowGPSWaypoints_GetResult_Response
            Event = FollowGPSWaypoints_GetResult_Event
        FeedbackMessage = FollowGPSWaypoints_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class FollowObject(Action):
    Goal = FollowObject_Goal
    Result = FollowObject_Result
    Feedback = FollowObject_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = FollowObject_SendGoal_Request
            Response = FollowObject_SendGoal_Response
            Event = FollowObject_SendGoal_Event
        class GetResultService(Service):
            Request = FollowObject_GetResult_Request
            Response = FollowObject_GetResult_Response
            Event = FollowObject_GetResult_Event
        FeedbackMessage = FollowObject_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class FollowPath(Action):
    Goal = FollowPath_Goal
    Result = FollowPath_Result
    Feedback = FollowPath_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = FollowPath_SendGoal_Request
            Response = FollowPath_SendGoal_Response
            Event = FollowPath_SendGoal_Event
        class GetResultService(Service):
            Request = FollowPath_GetResult_Request
            Response = FollowPath_GetResult_Response
            Event = FollowPath_GetResult_Event
        FeedbackMessage = FollowPath_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class FollowWaypoints(Action):
    Goal = FollowWaypoints_Goal
    Result = FollowWaypoints_Result
    Feedback = FollowWaypoints_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = FollowWaypoints_SendGoal_Request
            Response = FollowWaypoints_SendGoal_Response
            Event = FollowWaypoints_SendGoal_Event
        class GetResultService(Service):
            Request = FollowWaypoints_GetResult_Request
            Response = FollowWaypoints_GetResult_Response
            Event = FollowWaypoints_GetResult_Event
        FeedbackMessage = FollowWaypoints_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class NavigateThroughPoses(Action):
    Goal = NavigateThroughPoses_Goal
    Result = NavigateThroughPoses_Result
    Feedback = NavigateThroughPoses_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = NavigateThroughPoses_SendGoal_Request
            Response = NavigateThroughPoses_SendGoal_Response
            Event = NavigateThroughPoses_SendGoal_Event
        class GetResultService(Service):
            Request = NavigateThroughPoses_GetResult_Request
            Response = NavigateThroughPoses_GetResult_Response
            Event = NavigateThroughPoses_GetResult_Event
        FeedbackMessage = NavigateThroughPoses_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class NavigateToPose(Action):
    Goal = NavigateToPose_Goal
    Result = NavigateToPose_Result
    Feedback = NavigateToPose_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = NavigateToPose_SendGoal_Request
            Response = NavigateToPose_SendGoal_Response
            Event = NavigateToPose_SendGoal_Event
        class GetResultService(Service):
            Request = NavigateToPose_GetResult_Request
            Response = NavigateToPose_GetResult_Response
            Event = NavigateToPose_GetResult_Event
        FeedbackMessage = NavigateToPose_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class SmoothPath(Action):
    Goal = SmoothPath_Goal
    Result = SmoothPath_Result
    Feedback = SmoothPath_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = SmoothPath_SendGoal_Request
            Response = SmoothPath_SendGoal_Response
            Event = SmoothPath_SendGoal_Event
        class GetResultService(Service):
            Request = SmoothPath_GetResult_Request
            Response = SmoothPath_GetResult_Response
            Event = SmoothPath_GetResult_Event
        FeedbackMessage = SmoothPath_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class Spin(Action):
    Goal = Spin_Goal
    Result = Spin_Result
    Feedback = Spin_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = Spin_SendGoal_Request
            Response = Spin_SendGoal_Response
            Event = Spin_SendGoal_Event
        class GetResultService(Service):
            Request = Spin_GetResult_Request
            Response = Spin_GetResult_Response
            Event = Spin_GetResult_Event
        FeedbackMessage = Spin_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class UndockRobot(Action):
    Goal = UndockRobot_Goal
    Result = UndockRobot_Result
    Feedback = UndockRobot_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = UndockRobot_SendGoal_Request
            Response = UndockRobot_SendGoal_Response
            Event = UndockRobot_SendGoal_Event
        class GetResultService(Service):
            Request = UndockRobot_GetResult_Request
            Response = UndockRobot_GetResult_Response
            Event = UndockRobot_GetResult_Event
        FeedbackMessage = UndockRobot_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray

class Wait(Action):
    Goal = Wait_Goal
    Result = Wait_Result
    Feedback = Wait_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = Wait_SendGoal_Request
            Response = Wait_SendGoal_Response
            Event = Wait_SendGoal_Event
        class GetResultService(Service):
            Request = Wait_GetResult_Request
            Response = Wait_GetResult_Response
            Event = Wait_GetResult_Event
        FeedbackMessage = Wait_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray
