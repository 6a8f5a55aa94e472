//! Rigid transforms in three dimensions.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

/// Rigid transform `a_from_b`: transforms coordinates in `b` to coordinates in `a`, and is the pose of `b`
/// in `a`. Metres; the rotation is a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Origin of `b` in `a` [m].
    #[serde(rename = "xyz")]
    pub translation: DVec3,
    /// Orientation of `b` in `a`.
    #[serde(rename = "quat_xyzw")]
    pub rotation: DQuat,
}

/// Roll, pitch and yaw [rad] about the fixed axes x, y, z, in that order: `Rz(yaw) Ry(pitch)
/// Rx(roll)`. The convention of URDF, SDF and REP 103.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rpy {
    /// About x [rad].
    pub roll: f64,
    /// About y [rad].
    pub pitch: f64,
    /// About z [rad].
    pub yaw: f64,
}

impl Default for Pose {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Pose {
    /// Identity transform.
    pub const IDENTITY: Self = Self { translation: DVec3::ZERO, rotation: DQuat::IDENTITY };

    /// Translation without rotation [m].
    #[must_use]
    pub fn from_xyz(x: f64, y: f64, z: f64) -> Self {
        Self { translation: DVec3::new(x, y, z), rotation: DQuat::IDENTITY }
    }

    /// Transform from a translation [m] and fixed-axis angles [rad].
    #[must_use]
    pub fn from_xyz_rpy(xyz: [f64; 3], rpy: Rpy) -> Self {
        Self { translation: DVec3::from_array(xyz), rotation: quaternion_from_rpy(rpy) }
    }

    /// Transform from a translation [m] and a quaternion of any length except zero. A quaternion that is
    /// already of unit length within rounding is kept bit for bit, so that writing and reading back changes
    /// nothing.
    #[must_use]
    pub fn from_xyz_quaternion(xyz: [f64; 3], rotation: DQuat) -> Self {
        let rotation = if (rotation.length_squared() - 1.0).abs() < 1e-14 {
            rotation
        } else {
            rotation.normalize()
        };
        Self { translation: DVec3::from_array(xyz), rotation }
    }

    /// Inverse transform: `b_from_a` of an `a_from_b`.
    #[must_use]
    pub fn inverse(self) -> Self {
        let rotation = self.rotation.conjugate();
        Self { translation: -(rotation * self.translation), rotation }
    }

    /// Transforms a point in `b` [m] to coordinates in `a` [m].
    #[must_use]
    pub fn transform_point(self, point_in_b: DVec3) -> DVec3 {
        self.rotation * point_in_b + self.translation
    }

    /// Angles of the rotation.
    #[must_use]
    pub fn rpy(self) -> Rpy {
        rpy_from_quaternion(self.rotation)
    }

    /// Returns true if all seven numbers are finite.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.translation.is_finite() && self.rotation.is_finite()
    }

    /// Distance of the origins [m] and angle between the orientations [rad].
    #[must_use]
    pub fn distance_to(self, other: Self) -> (f64, f64) {
        let between = self.rotation.conjugate() * other.rotation;
        let sine = DVec3::new(between.x, between.y, between.z).length();
        (self.translation.distance(other.translation), 2.0 * libm::atan2(sine, between.w.abs()))
    }
}

impl std::ops::Mul for Pose {
    type Output = Self;

    /// `a_from_b * b_from_c = a_from_c`. Products with [`Pose::IDENTITY`] are exact.
    fn mul(self, b_from_c: Self) -> Self {
        if self == Self::IDENTITY {
            return b_from_c;
        }
        if b_from_c == Self::IDENTITY {
            return self;
        }
        Self {
            translation: self.transform_point(b_from_c.translation),
            rotation: (self.rotation * b_from_c.rotation).normalize(),
        }
    }
}

/// Quaternion of `Rz(yaw) Ry(pitch) Rx(roll)`.
#[must_use]
pub fn quaternion_from_rpy(rpy: Rpy) -> DQuat {
    let (sr, cr) = libm::sincos(rpy.roll / 2.0);
    let (sp, cp) = libm::sincos(rpy.pitch / 2.0);
    let (sy, cy) = libm::sincos(rpy.yaw / 2.0);
    DQuat::from_xyzw(
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )
}

/// Angles of a unit quaternion; pitch within ±π/2. At a pitch of ±π/2, where roll and yaw have the same
/// axis, roll is 0.
#[must_use]
pub fn rpy_from_quaternion(q: DQuat) -> Rpy {
    let sine_pitch = 2.0 * (q.w * q.y - q.z * q.x);
    if sine_pitch.abs() > 1.0 - 1e-12 {
        let yaw = 2.0 * libm::atan2(q.z, q.w);
        let sign = sine_pitch.signum();
        // Fold yaw into ±π: 2·atan2 spans ±2π.
        let yaw = libm::remainder(yaw, 2.0 * std::f64::consts::PI);
        return Rpy { roll: 0.0, pitch: sign * std::f64::consts::FRAC_PI_2, yaw };
    }
    Rpy {
        roll: libm::atan2(
            2.0 * (q.w * q.x + q.y * q.z),
            q.w * q.w - q.x * q.x - q.y * q.y + q.z * q.z,
        ),
        pitch: libm::asin(sine_pitch),
        yaw: libm::atan2(
            2.0 * (q.w * q.z + q.x * q.y),
            q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z,
        ),
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use proptest::prelude::*;

    use super::*;

    fn near(a: DVec3, b: [f64; 3]) -> bool {
        a.distance(DVec3::from_array(b)) < 1e-12
    }

    #[test]
    fn a_quarter_turn_left_points_x_along_y() {
        let rpy = Rpy { roll: 0.0, pitch: 0.0, yaw: FRAC_PI_2 };
        let world_from_robot = Pose::from_xyz_rpy([1.0, 0.0, 0.0], rpy);
        assert!(near(world_from_robot.transform_point(DVec3::X), [1.0, 1.0, 0.0]));
    }

    #[test]
    fn roll_comes_before_yaw() {
        let rpy = Rpy { roll: FRAC_PI_2, pitch: 0.0, yaw: FRAC_PI_2 };
        // Roll moves y to z, where yaw leaves it.
        assert!(near(quaternion_from_rpy(rpy) * DVec3::Y, [0.0, 0.0, 1.0]));
    }

    fn poses() -> impl Strategy<Value = Pose> {
        let angle = -3.1..3.1f64;
        (prop::array::uniform3(-10.0..10.0f64), angle.clone(), -1.5..1.5f64, angle)
            .prop_map(|(xyz, roll, pitch, yaw)| Pose::from_xyz_rpy(xyz, Rpy { roll, pitch, yaw }))
    }

    proptest! {
        #[test]
        fn a_pose_times_its_inverse_is_nothing(pose in poses()) {
            let (metres, radians) = (pose * pose.inverse()).distance_to(Pose::IDENTITY);
            prop_assert!(metres < 1e-12 && radians < 1e-12);
        }

        #[test]
        fn angles_come_back(pose in poses()) {
            let again = Pose { rotation: quaternion_from_rpy(pose.rpy()), ..pose };
            prop_assert!(again.distance_to(pose).1 < 1e-7);
        }

        #[test]
        fn products_associate(a in poses(), b in poses(), c in poses()) {
            let (metres, radians) = ((a * b) * c).distance_to(a * (b * c));
            prop_assert!(metres < 1e-11 && radians < 1e-11);
        }

        #[test]
        fn straight_up_and_down_keep_the_rotation(roll in -3.0..3.0f64, yaw in -3.0..3.0f64, up: bool) {
            let pitch = if up { FRAC_PI_2 } else { -FRAC_PI_2 };
            let rotation = quaternion_from_rpy(Rpy { roll, pitch, yaw });
            let pose = Pose { translation: DVec3::ZERO, rotation };
            let again = Pose { rotation: quaternion_from_rpy(pose.rpy()), ..pose };
            prop_assert!(again.distance_to(pose).1 < 1e-5);
        }
    }
}
