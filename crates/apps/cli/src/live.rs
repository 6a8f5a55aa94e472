//! A graph on the wire, for verbs whose nodes others see.

mod watched;

use std::time::Duration;

use periplus_dds::{Settings, Wire};
use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::{Arguments, Graph, GraphError, Mailbox, Node, Qos};
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_os::{Machine, sleep, unix_ns};

use crate::terminal;

pub(crate) use watched::Watched;

/// A live graph and the wire that carries it.
pub(crate) struct Live {
    // First, so that it is left before the graph goes.
    pub(crate) wire: Wire,
    pub(crate) graph: Graph,
    /// Which of the networks of ROS 2 it is.
    pub(crate) domain_id: u32,
    clock: Option<Mailbox<Clock>>,
}

impl Live {
    /// Joins the network that the environment names; nodes are told the arguments.
    ///
    /// # Errors
    /// When there is none: what to say of it.
    pub(crate) fn open(arguments: Arguments) -> Result<Self, String> {
        let (settings, findings) = Settings::from_environment(&Machine);
        tell(&findings);
        let graph = Graph::live();
        graph.set_simulated_time(false);
        graph.advance_to(unix_ns());
        graph.set_arguments(arguments);
        let attached = Wire::open(&settings).and_then(|wire| wire.attach(&graph).map(|()| wire));
        let wire = attached.map_err(|error| format!("cannot join ROS 2: {error}"))?;
        Ok(Self { wire, graph, domain_id: settings.domain_id, clock: None })
    }

    /// Lives by `/clock` from now on, as this node hears it; time stands still until somebody tells it.
    ///
    /// # Errors
    /// When `/clock` is of another type.
    pub(crate) fn follow_clock(&mut self, node: &Node) -> Result<(), GraphError> {
        self.graph.set_simulated_time(true);
        self.graph.jump_to(0);
        self.clock = Some(node.mailbox("/clock", Qos::clock())?);
        Ok(())
    }

    /// Does what is due by now.
    pub(crate) fn go_on(&self) {
        match &self.clock {
            None => self.graph.advance_to(unix_ns()),
            Some(clock) => {
                if let Some(told) = clock.latest() {
                    let time_ns = told.clock.ns();
                    // A run that begins again.
                    if time_ns < self.graph.now_ns() {
                        self.graph.jump_to(time_ns);
                    }
                    self.graph.advance_to(time_ns);
                }
            }
        }
    }

    /// Sleeps until something is due, at least and at most as long as this. By `/clock` it is the shorter
    /// one, since the next time may arrive at any moment.
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

    /// Tells what was wrong since the last time.
    pub(crate) fn tell(&self) {
        tell(&self.wire.take_findings());
        tell(&self.graph.take_findings());
    }

    /// Lets others take what was said, for so long at most; whether they did.
    pub(crate) fn end(&self, last_words: Duration) -> bool {
        let is_taken = self.wire.flush(last_words);
        self.tell();
        is_taken
    }
}

fn tell(findings: &Diagnostics) {
    // Who cannot be told cannot be told that either.
    let _ = terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new());
}
