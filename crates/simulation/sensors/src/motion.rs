//! Motion of a sensor with its link.

use periplus_geometry::{DVec3, Pose};
use periplus_physics::LinkState;

/// True pose and velocity of a sensor, the input of readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Pose of the sensor's frame.
    pub world_from_sensor: Pose,
    /// Velocity of the frame's origin, in world axes [m/s].
    pub linear_m_s: DVec3,
    /// Angular velocity, in world axes [rad/s].
    pub angular_rad_s: DVec3,
}

impl Motion {
    /// Returns the motion of a sensor at rest.
    #[must_use]
    pub fn at_rest(world_from_sensor: Pose) -> Self {
        Self { world_from_sensor, linear_m_s: DVec3::ZERO, angular_rad_s: DVec3::ZERO }
    }

    /// Returns the motion of a sensor on a link, including its lever arm: `v + ω × r`.
    #[must_use]
    pub fn on_link(link: &LinkState, link_from_sensor: Pose) -> Self {
        let world_from_sensor = link.world_from_link * link_from_sensor;
        let arm_m = world_from_sensor.translation - link.world_from_link.translation;
        Self {
            world_from_sensor,
            linear_m_s: link.linear_m_s + link.angular_rad_s.cross(arm_m),
            angular_rad_s: link.angular_rad_s,
        }
    }

    /// Rotates a vector from world axes into the sensor's axes.
    #[must_use]
    pub fn in_sensor(&self, vector_in_world: DVec3) -> DVec3 {
        self.world_from_sensor.rotation.conjugate() * vector_in_world
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sensor_ahead_of_a_turning_link_moves_to_the_left() {
        let link = LinkState {
            world_from_link: Pose::IDENTITY,
            linear_m_s: DVec3::X,
            angular_rad_s: DVec3::Z * 2.0,
        };
        let motion = Motion::on_link(&link, Pose::from_xyz(0.5, 0.0, 0.1));
        assert_eq!(motion.linear_m_s, DVec3::new(1.0, 1.0, 0.0));
        assert_eq!(motion.world_from_sensor.translation, DVec3::new(0.5, 0.0, 0.1));
    }
}
