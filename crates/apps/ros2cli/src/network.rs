//! Discovery of nodes, topics and services.

use std::time::Duration;

use periplus_graph::Graph;
use periplus_os::{Stopwatch, sleep};

use crate::Seen;

/// Polling period of a graph in the same program.
const POLL_PERIOD: Duration = Duration::from_millis(2);

/// Source of nodes, topics and services for verbs.
pub trait Network {
    /// Graph of the verb's own node.
    fn graph(&self) -> &Graph;

    /// Returns a snapshot of the network, without the verb's own node.
    fn seen(&self) -> Seen;

    /// Returns the progress of discovery. Costs less than [`Network::seen`].
    fn progress(&self) -> Progress;

    /// Waits until a condition holds, up to a timeout; returns true if it holds. The condition is
    /// evaluated only after changes.
    fn wait(&self, timeout: Duration, wanted: &mut dyn FnMut(&Seen) -> bool) -> bool;

    /// Returns a type as the network writes it: ROS 1 has `std_msgs/String`.
    fn shown_type(&self, type_name: &str) -> String {
        type_name.to_owned()
    }

    /// Waits until published messages have been delivered to all subscribers, up to a timeout.
    fn flush(&self, timeout: Duration) -> bool;
}

/// Progress of discovery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Number of changes seen so far.
    pub changes: u64,
    /// Number of discovered participants whose nodes, topics or services are not all known yet.
    pub incomplete: usize,
    /// Number of participants on this machine that were not discovered yet, as far as known.
    pub unanswered: usize,
}

/// Network of the nodes in this program.
pub struct InGraph(pub Graph);

/// Prefix of names of verbs' own nodes; the leading `_` hides them.
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
            sleep(POLL_PERIOD);
        }
    }

    fn flush(&self, _: Duration) -> bool {
        true
    }
}
