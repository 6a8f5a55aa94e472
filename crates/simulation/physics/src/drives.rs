//! The laws of the drive plugins: numbers in, numbers out.
//!
//! A drive knows nothing of a [`World`](crate::World): it is given what was commanded and what the
//! wheels do, and answers what the wheels should do. Defaults are those of the plugin that each is
//! named after.

mod ackermann;
mod classic;
mod classic_ackermann;
mod harmonic;
mod limits;
mod mecanum;
mod odometry;
mod planar;
mod tricycle;

pub use ackermann::{Ackermann, AckermannCommand};
pub use classic::{ClassicDiffDrive, ClassicDrive, WheelPair};
pub use classic_ackermann::{ClassicAckermann, ClassicAckermannTarget};
pub use harmonic::{HarmonicDiffDrive, HarmonicDrive};
pub use limits::Limits;
pub use mecanum::{Mecanum, MecanumWheels};
pub use odometry::{Odometry, truth};
pub use planar::planar_velocity;
pub use tricycle::{Steering, Tricycle};
