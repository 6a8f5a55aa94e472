"""Transformation of point clouds."""

from __future__ import annotations

from typing import Any

import numpy as np
from geometry_msgs.msg import Transform, TransformStamped
from sensor_msgs.msg import PointCloud2
from sensor_msgs_py.point_cloud2 import create_cloud, read_points
from tf2_ros.buffer_interface import ConvertRegistration, TransformRegistration

# Names of vectors in a cloud: positions, and directions that are only rotated.
_POSITIONS = (("x", "y", "z"), ("vp_x", "vp_y", "vp_z"))
_DIRECTIONS = (("normal_x", "normal_y", "normal_z"),)


def _rotation(transform: Transform) -> Any:
    rotation = transform.rotation
    x, y, z, w = rotation.x, rotation.y, rotation.z, rotation.w
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def transform_points(point_cloud: Any, transform: Transform) -> Any:
    """Points (N, 3) moved by a transform."""
    translation = transform.translation
    moved = np.asarray(point_cloud) @ _rotation(transform).T
    return moved + np.array([translation.x, translation.y, translation.z])


def do_transform_cloud(cloud: PointCloud2, transform: TransformStamped) -> PointCloud2:
    """Cloud in the frame of the transform."""
    points = read_points(cloud).copy()
    names = points.dtype.names or ()
    for group in (*_POSITIONS, *_DIRECTIONS):
        if not all(name in names for name in group):
            continue
        values = np.stack([points[name] for name in group], axis=-1).astype(np.float64)
        if group in _DIRECTIONS:
            moved = values @ _rotation(transform.transform).T
        else:
            moved = transform_points(values, transform.transform)
        for index, name in enumerate(group):
            points[name] = moved[..., index]
    made = create_cloud(transform.header, cloud.fields, points, point_step=cloud.point_step)
    made.height, made.width, made.row_step = cloud.height, cloud.width, cloud.row_step
    made.is_dense, made.is_bigendian = cloud.is_dense, cloud.is_bigendian
    return made


TransformRegistration().add(PointCloud2, do_transform_cloud)
ConvertRegistration().add_to_msg(PointCloud2, lambda msg: msg)
ConvertRegistration().add_from_msg(PointCloud2, lambda msg: msg)
