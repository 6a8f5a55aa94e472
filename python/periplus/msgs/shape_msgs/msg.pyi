from collections.abc import Iterable
from typing import ClassVar

import numpy as np
import numpy.typing as npt

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
from periplus.msgs import Message

__all__ = [
    "Mesh",
    "MeshTriangle",
    "Plane",
    "SolidPrimitive",
]

class Mesh(Message):
    @property
    def triangles(self) -> list[MeshTriangle]: ...
    @triangles.setter
    def triangles(self, value: Iterable[MeshTriangle]) -> None: ...
    @property
    def vertices(self) -> list[_geometry_msgs_msg.Point]: ...
    @vertices.setter
    def vertices(self, value: Iterable[_geometry_msgs_msg.Point]) -> None: ...
    def __init__(self, *, triangles: Iterable[MeshTriangle] = ..., vertices: Iterable[_geometry_msgs_msg.Point] = ...) -> None: ...

class MeshTriangle(Message):
    @property
    def vertex_indices(self) -> npt.NDArray[np.uint32]: ...
    @vertex_indices.setter
    def vertex_indices(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, vertex_indices: npt.ArrayLike = ...) -> None: ...

class Plane(Message):
    @property
    def coef(self) -> npt.NDArray[np.float64]: ...
    @coef.setter
    def coef(self, value: npt.ArrayLike) -> None: ...
    def __init__(self, *, coef: npt.ArrayLike = ...) -> None: ...

class SolidPrimitive(Message):
    BOX: ClassVar[int]
    SPHERE: ClassVar[int]
    CYLINDER: ClassVar[int]
    CONE: ClassVar[int]
    PRISM: ClassVar[int]
    BOX_X: ClassVar[int]
    BOX_Y: ClassVar[int]
    BOX_Z: ClassVar[int]
    SPHERE_RADIUS: ClassVar[int]
    CYLINDER_HEIGHT: ClassVar[int]
    CYLINDER_RADIUS: ClassVar[int]
    CONE_HEIGHT: ClassVar[int]
    CONE_RADIUS: ClassVar[int]
    PRISM_HEIGHT: ClassVar[int]
    type: int
    @property
    def dimensions(self) -> npt.NDArray[np.float64]: ...
    @dimensions.setter
    def dimensions(self, value: npt.ArrayLike) -> None: ...
    polygon: _geometry_msgs_msg.Polygon
    def __init__(self, *, type: int = ..., dimensions: npt.ArrayLike = ..., polygon: _geometry_msgs_msg.Polygon = ...) -> None: ...
