//! Sensor messages.

use periplus_msgs::sensor_msgs as ros;

use super::geometry::{matrix, numbers};
use super::{AsRos, array, frame, part};
use crate::{
    Altimeter, Axis, BatteryState, CameraInfo, Distortion, DistortionModel, FluidPressure, Header,
    Image, Imu, ImuFortress, Intrinsics, Joint, Joy, LaserScan, LogicalCameraImage, Magnetometer,
    Model, NavSat, PixelFormat, PointCloudPacked, PointField, PointKind, Pose, PowerSupply,
    Projection, Quaternion, SeenModel, SensorNoise, Vector3d,
};
use periplus_msgs::ros_gz_interfaces;

impl AsRos<ros::LaserScan> for LaserScan {
    /// Converts the middle row of several. Infinite ranges stay infinite.
    #[expect(clippy::cast_possible_truncation, reason = "ROS has ranges in single precision")]
    fn to_ros(&self) -> Option<ros::LaserScan> {
        let count = self.count as usize;
        let start = (self.vertical_count as usize / 2).saturating_mul(count);
        let row = |all: &[f64]| -> Vec<f32> {
            let end = start.saturating_add(count).min(all.len());
            all.get(start..end).unwrap_or_default().iter().map(|&value| value as f32).collect()
        };
        let header: periplus_msgs::std_msgs::Header = part(self.header.as_ref());
        Some(ros::LaserScan {
            header: periplus_msgs::std_msgs::Header { frame_id: frame(&self.frame), ..header },
            angle_min: self.angle_min as f32,
            angle_max: self.angle_max as f32,
            angle_increment: self.angle_step as f32,
            time_increment: 0.0,
            scan_time: 0.0,
            range_min: self.range_min as f32,
            range_max: self.range_max as f32,
            ranges: row(&self.ranges),
            intensities: row(&self.intensities),
        })
    }

    fn from_ros(ros: &ros::LaserScan) -> Option<Self> {
        let doubles = |all: &[f32]| all.iter().map(|&value| value.into()).collect();
        Some(Self {
            header: Header::from_ros(&ros.header),
            frame: ros.header.frame_id.clone(),
            angle_min: ros.angle_min.into(),
            angle_max: ros.angle_max.into(),
            angle_step: ros.angle_increment.into(),
            range_min: ros.range_min.into(),
            range_max: ros.range_max.into(),
            count: u32::try_from(ros.ranges.len()).ok()?,
            vertical_count: 1,
            ranges: doubles(&ros.ranges),
            intensities: doubles(&ros.intensities),
            ..Self::default()
        })
    }
}

/// Number types with both names.
const KINDS: [(u8, PointKind); 8] = [
    (ros::PointField::INT8, PointKind::INT8),
    (ros::PointField::UINT8, PointKind::UINT8),
    (ros::PointField::INT16, PointKind::INT16),
    (ros::PointField::UINT16, PointKind::UINT16),
    (ros::PointField::INT32, PointKind::INT32),
    (ros::PointField::UINT32, PointKind::UINT32),
    (ros::PointField::FLOAT32, PointKind::FLOAT32),
    (ros::PointField::FLOAT64, PointKind::FLOAT64),
];

impl AsRos<ros::PointField> for PointField {
    fn to_ros(&self) -> Option<ros::PointField> {
        let datatype = KINDS.iter().find(|(_, gz)| *gz == self.datatype)?.0;
        let (name, offset, count) = (self.name.clone(), self.offset, self.count);
        Some(ros::PointField { name, offset, datatype, count })
    }

    fn from_ros(ros: &ros::PointField) -> Option<Self> {
        let datatype = KINDS.iter().find(|(ours, _)| *ours == ros.datatype)?.1;
        let (name, offset, count) = (ros.name.clone(), ros.offset, ros.count);
        Some(Self { name, offset, datatype, count })
    }
}

impl AsRos<ros::PointCloud2> for PointCloudPacked {
    fn to_ros(&self) -> Option<ros::PointCloud2> {
        Some(ros::PointCloud2 {
            header: part(self.header.as_ref()),
            height: self.height,
            width: self.width,
            fields: self.field.iter().map(AsRos::to_ros).collect::<Option<_>>()?,
            is_bigendian: self.is_bigendian,
            point_step: self.point_step,
            row_step: self.row_step,
            data: self.data.clone(),
            is_dense: self.is_dense,
        })
    }

    fn from_ros(ros: &ros::PointCloud2) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            field: ros.fields.iter().map(AsRos::from_ros).collect::<Option<_>>()?,
            height: ros.height,
            width: ros.width,
            is_bigendian: ros.is_bigendian,
            point_step: ros.point_step,
            row_step: ros.row_step,
            data: ros.data.clone(),
            is_dense: ros.is_dense,
        })
    }
}

/// Pixel formats with both names; of those with two names in Gazebo the first is the default.
const PIXELS: [(&str, PixelFormat); 13] = [
    ("mono8", PixelFormat::L_INT8),
    ("mono16", PixelFormat::L_INT16),
    ("rgb8", PixelFormat::RGB_INT8),
    ("rgba8", PixelFormat::RGBA_INT8),
    ("bgra8", PixelFormat::BGRA_INT8),
    ("rgb16", PixelFormat::RGB_INT16),
    ("bgr8", PixelFormat::BGR_INT8),
    ("bgr16", PixelFormat::BGR_INT16),
    ("32FC1", PixelFormat::R_FLOAT32),
    ("bayer_rggb8", PixelFormat::BAYER_RGGB8),
    ("bayer_bggr8", PixelFormat::BAYER_BGGR8),
    ("bayer_gbrg8", PixelFormat::BAYER_GBRG8),
    ("bayer_grbg8", PixelFormat::BAYER_GRBG8),
];

/// Alternative ROS names of pixel formats.
const SAME_PIXELS: [(&str, &str); 5] = [
    ("8UC1", "mono8"),
    ("16UC1", "mono16"),
    ("8UC3", "rgb8"),
    ("8UC4", "rgba8"),
    ("16UC3", "rgb16"),
];

impl AsRos<ros::Image> for Image {
    fn to_ros(&self) -> Option<ros::Image> {
        let encoding = PIXELS.iter().find(|(_, gz)| *gz == self.pixel_format_type)?.0;
        Some(ros::Image {
            header: part(self.header.as_ref()),
            height: self.height,
            width: self.width,
            encoding: encoding.to_owned(),
            is_bigendian: 0,
            step: self.step,
            data: self.data.clone(),
        })
    }

    fn from_ros(ros: &ros::Image) -> Option<Self> {
        let same = SAME_PIXELS.iter().find(|(name, _)| *name == ros.encoding);
        let encoding = same.map_or(ros.encoding.as_str(), |(_, usual)| usual);
        Some(Self {
            header: Header::from_ros(&ros.header),
            width: ros.width,
            height: ros.height,
            step: ros.step,
            data: ros.data.clone(),
            pixel_format_type: PIXELS.iter().find(|(name, _)| *name == encoding)?.1,
        })
    }
}

const MODELS: [(&str, DistortionModel); 3] = [
    ("plumb_bob", DistortionModel::PLUMB_BOB),
    ("rational_polynomial", DistortionModel::RATIONAL_POLYNOMIAL),
    ("equidistant", DistortionModel::EQUIDISTANT),
];

impl AsRos<ros::CameraInfo> for CameraInfo {
    fn to_ros(&self) -> Option<ros::CameraInfo> {
        let model = self.distortion.as_ref().map(|it| it.model);
        let model = model.and_then(|model| MODELS.iter().find(|(_, gz)| *gz == model));
        let intrinsics = self.intrinsics.iter().flat_map(|it| it.k.iter().copied());
        let projection = self.projection.iter().flat_map(|it| it.p.iter().copied());
        Some(ros::CameraInfo {
            header: part(self.header.as_ref()),
            height: self.height,
            width: self.width,
            distortion_model: model.map(|(name, _)| (*name).to_owned()).unwrap_or_default(),
            d: self.distortion.iter().flat_map(|it| it.k.iter().copied()).collect(),
            k: array(intrinsics),
            r: array(self.rectification_matrix.iter().copied()),
            p: array(projection),
            ..ros::CameraInfo::default()
        })
    }

    fn from_ros(ros: &ros::CameraInfo) -> Option<Self> {
        let model = MODELS.iter().find(|(name, _)| *name == ros.distortion_model);
        let distortion = model.map(|(_, model)| Distortion { model: *model, k: ros.d.clone() });
        Some(Self {
            header: Header::from_ros(&ros.header),
            width: ros.width,
            height: ros.height,
            distortion,
            intrinsics: Some(Intrinsics { k: ros.k.to_vec() }),
            projection: Some(Projection { p: ros.p.to_vec() }),
            rectification_matrix: ros.r.to_vec(),
        })
    }
}

impl AsRos<ros::Imu> for Imu {
    /// A missing orientation is marked by -1 in the covariance, as in ROS.
    fn to_ros(&self) -> Option<ros::Imu> {
        let mut ros = ros::Imu {
            header: part(self.header.as_ref()),
            orientation: part(self.orientation.as_ref()),
            orientation_covariance: matrix(self.orientation_covariance.as_ref()),
            angular_velocity: part(self.angular_velocity.as_ref()),
            angular_velocity_covariance: matrix(self.angular_velocity_covariance.as_ref()),
            linear_acceleration: part(self.linear_acceleration.as_ref()),
            linear_acceleration_covariance: matrix(self.linear_acceleration_covariance.as_ref()),
        };
        if self.orientation.is_none() {
            ros.orientation_covariance[0] = -1.0;
        }
        Some(ros)
    }

    #[expect(clippy::float_cmp, reason = "a mark, not a measurement")]
    fn from_ros(ros: &ros::Imu) -> Option<Self> {
        let has_orientation = ros.orientation_covariance[0] != -1.0;
        let orientation = has_orientation.then(|| Quaternion::from_ros(&ros.orientation)).flatten();
        Some(Self {
            header: Header::from_ros(&ros.header),
            entity_name: ros.header.frame_id.clone(),
            orientation,
            orientation_covariance: numbers(&ros.orientation_covariance),
            angular_velocity: Vector3d::from_ros(&ros.angular_velocity),
            angular_velocity_covariance: numbers(&ros.angular_velocity_covariance),
            linear_acceleration: Vector3d::from_ros(&ros.linear_acceleration),
            linear_acceleration_covariance: numbers(&ros.linear_acceleration_covariance),
        })
    }
}

impl AsRos<ros::Imu> for ImuFortress {
    fn to_ros(&self) -> Option<ros::Imu> {
        let Self { header, entity_name, orientation, angular_velocity, linear_acceleration } =
            self.clone();
        Imu {
            header,
            entity_name,
            orientation,
            angular_velocity,
            linear_acceleration,
            ..Imu::default()
        }
        .to_ros()
    }

    fn from_ros(ros: &ros::Imu) -> Option<Self> {
        let Imu { header, entity_name, orientation, angular_velocity, linear_acceleration, .. } =
            Imu::from_ros(ros)?;
        Some(Self { header, entity_name, orientation, angular_velocity, linear_acceleration })
    }
}

impl AsRos<ros::JointState> for Model {
    fn to_ros(&self) -> Option<ros::JointState> {
        let mut ros =
            ros::JointState { header: part(self.header.as_ref()), ..ros::JointState::default() };
        for joint in &self.joint {
            let axis = joint.axis1.as_ref();
            ros.name.push(joint.name.clone());
            ros.position.push(axis.map_or(0.0, |axis| axis.position));
            ros.velocity.push(axis.map_or(0.0, |axis| axis.velocity));
            ros.effort.push(axis.map_or(0.0, |axis| axis.force));
        }
        Some(ros)
    }

    fn from_ros(ros: &ros::JointState) -> Option<Self> {
        let number = |all: &[f64], index: usize| all.get(index).copied().unwrap_or_default();
        let joints = ros.name.iter().enumerate().map(|(index, name)| Joint {
            name: name.clone(),
            axis1: Some(Axis {
                position: number(&ros.position, index),
                velocity: number(&ros.velocity, index),
                force: number(&ros.effort, index),
                ..Axis::default()
            }),
            ..Joint::default()
        });
        let joint = joints.collect();
        Some(Self { header: Header::from_ros(&ros.header), joint, ..Self::default() })
    }
}

impl AsRos<ros::Joy> for Joy {
    fn to_ros(&self) -> Option<ros::Joy> {
        let (axes, buttons) = (self.axes.clone(), self.buttons.clone());
        Some(ros::Joy { header: part(self.header.as_ref()), axes, buttons })
    }

    fn from_ros(ros: &ros::Joy) -> Option<Self> {
        let (axes, buttons) = (ros.axes.clone(), ros.buttons.clone());
        Some(Self { header: Header::from_ros(&ros.header), axes, buttons })
    }
}

impl AsRos<ros::MagneticField> for Magnetometer {
    fn to_ros(&self) -> Option<ros::MagneticField> {
        Some(ros::MagneticField {
            header: part(self.header.as_ref()),
            magnetic_field: part(self.field_tesla.as_ref()),
            ..ros::MagneticField::default()
        })
    }

    fn from_ros(ros: &ros::MagneticField) -> Option<Self> {
        let field_tesla = Vector3d::from_ros(&ros.magnetic_field);
        Some(Self { header: Header::from_ros(&ros.header), field_tesla })
    }
}

impl AsRos<ros::FluidPressure> for FluidPressure {
    fn to_ros(&self) -> Option<ros::FluidPressure> {
        let (fluid_pressure, variance) = (self.pressure, self.variance);
        Some(ros::FluidPressure { header: part(self.header.as_ref()), fluid_pressure, variance })
    }

    fn from_ros(ros: &ros::FluidPressure) -> Option<Self> {
        let (pressure, variance) = (ros.fluid_pressure, ros.variance);
        Some(Self { header: Header::from_ros(&ros.header), pressure, variance })
    }
}

impl AsRos<ros::NavSatFix> for NavSat {
    /// The frame is a separate field in Gazebo.
    fn to_ros(&self) -> Option<ros::NavSatFix> {
        let header: periplus_msgs::std_msgs::Header = part(self.header.as_ref());
        let frame_id =
            if self.frame_id.is_empty() { header.frame_id } else { frame(&self.frame_id) };
        Some(ros::NavSatFix {
            header: periplus_msgs::std_msgs::Header { frame_id, ..header },
            latitude: self.latitude_deg,
            longitude: self.longitude_deg,
            altitude: self.altitude,
            ..ros::NavSatFix::default()
        })
    }

    fn from_ros(ros: &ros::NavSatFix) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            latitude_deg: ros.latitude,
            longitude_deg: ros.longitude,
            altitude: ros.altitude,
            frame_id: ros.header.frame_id.clone(),
            ..Self::default()
        })
    }
}

/// Status of the power supply, with both numbers.
const SUPPLY: [(u8, PowerSupply); 5] = [
    (ros::BatteryState::POWER_SUPPLY_STATUS_UNKNOWN, PowerSupply::UNKNOWN),
    (ros::BatteryState::POWER_SUPPLY_STATUS_CHARGING, PowerSupply::CHARGING),
    (ros::BatteryState::POWER_SUPPLY_STATUS_DISCHARGING, PowerSupply::DISCHARGING),
    (ros::BatteryState::POWER_SUPPLY_STATUS_NOT_CHARGING, PowerSupply::NOT_CHARGING),
    (ros::BatteryState::POWER_SUPPLY_STATUS_FULL, PowerSupply::FULL),
];

impl AsRos<ros::BatteryState> for BatteryState {
    #[expect(clippy::cast_possible_truncation, reason = "ROS has them in single precision")]
    fn to_ros(&self) -> Option<ros::BatteryState> {
        let status = SUPPLY.iter().find(|(_, gz)| *gz == self.power_supply_status);
        Some(ros::BatteryState {
            header: part(self.header.as_ref()),
            voltage: self.voltage as f32,
            current: self.current as f32,
            charge: self.charge as f32,
            capacity: self.capacity as f32,
            design_capacity: f32::NAN,
            percentage: self.percentage as f32,
            power_supply_status: status.map_or(0, |(number, _)| *number),
            present: true,
            ..ros::BatteryState::default()
        })
    }

    fn from_ros(ros: &ros::BatteryState) -> Option<Self> {
        let status = SUPPLY.iter().find(|(number, _)| *number == ros.power_supply_status);
        Some(Self {
            header: Header::from_ros(&ros.header),
            voltage: ros.voltage.into(),
            current: ros.current.into(),
            charge: ros.charge.into(),
            capacity: ros.capacity.into(),
            percentage: ros.percentage.into(),
            power_supply_status: status.map(|(_, gz)| *gz).unwrap_or_default(),
        })
    }
}

impl AsRos<ros_gz_interfaces::Altimeter> for Altimeter {
    fn to_ros(&self) -> Option<ros_gz_interfaces::Altimeter> {
        Some(ros_gz_interfaces::Altimeter {
            header: part(self.header.as_ref()),
            vertical_position: self.vertical_position,
            vertical_velocity: self.vertical_velocity,
            vertical_reference: self.vertical_reference,
        })
    }

    fn from_ros(ros: &ros_gz_interfaces::Altimeter) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            vertical_position: ros.vertical_position,
            vertical_velocity: ros.vertical_velocity,
            vertical_reference: ros.vertical_reference,
        })
    }
}

impl AsRos<ros_gz_interfaces::LogicalCameraImage> for LogicalCameraImage {
    fn to_ros(&self) -> Option<ros_gz_interfaces::LogicalCameraImage> {
        let model = self.model.iter().map(|seen| ros_gz_interfaces::LogicalCameraImageModel {
            name: seen.name.clone(),
            pose: part(seen.pose.as_ref()),
        });
        Some(ros_gz_interfaces::LogicalCameraImage {
            header: part(self.header.as_ref()),
            pose: part(self.pose.as_ref()),
            model: model.collect(),
        })
    }

    fn from_ros(ros: &ros_gz_interfaces::LogicalCameraImage) -> Option<Self> {
        let pose = |ros: &periplus_msgs::geometry_msgs::Pose| Pose::from_ros(ros);
        let model = ros.model.iter();
        let model = model.map(|seen| SeenModel { name: seen.name.clone(), pose: pose(&seen.pose) });
        Some(Self {
            header: Header::from_ros(&ros.header),
            pose: pose(&ros.pose),
            model: model.collect(),
        })
    }
}

impl AsRos<ros_gz_interfaces::SensorNoise> for SensorNoise {
    fn to_ros(&self) -> Option<ros_gz_interfaces::SensorNoise> {
        Some(ros_gz_interfaces::SensorNoise {
            header: part(self.header.as_ref()),
            r#type: u8::try_from(self.r#type.0).ok()?,
            mean: self.mean,
            stddev: self.stddev,
            bias_mean: self.bias_mean,
            bias_stddev: self.bias_stddev,
            precision: self.precision,
            dynamic_bias_stddev: self.dynamic_bias_stddev,
            dynamic_bias_correlation_time: self.dynamic_bias_correlation_time,
        })
    }

    fn from_ros(ros: &ros_gz_interfaces::SensorNoise) -> Option<Self> {
        Some(Self {
            header: Header::from_ros(&ros.header),
            r#type: crate::NoiseKind(ros.r#type.into()),
            mean: ros.mean,
            stddev: ros.stddev,
            bias_mean: ros.bias_mean,
            bias_stddev: ros.bias_stddev,
            precision: ros.precision,
            dynamic_bias_stddev: ros.dynamic_bias_stddev,
            dynamic_bias_correlation_time: ros.dynamic_bias_correlation_time,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_rows_ros_gets_the_middle_one() {
        let scan = LaserScan {
            frame: "bot::lidar".into(),
            count: 2,
            vertical_count: 3,
            ranges: vec![1.0, 2.0, f64::INFINITY, f64::NEG_INFINITY, 5.0, 6.0],
            ..LaserScan::default()
        };
        let ros = scan.to_ros().expect("a scan");
        assert_eq!(ros.header.frame_id, "bot/lidar");
        assert_eq!(ros.ranges, [f32::INFINITY, f32::NEG_INFINITY]);
        assert_eq!((ros.time_increment, ros.scan_time), (0.0, 0.0));
    }

    #[test]
    fn a_scan_that_promises_more_than_it_has_is_short() {
        for (count, vertical_count, left) in [(10, 1, 3), (2, 9, 0), (u32::MAX, u32::MAX, 0)] {
            let ranges = vec![1.0; 3];
            let scan = LaserScan { count, vertical_count, ranges, ..LaserScan::default() };
            assert_eq!(scan.to_ros().map(|scan| scan.ranges.len()), Some(left));
        }
    }

    #[test]
    fn an_orientation_that_is_not_there_is_said() {
        let ros = Imu::default().to_ros().expect("an imu");
        assert_eq!(ros.orientation_covariance[0], -1.0);
        assert_eq!(Imu::from_ros(&ros).map(|imu| imu.orientation), Some(None));
    }

    #[test]
    fn kinds_of_pixels_that_the_other_does_not_know_are_no_message() {
        let format = |pixel_format_type| Image { pixel_format_type, ..Image::default() };
        assert_eq!(format(PixelFormat::RGB_FLOAT16).to_ros(), None);
        assert_eq!(format(PixelFormat(99)).to_ros(), None);
        let depth = format(PixelFormat::R_FLOAT32).to_ros().map(|image| image.encoding);
        assert_eq!(depth.as_deref(), Some("32FC1"));
        let ros = ros::Image { encoding: "yuv422".into(), ..ros::Image::default() };
        assert_eq!(Image::from_ros(&ros), None);
    }
}
