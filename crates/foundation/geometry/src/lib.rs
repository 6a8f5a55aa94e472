//! Poses, angles and numbers that print exactly.
//!
//! Frames are named in variables: `map_from_base` turns coordinates in `base` into coordinates in
//! `map`, and `map_from_odom * odom_from_base` reads off as `map_from_base`.

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
