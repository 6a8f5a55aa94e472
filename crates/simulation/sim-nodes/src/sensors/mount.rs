//! Mounting of a sensor.

use periplus_geometry::Pose;
use periplus_physics::{LinkId, PhysicsWorld};
use periplus_sensors::{Motion, Streams};

use super::SensorContext;

/// A sensor on a moving link.
#[derive(Clone, Debug)]
pub(super) struct Mount {
    pub(super) link: LinkId,
    /// `model::link::sensor`, unique in the world.
    pub(super) name: String,
    link_from_sensor: Pose,
    streams: Streams,
}

impl Mount {
    pub(super) fn new(sensor_context: &SensorContext<'_>) -> Self {
        Self {
            link: sensor_context.id,
            name: sensor_context.full_name(),
            link_from_sensor: sensor_context.link_from_sensor(),
            streams: sensor_context.streams(),
        }
    }

    /// Returns the current motion of the sensor; `None` after its model was removed.
    pub(super) fn motion(&self, world: &PhysicsWorld) -> Option<Motion> {
        Some(Motion::on_link(&world.link_state(self.link)?, self.link_from_sensor))
    }

    /// Returns the pose of the sensor in its link.
    pub(super) fn link_from_sensor(&self) -> Pose {
        self.link_from_sensor
    }

    pub(super) fn streams(&self) -> &Streams {
        &self.streams
    }
}
