from collections.abc import Iterable

import periplus.msgs.diagnostic_msgs.msg as _diagnostic_msgs_msg
import periplus.msgs.service_msgs.msg as _service_msgs_msg
from periplus.msgs import Message, Service

__all__ = [
    "AddDiagnostics",
    "AddDiagnostics_Event",
    "AddDiagnostics_Request",
    "AddDiagnostics_Response",
    "SelfTest",
    "SelfTest_Event",
    "SelfTest_Request",
    "SelfTest_Response",
]

class AddDiagnostics_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[AddDiagnostics_Request]: ...
    @request.setter
    def request(self, value: Iterable[AddDiagnostics_Request]) -> None: ...
    @property
    def response(self) -> list[AddDiagnostics_Response]: ...
    @response.setter
    def response(self, value: Iterable[AddDiagnostics_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[AddDiagnostics_Request] = ..., response: Iterable[AddDiagnostics_Response] = ...) -> None: ...

class AddDiagnostics_Request(Message):
    load_namespace: str
    def __init__(self, *, load_namespace: str = ...) -> None: ...

class AddDiagnostics_Response(Message):
    success: bool
    message: str
    def __init__(self, *, success: bool = ..., message: str = ...) -> None: ...

class SelfTest_Event(Message):
    info: _service_msgs_msg.ServiceEventInfo
    @property
    def request(self) -> list[SelfTest_Request]: ...
    @request.setter
    def request(self, value: Iterable[SelfTest_Request]) -> None: ...
    @property
    def response(self) -> list[SelfTest_Response]: ...
    @response.setter
    def response(self, value: Iterable[SelfTest_Response]) -> None: ...
    def __init__(self, *, info: _service_msgs_msg.ServiceEventInfo = ..., request: Iterable[SelfTest_Request] = ..., response: Iterable[SelfTest_Response] = ...) -> None: ...

class SelfTest_Request(Message):
    def __init__(self) -> None: ...

class SelfTest_Response(Message):
    id: str
    @property
    def passed(self) -> bytes: ...
    @passed.setter
    def passed(self, value: bytes | int) -> None: ...
    @property
    def status(self) -> list[_diagnostic_msgs_msg.DiagnosticStatus]: ...
    @status.setter
    def status(self, value: Iterable[_diagnostic_msgs_msg.DiagnosticStatus]) -> None: ...
    def __init__(self, *, id: str = ..., passed: bytes | int = ..., status: Iterable[_diagnostic_msgs_msg.DiagnosticStatus] = ...) -> None: ...

class AddDiagnostics(Service):
    Request = AddDiagnostics_Request
    Response = AddDiagnostics_Response
    Event = AddDiagnostics_Event

class SelfTest(Service):
    Request = SelfTest_Request
    Response = SelfTest_Response
    Event = SelfTest_Event
