//! Limits of accepted values. Larger values are rejected like NaN: their squares and products
//! overflow, or a millimetre is below their resolution.

use periplus_geometry::{DVec3, Pose};

/// Maximum coordinate of a position [m]; a double still resolves 2 nm there.
pub const MAX_POSITION_M: f64 = 1e7;
/// Maximum speed [m/s]. A body that exceeds it during a run has diverged.
pub const MAX_SPEED_M_S: f64 = 1e4;
/// Maximum angular speed that can be set [rad/s].
pub const MAX_ANGULAR_SPEED_RAD_S: f64 = 1e5;
/// Maximum gravity [m/s²]; that of the Sun's surface is 274.
pub const MAX_GRAVITY_M_S2: f64 = 1e4;
/// Maximum mass of a link [kg].
pub const MAX_MASS_KG: f64 = 1e12;
/// Maximum moment or product of inertia of a link [kg m²].
pub const MAX_INERTIA_KG_M2: f64 = 1e18;
/// Maximum extent of a shape [m].
pub const MAX_SIZE_M: f64 = 1e7;
/// Maximum force [N] and torque [N m].
pub const MAX_FORCE_N: f64 = 1e15;
/// Minimum and maximum step [s].
pub const STEP_RANGE_S: [f64; 2] = [1e-6, 1.0];

/// True for a pose with a unit rotation, within [`MAX_POSITION_M`] of the origin on each axis.
#[must_use]
pub fn is_pose(pose: Pose) -> bool {
    pose.is_finite()
        && is_within(pose.translation, MAX_POSITION_M)
        && (pose.rotation.length_squared() - 1.0).abs() < 1e-3
}

/// True if every component is a number of at most `limit`.
#[must_use]
pub fn is_within(vector: DVec3, limit: f64) -> bool {
    // A comparison with NaN is false.
    vector.abs().cmple(DVec3::splat(limit)).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn absurd_and_no_numbers_are_outside() {
        for bad in [f64::NAN, f64::INFINITY, 1e308, -1e308, 2e7] {
            assert!(!is_within(DVec3::new(0.0, bad, 0.0), MAX_POSITION_M), "{bad}");
            assert!(!is_pose(Pose::from_xyz(0.0, 0.0, bad)), "{bad}");
        }
        assert!(is_pose(Pose::from_xyz(-1e6, 1e6, 0.0)));
    }
}
