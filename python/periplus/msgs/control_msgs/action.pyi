from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.action_msgs.msg as _action_msgs_msg
import periplus.msgs.action_msgs.srv as _action_msgs_srv
import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.control_msgs.msg as _control_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.trajectory_msgs.msg as _trajectory_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Action, Message, Service

__all__ = [
    "FollowJointTrajectory",
    "FollowJointTrajectory_Feedback",
    "FollowJointTrajectory_FeedbackMessage",
    "FollowJointTrajectory_GetResult_Event",
    "FollowJointTrajectory_GetResult_Request",
    "FollowJointTrajectory_GetResult_Response",
    "FollowJointTrajectory_Goal",
    "FollowJointTrajectory_Result",
    "FollowJointTrajectory_SendGoal_Event",
    "FollowJointTrajectory_SendGoal_Request",
    "FollowJointTrajectory_SendGoal_Response",
]

class FollowJointTrajectory_Feedback(Message):
    header: _std_msgs_msg.Header
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    desired: _trajectory_msgs_msg.JointTrajectoryPoint
    actual: _trajectory_msgs_msg.JointTrajectoryPoint
    error: _trajectory_msgs_msg.JointTrajectoryPoint
    @property
    def multi_dof_joint_names(self) -> list[str]: ...
    @multi_dof_joint_names.setter
    def multi_dof_joint_names(self, value: Iterable[str]) -> None: ...
    multi_dof_desired: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    multi_dof_actual: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    def __init__(self, *, header: _std_msgs_msg.Header = ..., joint_names: Iterable[str] = ..., desired: _trajectory_msgs_msg.JointTrajectoryPoint = ..., actual: _trajectory_msgs_msg.JointTrajectoryPoint = ..., error: _trajectory_msgs_msg.JointTrajectoryPoint = ..., multi_dof_joint_names: Iterable[str] = ..., multi_dof_desired: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_actual: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_error: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ...) -> None: ...

class FollowJointTrajectory_FeedbackMessage(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    feedback: FollowJointTrajectory_Feedback
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., feedback: FollowJointTrajectory_Feedback = ...) -> None: ...

class FollowJointTrajectory_GetResult_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowJointTrajectory_GetResult_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowJointTrajectory_GetResult_Request]) -> None: ...
    @property
    def response(self) -> list[FollowJointTrajectory_GetResult_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowJointTrajectory_GetResult_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowJointTrajectory_GetResult_Request] = ..., response: Iterable[FollowJointTrajectory_GetResult_Response] = ...) -> None: ...

class FollowJointTrajectory_GetResult_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ...) -> None: ...

class FollowJointTrajectory_GetResult_Response(Message):
    status: int
    result: FollowJointTrajectory_Result
    def __init__(self, *, status: int = ..., result: FollowJointTrajectory_Result = ...) -> None: ...

class FollowJointTrajectory_Goal(Message):
    trajectory: _trajectory_msgs_msg.JointTrajectory
    multi_dof_trajectory: _trajectory_msgs_msg.MultiDOFJointTrajectory
    @property
    def path_tolerance(self) -> list[_control_msgs_msg.JointTolerance]: ...
    @path_tolerance.setter
    def path_tolerance(self, value: Iterable[_control_msgs_msg.JointTolerance]) -> None: ...
    @property
    def component_path_tolerance(self) -> list[_control_msgs_msg.JointComponentTolerance]: ...
    @component_path_tolerance.setter
    def component_path_tolerance(self, value: Iterable[_control_msgs_msg.JointComponentTolerance]) -> None: ...
    @property
    def goal_tolerance(self) -> list[_control_msgs_msg.JointTolerance]: ...
    @goal_tolerance.setter
    def goal_tolerance(self, value: Iterable[_control_msgs_msg.JointTolerance]) -> None: ...
    @property
    def component_goal_tolerance(self) -> list[_control_msgs_msg.JointComponentTolerance]: ...
    @component_goal_tolerance.setter
    def component_goal_tolerance(self, value: Iterable[_control_msgs_msg.JointComponentTolerance]) -> None: ...
    goal_time_tolerance: _builtin_interfaces_msg.Duration
    def __init__(self, *, trajectory: _trajectory_msgs_msg.JointTrajectory = ..., multi_dof_trajectory: _trajectory_msgs_msg.MultiDOFJointTrajectory = ..., path_tolerance: Iterable[_control_msgs_msg.JointTolerance] = ..., component_path_tolerance: Iterable[_control_msgs_msg.JointComponentTolerance] = ..., goal_tolerance: Iterable[_control_msgs_msg.JointTolerance] = ..., component_goal_tolerance: Iterable[_control_msgs_msg.JointComponentTolerance] = ..., goal_time_tolerance: _builtin_interfaces_msg.Duration = ...) -> None: ...

class FollowJointTrajectory_Result(Message):
    GOAL_TOLERANCE_VIOLATED: ClassVar[int]
    PATH_TOLERANCE_VIOLATED: ClassVar[int]
    OLD_HEADER_TIMESTAMP: ClassVar[int]
    INVALID_JOINTS: ClassVar[int]
    INVALID_GOAL: ClassVar[int]
    SUCCESSFUL: ClassVar[int]
    error_code: int
    error_string: str
    def __init__(self, *, error_code: int = ..., error_string: str = ...) -> None: ...

class FollowJointTrajectory_SendGoal_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[FollowJointTrajectory_SendGoal_Request]: ...
    @request.setter
    def request(self, value: Iterable[FollowJointTrajectory_SendGoal_Request]) -> None: ...
    @property
    def response(self) -> list[FollowJointTrajectory_SendGoal_Response]: ...
    @response.setter
    def response(self, value: Iterable[FollowJointTrajectory_SendGoal_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[FollowJointTrajectory_SendGoal_Request] = ..., response: Iterable[FollowJointTrajectory_SendGoal_Response] = ...) -> None: ...

class FollowJointTrajectory_SendGoal_Request(Message):
    goal_id: _unique_identifier_msgs_msg.UUID
    goal: FollowJointTrajectory_Goal
    def __init__(self, *, goal_id: _unique_identifier_msgs_msg.UUID = ..., goal: FollowJointTrajectory_Goal = ...) -> None: ...

class FollowJointTrajectory_SendGoal_Response(Message):
    accepted: bool
    stamp: _builtin_interfaces_msg.Time
    def __init__(self, *, accepted: bool = ..., stamp: _builtin_interfaces_msg.Time = ...) -> None: ...

class FollowJointTrajectory(Action):
    Goal = FollowJointTrajectory_Goal
    Result = FollowJointTrajectory_Result
    Feedback = FollowJointTrajectory_Feedback
    class Impl:
        class SendGoalService(Service):
            Request = FollowJointTrajectory_SendGoal_Request
            Response = FollowJointTrajectory_SendGoal_Response
            Event = FollowJointTrajectory_SendGoal_Event
        class GetResultService(Service):
            Request = FollowJointTrajectory_GetResult_Request
            Response = FollowJointTrajectory_GetResult_Response
            Event = FollowJointTrajectory_GetResult_Event
        FeedbackMessage = FollowJointTrajectory_FeedbackMessage
        CancelGoalService = _action_msgs_srv.CancelGoal
        GoalStatusMessage = _action_msgs_msg.GoalStatusArray
