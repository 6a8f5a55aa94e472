"""Types of the native module. One section for each part, in the order of the folders of the source."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypeAlias, final

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

@final
class RayHits:
    @property
    def distances(self) -> npt.NDArray[np.float64]: ...
    @property
    def normals(self) -> npt.NDArray[np.float64]: ...
    @property
    def ids(self) -> npt.NDArray[np.int64]: ...
    @property
    def primitives(self) -> npt.NDArray[np.int32]: ...
    @property
    def labels(self) -> npt.NDArray[np.int64]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, index: int, /) -> npt.NDArray[Any]: ...
    def __iter__(self) -> Iterator[npt.NDArray[Any]]: ...

@final
class RayScene:
    def __new__(cls, meshes: Iterable[tuple[npt.ArrayLike, npt.ArrayLike]] | None = None) -> RayScene: ...
    @staticmethod
    def from_file(
        path: StrPath,
        geometry: Literal["visual", "collision"] = "visual",
        arguments: dict[str, Any] | None = None,
        search_paths: Sequence[StrPath] | None = None,
    ) -> RayScene: ...
    def add_mesh(
        self,
        vertices: npt.ArrayLike,
        triangles: npt.ArrayLike,
        pose: PoseLike | None = None,
        label: int = 0,
    ) -> int: ...
    def add_box(self, size: npt.ArrayLike, pose: PoseLike | None = None, label: int = 0) -> int: ...
    def add_sphere(self, radius: float, pose: PoseLike | None = None, label: int = 0) -> int: ...
    def add_cylinder(
        self, radius: float, length: float, pose: PoseLike | None = None, label: int = 0
    ) -> int: ...
    def add_capsule(
        self, radius: float, length: float, pose: PoseLike | None = None, label: int = 0
    ) -> int: ...
    def add_cone(
        self, radius: float, length: float, pose: PoseLike | None = None, label: int = 0
    ) -> int: ...
    def add_ellipsoid(
        self, radii: npt.ArrayLike, pose: PoseLike | None = None, label: int = 0
    ) -> int: ...
    def add_plane(
        self, size: tuple[float, float] | None = None, pose: PoseLike | None = None, label: int = 0
    ) -> int: ...
    def add_heightfield(
        self,
        heights: npt.ArrayLike,
        size: tuple[float, float],
        pose: PoseLike | None = None,
        label: int = 0,
    ) -> int: ...
    def move(self, id: int, pose: PoseLike) -> None: ...
    def remove(self, id: int) -> None: ...
    def pose(self, id: int) -> Pose: ...
    @property
    def names(self) -> dict[int, str]: ...
    def __len__(self) -> int: ...
    def cast(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        max_distance_m: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> RayHits: ...
    def distances(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        max_distance_m: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> npt.NDArray[np.float32]: ...
    def occluded(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        max_distance_m: npt.ArrayLike | None = None,
        threads: int | None = None,
    ) -> npt.NDArray[np.bool_]: ...

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
