"""Point clouds as numpy arrays."""

import numpy as np
import pytest

import periplus.ros

periplus.ros.activate(quiet=True)

from sensor_msgs.msg import PointField  # noqa: E402
from sensor_msgs_py import point_cloud2  # noqa: E402
from std_msgs.msg import Header  # noqa: E402

FIELDS = [
    PointField(name="x", offset=0, datatype=PointField.FLOAT32, count=1),
    PointField(name="intensity", offset=4, datatype=PointField.UINT16, count=1),
    PointField(name="t", offset=8, datatype=PointField.FLOAT64, count=1),
]


def test_fields_of_several_types() -> None:
    cloud = point_cloud2.create_cloud(Header(), FIELDS, [(1.0, 7, 0.5), (2.0, 8, np.nan)])
    assert (cloud.point_step, cloud.width, cloud.height) == (16, 2, 1)
    points = point_cloud2.read_points(cloud)
    assert points["intensity"].tolist() == [7, 8]
    assert len(point_cloud2.read_points(cloud, skip_nans=True)) == 1
    assert point_cloud2.read_points_list(cloud, ["t"])[0].t == 0.5
    with pytest.raises(AssertionError, match="same datatype"):
        point_cloud2.read_points_numpy(cloud)


def test_fields_with_a_count() -> None:
    fields = [PointField(name="v", offset=0, datatype=PointField.FLOAT32, count=3), PointField(name="", offset=12, datatype=PointField.UINT8, count=1)]
    assert point_cloud2.dtype_from_fields(fields).names == ("v_0", "v_1", "v_2", "unnamed_field_1")


def test_organized_clouds() -> None:
    values = np.arange(24, dtype=np.float32).reshape(4, 2, 3)
    cloud = point_cloud2.create_cloud_xyz32(Header(), values)
    assert (cloud.width, cloud.height) == (4, 2)
    assert point_cloud2.read_points(cloud, reshape_organized_cloud=True).shape == (4, 2)
    assert np.array_equal(point_cloud2.read_points_numpy(cloud, reshape_organized_cloud=True), values)


def test_points_by_index() -> None:
    cloud = point_cloud2.create_cloud_xyz32(Header(), np.arange(9).reshape(3, 3))
    assert point_cloud2.read_points(cloud, uvs=[2, 0])["x"].tolist() == [6.0, 0.0]
