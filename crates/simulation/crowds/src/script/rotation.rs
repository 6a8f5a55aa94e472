//! Spherical quadrangle interpolation of rotations.

use periplus_geometry::DQuat;

/// Control rotation of a waypoint from its neighbours.
pub(super) fn control(rotation: DQuat, before: DQuat, after: DQuat) -> DQuat {
    let inverse = rotation.inverse();
    let sum = logarithm(inverse * after) + logarithm(inverse * before);
    rotation * exponential(sum * -0.25)
}

/// Rotation at a ratio between two rotations with their control rotations.
pub(super) fn squad(t: f64, [start, end]: [DQuat; 2], [a, b]: [DQuat; 2]) -> DQuat {
    slerp(2.0 * t * (1.0 - t), slerp(t, start, end), slerp(t, a, b)).normalize()
}

/// Pure quaternion of half of the rotation vector, by the shorter turn.
fn logarithm(rotation: DQuat) -> DQuat {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = rotation.xyz();
    let sine = axis.length();
    if sine < 1e-12 {
        return DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
    }
    let scaled = axis * (libm::atan2(sine, rotation.w) / sine);
    DQuat::from_xyzw(scaled.x, scaled.y, scaled.z, 0.0)
}

fn exponential(pure: DQuat) -> DQuat {
    let axis = pure.xyz();
    let angle_rad = axis.length();
    if angle_rad < 1e-12 {
        return DQuat::IDENTITY;
    }
    let (sine, cosine) = libm::sincos(angle_rad);
    let scaled = axis * (sine / angle_rad);
    DQuat::from_xyzw(scaled.x, scaled.y, scaled.z, cosine)
}

fn slerp(t: f64, from: DQuat, to: DQuat) -> DQuat {
    from * exponential(logarithm(from.inverse() * to) * t)
}

#[cfg(test)]
mod tests {
    use super::*;
    use periplus_geometry::{Rpy, quaternion_from_rpy};

    fn yaw(yaw: f64) -> DQuat {
        quaternion_from_rpy(Rpy { roll: 0.0, pitch: 0.0, yaw })
    }

    fn yaw_of(rotation: DQuat) -> f64 {
        2.0 * libm::atan2(rotation.z, rotation.w)
    }

    #[test]
    fn slerp_divides_the_angle() {
        assert!((yaw_of(slerp(0.25, yaw(0.4), yaw(1.2))) - 0.6).abs() < 1e-12);
        assert!((yaw_of(slerp(0.5, yaw(1.0), yaw(1.0))) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_control_of_an_even_turn_is_the_rotation() {
        assert!((yaw_of(control(yaw(1.0), yaw(0.5), yaw(1.5))) - 1.0).abs() < 1e-12);
        // The turn to the next is larger by 0.4: -0.1 of it.
        assert!((yaw_of(control(yaw(1.0), yaw(0.5), yaw(1.9))) - 0.9).abs() < 1e-12);
    }
}
