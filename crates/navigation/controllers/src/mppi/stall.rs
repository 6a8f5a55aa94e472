//! Standstill near the goal, already with its heading.
//!
//! Beside the goal the cost of the heading is higher than that of the last decimetres: a robot that cannot move to the
//! side turns to the heading of the goal and then stays outside of the tolerance until the progress checker ends the drive
//! (navigation2#5375). Here the heading is ignored until the position is reached.

use periplus_geometry::Twist2;

use super::lane_math::normalize_angle;
use super::limits::MppiVelocityLimits;
use super::sequence::{ControlSequence, MppiControl};
use crate::ControlInput;

/// Distance to the goal up to which a stand counts \[m\].
const NEAR_M: f64 = 1.0;

/// Time of a stand after which the heading is ignored \[ns\].
const PATIENCE_NS: i64 = 1_000_000_000;

/// Speeds of a stand \[m/s\], \[rad/s\].
const STILL: (f64, f64) = (0.03, 0.1);

/// Speed of the approach \[m/s\].
const APPROACH_M_S: f32 = 0.3;

/// Watch over the end of a drive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct StallWatch {
    /// Start of the stand \[ns\].
    still_since_ns: Option<i64>,
    is_approaching: bool,
}

/// Outcome of a look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stall {
    None,
    /// The heading of the goal is ignored.
    Approaching,
    /// As before, and samples start from a turn to the goal.
    Begins,
}

impl StallWatch {
    /// Looks at the inputs of a cycle.
    pub(super) fn look(&mut self, input: &ControlInput<'_>) -> Stall {
        let (dx_m, dy_m) = (input.goal.x_m - input.pose.x_m, input.goal.y_m - input.pose.y_m);
        let distance_m = libm::hypot(dx_m, dy_m);
        let tolerance_m = input.tolerance.xy_m.unwrap_or(f64::INFINITY);
        if input.is_position_reached || distance_m <= tolerance_m || distance_m > NEAR_M {
            *self = Self::default();
            return Stall::None;
        }
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } = input.velocity;
        let is_still = libm::hypot(vx_m_s, vy_m_s) < STILL.0 && wz_rad_s.abs() < STILL.1;
        if !is_still {
            self.still_since_ns = None;
        } else if input.time_ns - *self.still_since_ns.get_or_insert(input.time_ns) >= PATIENCE_NS {
            *self = Self { still_since_ns: None, is_approaching: true };
            return Stall::Begins;
        }
        if self.is_approaching { Stall::Approaching } else { Stall::None }
    }
}

/// Sets a sequence to a turn towards a point ahead or behind, the nearer one, and a drive to it; `bearing_rad` and
/// `distance_m` are those of the point from the robot.
pub(super) fn seed(
    sequence: &mut ControlSequence,
    bearing_rad: f32,
    distance_m: f32,
    limits: &MppiVelocityLimits,
    step_s: f32,
) {
    let is_behind = limits.vx_min < 0.0 && bearing_rad.abs() > std::f32::consts::FRAC_PI_2;
    let turn_rad =
        if is_behind { normalize_angle(bearing_rad + std::f32::consts::PI) } else { bearing_rad };
    let speed =
        if is_behind { -APPROACH_M_S.min(-limits.vx_min) } else { APPROACH_M_S.min(limits.vx_max) };
    let (mut turned, mut driven) = (0.0, 0.0);
    for step in 0..sequence.len() {
        let mut control = MppiControl::default();
        let left_rad: f32 = turn_rad.abs() - turned;
        let left_m: f32 = distance_m - driven;
        if left_rad > 0.0 {
            let rate = limits.wz_max.min(left_rad / step_s);
            turned += rate * step_s;
            control.wz = rate * turn_rad.signum();
        } else if left_m > 0.0 {
            driven += speed.abs() * step_s;
            control.vx = speed;
        }
        sequence.set(step, control);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bearing_rad: f32, turned_rad: f32, driven_m: f32) {
        let limits = MppiVelocityLimits { vx_max: 0.5, vx_min: -0.35, vy_max: 0.0, wz_max: 1.9 };
        let mut sequence = ControlSequence::new(56);
        seed(&mut sequence, bearing_rad, 0.3, &limits, 0.05);
        let sum = |values: &[f32]| values.iter().sum::<f32>() * 0.05;
        assert!((sum(&sequence.wz) - turned_rad).abs() < 1e-3, "{}", sum(&sequence.wz));
        assert!((sum(&sequence.vx) - driven_m).abs() < 0.02, "{}", sum(&sequence.vx));
    }

    #[test]
    fn a_seed_turns_to_the_goal_and_drives_to_it() {
        check(1.0, 1.0, 0.3);
        check(-1.5, -1.5, 0.3);
        // It drives backwards to a goal behind it.
        check(3.0, 3.0 - std::f32::consts::PI, -0.3);
    }
}
