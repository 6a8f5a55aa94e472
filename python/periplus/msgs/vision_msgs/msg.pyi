from collections.abc import Iterable

import periplus.msgs.geometry_msgs.msg as _geometry_msgs_msg
import periplus.msgs.std_msgs.msg as _std_msgs_msg
from periplus.msgs import Message

__all__ = [
    "BoundingBox2D",
    "BoundingBox2DArray",
    "BoundingBox3D",
    "BoundingBox3DArray",
    "Classification",
    "Detection2D",
    "Detection2DArray",
    "Detection3D",
    "Detection3DArray",
    "LabelInfo",
    "ObjectHypothesis",
    "ObjectHypothesisWithPose",
    "Point2D",
    "Pose2D",
    "VisionClass",
    "VisionInfo",
]

class BoundingBox2D(Message):
    center: Pose2D
    size_x: float
    size_y: float
    def __init__(self, *, center: Pose2D = ..., size_x: float = ..., size_y: float = ...) -> None: ...

class BoundingBox2DArray(Message):
    header: _std_msgs_msg.Header
    @property
    def boxes(self) -> list[BoundingBox2D]: ...
    @boxes.setter
    def boxes(self, value: Iterable[BoundingBox2D]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., boxes: Iterable[BoundingBox2D] = ...) -> None: ...

class BoundingBox3D(Message):
    center: _geometry_msgs_msg.Pose
    size: _geometry_msgs_msg.Vector3
    def __init__(self, *, center: _geometry_msgs_msg.Pose = ..., size: _geometry_msgs_msg.Vector3 = ...) -> None: ...

class BoundingBox3DArray(Message):
    header: _std_msgs_msg.Header
    @property
    def boxes(self) -> list[BoundingBox3D]: ...
    @boxes.setter
    def boxes(self, value: Iterable[BoundingBox3D]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., boxes: Iterable[BoundingBox3D] = ...) -> None: ...

class Classification(Message):
    header: _std_msgs_msg.Header
    @property
    def results(self) -> list[ObjectHypothesis]: ...
    @results.setter
    def results(self, value: Iterable[ObjectHypothesis]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., results: Iterable[ObjectHypothesis] = ...) -> None: ...

class Detection2D(Message):
    header: _std_msgs_msg.Header
    @property
    def results(self) -> list[ObjectHypothesisWithPose]: ...
    @results.setter
    def results(self, value: Iterable[ObjectHypothesisWithPose]) -> None: ...
    bbox: BoundingBox2D
    id: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., results: Iterable[ObjectHypothesisWithPose] = ..., bbox: BoundingBox2D = ..., id: str = ...) -> None: ...

class Detection2DArray(Message):
    header: _std_msgs_msg.Header
    @property
    def detections(self) -> list[Detection2D]: ...
    @detections.setter
    def detections(self, value: Iterable[Detection2D]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., detections: Iterable[Detection2D] = ...) -> None: ...

class Detection3D(Message):
    header: _std_msgs_msg.Header
    @property
    def results(self) -> list[ObjectHypothesisWithPose]: ...
    @results.setter
    def results(self, value: Iterable[ObjectHypothesisWithPose]) -> None: ...
    bbox: BoundingBox3D
    id: str
    def __init__(self, *, header: _std_msgs_msg.Header = ..., results: Iterable[ObjectHypothesisWithPose] = ..., bbox: BoundingBox3D = ..., id: str = ...) -> None: ...

class Detection3DArray(Message):
    header: _std_msgs_msg.Header
    @property
    def detections(self) -> list[Detection3D]: ...
    @detections.setter
    def detections(self, value: Iterable[Detection3D]) -> None: ...
    def __init__(self, *, header: _std_msgs_msg.Header = ..., detections: Iterable[Detection3D] = ...) -> None: ...

class LabelInfo(Message):
    header: _std_msgs_msg.Header
    @property
    def class_map(self) -> list[VisionClass]: ...
    @class_map.setter
    def class_map(self, value: Iterable[VisionClass]) -> None: ...
    threshold: float
    def __init__(self, *, header: _std_msgs_msg.Header = ..., class_map: Iterable[VisionClass] = ..., threshold: float = ...) -> None: ...

class ObjectHypothesis(Message):
    class_id: str
    score: float
    def __init__(self, *, class_id: str = ..., score: float = ...) -> None: ...

class ObjectHypothesisWithPose(Message):
    hypothesis: ObjectHypothesis
    pose: _geometry_msgs_msg.PoseWithCovariance
    def __init__(self, *, hypothesis: ObjectHypothesis = ..., pose: _geometry_msgs_msg.PoseWithCovariance = ...) -> None: ...

class Point2D(Message):
    x: float
    y: float
    def __init__(self, *, x: float = ..., y: float = ...) -> None: ...

class Pose2D(Message):
    position: Point2D
    theta: float
    def __init__(self, *, position: Point2D = ..., theta: float = ...) -> None: ...

class VisionClass(Message):
    class_id: int
    class_name: str
    def __init__(self, *, class_id: int = ..., class_name: str = ...) -> None: ...

class VisionInfo(Message):
    header: _std_msgs_msg.Header
    method: str
    database_location: str
    database_version: int
    def __init__(self, *, header: _std_msgs_msg.Header = ..., method: str = ..., database_location: str = ..., database_version: int = ...) -> None: ...
