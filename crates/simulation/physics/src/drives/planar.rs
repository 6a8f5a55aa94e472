//! `libgazebo_ros_planar_move.so`: sets the velocity of a body in the plane.

use periplus_geometry::{DVec3, Pose};

use crate::kinematic::Twist;

/// Returns the velocities of a body that follow a twist: along its own heading, with no vertical
/// speed, as in Gazebo's plugin. Between two such commands it falls. Linear [m/s] and angular
/// [rad/s], in world axes. See [`PhysicsWorld::set_model_velocity`](crate::PhysicsWorld::set_model_velocity).
#[must_use]
pub fn planar_velocity(world_from_base: Pose, twist: Twist) -> (DVec3, DVec3) {
    let (sine, cosine) = libm::sincos(world_from_base.rpy().yaw);
    let linear = DVec3::new(
        cosine * twist.x_m_s - sine * twist.y_m_s,
        sine * twist.x_m_s + cosine * twist.y_m_s,
        0.0,
    );
    (linear, DVec3::new(0.0, 0.0, twist.yaw_rad_s))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use periplus_geometry::Rpy;

    use super::*;

    #[test]
    fn facing_north_ahead_is_y() {
        let north = Pose::from_xyz_rpy([0.0; 3], Rpy { roll: 0.0, pitch: 0.0, yaw: FRAC_PI_2 });
        let twist = Twist { x_m_s: 1.0, y_m_s: 0.5, yaw_rad_s: 0.2 };
        let (linear, angular) = planar_velocity(north, twist);
        assert!(linear.distance(DVec3::new(-0.5, 1.0, 0.0)) < 1e-12);
        assert_eq!(angular, DVec3::new(0.0, 0.0, 0.2));
    }
}
