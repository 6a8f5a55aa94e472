"""Types of the native module. One section for each part, in the order of the folders of the source."""

from collections.abc import Iterable, Iterator, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Literal, Protocol, TypeAlias, final, type_check_only

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
        out: RayHits | None = None,
    ) -> RayHits: ...
    def distances(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        max_distance_m: npt.ArrayLike | None = None,
        threads: int | None = None,
        out: npt.NDArray[np.float32] | None = None,
    ) -> npt.NDArray[np.float32]: ...
    def occluded(
        self,
        origins: npt.ArrayLike,
        directions: npt.ArrayLike,
        max_distance_m: npt.ArrayLike | None = None,
        threads: int | None = None,
        out: npt.NDArray[np.bool_] | None = None,
    ) -> npt.NDArray[np.bool_]: ...

# ---- maps

@final
class OccupancyGrid:
    def __new__(
        cls, cells: npt.ArrayLike, resolution_m: float, origin: PoseLike | None = None
    ) -> OccupancyGrid: ...
    @staticmethod
    def load(
        path: StrPath, distro: str = "jazzy", resolution_m: float | None = None
    ) -> OccupancyGrid: ...
    def save(
        self,
        path: StrPath,
        distro: str = "jazzy",
        mode: str = "trinary",
        image_format: str | None = None,
        occupied_thresh: float | None = None,
        free_thresh: float | None = None,
    ) -> Path: ...
    @property
    def cells(self) -> npt.NDArray[np.int8]: ...
    @property
    def resolution_m(self) -> float: ...
    @property
    def origin(self) -> tuple[float, float, float]: ...
    @property
    def width(self) -> int: ...
    @property
    def height(self) -> int: ...
    def world_from_cell(self, cells: npt.ArrayLike) -> npt.NDArray[np.float64]: ...
    def cell_from_world(self, points: npt.ArrayLike) -> npt.NDArray[np.int64]: ...
    def distances(self, occupied_thresh: float = 0.65) -> npt.NDArray[np.float64]: ...
    def diff(
        self,
        other: OccupancyGrid,
        align: bool = True,
        window_m: float | None = None,
        window_rad: float | None = None,
    ) -> MapComparison: ...
    def _repr_png_(self) -> bytes | None: ...
    def _repr_html_(self) -> str: ...
    def __eq__(self, other: object, /) -> bool: ...
    __hash__: ClassVar[None]  # type: ignore[assignment]

@final
class MapComparison:
    @property
    def alignment(self) -> tuple[float, float, float]: ...
    @property
    def score(self) -> float: ...
    @property
    def walls(self) -> dict[str, float]: ...
    @property
    def walls_nearby(self) -> dict[str, float]: ...
    @property
    def free(self) -> dict[str, float]: ...
    @property
    def known(self) -> dict[str, float]: ...
    @property
    def first_to_other(self) -> dict[str, float]: ...
    @property
    def other_to_first(self) -> dict[str, float]: ...
    @property
    def image(self) -> npt.NDArray[np.uint8]: ...
    def _repr_png_(self) -> bytes | None: ...
    def _repr_html_(self) -> str: ...

def inflate(
    costs: npt.ArrayLike,
    resolution_m: float,
    inscribed_radius_m: float,
    inflation_radius: float | None = None,
    cost_scaling_factor: float | None = None,
    inflate_unknown: bool = False,
    inflate_around_unknown: bool = False,
) -> npt.NDArray[np.uint8]: ...

# ---- scan matching

@final
class ScanMatch:
    @property
    def pose(self) -> Pose: ...
    @property
    def information(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @property
    def matched(self) -> float: ...
    @property
    def rms_m(self) -> float: ...
    @property
    def cost(self) -> float: ...
    @property
    def observability(self) -> float: ...

def scan_match(
    reference_points: npt.ArrayLike,
    points: npt.ArrayLike,
    guess: PoseLike | None = None,
    *,
    origin: Sequence[float] | None = None,
    angle_increment: float | None = None,
    reach_m: Sequence[float] | None = None,
    scale_m: Sequence[float] | None = None,
    steps: int | None = None,
    sigma_m: float | None = None,
    independent: float | None = None,
    degenerate: float | None = None,
    spacing_m: float | None = None,
    max_points: int | None = None,
) -> ScanMatch: ...
def scan_search(
    reference_points: npt.ArrayLike,
    points: npt.ArrayLike,
    guess: PoseLike | None = None,
    *,
    half_m: Sequence[float],
    half_rad: float,
    step_rad: float | None = None,
    min_score: float = 0.3,
    resolution_m: float | None = None,
    sigma_m: float | None = None,
) -> tuple[Pose, float] | None: ...

# ---- costmap

@final
class Costmap:
    def __new__(
        cls,
        parameters: dict[str, Any] | None = None,
        *,
        plugins: Sequence[str | CostmapLayer] | None = None,
        **settings: Any,
    ) -> Costmap: ...
    @staticmethod
    def from_yaml(path: StrPath, node: str = "local_costmap") -> Costmap: ...
    @staticmethod
    def from_text(text: str, node: str = "local_costmap") -> Costmap: ...
    def add_layer(self, layer: CostmapLayer) -> None: ...
    def set_map(self, grid: OccupancyGrid, layer: str | None = None) -> None: ...
    def observe(
        self,
        layer: str,
        source: str,
        points: npt.ArrayLike,
        sensor_pose: PoseLike,
        time_s: float = 0.0,
    ) -> None: ...
    def observe_scan(
        self,
        layer: str,
        source: str,
        ranges: npt.ArrayLike,
        angle_min: float,
        angle_increment: float,
        range_min: float,
        range_max: float,
        sensor_pose: PoseLike,
        time_s: float = 0.0,
    ) -> None: ...
    def observe_range(
        self,
        layer: str,
        range_m: float,
        min_range_m: float,
        max_range_m: float,
        field_of_view: float,
        sensor_pose: PoseLike,
    ) -> None: ...
    def update(
        self, time_s: float = 0.0, robot_pose: PoseLike | None = None
    ) -> tuple[int, int, int, int] | None: ...
    @property
    def costs(self) -> npt.NDArray[np.uint8]: ...
    def cost_at(self, poses: npt.ArrayLike, footprint: bool = False) -> npt.NDArray[np.uint8]: ...
    def explain(self, x: float, y: float) -> CellReport: ...
    @property
    def footprint(self) -> npt.NDArray[np.float64]: ...
    @property
    def radii_m(self) -> tuple[float, float]: ...
    def set_footprint(self, corners: npt.ArrayLike) -> None: ...
    def clear(
        self,
        layers: Sequence[str] | None = None,
        around: tuple[float, float, float] | None = None,
        outside: tuple[float, float, float] | None = None,
    ) -> None: ...
    def get_parameter(self, name: str) -> Any: ...
    def set_parameter(self, name: str, value: Any) -> None: ...
    @property
    def parameters(self) -> dict[str, Any]: ...
    @property
    def layers(self) -> list[str]: ...
    @property
    def warnings(self) -> list[str]: ...
    def is_current(self, time_s: float) -> bool: ...
    def reset(self) -> None: ...
    @property
    def resolution_m(self) -> float: ...
    @property
    def origin(self) -> tuple[float, float]: ...
    def to_grid(self) -> OccupancyGrid: ...
    def _repr_png_(self) -> bytes | None: ...
    def _repr_html_(self) -> str: ...

@type_check_only
class CostmapLayer(Protocol):
    def update_costs(
        self, costs: npt.NDArray[np.uint8], min_i: int, min_j: int, max_i: int, max_j: int, /
    ) -> object: ...

@final
class UpdateBounds:
    def touch(self, x: float, y: float) -> None: ...
    def touch_all(self) -> None: ...
    @property
    def min_x(self) -> float: ...
    @property
    def min_y(self) -> float: ...
    @property
    def max_x(self) -> float: ...
    @property
    def max_y(self) -> float: ...

@final
class CellReport:
    @property
    def cell(self) -> tuple[int, int]: ...
    @property
    def center(self) -> tuple[float, float]: ...
    @property
    def cost(self) -> int: ...
    @property
    def layers(self) -> list[dict[str, Any]]: ...

# ---- exploration

@final
class Frontier:
    @property
    def cell(self) -> tuple[int, int]: ...
    @property
    def position(self) -> tuple[float, float]: ...
    @property
    def cost_m(self) -> float: ...
    @property
    def length_m(self) -> float: ...
    @property
    def cells(self) -> npt.NDArray[np.int64]: ...
    @property
    def centroid(self) -> tuple[float, float]: ...
    @property
    def path(self) -> npt.NDArray[np.float64]: ...

def frontiers(
    grid: OccupancyGrid,
    robot_pose: PoseLike,
    radius_m: float | None = None,
    comfort_m: float | None = None,
    min_length_m: float | None = None,
) -> list[Frontier]: ...

# ---- transforms

# ---- ekf

# ---- slam

# ---- amcl

# ---- messages

# ---- bags

# ---- robot files

# ---- simulation
