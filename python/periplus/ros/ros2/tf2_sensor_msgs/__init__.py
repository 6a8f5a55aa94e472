"""Transformation of point clouds; importing this module registers `PointCloud2` for `Buffer.transform`."""

from tf2_sensor_msgs.tf2_sensor_msgs import (
    do_transform_cloud as do_transform_cloud,
    transform_points as transform_points,
)
