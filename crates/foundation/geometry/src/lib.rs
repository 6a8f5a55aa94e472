//! Poses, angles and exact conversion of numbers to text.
//!
//! Variables are named by frames: `map_from_base` transforms coordinates in `base` to coordinates in `map`,
//! and `map_from_odom * odom_from_base` is `map_from_base`.
//!
//! ```
//! use periplus_geometry::{DVec3, Pose, Rpy};
//!
//! let map_from_odom = Pose::from_xyz(1.0, 0.0, 0.0);
//! let left = Rpy { roll: 0.0, pitch: 0.0, yaw: std::f64::consts::FRAC_PI_2 };
//! let odom_from_base = Pose::from_xyz_rpy([2.0, 0.0, 0.0], left);
//! let map_from_base = map_from_odom * odom_from_base;
//! let point = map_from_base.transform_point(DVec3::X);
//! assert!((point - DVec3::new(3.0, 1.0, 0.0)).length() < 1e-12);
//! ```

mod base64;
mod laser_scan;
mod number;
mod pose;
mod pose2;
mod stream;
mod twist2;

pub use base64::{decode_base64, encode_base64};
pub use glam::{DQuat, DVec3};
pub use laser_scan::{LaserScan2, ScannerMounting};
pub use number::{format_number, parse_number, parse_numbers};
pub use pose::{Pose, Rpy, quaternion_from_rpy, rpy_from_quaternion};
pub use pose2::{Pose2, normalize_angle};
pub use stream::Stream;
pub use twist2::Twist2;
