"""Types of the native module. One section for each part, in the order of the folders of the source."""

from os import PathLike
from typing import Any, TypeAlias, TypeVar, final, overload

import numpy as np
import numpy.typing as npt
from typing_extensions import Buffer

from periplus.msgs import Message

_M = TypeVar("_M", bound=Message)

__version__: str

StrPath: TypeAlias = str | PathLike[str]
PoseLike: TypeAlias = "Pose | tuple[float, float, float] | tuple[float, float, float, float, float, float]"

def run_command(arguments: list[str], interpreter: str) -> int: ...

class FileError(ValueError):
    file: str | None
    line: int | None
    column: int | None
    hint: str | None

# ---- poses

@final
class Pose:
    def __new__(
        cls,
        x: float = 0.0,
        y: float = 0.0,
        z: float = 0.0,
        roll: float = 0.0,
        pitch: float = 0.0,
        yaw: float = 0.0,
    ) -> Pose: ...
    @staticmethod
    def from_quaternion(position: npt.ArrayLike, quaternion: npt.ArrayLike) -> Pose: ...
    @property
    def x(self) -> float: ...
    @property
    def y(self) -> float: ...
    @property
    def z(self) -> float: ...
    @property
    def roll(self) -> float: ...
    @property
    def pitch(self) -> float: ...
    @property
    def yaw(self) -> float: ...
    @property
    def position(self) -> npt.NDArray[np.float64]: ...
    @property
    def quaternion(self) -> npt.NDArray[np.float64]: ...
    @property
    def matrix(self) -> npt.NDArray[np.float64]: ...
    def inverse(self) -> Pose: ...
    def transform(self, points: npt.ArrayLike) -> npt.NDArray[np.float64]: ...
    def __mul__(self, other: Pose) -> Pose: ...
    def __getnewargs__(self) -> tuple[float, float, float, float, float, float]: ...

# ---- rays

# ---- maps

# ---- scan matching

# ---- costmap

# ---- exploration

# ---- transforms

# ---- ekf

# ---- slam

# ---- amcl

# ---- messages

@final
class TypeHandle:
    @property
    def type_name(self) -> str: ...
    @property
    def type_hash(self) -> str | None: ...
    @property
    def fields(self) -> list[tuple[str, str]]: ...
    @property
    def constants(self) -> dict[str, Any]: ...
    @property
    def doc(self) -> str: ...
    def setter(self, index: int) -> FieldSetter: ...

@final
class FieldSetter:
    def __call__(self, message: Any, value: Any) -> None: ...

def message_types() -> list[str]: ...
def message_services() -> list[str]: ...
def message_class(type_name: str) -> type[Message]: ...
def init_message(message: Message, fields: dict[str, Any]) -> None: ...
def load_messages(folder: StrPath) -> list[str]: ...
def serialize(message: Message) -> bytes: ...
@overload
def deserialize(type: type[_M], data: Buffer) -> _M: ...
@overload
def deserialize(type: str, data: Buffer) -> Any: ...
def message_to_json(message: Message, *, indent: bool = False) -> str: ...
def message_from_json(type: type[_M] | str, text: str) -> Any: ...
def message_to_yaml(message: Message, *, max_length: int | None = None) -> str: ...

# ---- bags

# ---- robot files

# ---- simulation
