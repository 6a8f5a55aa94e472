from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.gazebo_msgs.msg as _gazebo_msgs_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.trajectory_msgs.msg as _trajectory_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "ApplyBodyWrench",
    "ApplyBodyWrench_Event",
    "ApplyBodyWrench_Request",
    "ApplyBodyWrench_Response",
    "ApplyJointEffort",
    "ApplyJointEffort_Event",
    "ApplyJointEffort_Request",
    "ApplyJointEffort_Response",
    "ApplyLinkWrench",
    "ApplyLinkWrench_Event",
    "ApplyLinkWrench_Request",
    "ApplyLinkWrench_Response",
    "BodyRequest",
    "BodyRequest_Event",
    "BodyRequest_Request",
    "BodyRequest_Response",
    "DeleteEntity",
    "DeleteEntity_Event",
    "DeleteEntity_Request",
    "DeleteEntity_Response",
    "DeleteLight",
    "DeleteLight_Event",
    "DeleteLight_Request",
    "DeleteLight_Response",
    "DeleteModel",
    "DeleteModel_Event",
    "DeleteModel_Request",
    "DeleteModel_Response",
    "GetEntityState",
    "GetEntityState_Event",
    "GetEntityState_Request",
    "GetEntityState_Response",
    "GetJointProperties",
    "GetJointProperties_Event",
    "GetJointProperties_Request",
    "GetJointProperties_Response",
    "GetLightProperties",
    "GetLightProperties_Event",
    "GetLightProperties_Request",
    "GetLightProperties_Response",
    "GetLinkProperties",
    "GetLinkProperties_Event",
    "GetLinkProperties_Request",
    "GetLinkProperties_Response",
    "GetLinkState",
    "GetLinkState_Event",
    "GetLinkState_Request",
    "GetLinkState_Response",
    "GetModelList",
    "GetModelList_Event",
    "GetModelList_Request",
    "GetModelList_Response",
    "GetModelProperties",
    "GetModelProperties_Event",
    "GetModelProperties_Request",
    "GetModelProperties_Response",
    "GetModelState",
    "GetModelState_Event",
    "GetModelState_Request",
    "GetModelState_Response",
    "GetPhysicsProperties",
    "GetPhysicsProperties_Event",
    "GetPhysicsProperties_Request",
    "GetPhysicsProperties_Response",
    "GetWorldProperties",
    "GetWorldProperties_Event",
    "GetWorldProperties_Request",
    "GetWorldProperties_Response",
    "JointRequest",
    "JointRequest_Event",
    "JointRequest_Request",
    "JointRequest_Response",
    "LinkRequest",
    "LinkRequest_Event",
    "LinkRequest_Request",
    "LinkRequest_Response",
    "SetEntityState",
    "SetEntityState_Event",
    "SetEntityState_Request",
    "SetEntityState_Response",
    "SetJointProperties",
    "SetJointProperties_Event",
    "SetJointProperties_Request",
    "SetJointProperties_Response",
    "SetJointTrajectory",
    "SetJointTrajectory_Event",
    "SetJointTrajectory_Request",
    "SetJointTrajectory_Response",
    "SetLightProperties",
    "SetLightProperties_Event",
    "SetLightProperties_Request",
    "SetLightProperties_Response",
    "SetLinkProperties",
    "SetLinkProperties_Event",
    "SetLinkProperties_Request",
    "SetLinkProperties_Response",
    "SetLinkState",
    "SetLinkState_Event",
    "SetLinkState_Request",
    "SetLinkState_Response",
    "SetModelConfiguration",
    "SetModelConfiguration_Event",
    "SetModelConfiguration_Request",
    "SetModelConfiguration_Response",
    "SetModelState",
    "SetModelState_Event",
    "SetModelState_Request",
    "SetModelState_Response",
    "SetPhysicsProperties",
    "SetPhysicsProperties_Event",
    "SetPhysicsProperties_Request",
    "SetPhysicsProperties_Response",
    "SpawnEntity",
    "SpawnEntity_Event",
    "SpawnEntity_Request",
    "SpawnEntity_Response",
    "SpawnModel",
    "SpawnModel_Event",
    "SpawnModel_Request",
    "SpawnModel_Response",
]

class ApplyBodyWrench_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ApplyBodyWrench_Request]: ...
    @request.setter
    def request(self, value: Iterable[ApplyBodyWrench_Request]) -> None: ...
    @property
    def response(self) -> list[ApplyBodyWrench_Response]: ...
    @response.setter
    def response(self, value: Iterable[ApplyBodyWrench_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ApplyBodyWrench_Request] = ..., response: Iterable[ApplyBodyWrench_Response] = ...) -> None: ...

class ApplyBodyWrench_Request(Message):
    body_name: str
    reference_frame: str
    reference_point: _geometry_msgs_msg.Point
    wrench: _geometry_msgs_msg.Wrench
    start_time: _builtin_interfaces_msg.Time
    duration: _builtin_interfaces_msg.Duration
    def __init__(self, *, body_name: str = ..., reference_frame: str = ..., reference_point: _geometry_msgs_msg.Point = ..., wrench: _geometry_msgs_msg.Wrench = ..., start_time: _builtin_interfaces_msg.Time = ..., duration: _builtin_interfaces_msg.Duration = ...) -> None: ...

class ApplyBodyWrench_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyJointEffort_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ApplyJointEffort_Request]: ...
    @request.setter
    def request(self, value: Iterable[ApplyJointEffort_Request]) -> None: ...
    @property
    def response(self) -> list[ApplyJointEffort_Response]: ...
    @response.setter
    def response(self, value: Iterable[ApplyJointEffort_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ApplyJointEffort_Request] = ..., response: Iterable[ApplyJointEffort_Response] = ...) -> None: ...

class ApplyJointEffort_Request(Message):
    joint_name: str
    effort: float
    start_time: _builtin_interfaces_msg.Time
    duration: _builtin_interfaces_msg.Duration
    def __init__(self, *, joint_name: str = ..., effort: float = ..., start_time: _builtin_interfaces_msg.Time = ..., duration: _builtin_interfaces_msg.Duration = ...) -> None: ...

class ApplyJointEffort_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyLinkWrench_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ApplyLinkWrench_Request]: ...
    @request.setter
    def request(self, value: Iterable[ApplyLinkWrench_Request]) -> None: ...
    @property
    def response(self) -> list[ApplyLinkWrench_Response]: ...
    @response.setter
    def response(self, value: Iterable[ApplyLinkWrench_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ApplyLinkWrench_Request] = ..., response: Iterable[ApplyLinkWrench_Response] = ...) -> None: ...

class ApplyLinkWrench_Request(Message):
    link_name: str
    reference_frame: str
    reference_point: _geometry_msgs_msg.Point
    wrench: _geometry_msgs_msg.Wrench
    start_time: _builtin_interfaces_msg.Time
    duration: _builtin_interfaces_msg.Duration
    def __init__(self, *, link_name: str = ..., reference_frame: str = ..., reference_point: _geometry_msgs_msg.Point = ..., wrench: _geometry_msgs_msg.Wrench = ..., start_time: _builtin_interfaces_msg.Time = ..., duration: _builtin_interfaces_msg.Duration = ...) -> None: ...

class ApplyLinkWrench_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class BodyRequest_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[BodyRequest_Request]: ...
    @request.setter
    def request(self, value: Iterable[BodyRequest_Request]) -> None: ...
    @property
    def response(self) -> list[BodyRequest_Response]: ...
    @response.setter
    def response(self, value: Iterable[BodyRequest_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[BodyRequest_Request] = ..., response: Iterable[BodyRequest_Response] = ...) -> None: ...

class BodyRequest_Request(Message):
    body_name: str
    def __init__(self, *, body_name: str = ...) -> None: ...

class BodyRequest_Response(Message):
    def __init__(self) -> None: ...

class DeleteEntity_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DeleteEntity_Request]: ...
    @request.setter
    def request(self, value: Iterable[DeleteEntity_Request]) -> None: ...
    @property
    def response(self) -> list[DeleteEntity_Response]: ...
    @response.setter
    def response(self, value: Iterable[DeleteEntity_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DeleteEntity_Request] = ..., response: Iterable[DeleteEntity_Response] = ...) -> None: ...

class DeleteEntity_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class DeleteEntity_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class DeleteLight_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DeleteLight_Request]: ...
    @request.setter
    def request(self, value: Iterable[DeleteLight_Request]) -> None: ...
    @property
    def response(self) -> list[DeleteLight_Response]: ...
    @response.setter
    def response(self, value: Iterable[DeleteLight_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DeleteLight_Request] = ..., response: Iterable[DeleteLight_Response] = ...) -> None: ...

class DeleteLight_Request(Message):
    light_name: str
    def __init__(self, *, light_name: str = ...) -> None: ...

class DeleteLight_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class DeleteModel_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[DeleteModel_Request]: ...
    @request.setter
    def request(self, value: Iterable[DeleteModel_Request]) -> None: ...
    @property
    def response(self) -> list[DeleteModel_Response]: ...
    @response.setter
    def response(self, value: Iterable[DeleteModel_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[DeleteModel_Request] = ..., response: Iterable[DeleteModel_Response] = ...) -> None: ...

class DeleteModel_Request(Message):
    model_name: str
    def __init__(self, *, model_name: str = ...) -> None: ...

class DeleteModel_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class GetEntityState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetEntityState_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetEntityState_Request]) -> None: ...
    @property
    def response(self) -> list[GetEntityState_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetEntityState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetEntityState_Request] = ..., response: Iterable[GetEntityState_Response] = ...) -> None: ...

class GetEntityState_Request(Message):
    name: str
    reference_frame: str
    def __init__(self, *, name: str = ..., reference_frame: str = ...) -> None: ...

class GetEntityState_Response(Message):
    header: _std_msgs_msg.Header
    state: _gazebo_msgs_msg.EntityState
    success: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., state: _gazebo_msgs_msg.EntityState = ..., success: bool = ...) -> None: ...

class GetJointProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetJointProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetJointProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetJointProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetJointProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetJointProperties_Request] = ..., response: Iterable[GetJointProperties_Response] = ...) -> None: ...

class GetJointProperties_Request(Message):
    joint_name: str
    def __init__(self, *, joint_name: str = ...) -> None: ...

class GetJointProperties_Response(Message):
    REVOLUTE: ClassVar[int]
    CONTINUOUS: ClassVar[int]
    PRISMATIC: ClassVar[int]
    FIXED: ClassVar[int]
    BALL: ClassVar[int]
    UNIVERSAL: ClassVar[int]
    type: int
    @property
    def damping(self) -> npt.NDArray[np.float64]: ...
    @damping.setter
    def damping(self, value: npt.ArrayLike) -> None: ...
    @property
    def position(self) -> npt.NDArray[np.float64]: ...
    @position.setter
    def position(self, value: npt.ArrayLike) -> None: ...
    @property
    def rate(self) -> npt.NDArray[np.float64]: ...
    @rate.setter
    def rate(self, value: npt.ArrayLike) -> None: ...
    success: bool
    status_message: str
    def __init__(self, *, type: int = ..., damping: npt.ArrayLike = ..., position: npt.ArrayLike = ..., rate: npt.ArrayLike = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLightProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetLightProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetLightProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetLightProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetLightProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetLightProperties_Request] = ..., response: Iterable[GetLightProperties_Response] = ...) -> None: ...

class GetLightProperties_Request(Message):
    light_name: str
    def __init__(self, *, light_name: str = ...) -> None: ...

class GetLightProperties_Response(Message):
    diffuse: _std_msgs_msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    success: bool
    status_message: str
    def __init__(self, *, diffuse: _std_msgs_msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLinkProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetLinkProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetLinkProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetLinkProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetLinkProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetLinkProperties_Request] = ..., response: Iterable[GetLinkProperties_Response] = ...) -> None: ...

class GetLinkProperties_Request(Message):
    link_name: str
    def __init__(self, *, link_name: str = ...) -> None: ...

class GetLinkProperties_Response(Message):
    com: _geometry_msgs_msg.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    success: bool
    status_message: str
    def __init__(self, *, com: _geometry_msgs_msg.Pose = ..., gravity_mode: bool = ..., mass: float = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetLinkState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetLinkState_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetLinkState_Request]) -> None: ...
    @property
    def response(self) -> list[GetLinkState_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetLinkState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetLinkState_Request] = ..., response: Iterable[GetLinkState_Response] = ...) -> None: ...

class GetLinkState_Request(Message):
    link_name: str
    reference_frame: str
    def __init__(self, *, link_name: str = ..., reference_frame: str = ...) -> None: ...

class GetLinkState_Response(Message):
    link_state: _gazebo_msgs_msg.LinkState
    success: bool
    status_message: str
    def __init__(self, *, link_state: _gazebo_msgs_msg.LinkState = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetModelList_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetModelList_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetModelList_Request]) -> None: ...
    @property
    def response(self) -> list[GetModelList_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetModelList_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetModelList_Request] = ..., response: Iterable[GetModelList_Response] = ...) -> None: ...

class GetModelList_Request(Message):
    def __init__(self) -> None: ...

class GetModelList_Response(Message):
    header: _std_msgs_msg.Header
    @property
    def model_names(self) -> list[str]: ...
    @model_names.setter
    def model_names(self, value: Iterable[str]) -> None: ...
    success: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., model_names: Iterable[str] = ..., success: bool = ...) -> None: ...

class GetModelProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetModelProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetModelProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetModelProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetModelProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetModelProperties_Request] = ..., response: Iterable[GetModelProperties_Response] = ...) -> None: ...

class GetModelProperties_Request(Message):
    model_name: str
    def __init__(self, *, model_name: str = ...) -> None: ...

class GetModelProperties_Response(Message):
    parent_model_name: str
    canonical_body_name: str
    @property
    def body_names(self) -> list[str]: ...
    @body_names.setter
    def body_names(self, value: Iterable[str]) -> None: ...
    @property
    def geom_names(self) -> list[str]: ...
    @geom_names.setter
    def geom_names(self, value: Iterable[str]) -> None: ...
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    @property
    def child_model_names(self) -> list[str]: ...
    @child_model_names.setter
    def child_model_names(self, value: Iterable[str]) -> None: ...
    is_static: bool
    success: bool
    status_message: str
    def __init__(self, *, parent_model_name: str = ..., canonical_body_name: str = ..., body_names: Iterable[str] = ..., geom_names: Iterable[str] = ..., joint_names: Iterable[str] = ..., child_model_names: Iterable[str] = ..., is_static: bool = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetModelState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetModelState_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetModelState_Request]) -> None: ...
    @property
    def response(self) -> list[GetModelState_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetModelState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetModelState_Request] = ..., response: Iterable[GetModelState_Response] = ...) -> None: ...

class GetModelState_Request(Message):
    model_name: str
    relative_entity_name: str
    def __init__(self, *, model_name: str = ..., relative_entity_name: str = ...) -> None: ...

class GetModelState_Response(Message):
    header: _std_msgs_msg.Header
    pose: _geometry_msgs_msg.Pose
    twist: _geometry_msgs_msg.Twist
    success: bool
    status_message: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: _geometry_msgs_msg.Pose = ..., twist: _geometry_msgs_msg.Twist = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetPhysicsProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetPhysicsProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetPhysicsProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetPhysicsProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetPhysicsProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetPhysicsProperties_Request] = ..., response: Iterable[GetPhysicsProperties_Response] = ...) -> None: ...

class GetPhysicsProperties_Request(Message):
    def __init__(self) -> None: ...

class GetPhysicsProperties_Response(Message):
    time_step: float
    pause: bool
    max_update_rate: float
    gravity: _geometry_msgs_msg.Vector3
    ode_config: _gazebo_msgs_msg.ODEPhysics
    success: bool
    status_message: str
    def __init__(self, *, time_step: float = ..., pause: bool = ..., max_update_rate: float = ..., gravity: _geometry_msgs_msg.Vector3 = ..., ode_config: _gazebo_msgs_msg.ODEPhysics = ..., success: bool = ..., status_message: str = ...) -> None: ...

class GetWorldProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[GetWorldProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[GetWorldProperties_Request]) -> None: ...
    @property
    def response(self) -> list[GetWorldProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[GetWorldProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[GetWorldProperties_Request] = ..., response: Iterable[GetWorldProperties_Response] = ...) -> None: ...

class GetWorldProperties_Request(Message):
    def __init__(self) -> None: ...

class GetWorldProperties_Response(Message):
    sim_time: float
    @property
    def model_names(self) -> list[str]: ...
    @model_names.setter
    def model_names(self, value: Iterable[str]) -> None: ...
    rendering_enabled: bool
    success: bool
    status_message: str
    def __init__(self, *, sim_time: float = ..., model_names: Iterable[str] = ..., rendering_enabled: bool = ..., success: bool = ..., status_message: str = ...) -> None: ...

class JointRequest_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[JointRequest_Request]: ...
    @request.setter
    def request(self, value: Iterable[JointRequest_Request]) -> None: ...
    @property
    def response(self) -> list[JointRequest_Response]: ...
    @response.setter
    def response(self, value: Iterable[JointRequest_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[JointRequest_Request] = ..., response: Iterable[JointRequest_Response] = ...) -> None: ...

class JointRequest_Request(Message):
    joint_name: str
    def __init__(self, *, joint_name: str = ...) -> None: ...

class JointRequest_Response(Message):
    def __init__(self) -> None: ...

class LinkRequest_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LinkRequest_Request]: ...
    @request.setter
    def request(self, value: Iterable[LinkRequest_Request]) -> None: ...
    @property
    def response(self) -> list[LinkRequest_Response]: ...
    @response.setter
    def response(self, value: Iterable[LinkRequest_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LinkRequest_Request] = ..., response: Iterable[LinkRequest_Response] = ...) -> None: ...

class LinkRequest_Request(Message):
    link_name: str
    def __init__(self, *, link_name: str = ...) -> None: ...

class LinkRequest_Response(Message):
    def __init__(self) -> None: ...

class SetEntityState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetEntityState_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetEntityState_Request]) -> None: ...
    @property
    def response(self) -> list[SetEntityState_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetEntityState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetEntityState_Request] = ..., response: Iterable[SetEntityState_Response] = ...) -> None: ...

class SetEntityState_Request(Message):
    state: _gazebo_msgs_msg.EntityState
    def __init__(self, *, state: _gazebo_msgs_msg.EntityState = ...) -> None: ...

class SetEntityState_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetJointProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetJointProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetJointProperties_Request]) -> None: ...
    @property
    def response(self) -> list[SetJointProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetJointProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetJointProperties_Request] = ..., response: Iterable[SetJointProperties_Response] = ...) -> None: ...

class SetJointProperties_Request(Message):
    joint_name: str
    ode_joint_config: _gazebo_msgs_msg.ODEJointProperties
    def __init__(self, *, joint_name: str = ..., ode_joint_config: _gazebo_msgs_msg.ODEJointProperties = ...) -> None: ...

class SetJointProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetJointTrajectory_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetJointTrajectory_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetJointTrajectory_Request]) -> None: ...
    @property
    def response(self) -> list[SetJointTrajectory_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetJointTrajectory_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetJointTrajectory_Request] = ..., response: Iterable[SetJointTrajectory_Response] = ...) -> None: ...

class SetJointTrajectory_Request(Message):
    model_name: str
    joint_trajectory: _trajectory_msgs_msg.JointTrajectory
    model_pose: _geometry_msgs_msg.Pose
    set_model_pose: bool
    disable_physics_updates: bool
    def __init__(self, *, model_name: str = ..., joint_trajectory: _trajectory_msgs_msg.JointTrajectory = ..., model_pose: _geometry_msgs_msg.Pose = ..., set_model_pose: bool = ..., disable_physics_updates: bool = ...) -> None: ...

class SetJointTrajectory_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLightProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetLightProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetLightProperties_Request]) -> None: ...
    @property
    def response(self) -> list[SetLightProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetLightProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetLightProperties_Request] = ..., response: Iterable[SetLightProperties_Response] = ...) -> None: ...

class SetLightProperties_Request(Message):
    light_name: str
    diffuse: _std_msgs_msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    def __init__(self, *, light_name: str = ..., diffuse: _std_msgs_msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ...) -> None: ...

class SetLightProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLinkProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetLinkProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetLinkProperties_Request]) -> None: ...
    @property
    def response(self) -> list[SetLinkProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetLinkProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetLinkProperties_Request] = ..., response: Iterable[SetLinkProperties_Response] = ...) -> None: ...

class SetLinkProperties_Request(Message):
    link_name: str
    com: _geometry_msgs_msg.Pose
    gravity_mode: bool
    mass: float
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    def __init__(self, *, link_name: str = ..., com: _geometry_msgs_msg.Pose = ..., gravity_mode: bool = ..., mass: float = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ...) -> None: ...

class SetLinkProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetLinkState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetLinkState_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetLinkState_Request]) -> None: ...
    @property
    def response(self) -> list[SetLinkState_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetLinkState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetLinkState_Request] = ..., response: Iterable[SetLinkState_Response] = ...) -> None: ...

class SetLinkState_Request(Message):
    link_state: _gazebo_msgs_msg.LinkState
    def __init__(self, *, link_state: _gazebo_msgs_msg.LinkState = ...) -> None: ...

class SetLinkState_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetModelConfiguration_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetModelConfiguration_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetModelConfiguration_Request]) -> None: ...
    @property
    def response(self) -> list[SetModelConfiguration_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetModelConfiguration_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetModelConfiguration_Request] = ..., response: Iterable[SetModelConfiguration_Response] = ...) -> None: ...

class SetModelConfiguration_Request(Message):
    model_name: str
    urdf_param_name: str
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    @property
    def joint_positions(self) -> npt.NDArray[np.float64]: ...
    @joint_positions.setter
    def joint_positions(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, model_name: str = ..., urdf_param_name: str = ..., joint_names: Iterable[str] = ..., joint_positions: npt.ArrayLike = ...) -> None: ...

class SetModelConfiguration_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetModelState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetModelState_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetModelState_Request]) -> None: ...
    @property
    def response(self) -> list[SetModelState_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetModelState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetModelState_Request] = ..., response: Iterable[SetModelState_Response] = ...) -> None: ...

class SetModelState_Request(Message):
    model_state: _gazebo_msgs_msg.ModelState
    def __init__(self, *, model_state: _gazebo_msgs_msg.ModelState = ...) -> None: ...

class SetModelState_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SetPhysicsProperties_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetPhysicsProperties_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetPhysicsProperties_Request]) -> None: ...
    @property
    def response(self) -> list[SetPhysicsProperties_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetPhysicsProperties_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetPhysicsProperties_Request] = ..., response: Iterable[SetPhysicsProperties_Response] = ...) -> None: ...

class SetPhysicsProperties_Request(Message):
    time_step: float
    max_update_rate: float
    gravity: _geometry_msgs_msg.Vector3
    ode_config: _gazebo_msgs_msg.ODEPhysics
    def __init__(self, *, time_step: float = ..., max_update_rate: float = ..., gravity: _geometry_msgs_msg.Vector3 = ..., ode_config: _gazebo_msgs_msg.ODEPhysics = ...) -> None: ...

class SetPhysicsProperties_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SpawnEntity_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SpawnEntity_Request]: ...
    @request.setter
    def request(self, value: Iterable[SpawnEntity_Request]) -> None: ...
    @property
    def response(self) -> list[SpawnEntity_Response]: ...
    @response.setter
    def response(self, value: Iterable[SpawnEntity_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SpawnEntity_Request] = ..., response: Iterable[SpawnEntity_Response] = ...) -> None: ...

class SpawnEntity_Request(Message):
    name: str
    xml: str
    robot_namespace: str
    initial_pose: _geometry_msgs_msg.Pose
    reference_frame: str
    def __init__(self, *, name: str = ..., xml: str = ..., robot_namespace: str = ..., initial_pose: _geometry_msgs_msg.Pose = ..., reference_frame: str = ...) -> None: ...

class SpawnEntity_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class SpawnModel_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SpawnModel_Request]: ...
    @request.setter
    def request(self, value: Iterable[SpawnModel_Request]) -> None: ...
    @property
    def response(self) -> list[SpawnModel_Response]: ...
    @response.setter
    def response(self, value: Iterable[SpawnModel_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SpawnModel_Request] = ..., response: Iterable[SpawnModel_Response] = ...) -> None: ...

class SpawnModel_Request(Message):
    model_name: str
    model_xml: str
    model_namespace: str
    initial_pose: _geometry_msgs_msg.Pose
    reference_frame: str
    def __init__(self, *, model_name: str = ..., model_xml: str = ..., model_namespace: str = ..., initial_pose: _geometry_msgs_msg.Pose = ..., reference_frame: str = ...) -> None: ...

class SpawnModel_Response(Message):
    success: bool
    status_message: str
    def __init__(self, *, success: bool = ..., status_message: str = ...) -> None: ...

class ApplyBodyWrench(Service):
    Request = ApplyBodyWrench_Request
    Response = ApplyBodyWrench_Response
    Event = ApplyBodyWrench_Event

class ApplyJointEffort(Service):
    Request = ApplyJointEffort_Request
    Response = ApplyJointEffort_Response
    Event = ApplyJointEffort_Event

class ApplyLinkWrench(Service):
    Request = ApplyLinkWrench_Request
    Response = ApplyLinkWrench_Response
    Event = ApplyLinkWrench_Event

class BodyRequest(Service):
    Request = BodyRequest_Request
    Response = BodyRequest_Response
    Event = BodyRequest_Event

class DeleteEntity(Service):
    Request = DeleteEntity_Request
    Response = DeleteEntity_Response
    Event = DeleteEntity_Event

class DeleteLight(Service):
    Request = DeleteLight_Request
    Response = DeleteLight_Response
    Event = DeleteLight_Event

class DeleteModel(Service):
    Request = DeleteModel_Request
    Response = DeleteModel_Response
    Event = DeleteModel_Event

class GetEntityState(Service):
    Request = GetEntityState_Request
    Response = GetEntityState_Response
    Event = GetEntityState_Event

class GetJointProperties(Service):
    Request = GetJointProperties_Request
    Response = GetJointProperties_Response
    Event = GetJointProperties_Event

class GetLightProperties(Service):
    Request = GetLightProperties_Request
    Response = GetLightProperties_Response
    Event = GetLightProperties_Event

class GetLinkProperties(Service):
    Request = GetLinkProperties_Request
    Response = GetLinkProperties_Response
    Event = GetLinkProperties_Event

class GetLinkState(Service):
    Request = GetLinkState_Request
    Response = GetLinkState_Response
    Event = GetLinkState_Event

class GetModelList(Service):
    Request = GetModelList_Request
    Response = GetModelList_Response
    Event = GetModelList_Event

class GetModelProperties(Service):
    Request = GetModelProperties_Request
    Response = GetModelProperties_Response
    Event = GetModelProperties_Event

class GetModelState(Service):
    Request = GetModelState_Request
    Response = GetModelState_Response
    Event = GetModelState_Event

class GetPhysicsProperties(Service):
    Request = GetPhysicsProperties_Request
    Response = GetPhysicsProperties_Response
    Event = GetPhysicsProperties_Event

class GetWorldProperties(Service):
    Request = GetWorldProperties_Request
    Response = GetWorldProperties_Response
    Event = GetWorldProperties_Event

class JointRequest(Service):
    Request = JointRequest_Request
    Response = JointRequest_Response
    Event = JointRequest_Event

class LinkRequest(Service):
    Request = LinkRequest_Request
    Response = LinkRequest_Response
    Event = LinkRequest_Event

class SetEntityState(Service):
    Request = SetEntityState_Request
    Response = SetEntityState_Response
    Event = SetEntityState_Event

class SetJointProperties(Service):
    Request = SetJointProperties_Request
    Response = SetJointProperties_Response
    Event = SetJointProperties_Event

class SetJointTrajectory(Service):
    Request = SetJointTrajectory_Request
    Response = SetJointTrajectory_Response
    Event = SetJointTrajectory_Event

class SetLightProperties(Service):
    Request = SetLightProperties_Request
    Response = SetLightProperties_Response
    Event = SetLightProperties_Event

class SetLinkProperties(Service):
    Request = SetLinkProperties_Request
    Response = SetLinkProperties_Response
    Event = SetLinkProperties_Event

class SetLinkState(Service):
    Request = SetLinkState_Request
    Response = SetLinkState_Response
    Event = SetLinkState_Event

class SetModelConfiguration(Service):
    Request = SetModelConfiguration_Request
    Response = SetModelConfiguration_Response
    Event = SetModelConfiguration_Event

class SetModelState(Service):
    Request = SetModelState_Request
    Response = SetModelState_Response
    Event = SetModelState_Event

class SetPhysicsProperties(Service):
    Request = SetPhysicsProperties_Request
    Response = SetPhysicsProperties_Response
    Event = SetPhysicsProperties_Event

class SpawnEntity(Service):
    Request = SpawnEntity_Request
    Response = SpawnEntity_Response
    Event = SpawnEntity_Event

class SpawnModel(Service):
    Request = SpawnModel_Request
    Response = SpawnModel_Response
    Event = SpawnModel_Event
