//! What rays of a sensor see.

use periplus_raycast::{Filter, InstanceId, RaycastWorld};

/// What rays of a sensor see, and with how many threads they are cast (few stay on one; the answers
/// are the same for any number).
#[derive(Clone, Copy)]
pub struct View<'a> {
    /// The shapes.
    pub rays: &'a RaycastWorld,
    /// What the sensor looks for: its visibility mask.
    pub filter: Filter,
    /// The group of the sensor's own model, whose parts do not count when they are nearer than the
    /// least range: housings. 0 is none.
    pub own_group: u32,
    /// Brightness to a laser of an instance; none where all are 0, which saves time.
    pub retro: Option<&'a (dyn Fn(InstanceId) -> f64 + Sync)>,
    /// Threads.
    pub threads: usize,
}

impl<'a> View<'a> {
    /// Everything there is, on one thread.
    #[must_use]
    pub fn of(rays: &'a RaycastWorld) -> Self {
        Self { rays, filter: Filter::default(), own_group: 0, retro: None, threads: 1 }
    }

    /// The filter that looks past the sensor's own model.
    pub(crate) fn others(&self) -> Filter {
        Filter { except_group: self.own_group, ..self.filter }
    }
}
