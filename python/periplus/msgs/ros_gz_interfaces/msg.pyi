from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.rcl_interfaces.msg as _rcl_interfaces_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "AirSpeed",
    "Altimeter",
    "Clock",
    "Contact",
    "Contacts",
    "Dataframe",
    "Entity",
    "EntityFactory",
    "EntityWrench",
    "Float32Array",
    "GuiCamera",
    "JointWrench",
    "Light",
    "LogPlaybackStatistics",
    "LogicalCameraImage",
    "LogicalCameraImageModel",
    "MaterialColor",
    "ParamVec",
    "SensorNoise",
    "StringVec",
    "TrackVisual",
    "VideoRecord",
    "WorldControl",
    "WorldReset",
    "WorldStatistics",
]

class AirSpeed(Message):
    header: _std_msgs_msg.Header
    diff_pressure: float
    temperature: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., diff_pressure: float = ..., temperature: float = ...) -> None: ...

class Altimeter(Message):
    header: _std_msgs_msg.Header
    vertical_position: float
    vertical_velocity: float
    vertical_reference: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., vertical_position: float = ..., vertical_velocity: float = ..., vertical_reference: float = ...) -> None: ...

class Clock(Message):
    header: _std_msgs_msg.Header
    system: _builtin_interfaces_msg.Time
    real: _builtin_interfaces_msg.Time
    sim: _builtin_interfaces_msg.Time
    def __init__(self, *, header: _std_msgs_msg.Header = ..., system: _builtin_interfaces_msg.Time = ..., real: _builtin_interfaces_msg.Time = ..., sim: _builtin_interfaces_msg.Time = ...) -> None: ...

class Contact(Message):
    collision1: Entity
    collision2: Entity
    @property
    def positions(self) -> list[_geometry_msgs_msg.Vector3]: ...
    @positions.setter
    def positions(self, value: Iterable[_geometry_msgs_msg.Vector3]) -> None: ...
    @property
    def normals(self) -> list[_geometry_msgs_msg.Vector3]: ...
    @normals.setter
    def normals(self, value: Iterable[_geometry_msgs_msg.Vector3]) -> None: ...
    @property
    def depths(self) -> npt.NDArray[np.float64]: ...
    @depths.setter
    def depths(self, value: npt.ArrayLike) -> None: ...
    @property
    def wrenches(self) -> list[JointWrench]: ...
    @wrenches.setter
    def wrenches(self, value: Iterable[JointWrench]) -> None: ...
    def __init__(self, *, collision1: Entity = ..., collision2: Entity = ..., positions: Iterable[_geometry_msgs_msg.Vector3] = ..., normals: Iterable[_geometry_msgs_msg.Vector3] = ..., depths: npt.ArrayLike = ..., wrenches: Iterable[JointWrench] = ...) -> None: ...

class Contacts(Message):
    header: _std_msgs_msg.Header
    @property
    def contacts(self) -> list[Contact]: ...
    @contacts.setter
    def contacts(self, value: Iterable[Contact]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., contacts: Iterable[Contact] = ...) -> None: ...

class Dataframe(Message):
    header: _std_msgs_msg.Header
    src_address: str
    dst_address: str
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    rssi: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., src_address: str = ..., dst_address: str = ..., data: npt.ArrayLike = ..., rssi: float = ...) -> None: ...

class Entity(Message):
    NONE: ClassVar[int]
    LIGHT: ClassVar[int]
    MODEL: ClassVar[int]
    LINK: ClassVar[int]
    VISUAL: ClassVar[int]
    COLLISION: ClassVar[int]
    SENSOR: ClassVar[int]
    JOINT: ClassVar[int]
    id: int
    name: str
    type: int
    def __init__(self, *, id: int = ..., name: str = ..., type: int = ...) -> None: ...

class EntityFactory(Message):
    name: str
    allow_renaming: bool
    sdf: str
    sdf_filename: str
    clone_name: str
    pose: _geometry_msgs_msg.Pose
    relative_to: str
    def __init__(self, *, name: str = ..., allow_renaming: bool = ..., sdf: str = ..., sdf_filename: str = ..., clone_name: str = ..., pose: _geometry_msgs_msg.Pose = ..., relative_to: str = ...) -> None: ...

class EntityWrench(Message):
    header: _std_msgs_msg.Header
    entity: Entity
    wrench: _geometry_msgs_msg.Wrench
    def __init__(self, *, header: _std_msgs_msg.Header = ..., entity: Entity = ..., wrench: _geometry_msgs_msg.Wrench = ...) -> None: ...

class Float32Array(Message):
    @property
    def data(self) -> npt.NDArray[np.float32]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, data: npt.ArrayLike = ...) -> None: ...

class GuiCamera(Message):
    header: _std_msgs_msg.Header
    name: str
    view_controller: str
    pose: _geometry_msgs_msg.Pose
    track: TrackVisual
    projection_type: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., name: str = ..., view_controller: str = ..., pose: _geometry_msgs_msg.Pose = ..., track: TrackVisual = ..., projection_type: str = ...) -> None: ...

class JointWrench(Message):
    header: _std_msgs_msg.Header
    body_1_name: _std_msgs_msg.String
    body_1_id: _std_msgs_msg.UInt32
    body_2_name: _std_msgs_msg.String
    body_2_id: _std_msgs_msg.UInt32
    body_1_wrench: _geometry_msgs_msg.Wrench
    body_2_wrench: _geometry_msgs_msg.Wrench
    def __init__(self, *, header: _std_msgs_msg.Header = ..., body_1_name: _std_msgs_msg.String = ..., body_1_id: _std_msgs_msg.UInt32 = ..., body_2_name: _std_msgs_msg.String = ..., body_2_id: _std_msgs_msg.UInt32 = ..., body_1_wrench: _geometry_msgs_msg.Wrench = ..., body_2_wrench: _geometry_msgs_msg.Wrench = ...) -> None: ...

class Light(Message):
    POINT: ClassVar[int]
    SPOT: ClassVar[int]
    DIRECTIONAL: ClassVar[int]
    header: _std_msgs_msg.Header
    name: str
    type: int
    pose: _geometry_msgs_msg.Pose
    diffuse: _std_msgs_msg.ColorRGBA
    specular: _std_msgs_msg.ColorRGBA
    attenuation_constant: float
    attenuation_linear: float
    attenuation_quadratic: float
    direction: _geometry_msgs_msg.Vector3
    range: float
    cast_shadows: bool
    spot_inner_angle: float
    spot_outer_angle: float
    spot_falloff: float
    id: int
    parent_id: int
    intensity: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., name: str = ..., type: int = ..., pose: _geometry_msgs_msg.Pose = ..., diffuse: _std_msgs_msg.ColorRGBA = ..., specular: _std_msgs_msg.ColorRGBA = ..., attenuation_constant: float = ..., attenuation_linear: float = ..., attenuation_quadratic: float = ..., direction: _geometry_msgs_msg.Vector3 = ..., range: float = ..., cast_shadows: bool = ..., spot_inner_angle: float = ..., spot_outer_angle: float = ..., spot_falloff: float = ..., id: int = ..., parent_id: int = ..., intensity: float = ...) -> None: ...

class LogPlaybackStatistics(Message):
    header: _std_msgs_msg.Header
    start_time: _builtin_interfaces_msg.Time
    end_time: _builtin_interfaces_msg.Time
    def __init__(self, *, header: _std_msgs_msg.Header = ..., start_time: _builtin_interfaces_msg.Time = ..., end_time: _builtin_interfaces_msg.Time = ...) -> None: ...

class LogicalCameraImage(Message):
    header: _std_msgs_msg.Header
    pose: _geometry_msgs_msg.Pose
    @property
    def model(self) -> list[LogicalCameraImageModel]: ...
    @model.setter
    def model(self, value: Iterable[LogicalCameraImageModel]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: _geometry_msgs_msg.Pose = ..., model: Iterable[LogicalCameraImageModel] = ...) -> None: ...

class LogicalCameraImageModel(Message):
    name: str
    pose: _geometry_msgs_msg.Pose
    def __init__(self, *, name: str = ..., pose: _geometry_msgs_msg.Pose = ...) -> None: ...

class MaterialColor(Message):
    FIRST: ClassVar[int]
    ALL: ClassVar[int]
    header: _std_msgs_msg.Header
    entity: Entity
    ambient: _std_msgs_msg.ColorRGBA
    diffuse: _std_msgs_msg.ColorRGBA
    specular: _std_msgs_msg.ColorRGBA
    emissive: _std_msgs_msg.ColorRGBA
    shininess: float
    entity_match: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., entity: Entity = ..., ambient: _std_msgs_msg.ColorRGBA = ..., diffuse: _std_msgs_msg.ColorRGBA = ..., specular: _std_msgs_msg.ColorRGBA = ..., emissive: _std_msgs_msg.ColorRGBA = ..., shininess: float = ..., entity_match: int = ...) -> None: ...

class ParamVec(Message):
    header: _std_msgs_msg.Header
    @property
    def params(self) -> list[_rcl_interfaces_msg.Parameter]: ...
    @params.setter
    def params(self, value: Iterable[_rcl_interfaces_msg.Parameter]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., params: Iterable[_rcl_interfaces_msg.Parameter] = ...) -> None: ...

class SensorNoise(Message):
    NONE: ClassVar[int]
    GAUSSIAN: ClassVar[int]
    GAUSSIAN_QUANTIZED: ClassVar[int]
    header: _std_msgs_msg.Header
    type: int
    mean: float
    stddev: float
    bias_mean: float
    bias_stddev: float
    precision: float
    dynamic_bias_stddev: float
    dynamic_bias_correlation_time: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., type: int = ..., mean: float = ..., stddev: float = ..., bias_mean: float = ..., bias_stddev: float = ..., precision: float = ..., dynamic_bias_stddev: float = ..., dynamic_bias_correlation_time: float = ...) -> None: ...

class StringVec(Message):
    header: _std_msgs_msg.Header
    @property
    def data(self) -> list[str]: ...
    @data.setter
    def data(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., data: Iterable[str] = ...) -> None: ...

class TrackVisual(Message):
    header: _std_msgs_msg.Header
    name: str
    id: int
    inherit_orientation: bool
    min_dist: float
    max_dist: float
    is_static: bool
    use_model_frame: bool
    xyz: _geometry_msgs_msg.Vector3
    inherit_yaw: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., name: str = ..., id: int = ..., inherit_orientation: bool = ..., min_dist: float = ..., max_dist: float = ..., is_static: bool = ..., use_model_frame: bool = ..., xyz: _geometry_msgs_msg.Vector3 = ..., inherit_yaw: bool = ...) -> None: ...

class VideoRecord(Message):
    header: _std_msgs_msg.Header
    start: bool
    stop: bool
    format: str
    save_filename: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., start: bool = ..., stop: bool = ..., format: str = ..., save_filename: str = ...) -> None: ...

class WorldControl(Message):
    pause: bool
    step: bool
    multi_step: int
    reset: WorldReset
    seed: int
    run_to_sim_time: _builtin_interfaces_msg.Time
    def __init__(self, *, pause: bool = ..., step: bool = ..., multi_step: int = ..., reset: WorldReset = ..., seed: int = ..., run_to_sim_time: _builtin_interfaces_msg.Time = ...) -> None: ...

class WorldReset(Message):
    all: bool
    time_only: bool
    model_only: bool
    def __init__(self, *, all: bool = ..., time_only: bool = ..., model_only: bool = ...) -> None: ...

class WorldStatistics(Message):
    header: _std_msgs_msg.Header
    sim_time: _builtin_interfaces_msg.Time
    pause_time: _builtin_interfaces_msg.Time
    real_time: _builtin_interfaces_msg.Time
    paused: bool
    iterations: int
    model_count: int
    log_playback_statistics: LogPlaybackStatistics
    real_time_factor: float
    step_size: _builtin_interfaces_msg.Time
    stepping: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., sim_time: _builtin_interfaces_msg.Time = ..., pause_time: _builtin_interfaces_msg.Time = ..., real_time: _builtin_interfaces_msg.Time = ..., paused: bool = ..., iterations: int = ..., model_count: int = ..., log_playback_statistics: LogPlaybackStatistics = ..., real_time_factor: float = ..., step_size: _builtin_interfaces_msg.Time = ..., stepping: bool = ...) -> None: ...
