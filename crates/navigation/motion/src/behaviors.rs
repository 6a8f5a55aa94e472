//! Motions of the behavior server: spin, drive straight, teleoperation that avoids collisions.
//!
//! A motion is a velocity for each cycle, and the poses that the robot would reach with it, which
//! [`is_motion_free`] checks on a costmap.
//!
//! Source: `nav2_behaviors` (humble 3c3db59d, jazzy f4108e5b, main a3a97043). Two mistakes there are
//! not repeated: a spin checks the angle that is left instead of the angle behind it, and the
//! projected pose of a teleoperated robot moves to the side that is commanded.

mod clearance;
mod drive;
mod spin;
mod teleop;

pub use clearance::is_motion_free;
pub use drive::{DriveLimits, InvalidDrive, StraightDrive};
pub use spin::{Spin, SpinLimits};
pub use teleop::{TeleopProjection, limit_teleop};

use periplus_costmap::{Costmap, Footprint, cost};
use periplus_geometry::Pose2;

/// Number of cycles that a motion looks ahead.
fn lookahead_cycle_count(frequency_hz: f64, lookahead_s: f64) -> u32 {
    (frequency_hz * lookahead_s) as u32
}

/// True if a robot at a pose, in the frame of the costmap, collides with no obstacle: its centre is
/// on the map, and no cell under its outline is lethal or unknown.
#[must_use]
pub fn is_pose_free(costmap: &Costmap, footprint: &Footprint, pose: Pose2) -> bool {
    let is_on_map = costmap.cost_at(pose.x_m, pose.y_m).is_some();
    is_on_map && footprint.cost(costmap, pose) < cost::LETHAL
}
