import periplus.msgs.actionlib_msgs.msg as _actionlib_msgs_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "MoveBaseAction",
    "MoveBaseActionFeedback",
    "MoveBaseActionGoal",
    "MoveBaseActionResult",
    "MoveBaseFeedback",
    "MoveBaseGoal",
    "MoveBaseResult",
    "RecoveryStatus",
]

class MoveBaseAction(Message):
    action_goal: MoveBaseActionGoal
    action_result: MoveBaseActionResult
    action_feedback: MoveBaseActionFeedback
    def __init__(self, *, action_goal: MoveBaseActionGoal = ..., action_result: MoveBaseActionResult = ..., action_feedback: MoveBaseActionFeedback = ...) -> None: ...

class MoveBaseActionFeedback(Message):
    header: _std_msgs_msg.Header
    status: _actionlib_msgs_msg.GoalStatus
    feedback: MoveBaseFeedback
    def __init__(self, *, header: _std_msgs_msg.Header = ..., status: _actionlib_msgs_msg.GoalStatus = ..., feedback: MoveBaseFeedback = ...) -> None: ...

class MoveBaseActionGoal(Message):
    header: _std_msgs_msg.Header
    goal_id: _actionlib_msgs_msg.GoalID
    goal: MoveBaseGoal
    def __init__(self, *, header: _std_msgs_msg.Header = ..., goal_id: _actionlib_msgs_msg.GoalID = ..., goal: MoveBaseGoal = ...) -> None: ...

class MoveBaseActionResult(Message):
    header: _std_msgs_msg.Header
    status: _actionlib_msgs_msg.GoalStatus
    result: MoveBaseResult
    def __init__(self, *, header: _std_msgs_msg.Header = ..., status: _actionlib_msgs_msg.GoalStatus = ..., result: MoveBaseResult = ...) -> None: ...

class MoveBaseFeedback(Message):
    base_position: _geometry_msgs_msg.PoseStamped
    def __init__(self, *, base_position: _geometry_msgs_msg.PoseStamped = ...) -> None: ...

class MoveBaseGoal(Message):
    target_pose: _geometry_msgs_msg.PoseStamped
    def __init__(self, *, target_pose: _geometry_msgs_msg.PoseStamped = ...) -> None: ...

class MoveBaseResult(Message):
    def __init__(self) -> None: ...

class RecoveryStatus(Message):
    pose_stamped: _geometry_msgs_msg.PoseStamped
    current_recovery_number: int
    total_number_of_recoveries: int
    recovery_behavior_name: str
    def __init__(self, *, pose_stamped: _geometry_msgs_msg.PoseStamped = ..., current_recovery_number: int = ..., total_number_of_recoveries: int = ..., recovery_behavior_name: str = ...) -> None: ...
