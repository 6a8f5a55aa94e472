from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "BatteryState",
    "CameraInfo",
    "ChannelFloat32",
    "CompressedImage",
    "FluidPressure",
    "Illuminance",
    "Image",
    "Imu",
    "JointState",
    "Joy",
    "JoyFeedback",
    "JoyFeedbackArray",
    "LaserEcho",
    "LaserScan",
    "MagneticField",
    "MultiDOFJointState",
    "MultiEchoLaserScan",
    "NavSatFix",
    "NavSatStatus",
    "PointCloud",
    "PointCloud2",
    "PointField",
    "Range",
    "RegionOfInterest",
    "RelativeHumidity",
    "Temperature",
    "TimeReference",
]

class BatteryState(Message):
    POWER_SUPPLY_STATUS_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_STATUS_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_DISCHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_NOT_CHARGING: ClassVar[int]
    POWER_SUPPLY_STATUS_FULL: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_HEALTH_GOOD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERHEAT: ClassVar[int]
    POWER_SUPPLY_HEALTH_DEAD: ClassVar[int]
    POWER_SUPPLY_HEALTH_OVERVOLTAGE: ClassVar[int]
    POWER_SUPPLY_HEALTH_UNSPEC_FAILURE: ClassVar[int]
    POWER_SUPPLY_HEALTH_COLD: ClassVar[int]
    POWER_SUPPLY_HEALTH_WATCHDOG_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_HEALTH_SAFETY_TIMER_EXPIRE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_UNKNOWN: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NIMH: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LION: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIPO: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIFE: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_NICD: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_LIMN: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_TERNARY: ClassVar[int]
    POWER_SUPPLY_TECHNOLOGY_VRLA: ClassVar[int]
    header: _std_msgs_msg.Header
    voltage: float
    temperature: float
    current: float
    charge: float
    capacity: float
    design_capacity: float
    percentage: float
    power_supply_status: int
    power_supply_health: int
    power_supply_technology: int
    present: bool
    @property
    def cell_voltage(self) -> npt.NDArray[np.float32]: ...
    @cell_voltage.setter
    def cell_voltage(self, value: npt.ArrayLike) -> None: ...
    @property
    def cell_temperature(self) -> npt.NDArray[np.float32]: ...
    @cell_temperature.setter
    def cell_temperature(self, value: npt.ArrayLike) -> None: ...
    location: str
    serial_number: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., voltage: float = ..., temperature: float = ..., current: float = ..., charge: float = ..., capacity: float = ..., design_capacity: float = ..., percentage: float = ..., power_supply_status: int = ..., power_supply_health: int = ..., power_supply_technology: int = ..., present: bool = ..., cell_voltage: npt.ArrayLike = ..., cell_temperature: npt.ArrayLike = ..., location: str = ..., serial_number: str = ...) -> None: ...

class CameraInfo(Message):
    header: _std_msgs_msg.Header
    height: int
    width: int
    distortion_model: str
    @property
    def d(self) -> npt.NDArray[np.float64]: ...
    @d.setter
    def d(self, value: npt.ArrayLike) -> None: ...
    @property
    def k(self) -> npt.NDArray[np.float64]: ...
    @k.setter
    def k(self, value: npt.ArrayLike) -> None: ...
    @property
    def r(self) -> npt.NDArray[np.float64]: ...
    @r.setter
    def r(self, value: npt.ArrayLike) -> None: ...
    @property
    def p(self) -> npt.NDArray[np.float64]: ...
    @p.setter
    def p(self, value: npt.ArrayLike) -> None: ...
    binning_x: int
    binning_y: int
    roi: RegionOfInterest
    def __init__(self, *, header: _std_msgs_msg.Header = ..., height: int = ..., width: int = ..., distortion_model: str = ..., d: npt.ArrayLike = ..., k: npt.ArrayLike = ..., r: npt.ArrayLike = ..., p: npt.ArrayLike = ..., binning_x: int = ..., binning_y: int = ..., roi: RegionOfInterest = ...) -> None: ...

class ChannelFloat32(Message):
    name: str
    @property
    def values(self) -> npt.NDArray[np.float32]: ...
    @values.setter
    def values(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, name: str = ..., values: npt.ArrayLike = ...) -> None: ...

class CompressedImage(Message):
    header: _std_msgs_msg.Header
    format: str
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., format: str = ..., data: npt.ArrayLike = ...) -> None: ...

class FluidPressure(Message):
    header: _std_msgs_msg.Header
    fluid_pressure: float
    variance: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., fluid_pressure: float = ..., variance: float = ...) -> None: ...

class Illuminance(Message):
    header: _std_msgs_msg.Header
    illuminance: float
    variance: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., illuminance: float = ..., variance: float = ...) -> None: ...

class Image(Message):
    header: _std_msgs_msg.Header
    height: int
    width: int
    encoding: str
    is_bigendian: int
    step: int
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., height: int = ..., width: int = ..., encoding: str = ..., is_bigendian: int = ..., step: int = ..., data: npt.ArrayLike = ...) -> None: ...

class Imu(Message):
    header: _std_msgs_msg.Header
    orientation: _geometry_msgs_msg.Quaternion
    @property
    def orientation_covariance(self) -> npt.NDArray[np.float64]: ...
    @orientation_covariance.setter
    def orientation_covariance(self, value: npt.ArrayLike) -> None: ...
    angular_velocity: _geometry_msgs_msg.Vector3
    @property
    def angular_velocity_covariance(self) -> npt.NDArray[np.float64]: ...
    @angular_velocity_covariance.setter
    def angular_velocity_covariance(self, value: npt.ArrayLike) -> None: ...
    linear_acceleration: _geometry_msgs_msg.Vector3
    @property
    def linear_acceleration_covariance(self) -> npt.NDArray[np.float64]: ...
    @linear_acceleration_covariance.setter
    def linear_acceleration_covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., orientation: _geometry_msgs_msg.Quaternion = ..., orientation_covariance: npt.ArrayLike = ..., angular_velocity: _geometry_msgs_msg.Vector3 = ..., angular_velocity_covariance: npt.ArrayLike = ..., linear_acceleration: _geometry_msgs_msg.Vector3 = ..., linear_acceleration_covariance: npt.ArrayLike = ...) -> None: ...

class JointState(Message):
    header: _std_msgs_msg.Header
    @property
    def name(self) -> list[str]: ...
    @name.setter
    def name(self, value: Iterable[str]) -> None: ...
    @property
    def position(self) -> npt.NDArray[np.float64]: ...
    @position.setter
    def position(self, value: npt.ArrayLike) -> None: ...
    @property
    def velocity(self) -> npt.NDArray[np.float64]: ...
    @velocity.setter
    def velocity(self, value: npt.ArrayLike) -> None: ...
    @property
    def effort(self) -> npt.NDArray[np.float64]: ...
    @effort.setter
    def effort(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., name: Iterable[str] = ..., position: npt.ArrayLike = ..., velocity: npt.ArrayLike = ..., effort: npt.ArrayLike = ...) -> None: ...

class Joy(Message):
    header: _std_msgs_msg.Header
    @property
    def axes(self) -> npt.NDArray[np.float32]: ...
    @axes.setter
    def axes(self, value: npt.ArrayLike) -> None: ...
    @property
    def buttons(self) -> npt.NDArray[np.int32]: ...
    @buttons.setter
    def buttons(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., axes: npt.ArrayLike = ..., buttons: npt.ArrayLike = ...) -> None: ...

class JoyFeedback(Message):
    TYPE_LED: ClassVar[int]
    TYPE_RUMBLE: ClassVar[int]
    TYPE_BUZZER: ClassVar[int]
    type: int
    id: int
    intensity: float
    def __init__(self, *, type: int = ..., id: int = ..., intensity: float = ...) -> None: ...

class JoyFeedbackArray(Message):
    @property
    def array(self) -> list[JoyFeedback]: ...
    @array.setter
    def array(self, value: Iterable[JoyFeedback]) -> None: ...
    def __init__(self, *, array: Iterable[JoyFeedback] = ...) -> None: ...

class LaserEcho(Message):
    @property
    def echoes(self) -> npt.NDArray[np.float32]: ...
    @echoes.setter
    def echoes(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, echoes: npt.ArrayLike = ...) -> None: ...

class LaserScan(Message):
    header: _std_msgs_msg.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    @property
    def ranges(self) -> npt.NDArray[np.float32]: ...
    @ranges.setter
    def ranges(self, value: npt.ArrayLike) -> None: ...
    @property
    def intensities(self) -> npt.NDArray[np.float32]: ...
    @intensities.setter
    def intensities(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., angle_min: float = ..., angle_max: float = ..., angle_increment: float = ..., time_increment: float = ..., scan_time: float = ..., range_min: float = ..., range_max: float = ..., ranges: npt.ArrayLike = ..., intensities: npt.ArrayLike = ...) -> None: ...

class MagneticField(Message):
    header: _std_msgs_msg.Header
    magnetic_field: _geometry_msgs_msg.Vector3
    @property
    def magnetic_field_covariance(self) -> npt.NDArray[np.float64]: ...
    @magnetic_field_covariance.setter
    def magnetic_field_covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., magnetic_field: _geometry_msgs_msg.Vector3 = ..., magnetic_field_covariance: npt.ArrayLike = ...) -> None: ...

class MultiDOFJointState(Message):
    header: _std_msgs_msg.Header
    @property
    def joint_names(self) -> list[str]: ...
    @joint_names.setter
    def joint_names(self, value: Iterable[str]) -> None: ...
    @property
    def transforms(self) -> list[_geometry_msgs_msg.Transform]: ...
    @transforms.setter
    def transforms(self, value: Iterable[_geometry_msgs_msg.Transform]) -> None: ...
    @property
    def twist(self) -> list[_geometry_msgs_msg.Twist]: ...
    @twist.setter
    def twist(self, value: Iterable[_geometry_msgs_msg.Twist]) -> None: ...
    @property
    def wrench(self) -> list[_geometry_msgs_msg.Wrench]: ...
    @wrench.setter
    def wrench(self, value: Iterable[_geometry_msgs_msg.Wrench]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., joint_names: Iterable[str] = ..., transforms: Iterable[_geometry_msgs_msg.Transform] = ..., twist: Iterable[_geometry_msgs_msg.Twist] = ..., wrench: Iterable[_geometry_msgs_msg.Wrench] = ...) -> None: ...

class MultiEchoLaserScan(Message):
    header: _std_msgs_msg.Header
    angle_min: float
    angle_max: float
    angle_increment: float
    time_increment: float
    scan_time: float
    range_min: float
    range_max: float
    @property
    def ranges(self) -> list[LaserEcho]: ...
    @ranges.setter
    def ranges(self, value: Iterable[LaserEcho]) -> None: ...
    @property
    def intensities(self) -> list[LaserEcho]: ...
    @intensities.setter
    def intensities(self, value: Iterable[LaserEcho]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., angle_min: float = ..., angle_max: float = ..., angle_increment: float = ..., time_increment: float = ..., scan_time: float = ..., range_min: float = ..., range_max: float = ..., ranges: Iterable[LaserEcho] = ..., intensities: Iterable[LaserEcho] = ...) -> None: ...

class NavSatFix(Message):
    COVARIANCE_TYPE_UNKNOWN: ClassVar[int]
    COVARIANCE_TYPE_APPROXIMATED: ClassVar[int]
    COVARIANCE_TYPE_DIAGONAL_KNOWN: ClassVar[int]
    COVARIANCE_TYPE_KNOWN: ClassVar[int]
    header: _std_msgs_msg.Header
    status: NavSatStatus
    latitude: float
    longitude: float
    altitude: float
    @property
    def position_covariance(self) -> npt.NDArray[np.float64]: ...
    @position_covariance.setter
    def position_covariance(self, value: npt.ArrayLike) -> None: ...
    position_covariance_type: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., status: NavSatStatus = ..., latitude: float = ..., longitude: float = ..., altitude: float = ..., position_covariance: npt.ArrayLike = ..., position_covariance_type: int = ...) -> None: ...

class NavSatStatus(Message):
    STATUS_UNKNOWN: ClassVar[int]
    STATUS_NO_FIX: ClassVar[int]
    STATUS_FIX: ClassVar[int]
    STATUS_SBAS_FIX: ClassVar[int]
    STATUS_GBAS_FIX: ClassVar[int]
    SERVICE_UNKNOWN: ClassVar[int]
    SERVICE_GPS: ClassVar[int]
    SERVICE_GLONASS: ClassVar[int]
    SERVICE_COMPASS: ClassVar[int]
    SERVICE_GALILEO: ClassVar[int]
    status: int
    service: int
    def __init__(self, *, status: int = ..., service: int = ...) -> None: ...

class PointCloud(Message):
    header: _std_msgs_msg.Header
    @property
    def points(self) -> list[_geometry_msgs_msg.Point32]: ...
    @points.setter
    def points(self, value: Iterable[_geometry_msgs_msg.Point32]) -> None: ...
    @property
    def channels(self) -> list[ChannelFloat32]: ...
    @channels.setter
    def channels(self, value: Iterable[ChannelFloat32]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., points: Iterable[_geometry_msgs_msg.Point32] = ..., channels: Iterable[ChannelFloat32] = ...) -> None: ...

class PointCloud2(Message):
    header: _std_msgs_msg.Header
    height: int
    width: int
    @property
    def fields(self) -> list[PointField]: ...
    @fields.setter
    def fields(self, value: Iterable[PointField]) -> None: ...
    is_bigendian: bool
    point_step: int
    row_step: int
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    is_dense: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., height: int = ..., width: int = ..., fields: Iterable[PointField] = ..., is_bigendian: bool = ..., point_step: int = ..., row_step: int = ..., data: npt.ArrayLike = ..., is_dense: bool = ...) -> None: ...

class PointField(Message):
    INT8: ClassVar[int]
    UINT8: ClassVar[int]
    INT16: ClassVar[int]
    UINT16: ClassVar[int]
    INT32: ClassVar[int]
    UINT32: ClassVar[int]
    FLOAT32: ClassVar[int]
    FLOAT64: ClassVar[int]
    name: str
    offset: int
    datatype: int
    count: int
    def __init__(self, *, name: str = ..., offset: int = ..., datatype: int = ..., count: int = ...) -> None: ...

class Range(Message):
    ULTRASOUND: ClassVar[int]
    INFRARED: ClassVar[int]
    header: _std_msgs_msg.Header
    radiation_type: int
    field_of_view: float
    min_range: float
    max_range: float
    range: float
    variance: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., radiation_type: int = ..., field_of_view: float = ..., min_range: float = ..., max_range: float = ..., range: float = ..., variance: float = ...) -> None: ...

class RegionOfInterest(Message):
    x_offset: int
    y_offset: int
    height: int
    width: int
    do_rectify: bool
    def __init__(self, *, x_offset: int = ..., y_offset: int = ..., height: int = ..., width: int = ..., do_rectify: bool = ...) -> None: ...

class RelativeHumidity(Message):
    header: _std_msgs_msg.Header
    relative_humidity: float
    variance: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., relative_humidity: float = ..., variance: float = ...) -> None: ...

class Temperature(Message):
    header: _std_msgs_msg.Header
    temperature: float
    variance: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., temperature: float = ..., variance: float = ...) -> None: ...

class TimeReference(Message):
    header: _std_msgs_msg.Header
    time_ref: _builtin_interfaces_msg.Time
    source: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., time_ref: _builtin_interfaces_msg.Time = ..., source: str = ...) -> None: ...
