//! Nodes in Python in step with the simulation.

use std::io;
use std::sync::Arc;

use periplus_graph::Graph;
use periplus_launch::bringup::Lockstep;

/// True if this build can run processes in step with the simulation.
pub(super) const IS_AVAILABLE: bool = false;

/// Lockstep of a run: its host, for the launch.
pub(super) struct LockstepRun {
    pub(super) host: Arc<dyn Lockstep>,
}

impl LockstepRun {
    /// Starts the lockstep of a run; `seed` is that of the simulation. `None` if this build has none.
    ///
    /// # Errors
    /// When its connection cannot be created.
    pub(super) fn start(_graph: &Graph, _seed: u64) -> io::Result<Option<Self>> {
        Ok(None)
    }
}
