//! TF listener and message conversions shared by the ROS nodes.
//!
//! [`Frames`] is the buffer of `/tf` with a diagnosis of missing transforms; [`places`] looks up
//! the transforms of a scan; [`transform`] and [`pose`] convert to messages; [`Told`] throttles log
//! messages.

mod frames;
mod poses;
mod scans;
mod told;

pub use frames::{Frames, plain};
pub use poses::{pose, transform};
pub use scans::{Lack, Places, Robot, places};
pub use told::Told;
