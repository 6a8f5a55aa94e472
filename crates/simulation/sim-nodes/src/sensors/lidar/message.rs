//! Conversion of scans to messages.

use std::ops::Range;

use periplus_msgs::geometry_msgs::Point32;
use periplus_msgs::sensor_msgs::{self, ChannelFloat32, LaserScan, PointCloud, PointCloud2};
use periplus_msgs::std_msgs::Header;
use periplus_sensors::{LidarSensor, Quirks};

use crate::sensors::cloud::{CLASSIC_LASER, GZ_LIDAR, cloud};

/// Publisher settings of a lidar.
#[derive(Clone, Debug, Default)]
pub(super) struct PublishSettings {
    pub(super) frame_id: String,
    /// Lower intensities are raised to this.
    pub(super) min_intensity: f64,
    /// Radiation type of `Range` messages.
    pub(super) is_ultrasound: bool,
    /// Field of view of `Range` messages \[rad\]; by default the wider of the scan's angles.
    pub(super) field_of_view_rad: Option<f64>,
    pub(super) quirks: Quirks,
}

impl PublishSettings {
    /// Returns the ranges of some beams. `span_ns` is the duration of the scan, 0 for a scan that is
    /// measured at once: then both times are 0, as in Gazebo's plugins.
    pub(super) fn scan(
        &self,
        lidar: &LidarSensor,
        beams: Range<usize>,
        time_ns: i64,
        span_ns: i64,
    ) -> LaserScan {
        let measured = lidar.last();
        let angles = lidar.beams();
        let [step_rad, _] = angles.steps_rad(self.quirks);
        let gaps = angles.ranges[0].max(2) - 1;
        #[expect(clippy::cast_precision_loss, reason = "a scan lasts seconds")]
        let span_s = span_ns as f64 * 1e-9;
        let [range_min_m, range_max_m] = lidar.range_m();
        #[expect(clippy::cast_precision_loss, reason = "fewer than 2^22 beams")]
        LaserScan {
            header: Header::at(time_ns, &self.frame_id),
            angle_min: single(angles.first_rad[0]),
            angle_max: single(angles.last_rad[0]),
            angle_increment: single(step_rad),
            time_increment: single(span_s / gaps as f64),
            scan_time: single(span_s),
            range_min: single(range_min_m),
            range_max: single(range_max_m),
            ranges: measured.ranges_m[beams.clone()].to_vec(),
            intensities: self.intensities(&measured.intensities[beams]),
        }
    }

    /// Returns the points of the hits (Classic's plugins).
    pub(super) fn points(&self, lidar: &LidarSensor, time_ns: i64) -> PointCloud2 {
        let intensities = self.intensities(&lidar.last().intensities);
        let mut data = Vec::with_capacity(16 * intensities.len());
        for (point, intensity) in lidar.points().zip(intensities) {
            if point[0].is_finite() && point[1].is_finite() && point[2].is_finite() {
                for number in [point[0], point[1], point[2], intensity] {
                    data.extend_from_slice(&number.to_le_bytes());
                }
            }
        }
        let count = data.len() / 16;
        cloud(Header::at(time_ns, &self.frame_id), CLASSIC_LASER, [count, 1], true, data)
    }

    /// Returns all points in rows, including those without a hit (Gazebo's own layout).
    pub(super) fn rings(&self, lidar: &LidarSensor, time_ns: i64) -> PointCloud2 {
        let intensities = self.intensities(&lidar.last().intensities);
        let [columns, rows] = lidar.beams().ranges;
        let mut data = Vec::with_capacity(32 * intensities.len());
        for (number, (point, intensity)) in lidar.points().zip(intensities).enumerate() {
            let ring = u16::try_from(number / columns.max(1)).unwrap_or(u16::MAX);
            for coordinate in point {
                data.extend_from_slice(&coordinate.to_le_bytes());
            }
            data.extend_from_slice(&[0; 4]);
            data.extend_from_slice(&intensity.to_le_bytes());
            data.extend_from_slice(&[0; 4]);
            data.extend_from_slice(&ring.to_le_bytes());
            data.extend_from_slice(&[0; 6]);
        }
        cloud(Header::at(time_ns, &self.frame_id), GZ_LIDAR, [columns, rows], false, data)
    }

    /// Returns the points of the hits as the legacy `PointCloud`.
    pub(super) fn old_points(&self, lidar: &LidarSensor, time_ns: i64) -> PointCloud {
        let intensities = self.intensities(&lidar.last().intensities);
        let met = lidar
            .points()
            .zip(intensities)
            .filter(|([x, y, z], _)| x.is_finite() && y.is_finite() && z.is_finite());
        let (points, values) = met.map(|([x, y, z], value)| (Point32 { x, y, z }, value)).unzip();
        PointCloud {
            header: Header::at(time_ns, &self.frame_id),
            points,
            channels: vec![ChannelFloat32 { name: "intensity".into(), values }],
        }
    }

    /// Returns the minimum of all ranges; `inf` without a hit (REP 117).
    pub(super) fn range(&self, lidar: &LidarSensor, time_ns: i64) -> sensor_msgs::Range {
        let nearest = lidar.last().ranges_m.iter().copied().fold(f32::INFINITY, f32::min);
        let quirk = self.quirks.greatest_float_for_no_range && nearest == f32::INFINITY;
        let angles = lidar.beams();
        let [range_min_m, range_max_m] = lidar.range_m();
        let wide = |axis: usize| angles.last_rad[axis] - angles.first_rad[axis];
        sensor_msgs::Range {
            header: Header::at(time_ns, &self.frame_id),
            radiation_type: if self.is_ultrasound {
                sensor_msgs::Range::ULTRASOUND
            } else {
                sensor_msgs::Range::INFRARED
            },
            field_of_view: single(self.field_of_view_rad.unwrap_or(wide(0).max(wide(1)))),
            min_range: single(range_min_m),
            max_range: single(range_max_m),
            range: if quirk { f32::MAX } else { nearest },
            ..sensor_msgs::Range::default()
        }
    }

    fn intensities(&self, measured: &[f32]) -> Vec<f32> {
        let least = single(self.min_intensity);
        measured.iter().map(|value| value.max(least)).collect()
    }
}

#[expect(clippy::cast_possible_truncation, reason = "messages carry single precision")]
fn single(number: f64) -> f32 {
    number as f32
}
