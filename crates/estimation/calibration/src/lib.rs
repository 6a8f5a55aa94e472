//! Calibration of a mobile robot from a drive.
//!
//! - [`calibrate_drive`]: wheel radii, wheel distance, pose of the scanner and delay of its stamps. The
//!   scanner's displacements come from [`match_scans`].
//! - [`OdometryErrorModel`]: errors of odometry in one drive, and their prediction for another; [`predict_second_half`]
//!   compares both in one recording
//! - [`lidar_noise`], [`range_bias`]: noise, dropouts and bias of a planar scanner
//! - [`calibrate_imu`]: noise and bias of an IMU at rest, scale and delay of its rotation; [`allan_deviation`] and
//!   [`imu_noise`] for single axes
//!
//! Each value is an [`Estimated`] with its standard error. Values that the data does not determine are
//! refused with the reason, see [`NotObservable`].
//!
//! ```
//! use periplus_calibration::imu_noise;
//!
//! // A gyroscope at rest with a bias of 0.01 rad/s and no noise, at 100 Hz.
//! let noise = imu_noise(&[0.01; 1000], 0.01).unwrap();
//! assert!((noise.bias.value - 0.01).abs() < 1e-12);
//! assert!(noise.noise_density.value < 1e-12);
//! ```

mod allan;
mod delay;
mod drive;
mod error_model;
mod estimated;
mod fit;
mod halves;
mod imu;
mod lidar;
mod reference;
mod scans;
mod segments;
mod wheels;

pub use allan::{AllanPoint, ImuNoise, allan_deviation, imu_noise};
pub use drive::{
    CalibrationError, DriveCalibration, DriveParameter, NotObservable, calibrate_drive,
};
pub use error_model::{OdometryErrorModel, RelativeError};
pub use estimated::Estimated;
pub use halves::{PredictionError, SecondHalf, predict_second_half};
pub use imu::{ImuCalibration, ImuSample, calibrate_imu};
pub use lidar::{LidarNoise, lidar_noise, range_bias};
pub use reference::{odometry_poses, refine_with_slam, slam_poses};
pub use scans::{ScannerDisplacement, match_scans};
pub use segments::ReferencedOdometry;
pub use wheels::{DifferentialDrive, WheelSample, WheelTrack};
