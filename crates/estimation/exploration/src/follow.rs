//! Path following by pure pursuit.

use periplus_geometry::{Pose2, normalize_angle};

/// Velocity command: forward and turning to the left.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Velocity {
    /// Forward velocity [m/s].
    pub forward_m_s: f64,
    /// Turn rate to the left [rad/s].
    pub left_rad_s: f64,
}

/// Lookahead distance \[m\].
const AHEAD_M: f64 = 0.4;

/// Angle beyond which the robot rotates in place first \[rad\].
const TURN_FIRST_RAD: f64 = 0.7;

/// Proportional gain of the turn rate [1/s].
const TURN_RATE_PER_ANGLE_HZ: f64 = 2.0;

/// Returns the velocity that follows a path within velocity limits: towards the lookahead point
/// beyond the nearest point, slower in turns and before the end (pure pursuit; Coulter, 1992).
/// Passed points are removed from the path.
pub fn follow(way: &mut Vec<[f64; 2]>, map_from_base: Pose2, most: Velocity) -> Velocity {
    let distance = |[x, y]: &[f64; 2]| libm::hypot(x - map_from_base.x_m, y - map_from_base.y_m);
    let by_distance = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
    let places = way.iter().map(distance).enumerate();
    if let Some((nearest, _)) = places.min_by(by_distance) {
        way.drain(..nearest);
    }
    let Some(end) = way.last() else { return Velocity::default() };
    let target = way.iter().find(|point| distance(point) >= AHEAD_M).unwrap_or(end);
    let bearing = libm::atan2(target[1] - map_from_base.y_m, target[0] - map_from_base.x_m);
    let off_rad = normalize_angle(bearing - map_from_base.yaw_rad);
    let left_rad_s = (TURN_RATE_PER_ANGLE_HZ * off_rad).clamp(-most.left_rad_s, most.left_rad_s);
    if off_rad.abs() > TURN_FIRST_RAD {
        return Velocity { forward_m_s: 0.0, left_rad_s };
    }
    let slower = libm::cos(off_rad) * (distance(end) / AHEAD_M).clamp(0.2, 1.0);
    Velocity { forward_m_s: most.forward_m_s * slower, left_rad_s }
}
