//! Control laws of the drive plugins.
//!
//! A drive is independent of a [`PhysicsWorld`](crate::PhysicsWorld): its inputs are the command and the wheel
//! states, its outputs the wheel commands. Defaults are those of the plugin of the same name.

mod ackermann;
mod classic_ackermann;
mod classic_diff_drive;
mod gz_diff_drive;
mod limits;
mod mecanum;
mod odometry;
mod planar;
mod tricycle;

pub use ackermann::{Ackermann, AckermannCommand};
pub use classic_ackermann::{ClassicAckermann, ClassicAckermannTarget};
pub use classic_diff_drive::{ClassicDiffDrive, ClassicDrive, WheelPair};
pub use gz_diff_drive::{GzDiffDrive, GzDiffDriveState};
pub use limits::SpeedLimits;
pub use mecanum::{Mecanum, MecanumWheels};
pub use odometry::{Odometry, true_twist};
pub use planar::planar_velocity;
pub use tricycle::{Steering, Tricycle};
