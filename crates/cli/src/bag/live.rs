//! A graph on the wire, for as long as a recording is played or made.

use std::time::Duration;

use periplus_diagnostics::{Diagnostics, SourceMap};
use periplus_graph::Graph;
use periplus_host::{Machine, unix_ns};
use periplus_wire_ros2::{Settings, Wire};

use crate::terminal;

/// A live graph and the wire that carries it.
pub(super) struct Live {
    pub(super) graph: Graph,
    pub(super) wire: Wire,
}

/// Until this long after all was said others may still be fetching it.
const LAST_WORDS: Duration = Duration::from_secs(2);

impl Live {
    /// Joins the network that the environment names.
    pub(super) fn open() -> Result<Self, String> {
        let (settings, findings) = Settings::from_environment(&Machine);
        tell(&findings);
        let wire = Wire::open(&settings).map_err(|error| error.to_string())?;
        let graph = Graph::live();
        graph.set_simulated_time(false);
        graph.advance_to(unix_ns());
        wire.attach(&graph).map_err(|error| error.to_string())?;
        Ok(Self { graph, wire })
    }

    /// Tells what was wrong since the last time.
    pub(super) fn tell(&self) {
        tell(&self.wire.take_findings());
        tell(&self.graph.take_findings());
    }

    /// Lets others take what was said.
    pub(super) fn end(&self) {
        if !self.wire.flush(LAST_WORDS) {
            terminal::complain("somebody did not take all that was said");
        }
        self.tell();
    }
}

fn tell(findings: &Diagnostics) {
    // Who cannot be told cannot be told that either.
    let _ = terminal::diagnostics(&mut anstream::stderr().lock(), findings, &SourceMap::new());
}
