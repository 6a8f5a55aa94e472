"""Points of `sensor_msgs/PointCloud2` messages as numpy arrays, and messages of points."""

from __future__ import annotations

import sys
from array import array
from collections import namedtuple
from collections.abc import Iterable
from typing import Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField
from sensor_msgs_py.numpy_compat import structured_to_unstructured, unstructured_to_structured
from std_msgs.msg import Header

_DATATYPES: dict[int, Any] = {
    PointField.INT8: np.dtype(np.int8),
    PointField.UINT8: np.dtype(np.uint8),
    PointField.INT16: np.dtype(np.int16),
    PointField.UINT16: np.dtype(np.uint16),
    PointField.INT32: np.dtype(np.int32),
    PointField.UINT32: np.dtype(np.uint32),
    PointField.FLOAT32: np.dtype(np.float32),
    PointField.FLOAT64: np.dtype(np.float64),
}

DUMMY_FIELD_PREFIX = "unnamed_field"


def read_points(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> Any:
    """Points of a cloud as a structured array.

    `uvs` selects points by their indices. With `reshape_organized_cloud` an organized cloud has the shape
    (width, height), as in ROS.
    """
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    dtype = dtype_from_fields(cloud.fields, point_step=cloud.point_step)
    points = np.ndarray(shape=(cloud.width * cloud.height,), dtype=dtype, buffer=cloud.data)
    if field_names is not None:
        assert all(name in (points.dtype.names or ()) for name in field_names), (
            "Requests field is not in the fields of the PointCloud!"
        )
        points = points[list(field_names)]
    if (sys.byteorder != "little") != bool(cloud.is_bigendian):
        points = points.byteswap()
    if skip_nans and not cloud.is_dense:
        keep = np.ones(len(points), dtype=bool)
        for name in points.dtype.names or ():
            if points.dtype[name].kind == "f":
                keep &= ~np.isnan(points[name])
        points = points[keep]
    if uvs is not None:
        points = points[uvs if isinstance(uvs, np.ndarray) else np.fromiter(uvs, int)]
    if reshape_organized_cloud and cloud.height > 1:
        points = points.reshape(cloud.width, cloud.height)
    return points


def read_points_numpy(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
    reshape_organized_cloud: bool = False,
) -> Any:
    """Points of a cloud whose fields have one type, as a plain array (N, number of fields)."""
    types = {field.datatype for field in cloud.fields if field_names is None or field.name in field_names}
    assert len(types) <= 1, "All fields need to have the same datatype. Use `read_points()` otherwise."
    return structured_to_unstructured(read_points(cloud, field_names, skip_nans, uvs, reshape_organized_cloud))


def read_points_list(
    cloud: PointCloud2,
    field_names: list[str] | None = None,
    skip_nans: bool = False,
    uvs: Iterable[int] | None = None,
) -> list[Any]:
    """Points of a cloud as named tuples."""
    assert isinstance(cloud, PointCloud2), "Cloud is not a sensor_msgs.msg.PointCloud2"
    points = read_points(cloud, field_names, skip_nans, uvs)
    kind = namedtuple("Point", points.dtype.names, rename=True)  # type: ignore[misc]
    return [kind._make(one) for one in points]


def dtype_from_fields(fields: Iterable[PointField], point_step: int | None = None) -> Any:
    """Type of the points of a cloud with these fields."""
    names: list[str] = []
    formats: list[str] = []
    offsets: list[int] = []
    for index, field in enumerate(fields):
        kind = _DATATYPES[field.datatype]
        name = field.name or f"{DUMMY_FIELD_PREFIX}_{index}"
        assert field.count > 0, "Can't process fields with count = 0."
        for number in range(field.count):
            one = f"{name}_{number}" if field.count > 1 else name
            assert one not in names, "Duplicate field names are not allowed!"
            names.append(one)
            formats.append(kind.str)
            offsets.append(field.offset + number * kind.itemsize)
    made: dict[str, Any] = {"names": names, "formats": formats, "offsets": offsets}
    if point_step is not None:
        made["itemsize"] = point_step
    spec: Any = made
    return np.dtype(spec)


def create_cloud(
    header: Header,
    fields: Iterable[PointField],
    points: Any,
    point_step: int | None = None,
) -> PointCloud2:
    """Cloud of points: a structured array, a plain array (N, number of fields) or a list of tuples."""
    fields = list(fields)
    dtype = dtype_from_fields(fields, point_step)
    if not isinstance(points, np.ndarray):
        points = np.array([tuple(one) for one in points], dtype=dtype)
    elif points.dtype.names is None:
        assert len({field.datatype for field in fields}) <= 1, (
            "All fields need to have the same datatype. Pass a structured NumPy array with multiple dtypes otherwise."
        )
        points = unstructured_to_structured(points, dtype=dtype)
    else:
        assert points.dtype == dtype, (
            "PointFields and structured NumPy array dtype do not match for all fields! "
            "Check their field order, names and types."
        )
    assert points.ndim <= 2, (
        "Too many dimensions for organized cloud! Points can only be organized in max. two dimensional space"
    )
    data = array("B")
    data.frombytes(np.ascontiguousarray(points).tobytes())
    width = points.shape[0]
    cloud = PointCloud2(
        header=header,
        height=points.shape[1] if points.ndim == 2 else 1,
        width=width,
        is_dense=False,
        is_bigendian=sys.byteorder != "little",
        fields=fields,
        point_step=points.dtype.itemsize,
        row_step=points.dtype.itemsize * width,
    )
    cloud.data = data
    return cloud


def create_cloud_xyz32(header: Header, points: Any) -> PointCloud2:
    """Cloud with the fields x, y and z (float32)."""
    fields = [
        PointField(name=name, offset=4 * index, datatype=PointField.FLOAT32, count=1) for index, name in enumerate("xyz")
    ]
    return create_cloud(header, fields, points)
