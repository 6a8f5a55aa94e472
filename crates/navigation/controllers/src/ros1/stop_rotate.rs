//! Stopping and rotating at the goal.
//!
//! Source: `latched_stop_rotate_controller.cpp`, `stopWithAccLimits` and `rotateToGoal` of
//! `trajectory_planner_ros.cpp`.

use periplus_geometry::{Pose2, Twist2, normalize_angle};

use crate::path::distance_m;

/// Limits at the goal.
#[derive(Clone, Copy, Debug)]
pub(super) struct StopRotateLimits {
    pub xy_tolerance_m: f64,
    pub yaw_tolerance_rad: f64,
    /// Remembers that the position was reached.
    pub latches: bool,
    /// Speed and turn rate at which the robot stands still.
    pub stopped_m_s: f64,
    pub stopped_rad_s: f64,
    pub min_rate_rad_s: f64,
    pub max_rate_rad_s: f64,
    pub accelerations: Twist2,
    pub period_s: f64,
}

/// State at the goal.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct StopRotate {
    was_at_position: bool,
    is_rotating: bool,
}

impl StopRotate {
    pub(super) fn reset(&mut self) {
        self.was_at_position = false;
    }

    /// Returns true if the robot is at the position of the goal.
    pub(super) fn is_at_position(
        &mut self,
        limits: &StopRotateLimits,
        pose: Pose2,
        goal: Pose2,
    ) -> bool {
        let is_near = distance_m(pose, goal) <= limits.xy_tolerance_m;
        self.was_at_position = limits.latches && (self.was_at_position || is_near);
        self.was_at_position || is_near
    }

    /// Returns the velocity at the position of the goal: zero with the right heading, else first a deceleration, then
    /// the rotation.
    pub(super) fn velocity(
        &mut self,
        limits: &StopRotateLimits,
        pose: Pose2,
        goal: Pose2,
        present: Twist2,
    ) -> Twist2 {
        let angle_rad = normalize_angle(goal.yaw_rad - pose.yaw_rad);
        if angle_rad.abs() <= limits.yaw_tolerance_rad {
            self.is_rotating = false;
            return Twist2::ZERO;
        }
        let is_still = present.wz_rad_s.abs() <= limits.stopped_rad_s
            && present.vx_m_s.abs() <= limits.stopped_m_s
            && present.vy_m_s.abs() <= limits.stopped_m_s;
        if !self.is_rotating && !is_still {
            return stopping(limits, present);
        }
        self.is_rotating = true;
        Twist2::new(0.0, 0.0, rotation_rad_s(limits, angle_rad, present.wz_rad_s))
    }
}

/// Velocity after a period of the greatest deceleration.
fn stopping(limits: &StopRotateLimits, present: Twist2) -> Twist2 {
    let slower = |velocity: f64, acceleration: f64| {
        libm::copysign((velocity.abs() - acceleration * limits.period_s).max(0.0), velocity)
    };
    Twist2::new(
        slower(present.vx_m_s, limits.accelerations.vx_m_s),
        slower(present.vy_m_s, limits.accelerations.vy_m_s),
        slower(present.wz_rad_s, limits.accelerations.wz_rad_s),
    )
}

/// Turn rate in proportion to the angle, within the acceleration and such that the robot can stop there; at least the
/// minimum rate.
fn rotation_rad_s(limits: &StopRotateLimits, angle_rad: f64, present_rad_s: f64) -> f64 {
    let clamped =
        |rate_rad_s: f64| rate_rad_s.max(limits.min_rate_rad_s).min(limits.max_rate_rad_s);
    let acceleration_rad_s2 = limits.accelerations.wz_rad_s;
    let step_rad_s = acceleration_rad_s2 * limits.period_s;
    let rate_rad_s = clamped(angle_rad.abs())
        .max(present_rad_s.abs() - step_rad_s)
        .min(present_rad_s.abs() + step_rad_s);
    let stopping_rad_s = libm::sqrt(2.0 * acceleration_rad_s2 * angle_rad.abs());
    libm::copysign(clamped(rate_rad_s.min(stopping_rad_s)), angle_rad)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: StopRotateLimits = StopRotateLimits {
        xy_tolerance_m: 0.1,
        yaw_tolerance_rad: 0.1,
        latches: false,
        stopped_m_s: 0.1,
        stopped_rad_s: 0.1,
        min_rate_rad_s: 0.4,
        max_rate_rad_s: 1.0,
        accelerations: Twist2::new(2.0, 2.0, 4.0),
        period_s: 0.1,
    };

    #[track_caller]
    fn check(yaw_rad: f64, present: Twist2, expected: Twist2) {
        let pose = Pose2::new(0.0, 0.0, yaw_rad);
        let found = StopRotate::default().velocity(&LIMITS, pose, Pose2::IDENTITY, present);
        assert_eq!(found, expected);
    }

    #[test]
    fn the_robot_stops_and_then_rotates() {
        check(0.05, Twist2::new(0.5, 0.0, 0.0), Twist2::ZERO);
        check(1.0, Twist2::new(0.5, 0.0, 0.0), Twist2::new(0.3, 0.0, 0.0));
        check(1.0, Twist2::ZERO, Twist2::new(0.0, 0.0, -0.4));
        check(-0.5, Twist2::new(0.0, 0.0, 0.1), Twist2::new(0.0, 0.0, 0.5));
    }

    #[test]
    fn a_latched_position_is_remembered() {
        let mut state = StopRotate::default();
        let limits = StopRotateLimits { latches: true, ..LIMITS };
        let mut at =
            |x_m| state.is_at_position(&limits, Pose2::new(x_m, 0.0, 0.0), Pose2::IDENTITY);
        assert_eq!([at(0.2), at(0.1), at(0.2)], [false, true, true]);
    }
}
