//! Where a sensor sits.

use periplus_geometry::Pose;
use periplus_physics::{LinkId, World};
use periplus_sensors::{Motion, Streams};

use super::Post;

/// A sensor on a link that moves.
#[derive(Clone, Debug)]
pub(super) struct Mount {
    pub(super) link: LinkId,
    /// `model::link::sensor`, unique in the world.
    pub(super) name: String,
    link_from_sensor: Pose,
    streams: Streams,
}

impl Mount {
    pub(super) fn new(post: &Post<'_>) -> Self {
        Self {
            link: post.id,
            name: post.full_name(),
            link_from_sensor: post.link_from_sensor(),
            streams: post.streams(),
        }
    }

    /// How the sensor moves now; none when its model has gone.
    pub(super) fn motion(&self, world: &World) -> Option<Motion> {
        Some(Motion::on_link(&world.link_state(self.link)?, self.link_from_sensor))
    }

    /// Its pose in its link.
    pub(super) fn link_from_sensor(&self) -> Pose {
        self.link_from_sensor
    }

    pub(super) fn streams(&self) -> &Streams {
        &self.streams
    }
}
