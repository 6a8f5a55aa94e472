"""Points of `PointCloud2` messages."""

from __future__ import annotations

import math
import struct
from collections import namedtuple
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from sensor_msgs.msg import PointCloud2, PointField

_DATATYPES = {
    PointField.INT8: ("b", 1),
    PointField.UINT8: ("B", 1),
    PointField.INT16: ("h", 2),
    PointField.UINT16: ("H", 2),
    PointField.INT32: ("i", 4),
    PointField.UINT32: ("I", 4),
    PointField.FLOAT32: ("f", 4),
    PointField.FLOAT64: ("d", 8),
}


def read_points(
    cloud: Any, field_names: Sequence[str] | None = None, skip_nans: bool = False, uvs: Iterable[Any] = ()
) -> Iterator[tuple[Any, ...]]:
    """Points of a cloud, as tuples of their fields.

    Args:
        cloud: `PointCloud2`.
        field_names: Names of the fields (default all).
        skip_nans: Leaves out points with a value that is not a number.
        uvs: Columns and rows of the points (default all points).
    """
    reader = struct.Struct(_get_struct_fmt(cloud.is_bigendian, cloud.fields, field_names))
    data = bytes(cloud.data)
    wanted = list(uvs)
    places = wanted if wanted else ((u, v) for v in range(cloud.height) for u in range(cloud.width))
    for u, v in places:
        point = reader.unpack_from(data, v * cloud.row_step + u * cloud.point_step)
        if not (skip_nans and any(isinstance(one, float) and math.isnan(one) for one in point)):
            yield point


def read_points_list(
    cloud: Any, field_names: Sequence[str] | None = None, skip_nans: bool = False, uvs: Iterable[Any] = ()
) -> list[Any]:
    """Points of a cloud, as a list of named tuples."""
    names = [one.name for one in sorted(cloud.fields, key=lambda one: one.offset)]
    if field_names is not None:
        names = [one for one in names if one in field_names]
    point = namedtuple("Point", names)  # type: ignore[misc]
    return [point._make(one) for one in read_points(cloud, field_names, skip_nans, uvs)]


def create_cloud(header: Any, fields: Sequence[Any], points: Iterable[Any]) -> Any:
    """`PointCloud2` of points with these fields."""
    writer = struct.Struct(_get_struct_fmt(False, fields))
    data = b"".join(writer.pack(*point) for point in points)
    count = len(data) // writer.size if writer.size else 0
    return PointCloud2(
        header=header,
        height=1,
        width=count,
        is_dense=False,
        is_bigendian=False,
        fields=list(fields),
        point_step=writer.size,
        row_step=writer.size * count,
        data=data,
    )


def create_cloud_xyz32(header: Any, points: Iterable[Any]) -> Any:
    """`PointCloud2` of points x, y, z in single precision."""
    fields = [PointField(name, 4 * index, PointField.FLOAT32, 1) for index, name in enumerate("xyz")]
    return create_cloud(header, fields, points)


def _get_struct_fmt(is_bigendian: bool, fields: Sequence[Any], field_names: Sequence[str] | None = None) -> str:
    """Format of a point for `struct`, with gaps for the fields that are left out."""
    text, offset = ">" if is_bigendian else "<", 0
    for one in sorted(fields, key=lambda one: one.offset):
        if field_names is not None and one.name not in field_names:
            continue
        if one.datatype not in _DATATYPES:
            raise ValueError(f"field {one.name} has the unknown type {one.datatype}")
        text += "x" * (one.offset - offset)
        code, size = _DATATYPES[one.datatype]
        text += code * one.count
        offset = one.offset + size * one.count
    return text
