//! Layouts of `sensor_msgs/PointCloud2`.

use periplus_msgs::sensor_msgs::{PointCloud2, PointField};
use periplus_msgs::std_msgs::Header;

/// A field of a point cloud.
#[derive(Clone, Copy)]
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) offset: u32,
    pub(crate) datatype: u8,
}

/// Memory layout of a point cloud.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    pub(crate) columns: &'static [Column],
    /// Bytes per point.
    pub(crate) point_step: u32,
}

const fn float(name: &'static str, offset: u32) -> Column {
    Column { name, offset, datatype: PointField::FLOAT32 }
}

/// Classic's lasers: four adjacent floats (`setPointCloud2Fields` of gazebo_ros).
pub(crate) const CLASSIC_LASER: Layout = Layout {
    columns: &[float("x", 0), float("y", 4), float("z", 8), float("intensity", 12)],
    point_step: 16,
};

/// Gazebo's lidars: positions padded to 16 bytes (`InitPointCloudPacked` of gz-msgs).
pub(crate) const GZ_LIDAR: Layout = Layout {
    columns: &[
        float("x", 0),
        float("y", 4),
        float("z", 8),
        float("intensity", 16),
        Column { name: "ring", offset: 24, datatype: PointField::UINT16 },
    ],
    point_step: 32,
};

/// Returns a cloud of this width and height with the given bytes.
pub(crate) fn cloud(
    header: Header,
    layout: Layout,
    [width, height]: [usize; 2],
    is_dense: bool,
    data: Vec<u8>,
) -> PointCloud2 {
    let fields = layout.columns.iter().map(|column| PointField {
        name: column.name.into(),
        offset: column.offset,
        datatype: column.datatype,
        count: 1,
    });
    let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
    PointCloud2 {
        header,
        height: count(height),
        width: count(width),
        fields: fields.collect(),
        is_bigendian: false,
        point_step: layout.point_step,
        row_step: layout.point_step.saturating_mul(count(width)),
        data,
        is_dense,
    }
}
