//! What acts and measures.

use periplus_geometry::Pose;
use periplus_physics::{LinkId, World};
use periplus_rendering::{PartId, RenderScene, SensedGeometry};

use crate::Views;

/// A stretch of simulated time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Where it begins \[ns\].
    pub start_ns: i64,
    /// How long it is \[ns\].
    pub length_ns: i64,
}

impl Span {
    /// Where it ends \[ns\].
    #[must_use]
    pub fn end_ns(self) -> i64 {
        self.start_ns + self.length_ns
    }

    /// How long it is \[s\].
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a step is far below 2^53 ns")]
    pub fn seconds(self) -> f64 {
        self.length_ns as f64 * 1e-9
    }
}

/// A drive, a sensor, a publisher of states: a part of the simulation that others know as a node.
///
/// In each step first all devices act, then everything moves, then all devices sense, always in the
/// order in which they were made.
pub trait Device: Send {
    /// Its name for messages and tables, such as `sam_bot::lidar`.
    fn name(&self) -> &str;

    /// Before a step: reads what it was told and tells joints what to do during `span`.
    fn act(&mut self, _world: &mut World, _span: Span) {}

    /// After a step: measures and publishes what is due.
    fn sense(&mut self, _moment: &mut Moment<'_>) {}

    /// While time stands still: measures once for subscribers that came after the last measurement.
    /// Nothing is published to others a second time.
    fn sense_paused(&mut self, _moment: &mut Moment<'_>) {}

    /// Mounting poses of the sensor data that it publishes.
    fn mounts(&self) -> Vec<SensorMount> {
        Vec::new()
    }

    /// When it next has something to do without being told \[ns\]. Where motion needs no small
    /// steps, time goes straight to the first of these.
    fn next_ns(&self) -> Option<i64> {
        None
    }

    /// Starts again at this time \[ns\], as after its making.
    fn reset(&mut self, time_ns: i64);
}

/// Mounting pose of the data on one topic.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorMount {
    /// Full name of the topic.
    pub topic: String,
    /// Frame in the headers of its messages.
    pub frame_id: String,
    /// The link that carries the sensor.
    pub link: LinkId,
    /// Pose of the data in that link.
    pub link_from_data: Pose,
}

/// The world at the end of a step, as devices see it.
pub struct Moment<'a> {
    /// The step that ends now; messages are stamped with its end.
    pub span: Span,
    /// What moved.
    pub world: &'a World,
    /// What rays see.
    pub views: &'a mut Views,
    /// Threads that one measurement may use.
    pub threads: usize,
}

impl Moment<'_> {
    /// Now \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.span.end_ns()
    }

    /// What rays see now.
    pub fn seen(&mut self, geometry: SensedGeometry) -> &RenderScene {
        self.views.at(geometry, self.span.end_ns(), self.world)
    }

    /// The part of a link in what rays see, so that a sensor can look past its own.
    pub fn part(&mut self, geometry: SensedGeometry, link: LinkId) -> Option<PartId> {
        self.views.part(geometry, link, self.world)
    }
}
