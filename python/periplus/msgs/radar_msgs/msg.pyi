from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
import periplus.msgs.unique_identifier_msgs.msg as _unique_identifier_msgs_msg
from periplus.msgs import Message

__all__ = [
    "RadarReturn",
    "RadarScan",
    "RadarTrack",
    "RadarTracks",
]

class RadarReturn(Message):
    range: float
    azimuth: float
    elevation: float
    doppler_velocity: float
    amplitude: float
    def __init__(self, *, range: float = ..., azimuth: float = ..., elevation: float = ..., doppler_velocity: float = ..., amplitude: float = ...) -> None: ...

class RadarScan(Message):
    header: _std_msgs_msg.Header
    @property
    def returns(self) -> list[RadarReturn]: ...
    @returns.setter
    def returns(self, value: Iterable[RadarReturn]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., returns: Iterable[RadarReturn] = ...) -> None: ...

class RadarTrack(Message):
    NO_CLASSIFICATION: ClassVar[int]
    STATIC: ClassVar[int]
    DYNAMIC: ClassVar[int]
    uuid: _unique_identifier_msgs_msg.UUID
    position: _geometry_msgs_msg.Point
    velocity: _geometry_msgs_msg.Vector3
    acceleration: _geometry_msgs_msg.Vector3
    size: _geometry_msgs_msg.Vector3
    classification: int
    @property
    def position_covariance(self) -> npt.NDArray[np.float32]: ...
    @position_covariance.setter
    def position_covariance(self, value: npt.ArrayLike) -> None: ...
    @property
    def velocity_covariance(self) -> npt.NDArray[np.float32]: ...
    @velocity_covariance.setter
    def velocity_covariance(self, value: npt.ArrayLike) -> None: ...
    @property
    def acceleration_covariance(self) -> npt.NDArray[np.float32]: ...
    @acceleration_covariance.setter
    def acceleration_covariance(self, value: npt.ArrayLike) -> None: ...
    @property
    def size_covariance(self) -> npt.NDArray[np.float32]: ...
    @size_covariance.setter
    def size_covariance(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, uuid: _unique_identifier_msgs_msg.UUID = ..., position: _geometry_msgs_msg.Point = ..., velocity: _geometry_msgs_msg.Vector3 = ..., acceleration: _geometry_msgs_msg.Vector3 = ..., size: _geometry_msgs_msg.Vector3 = ..., classification: int = ..., position_covariance: npt.ArrayLike = ..., velocity_covariance: npt.ArrayLike = ..., acceleration_covariance: npt.ArrayLike = ..., size_covariance: npt.ArrayLike = ...) -> None: ...

class RadarTracks(Message):
    header: _std_msgs_msg.Header
    @property
    def tracks(self) -> list[RadarTrack]: ...
    @tracks.setter
    def tracks(self, value: Iterable[RadarTrack]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., tracks: Iterable[RadarTrack] = ...) -> None: ...
