//! Devices: drives, sensors and state publishers.

use std::any::Any;

use periplus_geometry::Pose;
use periplus_physics::{LinkId, PhysicsWorld};
use periplus_rendering::{PartId, SensedGeometry};

use crate::{SceneRef, Views};

/// An interval of simulated time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StepInterval {
    /// Start \[ns\].
    pub start_ns: i64,
    /// Length \[ns\].
    pub length_ns: i64,
}

impl StepInterval {
    /// Returns the end \[ns\].
    #[must_use]
    pub fn end_ns(self) -> i64 {
        self.start_ns + self.length_ns
    }

    /// Returns the length \[s\].
    #[must_use]
    #[expect(clippy::cast_precision_loss, reason = "a step is far below 2^53 ns")]
    pub fn seconds(self) -> f64 {
        self.length_ns as f64 * 1e-9
    }
}

/// A drive, a sensor or a state publisher: a part of the simulation that appears as a node.
///
/// In each step first all devices act, then physics advances, then all devices sense, always in the
/// order of their creation.
pub trait Device: Send {
    /// Name for messages and tables, such as `sam_bot::lidar`.
    fn name(&self) -> &str;

    /// Before a step: reads received commands and commands the joints for `span`.
    fn act(&mut self, _world: &mut PhysicsWorld, _span: StepInterval) {}

    /// After a step: measures and publishes due messages.
    fn sense(&mut self, _moment: &mut SenseContext<'_>) {}

    /// While simulation is paused: measures once for subscribers that joined after the last
    /// measurement. Nothing is published a second time to others.
    fn sense_paused(&mut self, _moment: &mut SenseContext<'_>) {}

    /// Returns the mounting poses of the published sensor data.
    fn mounts(&self) -> Vec<SensorMount> {
        Vec::new()
    }

    /// Returns the time of the next scheduled action \[ns\]. If motion needs no small steps, time
    /// advances directly to the earliest of these.
    fn next_ns(&self) -> Option<i64> {
        None
    }

    /// Resets to the initial state at this time \[ns\].
    fn reset(&mut self, time_ns: i64);

    /// Saves all that decides the next actions: timers, counters, controllers, biases of noise, and
    /// commands, including messages that wait. Results of a measurement that the next one
    /// replaces are not part of it.
    fn save(&self) -> DeviceState;

    /// Restores a state; the next actions are those after it was saved. Returns false and changes
    /// nothing if another kind of device saved it.
    fn restore(&mut self, saved: &DeviceState) -> bool;
}

/// Saved state of a device, as [`Device::save`] returns it.
pub struct DeviceState(Box<dyn Any + Send + Sync>);

impl DeviceState {
    /// Wraps the state of a device.
    #[must_use]
    pub fn new(state: impl Any + Send + Sync) -> Self {
        Self(Box::new(state))
    }

    /// Returns the state if it is of this type.
    #[must_use]
    pub fn get<T: Any>(&self) -> Option<&T> {
        self.0.downcast_ref()
    }

    /// Copies the state to a value of its type; returns false for another type.
    pub fn copy_to<T: Any + Clone>(&self, to: &mut T) -> bool {
        let state = self.get::<T>();
        if let Some(state) = state {
            to.clone_from(state);
        }
        state.is_some()
    }
}

impl std::fmt::Debug for DeviceState {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("DeviceState").finish_non_exhaustive()
    }
}

/// Mounting pose of the data on one topic.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorMount {
    /// Full name of the topic.
    pub topic: String,
    /// Frame in the headers of its messages.
    pub frame_id: String,
    /// Link of the sensor.
    pub link: LinkId,
    /// Pose of the data in that link.
    pub link_from_data: Pose,
}

/// The world at the end of a step.
#[derive(Clone, Copy)]
pub struct SenseContext<'a> {
    /// The step that just ended; messages are stamped with its end.
    pub span: StepInterval,
    /// Physics state.
    pub world: &'a PhysicsWorld,
    /// Ray-cast scenes.
    pub views: &'a Views,
    /// Maximum number of threads of a measurement.
    pub threads: usize,
}

impl SenseContext<'_> {
    /// Returns the current time \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.span.end_ns()
    }

    /// Returns the ray-cast scene at the current time.
    #[must_use]
    pub fn seen(&self, geometry: SensedGeometry) -> SceneRef<'_> {
        self.views.seen(geometry, self.span.end_ns(), self.world)
    }

    /// Returns the id of a link in a ray-cast scene, so that a sensor can ignore its own model.
    #[must_use]
    pub fn part(&self, geometry: SensedGeometry, link: LinkId) -> Option<PartId> {
        self.views.part(geometry, link, self.world)
    }
}
