//! Sensor messages.

use super::{FloatV, Header, Pose, Quaternion, Time, Vector3d};
use crate::message::{kinds, messages};

messages! {
    /// Clock: system time, real time since the start, and simulation time.
    Clock {
        1 header: Option<Header>,
        2 system: Option<Time>,
        3 real: Option<Time>,
        4 sim: Option<Time>,
    }
    /// Ranges, lowest row first \[m, rad\].
    LaserScan {
        1 header: Option<Header>,
        2 frame: String,
        3 world_pose: Option<Pose>,
        4 angle_min: f64,
        5 angle_max: f64,
        6 angle_step: f64,
        7 range_min: f64,
        8 range_max: f64,
        9 count: u32,
        10 vertical_angle_min: f64,
        11 vertical_angle_max: f64,
        12 vertical_angle_step: f64,
        13 vertical_count: u32,
        14 ranges: Vec<f64>,
        15 intensities: Vec<f64>,
    }
    /// Point cloud.
    PointCloudPacked {
        1 header: Option<Header>,
        2 field: Vec<PointField>,
        3 height: u32,
        4 width: u32,
        5 is_bigendian: bool,
        6 point_step: u32,
        7 row_step: u32,
        8 data: Vec<u8>,
        9 is_dense: bool,
    }
    /// Field of a point.
    PointField = "PointCloudPacked.Field" {
        1 name: String,
        2 offset: u32,
        3 datatype: PointKind,
        4 count: u32,
    }
    /// Image.
    Image {
        1 header: Option<Header>,
        2 width: u32,
        3 height: u32,
        4 step: u32,
        5 data: Vec<u8>,
        6 pixel_format_type: PixelFormat,
    }
    /// Calibration of a camera.
    CameraInfo {
        1 header: Option<Header>,
        2 width: u32,
        3 height: u32,
        4 distortion: Option<Distortion>,
        5 intrinsics: Option<Intrinsics>,
        6 projection: Option<Projection>,
        7 rectification_matrix: Vec<f64>,
    }
    /// Lens distortion.
    Distortion = "CameraInfo.Distortion" { 1 model: DistortionModel, 2 k: Vec<f64> }
    /// Nine numbers, row-major.
    Intrinsics = "CameraInfo.Intrinsics" { 1 k: Vec<f64> }
    /// Twelve numbers, row-major.
    Projection = "CameraInfo.Projection" { 1 p: Vec<f64> }
    /// Angular velocity and linear acceleration, in Harmonic.
    Imu = "IMU" {
        1 header: Option<Header>,
        2 entity_name: String,
        3 orientation: Option<Quaternion>,
        4 orientation_covariance: Option<FloatV>,
        5 angular_velocity: Option<Vector3d>,
        6 angular_velocity_covariance: Option<FloatV>,
        7 linear_acceleration: Option<Vector3d>,
        8 linear_acceleration_covariance: Option<FloatV>,
    }
    /// Angular velocity and linear acceleration, in releases up to Fortress: the only message whose field
    /// numbers changed.
    ImuFortress = "IMU" {
        1 header: Option<Header>,
        2 entity_name: String,
        3 orientation: Option<Quaternion>,
        4 angular_velocity: Option<Vector3d>,
        5 linear_acceleration: Option<Vector3d>,
    }
    /// Magnetic field \[T\].
    Magnetometer { 1 header: Option<Header>, 2 field_tesla: Option<Vector3d> }
    /// Pressure \[Pa\].
    FluidPressure { 1 header: Option<Header>, 2 pressure: f64, 3 variance: f64 }
    /// Height \[m\].
    Altimeter {
        1 header: Option<Header>,
        2 vertical_position: f64,
        3 vertical_velocity: f64,
        4 vertical_reference: f64,
    }
    /// Geographic position \[deg, m, m/s\].
    NavSat {
        1 header: Option<Header>,
        2 latitude_deg: f64,
        3 longitude_deg: f64,
        4 altitude: f64,
        5 velocity_east: f64,
        6 velocity_north: f64,
        7 velocity_up: f64,
        8 frame_id: String,
    }
    /// Battery state.
    BatteryState {
        1 header: Option<Header>,
        2 voltage: f64,
        3 current: f64,
        4 charge: f64,
        5 capacity: f64,
        6 percentage: f64,
        7 power_supply_status: PowerSupply,
    }
    /// Contacts.
    Contacts { 1 header: Option<Header>, 2 contact: Vec<Contact> }
    /// Contact of two collisions.
    Contact {
        1 header: Option<Header>,
        2 collision1: Option<super::Entity>,
        3 collision2: Option<super::Entity>,
        4 position: Vec<Vector3d>,
        5 normal: Vec<Vector3d>,
        6 depth: Vec<f64>,
        7 wrench: Vec<JointWrench>,
        8 world: Option<super::Entity>,
    }
    /// Forces and torques between two bodies.
    JointWrench {
        1 header: Option<Header>,
        2 body_1_name: String,
        3 body_1_id: u32,
        4 body_2_name: String,
        5 body_2_id: u32,
        6 body_1_wrench: Option<super::Wrench>,
        7 body_2_wrench: Option<super::Wrench>,
    }
    /// State of a gamepad.
    Joy { 1 header: Option<Header>, 2 axes: Vec<f32>, 3 buttons: Vec<i32> }
    /// Models in the view of a logical camera.
    LogicalCameraImage {
        1 header: Option<Header>,
        2 pose: Option<Pose>,
        3 model: Vec<SeenModel>,
    }
    /// Model in the view of a logical camera.
    SeenModel = "LogicalCameraImage.Model" { 1 name: String, 2 pose: Option<Pose> }
    /// Noise of a sensor.
    SensorNoise {
        1 header: Option<Header>,
        2 r#type: NoiseKind,
        3 mean: f64,
        4 stddev: f64,
        5 bias_mean: f64,
        6 bias_stddev: f64,
        7 precision: f64,
        8 dynamic_bias_stddev: f64,
        9 dynamic_bias_correlation_time: f64,
    }
}

kinds! {
    /// Number type of a point field.
    PointKind {
        INT8 = 0, UINT8 = 1, INT16 = 2, UINT16 = 3, INT32 = 4, UINT32 = 5, FLOAT32 = 6, FLOAT64 = 7,
    }
    /// Pixel format.
    PixelFormat {
        UNKNOWN_PIXEL_FORMAT = 0, L_INT8 = 1, L_INT16 = 2, RGB_INT8 = 3, RGBA_INT8 = 4,
        BGRA_INT8 = 5, RGB_INT16 = 6, RGB_INT32 = 7, BGR_INT8 = 8, BGR_INT16 = 9, BGR_INT32 = 10,
        R_FLOAT16 = 11, RGB_FLOAT16 = 12, R_FLOAT32 = 13, RGB_FLOAT32 = 14, BAYER_RGGB8 = 15,
        BAYER_BGGR8 = 16, BAYER_GBRG8 = 17, BAYER_GRBG8 = 18,
    }
    /// Model of lens distortion.
    DistortionModel { PLUMB_BOB = 0, RATIONAL_POLYNOMIAL = 1, EQUIDISTANT = 2 }
    /// Status of the power supply.
    PowerSupply { UNKNOWN = 0, CHARGING = 1, DISCHARGING = 2, NOT_CHARGING = 3, FULL = 4 }
    /// Distribution of noise.
    NoiseKind { NONE = 0, GAUSSIAN = 2, GAUSSIAN_QUANTIZED = 3 }
}
