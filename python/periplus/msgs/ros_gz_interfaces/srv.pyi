from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.ros_gz_interfaces.msg as _ros_gz_interfaces_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "AttachDetach",
    "AttachDetach_Event",
    "AttachDetach_Request",
    "AttachDetach_Response",
    "ControlWorld",
    "ControlWorld_Event",
    "ControlWorld_Request",
    "ControlWorld_Response",
    "DeleteEntity",
    "DeleteEntity_Event",
    "DeleteEntity_Request",
    "DeleteEntity_Response",
    "SetEntityPose",
    "SetEntityPose_Event",
    "SetEntityPose_Request",
    "SetEntityPose_Response",
    "SpawnEntity",
    "SpawnEntity_Event",
    "SpawnEntity_Request",
    "SpawnEntity_Response",
]

class AttachDetach_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AttachDetach_Request]: ...
    @request.setter
    def request(self, value: Iterable[AttachDetach_Request]) -> None: ...
    @property
    def response(self) -> list[AttachDetach_Response]: ...
    @response.setter
    def response(self, value: Iterable[AttachDetach_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AttachDetach_Request] = ..., response: Iterable[AttachDetach_Response] = ...) -> None: ...

class AttachDetach_Request(Message):
    COMMAND_UNSPECIFIED: ClassVar[int]
    ATTACH: ClassVar[int]
    DETACH: ClassVar[int]
    child_model_name: str
    child_link_name: str
    command: int
    def __init__(self, *, child_model_name: str = ..., child_link_name: str = ..., command: int = ...) -> None: ...

class AttachDetach_Response(Message):
    error_code: int
    message: str
    def __init__(self, *, error_code: int = ..., message: str = ...) -> None: ...

class ControlWorld_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ControlWorld_Request]: ...
    @request.setter
    def request(self, value: Iterable[ControlWorld_Request]) -> None: ...
    @property
    def response(self) -> list[ControlWorld_Response]: ...
    @response.setter
    def response(self, value: Iterable[ControlWorld_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ControlWorld_Request] = ..., response: Iterable[ControlWorld_Response] = ...) -> None: ...

class ControlWorld_Request(Message):
    world_control: _ros_gz_interfaces_msg.WorldControl
    def __init__(self, *, world_control: _ros_gz_interfaces_msg.WorldControl = ...) -> None: ...

class ControlWorld_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

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
    entity: _ros_gz_interfaces_msg.Entity
    def __init__(self, *, entity: _ros_gz_interfaces_msg.Entity = ...) -> None: ...

class DeleteEntity_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class SetEntityPose_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetEntityPose_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetEntityPose_Request]) -> None: ...
    @property
    def response(self) -> list[SetEntityPose_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetEntityPose_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetEntityPose_Request] = ..., response: Iterable[SetEntityPose_Response] = ...) -> None: ...

class SetEntityPose_Request(Message):
    entity: _ros_gz_interfaces_msg.Entity
    pose: _geometry_msgs_msg.Pose
    def __init__(self, *, entity: _ros_gz_interfaces_msg.Entity = ..., pose: _geometry_msgs_msg.Pose = ...) -> None: ...

class SetEntityPose_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

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
    entity_factory: _ros_gz_interfaces_msg.EntityFactory
    def __init__(self, *, entity_factory: _ros_gz_interfaces_msg.EntityFactory = ...) -> None: ...

class SpawnEntity_Response(Message):
    success: bool
    def __init__(self, *, success: bool = ...) -> None: ...

class AttachDetach(Service):
    Request = AttachDetach_Request
    Response = AttachDetach_Response
    Event = AttachDetach_Event

class ControlWorld(Service):
    Request = ControlWorld_Request
    Response = ControlWorld_Response
    Event = ControlWorld_Event

class DeleteEntity(Service):
    Request = DeleteEntity_Request
    Response = DeleteEntity_Response
    Event = DeleteEntity_Event

class SetEntityPose(Service):
    Request = SetEntityPose_Request
    Response = SetEntityPose_Response
    Event = SetEntityPose_Event

class SpawnEntity(Service):
    Request = SpawnEntity_Request
    Response = SpawnEntity_Response
    Event = SpawnEntity_Event
