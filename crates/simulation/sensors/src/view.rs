//! The world as seen by a sensor's rays.

use periplus_raycast::{Filter, InstanceId, RaycastWorld};

/// The world as seen by a sensor's rays, and the number of threads for casting (small batches use
/// one; results are the same for any number).
#[derive(Clone, Copy)]
pub struct RayView<'a> {
    /// The ray-cast world.
    pub rays: &'a RaycastWorld,
    /// Visibility filter of the sensor.
    pub filter: Filter,
    /// Group of the sensor's own model, whose parts within the minimum range (housings) are ignored.
    /// 0 is none.
    pub own_group: u32,
    /// Laser intensity of an instance; `None` where all are 0, which saves time.
    pub retro: Option<&'a (dyn Fn(InstanceId) -> f64 + Sync)>,
    /// Number of threads.
    pub threads: usize,
}

impl<'a> RayView<'a> {
    /// Returns a view of everything, on one thread.
    #[must_use]
    pub fn of(rays: &'a RaycastWorld) -> Self {
        Self { rays, filter: Filter::default(), own_group: 0, retro: None, threads: 1 }
    }

    /// Returns the filter that excludes the sensor's own model.
    pub(crate) fn without_own_model(&self) -> Filter {
        Filter { except_group: self.own_group, ..self.filter }
    }
}
