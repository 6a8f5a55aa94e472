//! Poses, angles and exact conversion of numbers to text.
//!
//! Variables are named by frames: `map_from_base` transforms coordinates in `base` to coordinates in `map`,
//! and `map_from_odom * odom_from_base` is `map_from_base`.

mod base64;
mod number;
mod pose;
mod pose2;
mod stream;

pub use base64::{decode_base64, encode_base64};
pub use glam::{DQuat, DVec3};
pub use number::{format_number, parse_number, parse_numbers};
pub use pose::{Pose, Rpy, quaternion_from_rpy, rpy_from_quaternion};
pub use pose2::{Pose2, normalize_angle};
pub use stream::Stream;
