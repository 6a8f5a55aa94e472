//! Straight drive.

use std::fmt;

use periplus_costmap::Nav2Release;
use periplus_geometry::Pose2;

use super::lookahead_cycle_count;

/// Limits of the speed of a straight drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveLimits {
    /// Maximum acceleration, without sign \[m/s^2\]; 0 for none, with a deceleration of 0.
    pub acceleration_m_s2: f64,
    /// Maximum deceleration, without sign \[m/s^2\].
    pub deceleration_m_s2: f64,
    /// Minimum speed \[m/s\].
    pub min_speed_m_s: f64,
    /// True if an acceleration or deceleration of 0 is no limit, as in Humble.
    pub is_off_at_zero: bool,
}

impl DriveLimits {
    /// No limits: the speed is constant.
    pub const NONE: Self = Self {
        acceleration_m_s2: 0.0,
        deceleration_m_s2: 0.0,
        min_speed_m_s: 0.0,
        is_off_at_zero: true,
    };

    /// Limits of a release from the values of its parameters; the signs have no effect. Jazzy has no
    /// limits.
    #[must_use]
    pub fn new(
        release: Nav2Release,
        acceleration_m_s2: f64,
        deceleration_m_s2: f64,
        min_speed_m_s: f64,
    ) -> Self {
        if matches!(release, Nav2Release::EarlyJazzy | Nav2Release::Jazzy) {
            return Self::NONE;
        }
        Self {
            acceleration_m_s2: acceleration_m_s2.abs(),
            deceleration_m_s2: deceleration_m_s2.abs(),
            min_speed_m_s,
            is_off_at_zero: release == Nav2Release::Humble,
        }
    }

    fn are_off(&self) -> bool {
        self.is_off_at_zero && (self.acceleration_m_s2 == 0.0 || self.deceleration_m_s2 == 0.0)
    }
}

/// Command that cannot be driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InvalidDrive {
    /// The target has a part to the side or upward.
    NotAhead,
    /// Target and speed have different signs.
    Signs,
    /// A component of the target or the speed is not a finite number.
    NotFinite,
}

impl fmt::Display for InvalidDrive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotAhead => "the target must be along x: set `target.y` and `target.z` to 0",
            Self::Signs => "`target.x` and `speed` must have the same sign",
            Self::NotFinite => "`target` and `speed` must be finite numbers",
        })
    }
}

impl std::error::Error for InvalidDrive {}

/// Straight drive forward or backward.
///
/// ```
/// use periplus_motion::behaviors::{DriveLimits, StraightDrive};
///
/// let drive = StraightDrive::backward([0.3, 0.0, 0.0], 0.15).unwrap();
/// assert_eq!(drive.velocity_m_s(0.0, 0.0, 10.0, &DriveLimits::NONE), Some(-0.15));
/// assert_eq!(drive.velocity_m_s(0.3, -0.15, 10.0, &DriveLimits::NONE), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightDrive {
    distance_m: f64,
    speed_m_s: f64,
}

impl StraightDrive {
    /// Drive to a target in the base frame \[m\], as `DriveOnHeading`.
    ///
    /// # Errors
    /// The mistake in the command.
    pub fn on_heading(target_m: [f64; 3], speed_m_s: f64) -> Result<Self, InvalidDrive> {
        let distance_m = along_x(target_m, speed_m_s)?;
        if (distance_m > 0.0) != (speed_m_s > 0.0) {
            return Err(InvalidDrive::Signs);
        }
        Ok(Self { distance_m, speed_m_s })
    }

    /// Drive backward, as `BackUp`: the signs of target and speed have no effect.
    ///
    /// # Errors
    /// The mistake in the command.
    pub fn backward(target_m: [f64; 3], speed_m_s: f64) -> Result<Self, InvalidDrive> {
        let distance_m = -along_x(target_m, speed_m_s)?.abs();
        Ok(Self { distance_m, speed_m_s: -speed_m_s.abs() })
    }

    /// Velocity of the next cycle after a distance \[m\], if the last one was `last_m_s`; none once
    /// the target is reached.
    #[must_use]
    pub fn velocity_m_s(
        &self,
        travelled_m: f64,
        last_m_s: f64,
        frequency_hz: f64,
        limits: &DriveLimits,
    ) -> Option<f64> {
        if travelled_m >= self.distance_m.abs() {
            return None;
        }
        let sign: f64 = if self.speed_m_s > 0.0 { 1.0 } else { -1.0 };
        // Along the direction of the drive.
        let mut ahead_m_s = self.speed_m_s * sign;
        if !limits.are_off() {
            let last_m_s = last_m_s * sign;
            let slowest_m_s = last_m_s - limits.deceleration_m_s2 / frequency_hz;
            let fastest_m_s = last_m_s + limits.acceleration_m_s2 / frequency_hz;
            ahead_m_s = ahead_m_s.max(slowest_m_s).min(fastest_m_s);
            let remaining_m = self.distance_m.abs() - travelled_m;
            let braking_m_s = libm::sqrt(2.0 * limits.deceleration_m_s2 * remaining_m);
            if braking_m_s < ahead_m_s.abs() {
                ahead_m_s = braking_m_s;
            }
        }
        if ahead_m_s.abs() < limits.min_speed_m_s {
            ahead_m_s = limits.min_speed_m_s;
        }
        Some(ahead_m_s * sign)
    }

    /// Poses of the robot with a velocity \[m/s\], one for each cycle, as far as the lookahead and the
    /// target.
    pub fn poses_ahead(
        &self,
        pose: Pose2,
        travelled_m: f64,
        velocity_m_s: f64,
        frequency_hz: f64,
        lookahead_s: f64,
    ) -> impl Iterator<Item = Pose2> + use<> {
        let remaining_m = self.distance_m.abs() - travelled_m;
        let (sine, cosine) = libm::sincos(pose.yaw_rad);
        let distances = (0..lookahead_cycle_count(frequency_hz, lookahead_s))
            .map(move |cycle| velocity_m_s * (f64::from(cycle) / frequency_hz));
        distances.take_while(move |distance_m| distance_m.abs() < remaining_m).map(
            move |distance_m| Pose2 {
                x_m: pose.x_m + distance_m * cosine,
                y_m: pose.y_m + distance_m * sine,
                ..pose
            },
        )
    }
}

/// Distance of a target that is along x \[m\].
fn along_x([x, y, z]: [f64; 3], speed_m_s: f64) -> Result<f64, InvalidDrive> {
    if ![x, y, z, speed_m_s].iter().all(|number| number.is_finite()) {
        return Err(InvalidDrive::NotFinite);
    }
    if y == 0.0 && z == 0.0 { Ok(x) } else { Err(InvalidDrive::NotAhead) }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const LIMITS: DriveLimits = DriveLimits {
        acceleration_m_s2: 2.5,
        deceleration_m_s2: 2.5,
        min_speed_m_s: 0.1,
        is_off_at_zero: false,
    };

    #[test]
    fn a_drive_accelerates_and_brakes() {
        let check = |speed: f64, travelled: f64, last: f64, expected: Option<f64>| {
            let drive = StraightDrive::on_heading([speed.signum(), 0.0, 0.0], speed).unwrap();
            let velocity = drive.velocity_m_s(travelled, last, 10.0, &LIMITS);
            let is_same = match (velocity, expected) {
                (Some(velocity), Some(expected)) => (velocity - expected).abs() < 1e-12,
                (velocity, expected) => velocity == expected,
            };
            assert!(is_same, "{velocity:?}, expected {expected:?}");
        };
        check(1.0, 0.0, 0.0, Some(0.25));
        check(1.0, 0.1, 0.25, Some(0.5));
        check(-1.0, 0.1, -0.25, Some(-0.5));
        // sqrt(2 * 2.5 * 0.05) = 0.5
        check(1.0, 0.95, 0.6, Some(0.5));
        check(-1.0, 0.95, -0.6, Some(-0.5));
        check(1.0, 0.9999, 0.3, Some(0.1));
        check(1.0, 1.0, 0.3, None);
        check(0.05, 0.0, 0.0, Some(0.1));
        // A robot that is faster than commanded brakes.
        check(0.2, 0.0, 0.8, Some(0.55));
    }

    #[test]
    fn limits_of_zero_are_off_in_humble() {
        let drive = StraightDrive::backward([-0.3, 0.0, 0.0], 0.2).unwrap();
        assert_eq!(drive.velocity_m_s(0.299, 0.0, 10.0, &DriveLimits::NONE), Some(-0.2));
        let slow = DriveLimits { min_speed_m_s: 0.3, ..DriveLimits::NONE };
        assert_eq!(drive.velocity_m_s(0.0, 0.0, 10.0, &slow), Some(-0.3));
    }

    #[test]
    fn commands_are_checked() {
        let heading = StraightDrive::on_heading;
        assert_eq!(heading([1.0, 0.1, 0.0], 0.1), Err(InvalidDrive::NotAhead));
        assert_eq!(heading([1.0, 0.0, 0.1], 0.1), Err(InvalidDrive::NotAhead));
        assert_eq!(heading([1.0, 0.0, 0.0], -0.1), Err(InvalidDrive::Signs));
        assert!(heading([-1.0, 0.0, 0.0], -0.1).is_ok());
        let back = StraightDrive::backward([0.0, 1.0, 0.0], 0.1);
        assert_eq!(back, Err(InvalidDrive::NotAhead));
        for number in [f64::NAN, f64::INFINITY] {
            assert_eq!(heading([number, 0.0, 0.0], 0.1), Err(InvalidDrive::NotFinite));
            let back = StraightDrive::backward([1.0, 0.0, 0.0], number);
            assert_eq!(back, Err(InvalidDrive::NotFinite));
        }
    }

    #[test]
    fn poses_end_at_the_target() {
        let drive = StraightDrive::backward([0.3, 0.0, 0.0], 1.0).unwrap();
        let pose = Pose2::new(1.0, 2.0, 0.0);
        let poses = |travelled| drive.poses_ahead(pose, travelled, -1.0, 10.0, 2.0);
        let xs: Vec<f64> = poses(0.05).map(|pose| pose.x_m).collect();
        assert_eq!(xs, [1.0, 0.9, 0.8]);
        assert_eq!(poses(0.3).count(), 0);
    }

    proptest! {
        #[test]
        fn a_drive_arrives(distance in 0.01..3.0f64, speed in 0.05..1.0f64, is_back: bool) {
            let target = [distance, 0.0, 0.0];
            let drive = if is_back {
                StraightDrive::backward(target, speed)
            } else {
                StraightDrive::on_heading(target, speed)
            }.unwrap();
            let (mut travelled, mut last, mut cycles) = (0.0, 0.0, 0);
            while let Some(velocity) = drive.velocity_m_s(travelled, last, 10.0, &LIMITS) {
                prop_assert_eq!(velocity < 0.0, is_back);
                travelled += velocity.abs() / 10.0;
                last = velocity;
                cycles += 1;
                prop_assert!(cycles < 1000);
            }
            prop_assert!(travelled - distance <= 0.1 * speed.max(0.1));
        }
    }
}
