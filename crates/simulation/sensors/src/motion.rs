//! How a sensor moves with its link.

use periplus_geometry::{DVec3, Pose};
use periplus_physics::LinkState;

/// Where a sensor is and how it moves: the truth that readings are made from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Its frame in the world.
    pub world_from_sensor: Pose,
    /// Velocity of its frame's origin, in world axes [m/s].
    pub linear_m_s: DVec3,
    /// Angular velocity, in world axes [rad/s].
    pub angular_rad_s: DVec3,
}

impl Motion {
    /// Not moving.
    #[must_use]
    pub fn at_rest(world_from_sensor: Pose) -> Self {
        Self { world_from_sensor, linear_m_s: DVec3::ZERO, angular_rad_s: DVec3::ZERO }
    }

    /// Of a sensor on a link. On a turning link it moves with its lever arm: `v + ω × r`.
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

    /// A vector in world axes, in the sensor's.
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
