//! Periodic tasks of a running plan.

mod bonds;
mod changer;
mod child;
mod controllers;
mod described;
mod manager;
mod node_arguments;
mod relay;
mod respawn;
mod saver;
mod spawner;
mod stamp;
mod twist_mux;
mod unstamp;

use periplus_graph::Graph;
use periplus_sim::{Search, Simulation};

pub(crate) use changer::TransitionTask;
pub(crate) use child::{Child, installed_program};
pub(crate) use controllers::{ControllerSpawner, SpawnerKind, SpawnerOptions};
pub(crate) use described::JointStateTask;
pub(crate) use described::robot;
pub(crate) use manager::{Manager, ManagerSettings};
pub(crate) use relay::Relay;
pub(crate) use saver::Saver;
pub(crate) use spawner::Spawner;
pub(crate) use stamp::TwistStamper;
pub(crate) use twist_mux::{MuxTopics, TwistMux};
pub(crate) use unstamp::Unstamp;

use crate::bringup::report::LaunchLog;

/// Context of a task.
pub(crate) struct TaskContext<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) now_ns: i64,
    /// World, if one is simulated here.
    pub(crate) simulation: Option<&'a mut Simulation>,
    pub(crate) search: &'a Search,
    pub(crate) said: &'a mut Vec<LaunchLog>,
    /// True if the task has printed output.
    pub(crate) has_printed: bool,
}

/// Result of a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Done {
    /// The task continues.
    No,
    /// The task is finished.
    Yes,
}

/// Periodic task.
pub(crate) trait Task: Send {
    /// Processes what is due now.
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done;

    /// Adapts deadlines after a jump back in time by this amount \[ns\].
    fn time_went_back(&mut self, _by_ns: i64) {}

    /// Asks the task to end, without waiting.
    fn ask_to_stop(&mut self) {}

    /// Waits for the end; adds the last output to the log.
    fn stop(&mut self, _said: &mut Vec<LaunchLog>) {}
}
