//! Point clouds of depth cameras.

use periplus_msgs::sensor_msgs::{PointCloud2, PointField};
use periplus_msgs::std_msgs::Header;
use periplus_rendering::RenderedImages;
use periplus_sensors::Pinhole;

use super::super::cloud::{Column, Layout};

/// Layout and axes of the points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cloud {
    /// Classic: the optical frame (x right, y down, z forward), 32 bytes.
    Classic,
    /// The same with red and blue swapped, as in `gazebo_ros_camera`.
    ClassicSwapped,
    /// Gazebo: x forward, y left, z up, 24 bytes.
    Gz,
}

const COLUMNS: &[Column] = &[
    Column { name: "x", offset: 0, datatype: PointField::FLOAT32 },
    Column { name: "y", offset: 4, datatype: PointField::FLOAT32 },
    Column { name: "z", offset: 8, datatype: PointField::FLOAT32 },
    Column { name: "rgb", offset: 16, datatype: PointField::FLOAT32 },
];

/// Returns one point per pixel; all coordinates are infinite without a hit.
pub(super) fn cloud(
    header: Header,
    picture: &RenderedImages,
    pinhole: &Pinhole,
    kind: Cloud,
) -> PointCloud2 {
    let point_step: usize = if kind == Cloud::Gz { 24 } else { 32 };
    let layout = Layout { columns: COLUMNS, point_step: if kind == Cloud::Gz { 24 } else { 32 } };
    #[expect(clippy::cast_possible_truncation, reason = "messages have single precision")]
    let single = |slopes: Vec<f64>| -> Vec<f32> { slopes.iter().map(|&it| it as f32).collect() };
    let (right, down) = (single(pinhole.right()), single(pinhole.down()));
    let mut data = vec![0; picture.depth_m.len() * point_step];
    let mut all = true;
    let rows = data.chunks_exact_mut(right.len() * point_step);
    let depths = picture.depth_m.chunks_exact(right.len());
    let colours = picture.rgb.chunks_exact(right.len() * 3);
    for (((row, depths), colours), down) in rows.zip(depths).zip(colours).zip(&down) {
        let pixels = depths.iter().zip(colours.chunks_exact(3)).zip(&right);
        for (point, ((&depth_m, colour), right)) in row.chunks_exact_mut(point_step).zip(pixels) {
            let xyz = if !depth_m.is_finite() {
                all = false;
                [depth_m; 3]
            } else if kind == Cloud::Gz {
                [depth_m, -depth_m * right, -depth_m * down]
            } else {
                [depth_m * right, depth_m * down, depth_m]
            };
            for (place, value) in point.chunks_exact_mut(4).zip(xyz) {
                place.copy_from_slice(&value.to_le_bytes());
            }
            // Packed 0x00RRGGBB, the lowest byte first (PCL).
            let [r, g, b] = [colour[0], colour[1], colour[2]];
            let packed = if kind == Cloud::ClassicSwapped { [r, g, b] } else { [b, g, r] };
            point[16..19].copy_from_slice(&packed);
        }
    }
    let size = [picture.width as usize, picture.height as usize];
    super::super::cloud::cloud(header, layout, size, all, data)
}
