//! Graph connected to ROS 2, for commands whose nodes join the network.

mod monitor;

use std::time::Duration;

use periplus_dds::{DdsTransport, Settings};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, Graph, GraphError, Mailbox, Node, Qos};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_os::{Machine, sleep, unix_ns};

use crate::terminal;

pub(crate) use monitor::NodeMonitor;

/// Live graph and its network connection.
pub(crate) struct Live {
    // Declared first, so that the network is left before the graph is dropped.
    pub(crate) wire: DdsTransport,
    pub(crate) graph: Graph,
    /// ROS 2 domain.
    pub(crate) domain_id: u32,
    clock: Option<Mailbox<Clock>>,
}

impl Live {
    /// Joins the network that the environment selects; the arguments apply to its nodes.
    ///
    /// # Errors
    /// A message when the network cannot be joined.
    pub(crate) fn open(arguments: Arguments) -> Result<Self, String> {
        let (settings, findings) = Settings::from_environment(&Machine);
        tell(&findings);
        let graph = Graph::live();
        graph.set_simulated_time(false);
        graph.advance_to(unix_ns());
        graph.set_arguments(arguments);
        let attached =
            DdsTransport::open(&settings).and_then(|wire| wire.attach(&graph).map(|()| wire));
        let wire = attached.map_err(|error| format!("cannot join ROS 2: {error}"))?;
        Ok(Self { wire, graph, domain_id: settings.domain_id, clock: None })
    }

    /// Follows `/clock` from now on; time does not advance until `/clock` has a publisher.
    ///
    /// # Errors
    /// An error when `/clock` has another type.
    pub(crate) fn follow_clock(&mut self, node: &Node) -> Result<(), GraphError> {
        self.graph.set_simulated_time(true);
        self.graph.jump_to(0);
        self.clock = Some(node.mailbox("/clock", Qos::clock())?);
        Ok(())
    }

    /// Processes everything due now.
    pub(crate) fn spin_once(&self) {
        match &self.clock {
            None => self.graph.advance_to(unix_ns()),
            Some(clock) => {
                if let Some(told) = clock.latest() {
                    let time_ns = told.clock.ns();
                    // Time jumped back: the simulation was reset.
                    if time_ns < self.graph.now_ns() {
                        self.graph.jump_to(time_ns);
                    }
                    self.graph.advance_to(time_ns);
                }
            }
        }
    }

    /// Sleeps until something is due, within these limits. With `/clock` the shorter one applies,
    /// since the next time may arrive at any moment.
    pub(crate) fn sleep_until_due(&self, shortest: Duration, longest: Duration) {
        let until_due = |due_ns: i64| {
            let rest_ns = due_ns.saturating_sub(unix_ns());
            Duration::from_nanos(u64::try_from(rest_ns).unwrap_or_default())
        };
        sleep(match (&self.clock, self.graph.next_due_ns()) {
            (Some(_), _) => shortest,
            (None, due_ns) => due_ns.map_or(longest, until_due).clamp(shortest, longest),
        });
    }

    /// Prints the findings since the last call.
    pub(crate) fn tell(&self) {
        tell(&self.wire.take_findings());
        tell(&self.graph.take_findings());
    }

    /// Flushes published messages within a timeout; returns false if some were not acknowledged.
    pub(crate) fn end(&self, last_words: Duration) -> bool {
        let is_taken = self.wire.flush(last_words);
        self.tell();
        is_taken
    }
}

fn tell(findings: &Diagnostics) {
    // A failing stderr cannot be reported.
    let _ = terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new());
}
