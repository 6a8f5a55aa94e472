"""Types of the native module. One section for each part, in the order of the folders of the source."""

from os import PathLike
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt

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

# ---- bags

# ---- robot files

# ---- simulation
