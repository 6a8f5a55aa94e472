from collections.abc import Iterable
from typing import ClassVar

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.controller_manager_msgs.msg as _controller_manager_msgs_msg
import periplus.msgs.lifecycle_msgs.msg as _lifecycle_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "CleanupController",
    "CleanupController_Event",
    "CleanupController_Request",
    "CleanupController_Response",
    "ConfigureController",
    "ConfigureController_Event",
    "ConfigureController_Request",
    "ConfigureController_Response",
    "ListControllerTypes",
    "ListControllerTypes_Event",
    "ListControllerTypes_Request",
    "ListControllerTypes_Response",
    "ListControllers",
    "ListControllers_Event",
    "ListControllers_Request",
    "ListControllers_Response",
    "ListHardwareComponents",
    "ListHardwareComponents_Event",
    "ListHardwareComponents_Request",
    "ListHardwareComponents_Response",
    "ListHardwareInterfaces",
    "ListHardwareInterfaces_Event",
    "ListHardwareInterfaces_Request",
    "ListHardwareInterfaces_Response",
    "LoadController",
    "LoadController_Event",
    "LoadController_Request",
    "LoadController_Response",
    "ReloadControllerLibraries",
    "ReloadControllerLibraries_Event",
    "ReloadControllerLibraries_Request",
    "ReloadControllerLibraries_Response",
    "SetHardwareComponentState",
    "SetHardwareComponentState_Event",
    "SetHardwareComponentState_Request",
    "SetHardwareComponentState_Response",
    "SwitchController",
    "SwitchController_Event",
    "SwitchController_Request",
    "SwitchController_Response",
    "UnloadController",
    "UnloadController_Event",
    "UnloadController_Request",
    "UnloadController_Response",
]

class CleanupController_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[CleanupController_Request]: ...
    @request.setter
    def request(self, value: Iterable[CleanupController_Request]) -> None: ...
    @property
    def response(self) -> list[CleanupController_Response]: ...
    @response.setter
    def response(self, value: Iterable[CleanupController_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[CleanupController_Request] = ..., response: Iterable[CleanupController_Response] = ...) -> None: ...

class CleanupController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class CleanupController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class ConfigureController_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ConfigureController_Request]: ...
    @request.setter
    def request(self, value: Iterable[ConfigureController_Request]) -> None: ...
    @property
    def response(self) -> list[ConfigureController_Response]: ...
    @response.setter
    def response(self, value: Iterable[ConfigureController_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ConfigureController_Request] = ..., response: Iterable[ConfigureController_Response] = ...) -> None: ...

class ConfigureController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class ConfigureController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class ListControllerTypes_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ListControllerTypes_Request]: ...
    @request.setter
    def request(self, value: Iterable[ListControllerTypes_Request]) -> None: ...
    @property
    def response(self) -> list[ListControllerTypes_Response]: ...
    @response.setter
    def response(self, value: Iterable[ListControllerTypes_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ListControllerTypes_Request] = ..., response: Iterable[ListControllerTypes_Response] = ...) -> None: ...

class ListControllerTypes_Request(Message):
    def __init__(self) -> None: ...

class ListControllerTypes_Response(Message):
    @property
    def types(self) -> list[str]: ...
    @types.setter
    def types(self, value: Iterable[str]) -> None: ...
    @property
    def base_classes(self) -> list[str]: ...
    @base_classes.setter
    def base_classes(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, types: Iterable[str] = ..., base_classes: Iterable[str] = ...) -> None: ...

class ListControllers_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ListControllers_Request]: ...
    @request.setter
    def request(self, value: Iterable[ListControllers_Request]) -> None: ...
    @property
    def response(self) -> list[ListControllers_Response]: ...
    @response.setter
    def response(self, value: Iterable[ListControllers_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ListControllers_Request] = ..., response: Iterable[ListControllers_Response] = ...) -> None: ...

class ListControllers_Request(Message):
    def __init__(self) -> None: ...

class ListControllers_Response(Message):
    @property
    def controller(self) -> list[_controller_manager_msgs_msg.ControllerState]: ...
    @controller.setter
    def controller(self, value: Iterable[_controller_manager_msgs_msg.ControllerState]) -> None: ...
    def __init__(self, *, controller: Iterable[_controller_manager_msgs_msg.ControllerState] = ...) -> None: ...

class ListHardwareComponents_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ListHardwareComponents_Request]: ...
    @request.setter
    def request(self, value: Iterable[ListHardwareComponents_Request]) -> None: ...
    @property
    def response(self) -> list[ListHardwareComponents_Response]: ...
    @response.setter
    def response(self, value: Iterable[ListHardwareComponents_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ListHardwareComponents_Request] = ..., response: Iterable[ListHardwareComponents_Response] = ...) -> None: ...

class ListHardwareComponents_Request(Message):
    def __init__(self) -> None: ...

class ListHardwareComponents_Response(Message):
    @property
    def component(self) -> list[_controller_manager_msgs_msg.HardwareComponentState]: ...
    @component.setter
    def component(self, value: Iterable[_controller_manager_msgs_msg.HardwareComponentState]) -> None: ...
    def __init__(self, *, component: Iterable[_controller_manager_msgs_msg.HardwareComponentState] = ...) -> None: ...

class ListHardwareInterfaces_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ListHardwareInterfaces_Request]: ...
    @request.setter
    def request(self, value: Iterable[ListHardwareInterfaces_Request]) -> None: ...
    @property
    def response(self) -> list[ListHardwareInterfaces_Response]: ...
    @response.setter
    def response(self, value: Iterable[ListHardwareInterfaces_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ListHardwareInterfaces_Request] = ..., response: Iterable[ListHardwareInterfaces_Response] = ...) -> None: ...

class ListHardwareInterfaces_Request(Message):
    def __init__(self) -> None: ...

class ListHardwareInterfaces_Response(Message):
    @property
    def command_interfaces(self) -> list[_controller_manager_msgs_msg.HardwareInterface]: ...
    @command_interfaces.setter
    def command_interfaces(self, value: Iterable[_controller_manager_msgs_msg.HardwareInterface]) -> None: ...
    @property
    def state_interfaces(self) -> list[_controller_manager_msgs_msg.HardwareInterface]: ...
    @state_interfaces.setter
    def state_interfaces(self, value: Iterable[_controller_manager_msgs_msg.HardwareInterface]) -> None: ...
    def __init__(self, *, command_interfaces: Iterable[_controller_manager_msgs_msg.HardwareInterface] = ..., state_interfaces: Iterable[_controller_manager_msgs_msg.HardwareInterface] = ...) -> None: ...

class LoadController_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[LoadController_Request]: ...
    @request.setter
    def request(self, value: Iterable[LoadController_Request]) -> None: ...
    @property
    def response(self) -> list[LoadController_Response]: ...
    @response.setter
    def response(self, value: Iterable[LoadController_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[LoadController_Request] = ..., response: Iterable[LoadController_Response] = ...) -> None: ...

class LoadController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class LoadController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class ReloadControllerLibraries_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[ReloadControllerLibraries_Request]: ...
    @request.setter
    def request(self, value: Iterable[ReloadControllerLibraries_Request]) -> None: ...
    @property
    def response(self) -> list[ReloadControllerLibraries_Response]: ...
    @response.setter
    def response(self, value: Iterable[ReloadControllerLibraries_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[ReloadControllerLibraries_Request] = ..., response: Iterable[ReloadControllerLibraries_Response] = ...) -> None: ...

class ReloadControllerLibraries_Request(Message):
    force_kill: bool
    def __init__(self, *, force_kill: bool = ...) -> None: ...

class ReloadControllerLibraries_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class SetHardwareComponentState_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SetHardwareComponentState_Request]: ...
    @request.setter
    def request(self, value: Iterable[SetHardwareComponentState_Request]) -> None: ...
    @property
    def response(self) -> list[SetHardwareComponentState_Response]: ...
    @response.setter
    def response(self, value: Iterable[SetHardwareComponentState_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SetHardwareComponentState_Request] = ..., response: Iterable[SetHardwareComponentState_Response] = ...) -> None: ...

class SetHardwareComponentState_Request(Message):
    name: str
    target_state: _lifecycle_msgs_msg.State
    def __init__(self, *, name: str = ..., target_state: _lifecycle_msgs_msg.State = ...) -> None: ...

class SetHardwareComponentState_Response(Message):
    ok: bool
    state: _lifecycle_msgs_msg.State
    def __init__(self, *, ok: bool = ..., state: _lifecycle_msgs_msg.State = ...) -> None: ...

class SwitchController_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SwitchController_Request]: ...
    @request.setter
    def request(self, value: Iterable[SwitchController_Request]) -> None: ...
    @property
    def response(self) -> list[SwitchController_Response]: ...
    @response.setter
    def response(self, value: Iterable[SwitchController_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SwitchController_Request] = ..., response: Iterable[SwitchController_Response] = ...) -> None: ...

class SwitchController_Request(Message):
    BEST_EFFORT: ClassVar[int]
    STRICT: ClassVar[int]
    AUTO: ClassVar[int]
    FORCE_AUTO: ClassVar[int]
    @property
    def activate_controllers(self) -> list[str]: ...
    @activate_controllers.setter
    def activate_controllers(self, value: Iterable[str]) -> None: ...
    @property
    def deactivate_controllers(self) -> list[str]: ...
    @deactivate_controllers.setter
    def deactivate_controllers(self, value: Iterable[str]) -> None: ...
    strictness: int
    activate_asap: bool
    timeout: _builtin_interfaces_msg.Duration
    def __init__(self, *, activate_controllers: Iterable[str] = ..., deactivate_controllers: Iterable[str] = ..., strictness: int = ..., activate_asap: bool = ..., timeout: _builtin_interfaces_msg.Duration = ...) -> None: ...

class SwitchController_Response(Message):
    ok: bool
    message: str
    def __init__(self, *, ok: bool = ..., message: str = ...) -> None: ...

class UnloadController_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[UnloadController_Request]: ...
    @request.setter
    def request(self, value: Iterable[UnloadController_Request]) -> None: ...
    @property
    def response(self) -> list[UnloadController_Response]: ...
    @response.setter
    def response(self, value: Iterable[UnloadController_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[UnloadController_Request] = ..., response: Iterable[UnloadController_Response] = ...) -> None: ...

class UnloadController_Request(Message):
    name: str
    def __init__(self, *, name: str = ...) -> None: ...

class UnloadController_Response(Message):
    ok: bool
    def __init__(self, *, ok: bool = ...) -> None: ...

class CleanupController(Service):
    Request = CleanupController_Request
    Response = CleanupController_Response
    Event = CleanupController_Event

class ConfigureController(Service):
    Request = ConfigureController_Request
    Response = ConfigureController_Response
    Event = ConfigureController_Event

class ListControllerTypes(Service):
    Request = ListControllerTypes_Request
    Response = ListControllerTypes_Response
    Event = ListControllerTypes_Event

class ListControllers(Service):
    Request = ListControllers_Request
    Response = ListControllers_Response
    Event = ListControllers_Event

class ListHardwareComponents(Service):
    Request = ListHardwareComponents_Request
    Response = ListHardwareComponents_Response
    Event = ListHardwareComponents_Event

class ListHardwareInterfaces(Service):
    Request = ListHardwareInterfaces_Request
    Response = ListHardwareInterfaces_Response
    Event = ListHardwareInterfaces_Event

class LoadController(Service):
    Request = LoadController_Request
    Response = LoadController_Response
    Event = LoadController_Event

class ReloadControllerLibraries(Service):
    Request = ReloadControllerLibraries_Request
    Response = ReloadControllerLibraries_Response
    Event = ReloadControllerLibraries_Event

class SetHardwareComponentState(Service):
    Request = SetHardwareComponentState_Request
    Response = SetHardwareComponentState_Response
    Event = SetHardwareComponentState_Event

class SwitchController(Service):
    Request = SwitchController_Request
    Response = SwitchController_Response
    Event = SwitchController_Event

class UnloadController(Service):
    Request = UnloadController_Request
    Response = UnloadController_Response
    Event = UnloadController_Event
