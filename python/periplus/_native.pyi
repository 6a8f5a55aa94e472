"""Types of the native module. One section for each part, in the order of the folders of the source."""

from os import PathLike
from typing import Any, ClassVar, Literal, TypeAlias, final

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

class TransformError(LookupError): ...
class TransformLookupError(TransformError): ...
class TransformConnectivityError(TransformError): ...
class TransformExtrapolationError(TransformError): ...
class TransformArgumentError(TransformError): ...

@final
class TfBuffer:
    def __new__(cls, cache_time_s: float = 10.0) -> TfBuffer: ...
    @property
    def cache_time_s(self) -> float: ...
    def set_transform(
        self,
        parent: str,
        child: str,
        pose: PoseLike,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        is_static: bool = False,
        authority: str = "python",
    ) -> None: ...
    def set_transforms(
        self,
        parent: str,
        child: str,
        poses: npt.ArrayLike,
        times_s: npt.ArrayLike | None = None,
        *,
        times_ns: npt.ArrayLike | None = None,
        authority: str = "python",
    ) -> None: ...
    def lookup(
        self, target: str, source: str, time_s: float | None = None, *, time_ns: int | None = None
    ) -> Pose: ...
    def lookup_many(
        self,
        target: str,
        source: str,
        times_s: npt.ArrayLike | None = None,
        *,
        times_ns: npt.ArrayLike | None = None,
        missing: Literal["raise", "nan"] = "raise",
    ) -> npt.NDArray[np.float64]: ...
    def lookup_across(
        self, target: str, target_time_s: float, source: str, source_time_s: float, fixed: str
    ) -> Pose: ...
    def latest_time(self, target: str, source: str) -> float: ...
    def latest_time_ns(self, target: str, source: str) -> int: ...
    def can_transform(
        self, target: str, source: str, time_s: float | None = None, *, time_ns: int | None = None
    ) -> bool: ...
    def frames(self) -> list[str]: ...
    def parent(self, frame: str) -> str | None: ...
    def chain(self, target: str, source: str) -> list[str] | None: ...
    def frame_status(self) -> list[dict[str, Any]]: ...
    def tree(self) -> str: ...
    def frames_yaml(self) -> str: ...
    def clear(self) -> None: ...

# ---- ekf

@final
class EkfEstimate:
    @property
    def time_s(self) -> float: ...
    @property
    def time_ns(self) -> int: ...
    @property
    def state(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @property
    def pose(self) -> Pose: ...
    @property
    def linear_velocity(self) -> npt.NDArray[np.float64]: ...
    @property
    def angular_velocity(self) -> npt.NDArray[np.float64]: ...
    @property
    def acceleration(self) -> npt.NDArray[np.float64]: ...
    @property
    def pose_covariance(self) -> npt.NDArray[np.float64]: ...
    @property
    def twist_covariance(self) -> npt.NDArray[np.float64]: ...

@final
class Ekf:
    VARIABLES: ClassVar[tuple[str, ...]]
    def __new__(
        cls, yaml: StrPath | None = None, *, node: str = "ekf_filter_node", **parameters: Any
    ) -> Ekf: ...
    @staticmethod
    def parameters() -> list[dict[str, Any]]: ...
    @property
    def inputs(self) -> list[str]: ...
    def add_pose(
        self,
        input: str,
        pose: PoseLike,
        covariance: npt.ArrayLike,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        world_from_frame: PoseLike | None = None,
    ) -> bool: ...
    def add_twist(
        self,
        input: str,
        linear: npt.ArrayLike,
        angular: npt.ArrayLike,
        covariance: npt.ArrayLike,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        base_from_sensor: PoseLike | None = None,
    ) -> bool: ...
    def add_odometry(
        self,
        input: str,
        pose: PoseLike,
        pose_covariance: npt.ArrayLike,
        linear: npt.ArrayLike,
        angular: npt.ArrayLike,
        twist_covariance: npt.ArrayLike,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        world_from_frame: PoseLike | None = None,
        base_from_sensor: PoseLike | None = None,
    ) -> bool: ...
    def add_imu(
        self,
        input: str,
        orientation: npt.ArrayLike | None = None,
        orientation_covariance: npt.ArrayLike | None = None,
        angular_velocity: npt.ArrayLike | None = None,
        angular_velocity_covariance: npt.ArrayLike | None = None,
        linear_acceleration: npt.ArrayLike | None = None,
        linear_acceleration_covariance: npt.ArrayLike | None = None,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        base_from_sensor: PoseLike | None = None,
    ) -> bool: ...
    def add_measurement(
        self,
        values: dict[str, float],
        covariance: npt.ArrayLike,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
        rejection_threshold: float = ...,
    ) -> None: ...
    def update(self, time_s: float | None = None, *, time_ns: int | None = None) -> bool: ...
    def predict(self, time_s: float | None = None, *, time_ns: int | None = None) -> EkfEstimate: ...
    @property
    def estimate(self) -> EkfEstimate | None: ...
    @property
    def state(self) -> npt.NDArray[np.float64]: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @property
    def pose(self) -> Pose: ...
    def set_state(
        self,
        state: npt.ArrayLike,
        covariance: npt.ArrayLike | None = None,
        time_s: float | None = None,
        *,
        time_ns: int | None = None,
    ) -> None: ...
    def take_rejections(self) -> list[dict[str, Any]]: ...
    def reset(self) -> None: ...

# ---- slam

# A LaserScan message, or any object with its fields; else ranges.
_ScanLike: TypeAlias = Any

@final
class LaserScanner:
    def __new__(
        cls,
        angle_min: float,
        angle_increment: float,
        *,
        range_min: float = 0.0,
        range_max: float = ...,
        time_increment: float = 0.0,
        base_from_laser: PoseLike | None = None,
    ) -> LaserScanner: ...
    @staticmethod
    def from_angles(
        angles: npt.ArrayLike,
        *,
        range_min: float = 0.0,
        range_max: float = ...,
        time_increment: float = 0.0,
        base_from_laser: PoseLike | None = None,
    ) -> LaserScanner: ...
    @staticmethod
    def from_message(message: Any, base_from_laser: PoseLike | None = None) -> LaserScanner: ...
    @property
    def angle_min(self) -> float: ...
    @property
    def angle_increment(self) -> float: ...
    @property
    def range_min(self) -> float: ...
    @property
    def range_max(self) -> float: ...
    @property
    def time_increment(self) -> float: ...
    @property
    def base_from_laser(self) -> Pose: ...

@final
class SlamRemark:
    @property
    def kind(self) -> str: ...
    @property
    def values(self) -> dict[str, float]: ...
    @property
    def position(self) -> tuple[float, float] | None: ...
    @property
    def time_s(self) -> float: ...
    @property
    def time_ns(self) -> int: ...
    @property
    def is_warning(self) -> bool: ...
    @property
    def text(self) -> str: ...

@final
class SlamUpdate:
    @property
    def outcome(
        self,
    ) -> Literal["inserted", "below_motion_threshold", "no_match", "rejected", "skipped"]: ...
    @property
    def reason(self) -> str | None: ...
    @property
    def is_keyframe(self) -> bool: ...
    @property
    def map_from_base(self) -> Pose: ...
    @property
    def map_from_odom(self) -> Pose: ...
    @property
    def is_map_revised(self) -> bool: ...
    @property
    def remarks(self) -> list[SlamRemark]: ...

@final
class PoseGraph:
    @property
    def poses(self) -> npt.NDArray[np.float64]: ...
    @property
    def times_s(self) -> npt.NDArray[np.float64]: ...
    @property
    def edges(self) -> npt.NDArray[np.int64]: ...
    @property
    def kinds(self) -> list[str]: ...
    @property
    def residuals(self) -> npt.NDArray[np.float64]: ...
    @property
    def chi2(self) -> float: ...

@final
class Slam:
    def __new__(
        cls,
        method: Literal["graph", "gmapping"] | None = None,
        yaml: StrPath | None = None,
        *,
        scanner: LaserScanner | None = None,
        **parameters: Any,
    ) -> Slam: ...
    @staticmethod
    def parameters(method: Literal["graph", "gmapping"] = "graph") -> list[dict[str, Any]]: ...
    @classmethod
    def from_log(
        cls,
        path: StrPath,
        method: Literal["graph", "gmapping"] | None = None,
        yaml: StrPath | None = None,
        *,
        finish: bool = True,
        **parameters: Any,
    ) -> Slam: ...
    def process(
        self,
        scan: _ScanLike,
        odom_from_base: PoseLike | npt.ArrayLike | None = None,
        *,
        time_s: float | None = None,
        time_ns: int | None = None,
        scanner: LaserScanner | None = None,
    ) -> SlamUpdate: ...
    def process_many(
        self,
        ranges: npt.ArrayLike,
        odom_from_base: npt.ArrayLike | None = None,
        *,
        times_s: npt.ArrayLike | None = None,
        times_ns: npt.ArrayLike | None = None,
        scanner: LaserScanner | None = None,
    ) -> list[SlamUpdate]: ...
    def finish(self) -> None: ...
    @property
    def method(self) -> Literal["graph", "gmapping"]: ...
    @property
    def map_from_base(self) -> Pose: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    def set_pose(
        self, pose: PoseLike, variances: tuple[float, float, float] = ...
    ) -> None: ...
    def map(self) -> tuple[npt.NDArray[np.int8], float, Pose]: ...
    def trajectory(self) -> npt.NDArray[np.float64]: ...
    def trajectory_times_ns(self) -> npt.NDArray[np.int64]: ...
    def graph(self) -> PoseGraph: ...
    def g2o(self) -> str: ...
    @property
    def remarks(self) -> list[SlamRemark]: ...
    def contradictions(self) -> list[dict[str, Any]]: ...
    def closures(self) -> list[dict[str, Any]]: ...
    @property
    def counts(self) -> dict[str, int]: ...
    @property
    def mounting_correction(self) -> str | None: ...
    def settings(self) -> dict[str, Any]: ...
    def to_bytes(self) -> bytes: ...
    def save(self, path: StrPath) -> None: ...
    @classmethod
    def load(
        cls,
        path: StrPath,
        yaml: StrPath | None = None,
        *,
        scanner: LaserScanner | None = None,
        **parameters: Any,
    ) -> Slam: ...
    @classmethod
    def from_bytes(
        cls,
        data: bytes,
        yaml: StrPath | None = None,
        *,
        scanner: LaserScanner | None = None,
        **parameters: Any,
    ) -> Slam: ...

# ---- amcl

@final
class AmclEstimate:
    @property
    def pose(self) -> Pose | None: ...
    @property
    def map_from_odom(self) -> Pose | None: ...
    @property
    def covariance(self) -> npt.NDArray[np.float64] | None: ...
    @property
    def pose_covariance(self) -> npt.NDArray[np.float64] | None: ...
    @property
    def state(self) -> Literal["unset", "tracking", "ambiguous", "lost"]: ...
    @property
    def reason(self) -> str: ...
    @property
    def has_pose(self) -> bool: ...
    @property
    def inlier_ratio(self) -> float | None: ...
    @property
    def hypotheses(self) -> npt.NDArray[np.float64]: ...
    @property
    def is_updated(self) -> bool: ...
    @property
    def is_resampled(self) -> bool: ...
    @property
    def likelihood(self) -> float | None: ...
    @property
    def random_fraction(self) -> float | None: ...

@final
class Amcl:
    def __new__(
        cls,
        map: Any = None,
        yaml: StrPath | None = None,
        *,
        scanner: LaserScanner | None = None,
        **parameters: Any,
    ) -> Amcl: ...
    @staticmethod
    def parameters() -> list[dict[str, Any]]: ...
    def settings(self) -> dict[str, Any]: ...
    def set_map(self, map: Any) -> bool: ...
    def set_initial_pose(self, pose: PoseLike, covariance: npt.ArrayLike | None = None) -> None: ...
    def global_localization(self) -> None: ...
    def localize_globally(
        self, scan: _ScanLike, *, scanner: LaserScanner | None = None
    ) -> npt.NDArray[np.float64]: ...
    def update(
        self,
        scan: _ScanLike,
        odom_from_base: PoseLike | npt.ArrayLike,
        *,
        time_s: float | None = None,
        time_ns: int | None = None,
        scanner: LaserScanner | None = None,
    ) -> AmclEstimate: ...
    def request_update(self) -> None: ...
    def reset_odometry(self) -> None: ...
    @property
    def estimate(self) -> AmclEstimate: ...
    @property
    def particles(self) -> npt.NDArray[np.float64]: ...
    def likelihoods(
        self, scan: _ScanLike, *, scanner: LaserScanner | None = None
    ) -> npt.NDArray[np.float64]: ...

# ---- messages

# ---- bags

# ---- robot files

# ---- simulation
