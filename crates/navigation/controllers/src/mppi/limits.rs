//! Limits of velocity and acceleration, and the motion models.
//!
//! Source: `nav2_mppi_controller` `optimizer.cpp` (`setSpeedLimit`), `motion_models.hpp`.

use super::lanes::{clamp, max, min};
use super::sequence::ControlSequence;

/// Motion model of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MppiModel {
    /// Differential drive.
    DiffDrive,
    /// Omnidirectional drive.
    Omni,
    /// Steered wheels.
    Ackermann {
        /// Minimum radius of a curve \[m\].
        min_turning_radius_m: f32,
        /// True if samples keep the curvature of the sequence, and the limit.
        samples_curvatures: bool,
    },
}

impl MppiModel {
    /// Returns true if the robot can move sideways.
    #[must_use]
    pub fn is_holonomic(self) -> bool {
        self == Self::Omni
    }

    /// Returns the highest curvature of samples \[1/m\]; none if samples may turn at any rate, as in Nav2.
    pub(crate) fn max_sample_curvature(self) -> Option<f32> {
        match self {
            Self::Ackermann { min_turning_radius_m, samples_curvatures: true } => {
                Some(1.0 / min_turning_radius_m)
            }
            _ => None,
        }
    }

    /// Limits turn rates to curves that the robot can drive.
    pub(crate) fn limit_turns(self, sequence: &mut ControlSequence) {
        let Self::Ackermann { min_turning_radius_m, .. } = self else { return };
        for (wz, vx) in sequence.wz.iter_mut().zip(&sequence.vx) {
            let limit = vx.abs() / min_turning_radius_m;
            *wz = clamp(*wz, -limit, limit);
        }
    }
}

/// Limits of the velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MppiVelocityLimits {
    /// Maximum velocity forwards \[m/s\].
    pub vx_max: f32,
    /// Minimum velocity forwards, negative if the robot may reverse \[m/s\].
    pub vx_min: f32,
    /// Maximum speed sideways \[m/s\].
    pub vy_max: f32,
    /// Maximum turn rate \[rad/s\].
    pub wz_max: f32,
}

impl MppiVelocityLimits {
    /// Returns the limits under a speed limit: a percentage of the maximum speed, or a speed \[m/s\] that
    /// replaces `vx_max`. All limits are scaled by the same ratio. A limit of 0 is none.
    #[must_use]
    pub fn limited(&self, limit: f64, is_percentage: bool) -> Self {
        if limit == 0.0 {
            return *self;
        }
        let ratio = if is_percentage { limit / 100.0 } else { limit / f64::from(self.vx_max) };
        if !ratio.is_finite() {
            return *self;
        }
        let scaled = |value: f32| (f64::from(value) * ratio) as f32;
        Self {
            vx_max: scaled(self.vx_max),
            vx_min: scaled(self.vx_min),
            vy_max: scaled(self.vy_max),
            wz_max: scaled(self.wz_max),
        }
    }
}

/// Limits of the accelerations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MppiAccelerationLimits {
    /// Maximum acceleration forwards \[m/s²\].
    pub ax_max: f32,
    /// Strongest deceleration, negative \[m/s²\].
    pub ax_min: f32,
    /// Maximum acceleration sideways \[m/s²\].
    pub ay_max: f32,
    /// Strongest deceleration sideways, negative \[m/s²\].
    pub ay_min: f32,
    /// Maximum angular acceleration \[rad/s²\].
    pub az_max: f32,
}

impl MppiAccelerationLimits {
    /// Returns the changes of the velocity that are possible within a time \[s\].
    pub(crate) fn within(&self, time_s: f32) -> Changes {
        Changes {
            vx: Change { gain: time_s * self.ax_max, loss: time_s * self.ax_min },
            vy: Change { gain: time_s * self.ay_max, loss: time_s * self.ay_min },
            wz: Change { gain: time_s * self.az_max, loss: -time_s * self.az_max },
        }
    }
}

/// Possible change of a speed in one step; mirrored for motion backwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Change {
    /// Increase of the speed.
    pub(crate) gain: f32,
    /// Decrease of the speed, negative.
    pub(crate) loss: f32,
}

impl Change {
    /// No limit.
    pub(crate) const FREE: Self = Self { gain: f32::INFINITY, loss: f32::NEG_INFINITY };

    /// Velocity nearest to a wanted one that is reached from the last. Standing still counts as motion
    /// backwards.
    #[inline(always)]
    pub(crate) fn reach(self, wanted: f32, last: f32) -> f32 {
        let is_forwards = last > 0.0;
        let lower = last + if is_forwards { self.loss } else { -self.gain };
        let upper = last + if is_forwards { self.gain } else { -self.loss };
        min(max(wanted, lower), upper)
    }

    /// Velocity as [`Self::reach`], where standing still counts as motion forwards.
    pub(crate) fn reach_from_rest(self, wanted: f32, last: f32) -> f32 {
        if last == 0.0 { clamp(wanted, self.loss, self.gain) } else { self.reach(wanted, last) }
    }
}

/// Possible changes of all axes in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Changes {
    pub(crate) vx: Change,
    pub(crate) vy: Change,
    pub(crate) wz: Change,
}

impl Changes {
    /// No limits, as in Humble.
    pub(crate) const FREE: Self = Self { vx: Change::FREE, vy: Change::FREE, wz: Change::FREE };
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check_limit(limit: f64, is_percentage: bool, expected: [f32; 4]) {
        let base = MppiVelocityLimits { vx_max: 0.5, vx_min: -0.35, vy_max: 0.5, wz_max: 1.9 };
        let limited = base.limited(limit, is_percentage);
        let values = [limited.vx_max, limited.vx_min, limited.vy_max, limited.wz_max];
        for (value, expected) in values.into_iter().zip(expected) {
            assert!((value - expected).abs() < 1e-6, "{limit}: {values:?}");
        }
    }

    #[test]
    fn speed_limits_scale_every_axis() {
        check_limit(0.25, false, [0.25, -0.175, 0.25, 0.95]);
        check_limit(50.0, true, [0.25, -0.175, 0.25, 0.95]);
        check_limit(1.0, false, [1.0, -0.7, 1.0, 3.8]);
        check_limit(0.0, true, [0.5, -0.35, 0.5, 1.9]);
    }

    #[test]
    fn speeds_change_as_far_as_the_accelerations_permit() {
        let change = Change { gain: 0.15, loss: -0.3 };
        let reached = |wanted, last| change.reach(wanted, last);
        assert_eq!([reached(1.0, 0.2), reached(-1.0, 0.2)], [0.2 + 0.15, 0.2 - 0.3]);
        // Backwards, a lower velocity is a higher speed.
        assert_eq!([reached(1.0, -0.2), reached(-1.0, -0.2)], [-0.2 + 0.3, -0.2 - 0.15]);
        assert_eq!([reached(1.0, 0.0), change.reach_from_rest(1.0, 0.0)], [0.3, 0.15]);
        assert_eq!(Change::FREE.reach(9.0, 0.0), 9.0);
    }

    #[test]
    fn curves_are_wide_enough_for_steered_wheels() {
        let mut sequence = ControlSequence::new(3);
        sequence.vx = vec![0.4, -0.4, 0.4];
        sequence.wz = vec![5.0, -5.0, 0.5];
        MppiModel::Ackermann { min_turning_radius_m: 0.4, samples_curvatures: false }
            .limit_turns(&mut sequence);
        assert_eq!(sequence.wz, [1.0, -1.0, 0.5]);
    }
}
