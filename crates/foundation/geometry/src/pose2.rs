//! Rigid transforms in the plane.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::{Pose, Twist2};

/// Rigid transform `a_from_b` in the plane: transforms coordinates in `b` to coordinates in `a`, and is the
/// pose of `b` in `a`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose2 {
    /// Origin of `b` in `a`, along x \[m\].
    pub x_m: f64,
    /// Origin of `b` in `a`, along y \[m\].
    pub y_m: f64,
    /// Direction of the x axis of `b` in `a`, counterclockwise \[rad\]; not limited to ±π.
    pub yaw_rad: f64,
}

impl Pose2 {
    /// Identity transform.
    pub const IDENTITY: Self = Self::new(0.0, 0.0, 0.0);

    /// Transform from a translation \[m\] and a rotation \[rad\].
    #[must_use]
    pub const fn new(x_m: f64, y_m: f64, yaw_rad: f64) -> Self {
        Self { x_m, y_m, yaw_rad }
    }

    /// Inverse transform: `b_from_a` of an `a_from_b`.
    #[must_use]
    pub fn inverse(self) -> Self {
        let (sine, cosine) = sine_and_cosine(self.yaw_rad);
        Self {
            x_m: -(cosine * self.x_m + sine * self.y_m),
            y_m: sine * self.x_m - cosine * self.y_m,
            yaw_rad: -self.yaw_rad,
        }
    }

    /// Transforms a point in `b` \[m\] to coordinates in `a` \[m\].
    #[must_use]
    pub fn transform_point(self, x_in_b_m: f64, y_in_b_m: f64) -> (f64, f64) {
        let (sine, cosine) = sine_and_cosine(self.yaw_rad);
        let x_m = cosine * x_in_b_m - sine * y_in_b_m;
        let y_m = sine * x_in_b_m + cosine * y_in_b_m;
        (self.x_m + x_m, self.y_m + y_m)
    }

    /// Returns the pose after motion with a constant velocity of the body for a time \[s\]: along an arc, for any
    /// duration.
    ///
    /// The position moves by the integral of the rotating velocity, `V(a) (x, y) dt` with the turned
    /// angle `a` and `V(a) = [[sin a, cos a - 1], [1 - cos a, sin a]] / a` (the exponential map of
    /// planar motions; Lynch & Park, "Modern Robotics", section 3.3).
    #[must_use]
    pub fn advanced(self, twist: Twist2, dt_s: f64) -> Self {
        let angle = twist.wz_rad_s * dt_s;
        let (sine_by_angle, one_less_cosine_by_angle) = if angle.abs() < 1e-4 {
            // Terms beyond the second are below the precision of a double.
            (1.0 - angle * angle / 6.0, angle / 2.0 - angle * angle * angle / 24.0)
        } else {
            let half = libm::sin(angle / 2.0);
            (libm::sin(angle) / angle, 2.0 * half * half / angle)
        };
        let (ahead, left) = (twist.vx_m_s * dt_s, twist.vy_m_s * dt_s);
        let along = sine_by_angle * ahead - one_less_cosine_by_angle * left;
        let across = one_less_cosine_by_angle * ahead + sine_by_angle * left;
        let (sine, cosine) = libm::sincos(self.yaw_rad);
        Self {
            x_m: self.x_m + cosine * along - sine * across,
            y_m: self.y_m + sine * along + cosine * across,
            yaw_rad: self.yaw_rad + angle,
        }
    }

    /// Returns the same transform with the yaw in (-π, π].
    #[must_use]
    pub fn normalized(self) -> Self {
        Self { yaw_rad: normalize_angle(self.yaw_rad), ..self }
    }

    /// Returns true if all three numbers are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.x_m.is_finite() && self.y_m.is_finite() && self.yaw_rad.is_finite()
    }
}

impl std::ops::Mul for Pose2 {
    type Output = Self;

    /// `a_from_b * b_from_c = a_from_c`. The yaws are added without normalization.
    #[expect(clippy::suspicious_arithmetic_impl, reason = "turns on the plane add up")]
    fn mul(self, b_from_c: Self) -> Self {
        let (x_m, y_m) = self.transform_point(b_from_c.x_m, b_from_c.y_m);
        Self { x_m, y_m, yaw_rad: self.yaw_rad + b_from_c.yaw_rad }
    }
}

/// Embeds the plane as z = 0 in three dimensions.
impl From<Pose2> for Pose {
    fn from(pose: Pose2) -> Self {
        let (sine, cosine) = libm::sincos(pose.yaw_rad / 2.0);
        Self {
            translation: DVec3::new(pose.x_m, pose.y_m, 0.0),
            rotation: DQuat::from_xyzw(0.0, 0.0, sine, cosine),
        }
    }
}

/// Projects onto the plane z = 0: keeps x, y and yaw.
impl From<Pose> for Pose2 {
    fn from(pose: Pose) -> Self {
        Self::new(pose.translation.x, pose.translation.y, pose.rpy().yaw)
    }
}

/// Equivalent angle in (-π, π] \[rad\]. Angles in this range are returned unchanged.
#[must_use]
pub fn normalize_angle(angle_rad: f64) -> f64 {
    use std::f64::consts::PI;
    if angle_rad > -PI && angle_rad <= PI {
        return angle_rad;
    }
    let rest = libm::remainder(angle_rad, 2.0 * PI);
    if rest <= -PI { PI } else { rest }
}

/// Exact for a zero angle, so that pure translations stay exact.
fn sine_and_cosine(angle_rad: f64) -> (f64, f64) {
    if angle_rad == 0.0 { (0.0, 1.0) } else { libm::sincos(angle_rad) }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use proptest::prelude::*;

    use super::*;

    fn near(a: Pose2, b: Pose2) -> bool {
        let turn = normalize_angle(a.yaw_rad - b.yaw_rad).abs();
        (a.x_m - b.x_m).abs() < 1e-9 && (a.y_m - b.y_m).abs() < 1e-9 && turn < 1e-9
    }

    #[test]
    fn a_quarter_turn() {
        let map_from_base = Pose2::new(1.0, 2.0, FRAC_PI_2);
        let (x_m, y_m) = map_from_base.transform_point(3.0, 0.0);
        assert!((x_m - 1.0).abs() < 1e-12 && (y_m - 5.0).abs() < 1e-12);
    }

    #[test]
    fn a_quarter_of_a_circle_with_a_radius_of_one_metre() {
        let twist = Twist2::new(FRAC_PI_2, 0.0, FRAC_PI_2);
        let end = Pose2::IDENTITY.advanced(twist, 1.0);
        assert!(near(end, Pose2::new(1.0, 1.0, FRAC_PI_2)), "{end:?}");
    }

    #[test]
    fn angles_come_into_half_a_turn() {
        assert_eq!(normalize_angle(PI), PI);
        assert_eq!(normalize_angle(-PI), PI);
        assert_eq!(normalize_angle(0.25), 0.25);
        assert!((normalize_angle(1.5 * PI) + 0.5 * PI).abs() < 1e-12);
        assert!((normalize_angle(7.0 * PI) - PI).abs() < 1e-12);
    }

    proptest! {
        #[test]
        fn there_and_back(
            a in [-9.0..9.0, -9.0..9.0, -9.0..9.0_f64],
            b in [-9.0..9.0, -9.0..9.0, -9.0..9.0_f64],
        ) {
            let pose = |[x_m, y_m, yaw_rad]: [f64; 3]| Pose2::new(x_m, y_m, yaw_rad);
            let (a, b) = (pose(a), pose(b));
            prop_assert!(near(a * a.inverse(), Pose2::IDENTITY));
            prop_assert!(near((a * b).inverse(), b.inverse() * a.inverse()));
            prop_assert!(near(Pose2::from(Pose::from(a) * Pose::from(b)), a * b));
        }
    }
}
