//! Inertial sensors as state interfaces.

use periplus_geometry::{DQuat, DVec3};
use periplus_physics::PhysicsWorld;
use periplus_ros2_control::Hardware;
use periplus_scene::SensorKind;

use crate::drives::{Body, BuildContext};

/// An inertial sensor without noise.
#[derive(Clone, Debug)]
pub(super) struct InertialSensor {
    name: String,
    body: Body,
    /// Velocity at the last reading [m/s].
    before_m_s: Option<DVec3>,
    world_from_start: Option<DQuat>,
}

impl InertialSensor {
    /// Finds the inertial sensor of a name on the links of the plugin's model.
    pub(super) fn find(context: &BuildContext<'_>, name: &str) -> Option<Self> {
        let links = context.model().links.iter();
        let (link, sensor) = links
            .flat_map(|link| link.sensors.iter().map(move |sensor| (link, sensor)))
            .find(|(_, one)| one.name == name && matches!(one.kind, SensorKind::Imu(_)))?;
        let id = context.setting.link(context.site, &link.name)?;
        let body = Body { link: id, link_from_body: sensor.parent_from_sensor };
        Some(Self { name: name.to_owned(), body, before_m_s: None, world_from_start: None })
    }

    /// Reads the sensor after a time [s] into its state interfaces: the orientation relative to the
    /// start, the angular velocity, and the acceleration minus gravity.
    pub(super) fn read(&mut self, world: &PhysicsWorld, hardware: &mut Hardware, dt_s: f64) {
        let Some(state) = self.body.state(world) else { return };
        let rotation = state.world_from_link.rotation;
        let start = *self.world_from_start.get_or_insert(rotation);
        let before_m_s = self.before_m_s.replace(state.linear_m_s).unwrap_or(state.linear_m_s);
        let change = if dt_s > 0.0 { (state.linear_m_s - before_m_s) / dt_s } else { DVec3::ZERO };
        let force = rotation.conjugate() * (change - world.gravity_m_s2());
        let turn = rotation.conjugate() * state.angular_rad_s;
        let orientation = start.conjugate() * rotation;
        for (interface, value) in [
            ("orientation.x", orientation.x),
            ("orientation.y", orientation.y),
            ("orientation.z", orientation.z),
            ("orientation.w", orientation.w),
            ("angular_velocity.x", turn.x),
            ("angular_velocity.y", turn.y),
            ("angular_velocity.z", turn.z),
            ("linear_acceleration.x", force.x),
            ("linear_acceleration.y", force.y),
            ("linear_acceleration.z", force.z),
        ] {
            hardware.set_state(&format!("{}/{interface}", self.name), value);
        }
    }

    /// Resets to the initial state.
    pub(super) fn reset(&mut self) {
        (self.before_m_s, self.world_from_start) = Default::default();
    }
}
