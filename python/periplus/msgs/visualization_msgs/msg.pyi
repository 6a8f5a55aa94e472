from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.builtin_interfaces.msg as _builtin_interfaces_msg
import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.sensor_msgs.msg as _sensor_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "ImageMarker",
    "InteractiveMarker",
    "InteractiveMarkerControl",
    "InteractiveMarkerFeedback",
    "InteractiveMarkerInit",
    "InteractiveMarkerPose",
    "InteractiveMarkerUpdate",
    "Marker",
    "MarkerArray",
    "MenuEntry",
    "MeshFile",
    "UVCoordinate",
]

class ImageMarker(Message):
    CIRCLE: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    POLYGON: ClassVar[int]
    POINTS: ClassVar[int]
    ADD: ClassVar[int]
    REMOVE: ClassVar[int]
    header: _std_msgs_msg.Header
    ns: str
    id: int
    type: int
    action: int
    position: _geometry_msgs_msg.Point
    scale: float
    outline_color: _std_msgs_msg.ColorRGBA
    filled: int
    fill_color: _std_msgs_msg.ColorRGBA
    lifetime: _builtin_interfaces_msg.Duration
    @property
    def points(self) -> list[_geometry_msgs_msg.Point]: ...
    @points.setter
    def points(self, value: Iterable[_geometry_msgs_msg.Point]) -> None: ...
    @property
    def outline_colors(self) -> list[_std_msgs_msg.ColorRGBA]: ...
    @outline_colors.setter
    def outline_colors(self, value: Iterable[_std_msgs_msg.ColorRGBA]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., position: _geometry_msgs_msg.Point = ..., scale: float = ..., outline_color: _std_msgs_msg.ColorRGBA = ..., filled: int = ..., fill_color: _std_msgs_msg.ColorRGBA = ..., lifetime: _builtin_interfaces_msg.Duration = ..., points: Iterable[_geometry_msgs_msg.Point] = ..., outline_colors: Iterable[_std_msgs_msg.ColorRGBA] = ...) -> None: ...

class InteractiveMarker(Message):
    header: _std_msgs_msg.Header
    pose: _geometry_msgs_msg.Pose
    name: str
    description: str
    scale: float
    @property
    def menu_entries(self) -> list[MenuEntry]: ...
    @menu_entries.setter
    def menu_entries(self, value: Iterable[MenuEntry]) -> None: ...
    @property
    def controls(self) -> list[InteractiveMarkerControl]: ...
    @controls.setter
    def controls(self, value: Iterable[InteractiveMarkerControl]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: _geometry_msgs_msg.Pose = ..., name: str = ..., description: str = ..., scale: float = ..., menu_entries: Iterable[MenuEntry] = ..., controls: Iterable[InteractiveMarkerControl] = ...) -> None: ...

class InteractiveMarkerControl(Message):
    INHERIT: ClassVar[int]
    FIXED: ClassVar[int]
    VIEW_FACING: ClassVar[int]
    NONE: ClassVar[int]
    MENU: ClassVar[int]
    BUTTON: ClassVar[int]
    MOVE_AXIS: ClassVar[int]
    MOVE_PLANE: ClassVar[int]
    ROTATE_AXIS: ClassVar[int]
    MOVE_ROTATE: ClassVar[int]
    MOVE_3D: ClassVar[int]
    ROTATE_3D: ClassVar[int]
    MOVE_ROTATE_3D: ClassVar[int]
    name: str
    orientation: _geometry_msgs_msg.Quaternion
    orientation_mode: int
    interaction_mode: int
    always_visible: bool
    @property
    def markers(self) -> list[Marker]: ...
    @markers.setter
    def markers(self, value: Iterable[Marker]) -> None: ...
    independent_marker_orientation: bool
    description: str
    def __init__(self, *, name: str = ..., orientation: _geometry_msgs_msg.Quaternion = ..., orientation_mode: int = ..., interaction_mode: int = ..., always_visible: bool = ..., markers: Iterable[Marker] = ..., independent_marker_orientation: bool = ..., description: str = ...) -> None: ...

class InteractiveMarkerFeedback(Message):
    KEEP_ALIVE: ClassVar[int]
    POSE_UPDATE: ClassVar[int]
    MENU_SELECT: ClassVar[int]
    BUTTON_CLICK: ClassVar[int]
    MOUSE_DOWN: ClassVar[int]
    MOUSE_UP: ClassVar[int]
    header: _std_msgs_msg.Header
    client_id: str
    marker_name: str
    control_name: str
    event_type: int
    pose: _geometry_msgs_msg.Pose
    menu_entry_id: int
    mouse_point: _geometry_msgs_msg.Point
    mouse_point_valid: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., client_id: str = ..., marker_name: str = ..., control_name: str = ..., event_type: int = ..., pose: _geometry_msgs_msg.Pose = ..., menu_entry_id: int = ..., mouse_point: _geometry_msgs_msg.Point = ..., mouse_point_valid: bool = ...) -> None: ...

class InteractiveMarkerInit(Message):
    server_id: str
    seq_num: int
    @property
    def markers(self) -> list[InteractiveMarker]: ...
    @markers.setter
    def markers(self, value: Iterable[InteractiveMarker]) -> None: ...
    def __init__(self, *, server_id: str = ..., seq_num: int = ..., markers: Iterable[InteractiveMarker] = ...) -> None: ...

class InteractiveMarkerPose(Message):
    header: _std_msgs_msg.Header
    pose: _geometry_msgs_msg.Pose
    name: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., pose: _geometry_msgs_msg.Pose = ..., name: str = ...) -> None: ...

class InteractiveMarkerUpdate(Message):
    KEEP_ALIVE: ClassVar[int]
    UPDATE: ClassVar[int]
    server_id: str
    seq_num: int
    type: int
    @property
    def markers(self) -> list[InteractiveMarker]: ...
    @markers.setter
    def markers(self, value: Iterable[InteractiveMarker]) -> None: ...
    @property
    def poses(self) -> list[InteractiveMarkerPose]: ...
    @poses.setter
    def poses(self, value: Iterable[InteractiveMarkerPose]) -> None: ...
    @property
    def erases(self) -> list[str]: ...
    @erases.setter
    def erases(self, value: Iterable[str]) -> None: ...
    def __init__(self, *, server_id: str = ..., seq_num: int = ..., type: int = ..., markers: Iterable[InteractiveMarker] = ..., poses: Iterable[InteractiveMarkerPose] = ..., erases: Iterable[str] = ...) -> None: ...

class Marker(Message):
    ARROW: ClassVar[int]
    CUBE: ClassVar[int]
    SPHERE: ClassVar[int]
    CYLINDER: ClassVar[int]
    LINE_STRIP: ClassVar[int]
    LINE_LIST: ClassVar[int]
    CUBE_LIST: ClassVar[int]
    SPHERE_LIST: ClassVar[int]
    POINTS: ClassVar[int]
    TEXT_VIEW_FACING: ClassVar[int]
    MESH_RESOURCE: ClassVar[int]
    TRIANGLE_LIST: ClassVar[int]
    ARROW_STRIP: ClassVar[int]
    ADD: ClassVar[int]
    MODIFY: ClassVar[int]
    DELETE: ClassVar[int]
    DELETEALL: ClassVar[int]
    header: _std_msgs_msg.Header
    ns: str
    id: int
    type: int
    action: int
    pose: _geometry_msgs_msg.Pose
    scale: _geometry_msgs_msg.Vector3
    color: _std_msgs_msg.ColorRGBA
    lifetime: _builtin_interfaces_msg.Duration
    frame_locked: bool
    @property
    def points(self) -> list[_geometry_msgs_msg.Point]: ...
    @points.setter
    def points(self, value: Iterable[_geometry_msgs_msg.Point]) -> None: ...
    @property
    def colors(self) -> list[_std_msgs_msg.ColorRGBA]: ...
    @colors.setter
    def colors(self, value: Iterable[_std_msgs_msg.ColorRGBA]) -> None: ...
    texture_resource: str
    texture: _sensor_msgs_msg.CompressedImage
    @property
    def uv_coordinates(self) -> list[UVCoordinate]: ...
    @uv_coordinates.setter
    def uv_coordinates(self, value: Iterable[UVCoordinate]) -> None: ...
    text: str
    mesh_resource: str
    mesh_file: MeshFile
    mesh_use_embedded_materials: bool
    def __init__(self, *, header: _std_msgs_msg.Header = ..., ns: str = ..., id: int = ..., type: int = ..., action: int = ..., pose: _geometry_msgs_msg.Pose = ..., scale: _geometry_msgs_msg.Vector3 = ..., color: _std_msgs_msg.ColorRGBA = ..., lifetime: _builtin_interfaces_msg.Duration = ..., frame_locked: bool = ..., points: Iterable[_geometry_msgs_msg.Point] = ..., colors: Iterable[_std_msgs_msg.ColorRGBA] = ..., texture_resource: str = ..., texture: _sensor_msgs_msg.CompressedImage = ..., uv_coordinates: Iterable[UVCoordinate] = ..., text: str = ..., mesh_resource: str = ..., mesh_file: MeshFile = ..., mesh_use_embedded_materials: bool = ...) -> None: ...

class MarkerArray(Message):
    @property
    def markers(self) -> list[Marker]: ...
    @markers.setter
    def markers(self, value: Iterable[Marker]) -> None: ...
    def __init__(self, *, markers: Iterable[Marker] = ...) -> None: ...

class MenuEntry(Message):
    FEEDBACK: ClassVar[int]
    ROSRUN: ClassVar[int]
    ROSLAUNCH: ClassVar[int]
    id: int
    parent_id: int
    title: str
    command: str
    command_type: int
    def __init__(self, *, id: int = ..., parent_id: int = ..., title: str = ..., command: str = ..., command_type: int = ...) -> None: ...

class MeshFile(Message):
    filename: str
    @property
    def data(self) -> npt.NDArray[np.uint8]: ...
    @data.setter
    def data(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, filename: str = ..., data: npt.ArrayLike = ...) -> None: ...

class UVCoordinate(Message):
    u: float
    v: float
    def __init__(self, *, u: float = ..., v: float = ...) -> None: ...
