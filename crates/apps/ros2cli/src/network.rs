//! Where the others are.

use std::time::Duration;

use periplus_graph::Graph;
use periplus_os::{Stopwatch, sleep};

use crate::Seen;

/// How often a graph in the same program is looked at.
const LOOK_AGAIN: Duration = Duration::from_millis(2);

/// Where a verb finds nodes, topics and services.
pub trait Network {
    /// The graph in which the verb's own node takes part.
    fn graph(&self) -> &Graph;

    /// Who is there now, the verb's own node left out.
    fn seen(&self) -> Seen;

    /// How far discovery has come. Costs less than [`Network::seen`].
    fn progress(&self) -> Progress;

    /// Waits until the others are as wanted, at most so long; whether they are. Who is asked is
    /// asked only when something has changed.
    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool;

    /// Waits until what was published has arrived at all who listen, at most so long.
    fn flush(&self, timeout: Duration) -> bool;
}

/// How far discovery has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Number of changes seen so far.
    pub changes: u64,
    /// Number of programs found whose nodes, topics or services are not all known yet.
    pub incomplete: usize,
    /// Number of programs on this machine that were not found yet, as far as the system tells.
    pub unanswered: usize,
}

/// The nodes of this same program.
pub struct InGraph(pub Graph);

/// Names of verbs' own nodes begin so; the first `_` hides them.
pub(crate) const OWN_NODE: &str = "_periplus_cli";

impl Network for InGraph {
    fn graph(&self) -> &Graph {
        &self.0
    }

    fn seen(&self) -> Seen {
        Seen::of_graph(&self.0, |name| name.trim_start_matches('/').starts_with(OWN_NODE))
    }

    fn progress(&self) -> Progress {
        Progress { changes: self.0.generation(), ..Progress::default() }
    }

    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool {
        let clock = Stopwatch::start();
        loop {
            if wanted(&self.seen()) {
                return true;
            }
            if clock.elapsed() >= timeout {
                return false;
            }
            sleep(LOOK_AGAIN);
        }
    }

    fn flush(&self, _: Duration) -> bool {
        true
    }
}
