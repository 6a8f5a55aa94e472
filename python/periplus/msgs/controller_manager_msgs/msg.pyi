from collections.abc import Iterable

import periplus.msgs.lifecycle_msgs.msg as _lifecycle_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "ChainConnection",
    "ControllerManagerActivity",
    "ControllerState",
    "HardwareComponentState",
    "HardwareInterface",
    "NamedLifecycleState",
]

class ChainConnection(Message):
    name: str
    @property
    def reference_interfaces(self) -> list[str]: ...
    @reference_interfaces.setter
    def reference_interfaces(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, name: str = ..., reference_interfaces: Iterable[str] = ...) -> None: ...

class ControllerManagerActivity(Message):
    header: _std_msgs_msg.Header
    @property
    def controllers(self) -> list[NamedLifecycleState]: ...
    @controllers.setter
    def controllers(self, value: Iterable[NamedLifecycleState]) -> None: ...
    @property
    def hardware_components(self) -> list[NamedLifecycleState]: ...
    @hardware_components.setter
    def hardware_components(self, value: Iterable[NamedLifecycleState]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., controllers: Iterable[NamedLifecycleState] = ..., hardware_components: Iterable[NamedLifecycleState] = ...) -> None: ...

class ControllerState(Message):
    name: str
    state: str
    type: str
    is_async: bool
    update_rate: int
    @property
    def claimed_interfaces(self) -> list[str]: ...
    @claimed_interfaces.setter
    def claimed_interfaces(self, value: Iterable[str]) -> None: ...
    @property
    def required_command_interfaces(self) -> list[str]: ...
    @required_command_interfaces.setter
    def required_command_interfaces(self, value: Iterable[str]) -> None: ...
    @property
    def required_state_interfaces(self) -> list[str]: ...
    @required_state_interfaces.setter
    def required_state_interfaces(self, value: Iterable[str]) -> None: ...
    is_chainable: bool
    is_chained: bool
    @property
    def exported_state_interfaces(self) -> list[str]: ...
    @exported_state_interfaces.setter
    def exported_state_interfaces(self, value: Iterable[str]) -> None: ...
    @property
    def reference_interfaces(self) -> list[str]: ...
    @reference_interfaces.setter
    def reference_interfaces(self, value: Iterable[str]) -> None: ...
    @property
    def chain_connections(self) -> list[ChainConnection]: ...
    @chain_connections.setter
    def chain_connections(self, value: Iterable[ChainConnection]) -> None: ...
    def __init__(self, *, name: str = ..., state: str = ..., type: str = ..., is_async: bool = ..., update_rate: int = ..., claimed_interfaces: Iterable[str] = ..., required_command_interfaces: Iterable[str] = ..., required_state_interfaces: Iterable[str] = ..., is_chainable: bool = ..., is_chained: bool = ..., exported_state_interfaces: Iterable[str] = ..., reference_interfaces: Iterable[str] = ..., chain_connections: Iterable[ChainConnection] = ...) -> None: ...

class HardwareComponentState(Message):
    name: str
    type: str
    is_async: bool
    rw_rate: int
    class_type: str
    plugin_name: str
    state: _lifecycle_msgs_msg.State
    @property
    def command_interfaces(self) -> list[HardwareInterface]: ...
    @command_interfaces.setter
    def command_interfaces(self, value: Iterable[HardwareInterface]) -> None: ...
    @property
    def state_interfaces(self) -> list[HardwareInterface]: ...
    @state_interfaces.setter
    def state_interfaces(self, value: Iterable[HardwareInterface]) -> None: ...
    def __init__(self, *, name: str = ..., type: str = ..., is_async: bool = ..., rw_rate: int = ..., class_type: str = ..., plugin_name: str = ..., state: _lifecycle_msgs_msg.State = ..., command_interfaces: Iterable[HardwareInterface] = ..., state_interfaces: Iterable[HardwareInterface] = ...) -> None: ...

class HardwareInterface(Message):
    name: str
    data_type: str
    is_available: bool
    is_claimed: bool
    def __init__(self, *, name: str = ..., data_type: str = ..., is_available: bool = ..., is_claimed: bool = ...) -> None: ...

class NamedLifecycleState(Message):
    name: str
    state: _lifecycle_msgs_msg.State
    def __init__(self, *, name: str = ..., state: _lifecycle_msgs_msg.State = ...) -> None: ...
