from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "FloatingPointRange",
    "IntegerRange",
    "ListParametersResult",
    "Log",
    "LoggerLevel",
    "Parameter",
    "ParameterDescriptor",
    "ParameterEvent",
    "ParameterEventDescriptors",
    "ParameterType",
    "ParameterValue",
    "SetLoggerLevelsResult",
    "SetParametersResult",
]

class FloatingPointRange(Message):
    from_value: float
    to_value: float
    step: float
    def __init__(self, *, from_value: float = ..., to_value: float = ..., step: float = ...) -> None: ...

class IntegerRange(Message):
    from_value: int
    to_value: int
    step: int
    def __init__(self, *, from_value: int = ..., to_value: int = ..., step: int = ...) -> None: ...

class ListParametersResult(Message):
    @property
    def names(self) -> list[str]: ...
    @names.setter
    def names(self, value: Iterable[str]) -> None: ...
    @property
    def prefixes(self) -> list[str]: ...
    @prefixes.setter
    def prefixes(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, names: Iterable[str] = ..., prefixes: Iterable[str] = ...) -> None: ...

class Log(Message):
    DEBUG: ClassVar[int]
    INFO: ClassVar[int]
    WARN: ClassVar[int]
    ERROR: ClassVar[int]
    FATAL: ClassVar[int]
    stamp: _builtin_interfaces_msg.Time
    level: int
    name: str
    msg: str
    file: str
    function: str
    line: int
    def __init__(self, *, stamp: _builtin_interfaces_msg.Time = ..., level: int = ..., name: str = ..., msg: str = ..., file: str = ..., function: str = ..., line: int = ...) -> None: ...

class LoggerLevel(Message):
    LOG_LEVEL_UNKNOWN: ClassVar[int]
    LOG_LEVEL_DEBUG: ClassVar[int]
    LOG_LEVEL_INFO: ClassVar[int]
    LOG_LEVEL_WARN: ClassVar[int]
    LOG_LEVEL_ERROR: ClassVar[int]
    LOG_LEVEL_FATAL: ClassVar[int]
    name: str
    level: int
    def __init__(self, *, name: str = ..., level: int = ...) -> None: ...

class Parameter(Message):
    name: str
    value: ParameterValue
    def __init__(self, *, name: str = ..., value: ParameterValue = ...) -> None: ...

class ParameterDescriptor(Message):
    name: str
    type: int
    description: str
    additional_constraints: str
    read_only: bool
    dynamic_typing: bool
    @property
    def floating_point_range(self) -> list[FloatingPointRange]: ...
    @floating_point_range.setter
    def floating_point_range(self, value: Iterable[FloatingPointRange]) -> None: ...
    @property
    def integer_range(self) -> list[IntegerRange]: ...
    @integer_range.setter
    def integer_range(self, value: Iterable[IntegerRange]) -> None: ...
    def __init__(self, *, name: str = ..., type: int = ..., description: str = ..., additional_constraints: str = ..., read_only: bool = ..., dynamic_typing: bool = ..., floating_point_range: Iterable[FloatingPointRange] = ..., integer_range: Iterable[IntegerRange] = ...) -> None: ...

class ParameterEvent(Message):
    stamp: _builtin_interfaces_msg.Time
    node: str
    @property
    def new_parameters(self) -> list[Parameter]: ...
    @new_parameters.setter
    def new_parameters(self, value: Iterable[Parameter]) -> None: ...
    @property
    def changed_parameters(self) -> list[Parameter]: ...
    @changed_parameters.setter
    def changed_parameters(self, value: Iterable[Parameter]) -> None: ...
    @property
    def deleted_parameters(self) -> list[Parameter]: ...
    @deleted_parameters.setter
    def deleted_parameters(self, value: Iterable[Parameter]) -> None: ...
    def __init__(self, *, stamp: _builtin_interfaces_msg.Time = ..., node: str = ..., new_parameters: Iterable[Parameter] = ..., changed_parameters: Iterable[Parameter] = ..., deleted_parameters: Iterable[Parameter] = ...) -> None: ...

class ParameterEventDescriptors(Message):
    @property
    def new_parameters(self) -> list[ParameterDescriptor]: ...
    @new_parameters.setter
    def new_parameters(self, value: Iterable[ParameterDescriptor]) -> None: ...
    @property
    def changed_parameters(self) -> list[ParameterDescriptor]: ...
    @changed_parameters.setter
    def changed_parameters(self, value: Iterable[ParameterDescriptor]) -> None: ...
    @property
    def deleted_parameters(self) -> list[ParameterDescriptor]: ...
    @deleted_parameters.setter
    def deleted_parameters(self, value: Iterable[ParameterDescriptor]) -> None: ...
    def __init__(self, *, new_parameters: Iterable[ParameterDescriptor] = ..., changed_parameters: Iterable[ParameterDescriptor] = ..., deleted_parameters: Iterable[ParameterDescriptor] = ...) -> None: ...

class ParameterType(Message):
    PARAMETER_NOT_SET: ClassVar[int]
    PARAMETER_BOOL: ClassVar[int]
    PARAMETER_INTEGER: ClassVar[int]
    PARAMETER_DOUBLE: ClassVar[int]
    PARAMETER_STRING: ClassVar[int]
    PARAMETER_BYTE_ARRAY: ClassVar[int]
    PARAMETER_BOOL_ARRAY: ClassVar[int]
    PARAMETER_INTEGER_ARRAY: ClassVar[int]
    PARAMETER_DOUBLE_ARRAY: ClassVar[int]
    PARAMETER_STRING_ARRAY: ClassVar[int]
    def __init__(self) -> None: ...

class ParameterValue(Message):
    type: int
    bool_value: bool
    integer_value: int
    double_value: float
    string_value: str
    @property
    def byte_array_value(self) -> npt.NDArray[np.uint8]: ...
    @byte_array_value.setter
    def byte_array_value(self, value: npt.ArrayLike) -> None: ...
    @property
    def bool_array_value(self) -> npt.NDArray[np.bool_]: ...
    @bool_array_value.setter
    def bool_array_value(self, value: npt.ArrayLike) -> None: ...
    @property
    def integer_array_value(self) -> npt.NDArray[np.int64]: ...
    @integer_array_value.setter
    def integer_array_value(self, value: npt.ArrayLike) -> None: ...
    @property
    def double_array_value(self) -> npt.NDArray[np.float64]: ...
    @double_array_value.setter
    def double_array_value(self, value: npt.ArrayLike) -> None: ...
    @property
    def string_array_value(self) -> list[str]: ...
    @string_array_value.setter
    def string_array_value(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, type: int = ..., bool_value: bool = ..., integer_value: int = ..., double_value: float = ..., string_value: str = ..., byte_array_value: npt.ArrayLike = ..., bool_array_value: npt.ArrayLike = ..., integer_array_value: npt.ArrayLike = ..., double_array_value: npt.ArrayLike = ..., string_array_value: Iterable[str] = ...) -> None: ...

class SetLoggerLevelsResult(Message):
    successful: bool
    reason: str
    def __init__(self, *, successful: bool = ..., reason: str = ...) -> None: ...

class SetParametersResult(Message):
    successful: bool
    reason: str
    def __init__(self, *, successful: bool = ..., reason: str = ...) -> None: ...
