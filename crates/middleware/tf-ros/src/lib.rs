//! What nodes hear and tell of where a robot is.
//!
//! [`Frames`] are what was heard on `/tf`, and know which edge is missing; [`places`] are where a scan
//! was taken; [`transform`] and [`pose`] are what is told; [`Told`] says nothing twice.

mod frames;
mod poses;
mod scans;
mod told;

pub use frames::{Frames, plain};
pub use poses::{pose, transform};
pub use scans::{Lack, Places, Robot, places};
pub use told::Told;
