from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.trajectory_msgs.msg as _trajectory_msgs_msg
from periplus.msgs import Message

__all__ = [
    "DynamicJointState",
    "InterfaceValue",
    "JointComponentTolerance",
    "JointJog",
    "JointTolerance",
    "JointTrajectoryControllerState",
    "MecanumDriveControllerState",
    "PidState",
    "SingleDOFState",
    "SpeedScalingFactor",
    "SteeringControllerCommand",
    "SteeringControllerStatus",
]

class DynamicJointState(Message):
    header: _std_msgs_msg.Header
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    @property
    def interface_values(self) -> list[InterfaceValue]: ...
    @interface_values.setter
    def interface_values(self, value: Iterable[InterfaceValue]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., joint_names: Iterable[str] = ..., interface_values: Iterable[InterfaceValue] = ...) -> None: ...

class InterfaceValue(Message):
    @property
    def interface_names(self) -> list[str]: ...
    @interface_names.setter
    def interface_names(self, value: Iterable[str]) -> None: ...
    @property
    def values(self) -> npt.NDArray[np.float64]: ...
    @values.setter
    def values(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, interface_names: Iterable[str] = ..., values: npt.ArrayLike = ...) -> None: ...

class JointComponentTolerance(Message):
    X_AXIS: ClassVar[int]
    Y_AXIS: ClassVar[int]
    Z_AXIS: ClassVar[int]
    TRANSLATION: ClassVar[int]
    ROTATION: ClassVar[int]
    joint_name: str
    component: int
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, joint_name: str = ..., component: int = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointJog(Message):
    header: _std_msgs_msg.Header
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    @property
    def displacements(self) -> npt.NDArray[np.float64]: ...
    @displacements.setter
    def displacements(self, value: npt.ArrayLike) -> None: ...
    @property
    def velocities(self) -> npt.NDArray[np.float64]: ...
    @velocities.setter
    def velocities(self, value: npt.ArrayLike) -> None: ...
    duration: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., joint_names: Iterable[str] = ..., displacements: npt.ArrayLike = ..., velocities: npt.ArrayLike = ..., duration: float = ...) -> None: ...

class JointTolerance(Message):
    name: str
    position: float
    velocity: float
    acceleration: float
    def __init__(self, *, name: str = ..., position: float = ..., velocity: float = ..., acceleration: float = ...) -> None: ...

class JointTrajectoryControllerState(Message):
    header: _std_msgs_msg.Header
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    reference: _trajectory_msgs_msg.JointTrajectoryPoint
    feedback: _trajectory_msgs_msg.JointTrajectoryPoint
    error: _trajectory_msgs_msg.JointTrajectoryPoint
    output: _trajectory_msgs_msg.JointTrajectoryPoint
    @property
    def multi_dof_joint_names(self) -> list[str]: ...
    @multi_dof_joint_names.setter
    def multi_dof_joint_names(self, value: Iterable[str]) -> None: ...
    multi_dof_reference: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    multi_dof_feedback: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    multi_dof_error: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    multi_dof_output: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint
    speed_scaling_factor: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., joint_names: Iterable[str] = ..., reference: _trajectory_msgs_msg.JointTrajectoryPoint = ..., feedback: _trajectory_msgs_msg.JointTrajectoryPoint = ..., error: _trajectory_msgs_msg.JointTrajectoryPoint = ..., output: _trajectory_msgs_msg.JointTrajectoryPoint = ..., multi_dof_joint_names: Iterable[str] = ..., multi_dof_reference: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_feedback: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_error: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., multi_dof_output: _trajectory_msgs_msg.MultiDOFJointTrajectoryPoint = ..., speed_scaling_factor: float = ...) -> None: ...

class MecanumDriveControllerState(Message):
    header: _std_msgs_msg.Header
    front_left_wheel_velocity: float
    back_left_wheel_velocity: float
    back_right_wheel_velocity: float
    front_right_wheel_velocity: float
    reference_velocity: _geometry_msgs_msg.Twist
    def __init__(self, *, header: _std_msgs_msg.Header = ..., front_left_wheel_velocity: float = ..., back_left_wheel_velocity: float = ..., back_right_wheel_velocity: float = ..., front_right_wheel_velocity: float = ..., reference_velocity: _geometry_msgs_msg.Twist = ...) -> None: ...

class PidState(Message):
    header: _std_msgs_msg.Header
    timestep: _builtin_interfaces_msg.Duration
    error: float
    error_dot: float
    p_error: float
    i_error: float
    d_error: float
    p_term: float
    i_term: float
    d_term: float
    i_max: float
    i_min: float
    output: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., timestep: _builtin_interfaces_msg.Duration = ..., error: float = ..., error_dot: float = ..., p_error: float = ..., i_error: float = ..., d_error: float = ..., p_term: float = ..., i_term: float = ..., d_term: float = ..., i_max: float = ..., i_min: float = ..., output: float = ...) -> None: ...

class SingleDOFState(Message):
    name: str
    reference: float
    feedback: float
    feedback_dot: float
    error: float
    error_dot: float
    time_step: float
    output: float
    def __init__(self, *, name: str = ..., reference: float = ..., feedback: float = ..., feedback_dot: float = ..., error: float = ..., error_dot: float = ..., time_step: float = ..., output: float = ...) -> None: ...

class SpeedScalingFactor(Message):
    factor: float
    def __init__(self, *, factor: float = ...) -> None: ...

class SteeringControllerCommand(Message):
    header: _std_msgs_msg.Header
    steering_angle: float
    linear_velocity: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., steering_angle: float = ..., linear_velocity: float = ...) -> None: ...

class SteeringControllerStatus(Message):
    header: _std_msgs_msg.Header
    @property
    def traction_wheels_position(self) -> npt.NDArray[np.float64]: ...
    @traction_wheels_position.setter
    def traction_wheels_position(self, value: npt.ArrayLike) -> None: ...
    @property
    def traction_wheels_velocity(self) -> npt.NDArray[np.float64]: ...
    @traction_wheels_velocity.setter
    def traction_wheels_velocity(self, value: npt.ArrayLike) -> None: ...
    @property
    def steer_positions(self) -> npt.NDArray[np.float64]: ...
    @steer_positions.setter
    def steer_positions(self, value: npt.ArrayLike) -> None: ...
    @property
    def linear_velocity_command(self) -> npt.NDArray[np.float64]: ...
    @linear_velocity_command.setter
    def linear_velocity_command(self, value: npt.ArrayLike) -> None: ...
    @property
    def steering_angle_command(self) -> npt.NDArray[np.float64]: ...
    @steering_angle_command.setter
    def steering_angle_command(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., traction_wheels_position: npt.ArrayLike = ..., traction_wheels_velocity: npt.ArrayLike = ..., steer_positions: npt.ArrayLike = ..., linear_velocity_command: npt.ArrayLike = ..., steering_angle_command: npt.ArrayLike = ...) -> None: ...
