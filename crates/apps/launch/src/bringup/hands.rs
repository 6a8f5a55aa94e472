//! Those who have something to do from time to time while a plan runs.

mod bonds;
mod changer;
mod child;
mod described;
mod manager;
mod relay;
mod respawn;
mod saver;
mod spawner;
mod unstamp;

use periplus_graph::Graph;
use periplus_sim::{Search, Simulation};

pub(crate) use changer::Changer;
pub(crate) use child::Child;
pub(crate) use described::Described;
pub(crate) use described::robot;
pub(crate) use manager::{Manager, ManagerSettings};
pub(crate) use relay::Relay;
pub(crate) use saver::Saver;
pub(crate) use spawner::Spawner;
pub(crate) use unstamp::Unstamp;

use crate::bringup::told::Said;

/// What there is to work with.
pub(crate) struct Stage<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) now_ns: i64,
    /// The world, if one is simulated here.
    pub(crate) simulation: Option<&'a mut Simulation>,
    pub(crate) search: &'a Search,
    pub(crate) said: &'a mut Vec<Said>,
    /// Whether it has written something to its output.
    pub(crate) has_printed: bool,
}

/// Whether somebody is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// There is more to do, or to wait for.
    No,
    /// It is.
    Yes,
}

/// One who has something to do.
pub(crate) trait Hand: Send {
    /// Does what can be done now.
    fn work(&mut self, stage: &mut Stage<'_>) -> Done;

    /// Time went back by this \[ns\]; times that are waited for come as much earlier.
    fn time_went_back(&mut self, _by_ns: i64) {}

    /// Everything ends: asks for it, and waits for nothing.
    fn ask_to_stop(&mut self) {}

    /// Everything ends: waits for it.
    fn stop(&mut self) {}
}
