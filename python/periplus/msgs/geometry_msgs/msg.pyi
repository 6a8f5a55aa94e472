from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Accel",
    "AccelStamped",
    "AccelWithCovariance",
    "AccelWithCovarianceStamped",
    "Inertia",
    "InertiaStamped",
    "Point",
    "Point32",
    "PointStamped",
    "Polygon",
    "PolygonInstance",
    "PolygonInstanceStamped",
    "PolygonStamped",
    "Pose",
    "Pose2D",
    "PoseArray",
    "PoseStamped",
    "PoseWithCovariance",
    "PoseWithCovarianceStamped",
    "Quaternion",
    "QuaternionStamped",
    "Transform",
    "TransformStamped",
    "Twist",
    "TwistStamped",
    "TwistWithCovariance",
    "TwistWithCovarianceStamped",
    "Vector3",
    "Vector3Stamped",
    "VelocityStamped",
    "Wrench",
    "WrenchStamped",
]

class Accel(Message):
    linear: Vector3
    angular: Vector3
    def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...

class AccelStamped(Message):
    header: _std_msgs_msg.Header
    accel: Accel
    def __init__(self, *, header: _std_msgs_msg.Header = ..., accel: Accel = ...) -> None: ...

class AccelWithCovariance(Message):
    accel: Accel
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @covariance.setter
    def covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, accel: Accel = ..., covariance: npt.ArrayLike = ...) -> None: ...

class AccelWithCovarianceStamped(Message):
    header: _std_msgs_msg.Header
    accel: AccelWithCovariance
    def __init__(self, *, header: _std_msgs_msg.Header = ..., accel: AccelWithCovariance = ...) -> None: ...

class Inertia(Message):
    m: float
    com: Vector3
    ixx: float
    ixy: float
    ixz: float
    iyy: float
    iyz: float
    izz: float
    def __init__(self, *, m: float = ..., com: Vector3 = ..., ixx: float = ..., ixy: float = ..., ixz: float = ..., iyy: float = ..., iyz: float = ..., izz: float = ...) -> None: ...

class InertiaStamped(Message):
    header: _std_msgs_msg.Header
    inertia: Inertia
    def __init__(self, *, header: _std_msgs_msg.Header = ..., inertia: Inertia = ...) -> None: ...

class Point(Message):
    x: float
    y: float
    z: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...

class Point32(Message):
    x: float
    y: float
    z: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...

class PointStamped(Message):
    header: _std_msgs_msg.Header
    point: Point
    def __init__(self, *, header: _std_msgs_msg.Header = ..., point: Point = ...) -> None: ...

class Polygon(Message):
    @property
    def points(self) -> list[Point32]: ...
    @points.setter
    def points(self, value: Iterable[Point32]) -> None: ...
    def __init__(self, *, points: Iterable[Point32] = ...) -> None: ...

class PolygonInstance(Message):
    polygon: Polygon
    id: int
    def __init__(self, *, polygon: Polygon = ..., id: int = ...) -> None: ...

class PolygonInstanceStamped(Message):
    header: _std_msgs_msg.Header
    polygon: PolygonInstance
    def __init__(self, *, header: _std_msgs_msg.Header = ..., polygon: PolygonInstance = ...) -> None: ...

class PolygonStamped(Message):
    header: _std_msgs_msg.Header
    polygon: Polygon
    def __init__(self, *, header: _std_msgs_msg.Header = ..., polygon: Polygon = ...) -> None: ...

class Pose(Message):
    position: Point
    orientation: Quaternion
    def __init__(self, *, position: Point = ..., orientation: Quaternion = ...) -> None: ...

class Pose2D(Message):
    x: float
    y: float
    theta: float
    def __init__(self, *, x: float = ..., y: float = ..., theta: float = ...) -> None: ...

class PoseArray(Message):
    header: _std_msgs_msg.Header
    @property
    def poses(self) -> list[Pose]: ...
    @poses.setter
    def poses(self, value: Iterable[Pose]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., poses: Iterable[Pose] = ...) -> None: ...

class PoseStamped(Message):
    header: _std_msgs_msg.Header
    pose: Pose
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: Pose = ...) -> None: ...

class PoseWithCovariance(Message):
    pose: Pose
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @covariance.setter
    def covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, pose: Pose = ..., covariance: npt.ArrayLike = ...) -> None: ...

class PoseWithCovarianceStamped(Message):
    header: _std_msgs_msg.Header
    pose: PoseWithCovariance
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: PoseWithCovariance = ...) -> None: ...

class Quaternion(Message):
    x: float
    y: float
    z: float
    w: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ..., w: float = ...) -> None: ...

class QuaternionStamped(Message):
    header: _std_msgs_msg.Header
    quaternion: Quaternion
    def __init__(self, *, header: _std_msgs_msg.Header = ..., quaternion: Quaternion = ...) -> None: ...

class Transform(Message):
    translation: Vector3
    rotation: Quaternion
    def __init__(self, *, translation: Vector3 = ..., rotation: Quaternion = ...) -> None: ...

class TransformStamped(Message):
    header: _std_msgs_msg.Header
    child_frame_id: str
    transform: Transform
    def __init__(self, *, header: _std_msgs_msg.Header = ..., child_frame_id: str = ..., transform: Transform = ...) -> None: ...

class Twist(Message):
    linear: Vector3
    angular: Vector3
    def __init__(self, *, linear: Vector3 = ..., angular: Vector3 = ...) -> None: ...

class TwistStamped(Message):
    header: _std_msgs_msg.Header
    twist: Twist
    def __init__(self, *, header: _std_msgs_msg.Header = ..., twist: Twist = ...) -> None: ...

class TwistWithCovariance(Message):
    twist: Twist
    @property
    def covariance(self) -> npt.NDArray[np.float64]: ...
    @covariance.setter
    def covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, twist: Twist = ..., covariance: npt.ArrayLike = ...) -> None: ...

class TwistWithCovarianceStamped(Message):
    header: _std_msgs_msg.Header
    twist: TwistWithCovariance
    def __init__(self, *, header: _std_msgs_msg.Header = ..., twist: TwistWithCovariance = ...) -> None: ...

class Vector3(Message):
    x: float
    y: float
    z: float
    def __init__(self, *, x: float = ..., y: float = ..., z: float = ...) -> None: ...

class Vector3Stamped(Message):
    header: _std_msgs_msg.Header
    vector: Vector3
    def __init__(self, *, header: _std_msgs_msg.Header = ..., vector: Vector3 = ...) -> None: ...

class VelocityStamped(Message):
    header: _std_msgs_msg.Header
    body_frame_id: str
    reference_frame_id: str
    velocity: Twist
    def __init__(self, *, header: _std_msgs_msg.Header = ..., body_frame_id: str = ..., reference_frame_id: str = ..., velocity: Twist = ...) -> None: ...

class Wrench(Message):
    force: Vector3
    torque: Vector3
    def __init__(self, *, force: Vector3 = ..., torque: Vector3 = ...) -> None: ...

class WrenchStamped(Message):
    header: _std_msgs_msg.Header
    wrench: Wrench
    def __init__(self, *, header: _std_msgs_msg.Header = ..., wrench: Wrench = ...) -> None: ...
