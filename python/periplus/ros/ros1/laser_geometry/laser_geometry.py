"""Projection of laser scans to points."""

from __future__ import annotations

from typing import Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField


class LaserProjection:
    """Makes point clouds of laser scans."""

    class ChannelOption:
        """Values beside x, y and z."""

        NONE = 0x00
        INTENSITY = 0x01
        INDEX = 0x02
        DISTANCE = 0x04
        TIMESTAMP = 0x08
        VIEWPOINT = 0x10
        DEFAULT = INTENSITY | INDEX

    def projectLaser(  # noqa: N802
        self, scan_in: Any, range_cutoff: float = -1.0, channel_options: int = ChannelOption.DEFAULT
    ) -> Any:
        """`PointCloud2` in the frame of the scan.

        Args:
            scan_in: `LaserScan`.
            range_cutoff: Largest range that is used [m]; negative for that of the scan.
            channel_options: Values beside x, y and z, of `ChannelOption`.
        """
        ranges = np.array(scan_in.ranges, dtype=np.float64)
        count = len(ranges)
        angles = scan_in.angle_min + np.arange(count) * scan_in.angle_increment
        limit = scan_in.range_max if range_cutoff < 0 else min(range_cutoff, scan_in.range_max)
        with np.errstate(invalid="ignore"):
            kept = np.flatnonzero((ranges >= scan_in.range_min) & (ranges < limit))
        used = ranges[kept]
        columns = {"x": used * np.cos(angles[kept]), "y": used * np.sin(angles[kept]), "z": np.zeros(len(kept))}
        option = self.ChannelOption
        if channel_options & option.INTENSITY and len(scan_in.intensities) == count:
            columns["intensity"] = np.array(scan_in.intensities)[kept]
        if channel_options & option.INDEX:
            columns["index"] = kept
        if channel_options & option.DISTANCE:
            columns["distances"] = used
        if channel_options & option.TIMESTAMP:
            columns["stamps"] = kept * scan_in.time_increment
        dtype = [(name, "<i4" if name == "index" else "<f4") for name in columns]
        points = np.zeros(len(kept), dtype)
        for name, values in columns.items():
            points[name] = values
        fields = [
            PointField(
                name=name,
                offset=4 * index,
                datatype=PointField.INT32 if kind == "<i4" else PointField.FLOAT32,
                count=1,
            )
            for index, (name, kind) in enumerate(dtype)
        ]
        step = points.dtype.itemsize
        return PointCloud2(
            header=scan_in.header,
            height=1,
            width=len(points),
            fields=fields,
            is_bigendian=False,
            point_step=step,
            row_step=step * len(points),
            data=points.tobytes(),
            is_dense=False,
        )
