from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
from periplus.msgs import Message

__all__ = [
    "Bool",
    "Byte",
    "ByteMultiArray",
    "Char",
    "ColorRGBA",
    "Empty",
    "Float32",
    "Float32MultiArray",
    "Float64",
    "Float64MultiArray",
    "Header",
    "Int16",
    "Int16MultiArray",
    "Int32",
    "Int32MultiArray",
    "Int64",
    "Int64MultiArray",
    "Int8",
    "Int8MultiArray",
    "MultiArrayDimension",
    "MultiArrayLayout",
    "String",
    "UInt16",
    "UInt16MultiArray",
    "UInt32",
    "UInt32MultiArray",
    "UInt64",
    "UInt64MultiArray",
    "UInt8",
    "UInt8MultiArray",
]

class Bool(Message):
    data: bool
    def __init__(self, *, data: bool = ...) -> None: ...

class Byte(Message):
    @property
    def data(self) -> bytes: ...
    @data.setter
    def data(self, value: bytes | int) -> None: ...
    def __init__(self, *, data: bytes | int = ...) -> None: ...

class ByteMultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Char(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class ColorRGBA(Message):
    r: float
    g: float
    b: float
    a: float
    def __init__(self, *, r: float = ..., g: float = ..., b: float = ..., a: float = ...) -> None: ...

class Empty(Message):
    def __init__(self) -> None: ...

class Float32(Message):
    data: float
    def __init__(self, *, data: float = ...) -> None: ...

class Float32MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.float32]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Float64(Message):
    data: float
    def __init__(self, *, data: float = ...) -> None: ...

class Float64MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.float64]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Header(Message):
    stamp: _builtin_interfaces_msg.Time
    frame_id: str
    def __init__(self, *, stamp: _builtin_interfaces_msg.Time = ..., frame_id: str = ...) -> None: ...

class Int16(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int16MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.int16]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Int32(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int32MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.int32]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Int64(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int64MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.int64]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class Int8(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class Int8MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.int8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class MultiArrayDimension(Message):
    label: str
    size: int
    stride: int
    def __init__(self, *, label: str = ..., size: int = ..., stride: int = ...) -> None: ...

class MultiArrayLayout(Message):
    @property
    def dim(self) -> list[MultiArrayDimension]: ...
    @dim.setter
    def dim(self, value: Iterable[MultiArrayDimension]) -> None: ...
    data_offset: int
    def __init__(self, *, dim: Iterable[MultiArrayDimension] = ..., data_offset: int = ...) -> None: ...

class String(Message):
    data: str
    def __init__(self, *, data: str = ...) -> None: ...

class UInt16(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt16MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.uint16]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class UInt32(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt32MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.uint32]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class UInt64(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt64MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.uint64]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...

class UInt8(Message):
    data: int
    def __init__(self, *, data: int = ...) -> None: ...

class UInt8MultiArray(Message):
    layout: MultiArrayLayout
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, layout: MultiArrayLayout = ..., data: npt.ArrayLike = ...) -> None: ...
