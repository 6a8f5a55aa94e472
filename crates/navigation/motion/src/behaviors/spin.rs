//! Rotation in place.

use std::f64::consts::PI;

use periplus_geometry::Pose2;

use super::lookahead_cycle_count;

/// Angle below which a rotation is complete \[rad\].
const DONE_RAD: f64 = 1e-6;

/// Limits of a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpinLimits {
    /// Minimum speed \[rad/s\].
    pub min_rad_s: f64,
    /// Maximum speed \[rad/s\].
    pub max_rad_s: f64,
    /// Deceleration with which the target is reached \[rad/s^2\].
    pub acc_rad_s2: f64,
}

/// Rotation in place by an angle, which may exceed a full turn.
///
/// ```
/// use periplus_motion::behaviors::{Spin, SpinLimits};
///
/// let limits = SpinLimits { min_rad_s: 0.4, max_rad_s: 1.0, acc_rad_s2: 3.2 };
/// let mut spin = Spin::new(-1.0, 0.0);
/// assert_eq!(spin.velocity_rad_s(&limits), Some(-1.0));
/// spin.update(-1.0);
/// assert_eq!(spin.velocity_rad_s(&limits), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spin {
    target_rad: f64,
    last_yaw_rad: f64,
    turned_rad: f64,
}

impl Spin {
    /// Starts a rotation by an angle, left if positive, at a heading \[rad\].
    #[must_use]
    pub fn new(target_rad: f64, yaw_rad: f64) -> Self {
        Self { target_rad, last_yaw_rad: yaw_rad, turned_rad: 0.0 }
    }

    /// Continues a rotation after a part of it \[rad\].
    #[must_use]
    pub fn after(target_rad: f64, turned_rad: f64) -> Self {
        Self { turned_rad, ..Self::new(target_rad, 0.0) }
    }

    /// Adds the rotation up to a heading within ±π \[rad\].
    pub fn update(&mut self, yaw_rad: f64) {
        let mut change_rad = yaw_rad - self.last_yaw_rad;
        if change_rad.abs() > PI {
            change_rad = (2.0 * PI - change_rad.abs()).copysign(self.last_yaw_rad);
        }
        self.turned_rad += change_rad;
        self.last_yaw_rad = yaw_rad;
    }

    /// Angle that was turned \[rad\].
    #[must_use]
    pub fn turned_rad(&self) -> f64 {
        self.turned_rad
    }

    /// Angle to the target, without sign \[rad\].
    fn remaining_rad(&self) -> f64 {
        self.target_rad.abs() - self.turned_rad.abs()
    }

    /// Angular velocity of the next cycle \[rad/s\]; none once the target is reached.
    #[must_use]
    pub fn velocity_rad_s(&self, limits: &SpinLimits) -> Option<f64> {
        let remaining_rad = self.remaining_rad();
        if remaining_rad < DONE_RAD {
            return None;
        }
        let braking_rad_s = libm::sqrt(2.0 * limits.acc_rad_s2 * remaining_rad);
        let speed_rad_s = braking_rad_s.max(limits.min_rad_s).min(limits.max_rad_s);
        Some(speed_rad_s.copysign(self.target_rad))
    }

    /// Poses of the robot with a velocity \[rad/s\], one for each cycle, as far as the lookahead and
    /// the target.
    pub fn poses_ahead(
        &self,
        pose: Pose2,
        velocity_rad_s: f64,
        frequency_hz: f64,
        lookahead_s: f64,
    ) -> impl Iterator<Item = Pose2> + use<> {
        let remaining_rad = self.remaining_rad();
        let angles = (0..lookahead_cycle_count(frequency_hz, lookahead_s))
            .map(move |cycle| velocity_rad_s * (f64::from(cycle) / frequency_hz));
        angles
            .take_while(move |angle_rad| angle_rad.abs() < remaining_rad)
            .map(move |angle_rad| Pose2 { yaw_rad: pose.yaw_rad + angle_rad, ..pose })
    }
}

#[cfg(test)]
mod tests {
    use periplus_geometry::normalize_angle;
    use proptest::prelude::*;

    use super::*;

    const LIMITS: SpinLimits = SpinLimits { min_rad_s: 0.4, max_rad_s: 1.0, acc_rad_s2: 3.2 };

    #[test]
    fn a_spin_brakes_before_its_target() {
        let check = |target, turned, expected: Option<f64>| {
            assert_eq!(Spin::after(target, turned).velocity_rad_s(&LIMITS), expected);
        };
        check(1.57, 0.0, Some(1.0));
        // sqrt(2 * 3.2 * 0.1)
        check(1.5, 1.4, Some(libm::sqrt(2.0 * 3.2 * (1.5 - 1.4))));
        check(-1.5, -1.499, Some(-0.4));
        check(1.5, 1.5, None);
        check(1.5, 1.6, None);
        check(0.0, 0.0, None);
    }

    #[test]
    fn poses_end_at_the_target_and_at_the_lookahead() {
        let count =
            |spin: Spin, ahead_s| spin.poses_ahead(Pose2::IDENTITY, 0.5, 10.0, ahead_s).count();
        assert_eq!(count(Spin::after(2.0, 0.0), 2.0), 20);
        // Angles 0, 0.05, 0.1, 0.15 are below 0.19.
        assert_eq!(count(Spin::after(0.19, 0.0), 2.0), 4);
        assert_eq!(count(Spin::after(0.19, 0.19), 2.0), 0);
        let yaws: Vec<f64> = Spin::after(9.0, 0.0)
            .poses_ahead(Pose2::new(1.0, 2.0, 1.0), -0.5, 10.0, 0.3)
            .map(|pose| pose.yaw_rad)
            .collect();
        assert_eq!(yaws, [1.0, 0.95, 0.9]);
    }

    proptest! {
        #[test]
        fn turns_add_up_through_the_border(
            start in -3.1..3.1f64,
            turns in prop::collection::vec(-1.5..1.5f64, 0..30),
        ) {
            let mut spin = Spin::new(1.0, start);
            let mut yaw_rad = start;
            for turn_rad in &turns {
                yaw_rad += turn_rad;
                spin.update(normalize_angle(yaw_rad));
            }
            prop_assert!((spin.turned_rad() - (yaw_rad - start)).abs() < 1e-9);
        }
    }
}
