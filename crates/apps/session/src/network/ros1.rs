//! Simulation on the ROS 1 network.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use periplus_graph::Graph;
use periplus_os::Machine;
use periplus_ros1::{
    MasterUse, Ros1Error, Ros1Reach, Ros1Transport, Settings, SystemState, XmlRpcValue,
};

use crate::error::RunError;
use crate::terminal;

/// Period of checking for network problems.
const POLL_PERIOD: Duration = Duration::from_millis(500);

/// Connection of a session to ROS 1.
pub(crate) struct Ros1Connection {
    wire: Ros1Transport,
    /// Wall time of the last check for network problems, since the start of the run.
    checked: Duration,
    is_quiet: bool,
}

/// Joins the master that `ROS_MASTER_URI` names, or starts one, sets parameters by their full names, and attaches a
/// graph.
///
/// # Errors
/// When no master answers and none can be started.
pub fn join_ros1(
    graph: &Graph,
    reach: Ros1Reach,
    parameters: Vec<(String, XmlRpcValue)>,
    is_quiet: bool,
) -> Result<Ros1Transport, RunError> {
    let (settings, findings) = Settings::from_environment(&Machine, reach);
    terminal::print_findings(&findings)?;
    let join = || -> Result<Ros1Transport, Ros1Error> {
        let wire = Ros1Transport::open(&settings, MasterUse::JoinOrStart)?;
        wire.set_parameters(parameters)?;
        wire.attach(graph)?;
        Ok(wire)
    };
    let wire = join()?;
    if !is_quiet {
        let how = if wire.is_master() { "started here" } else { "joined" };
        let on = match reach {
            Ros1Reach::Machine => "this machine only; --ros1=network opens it",
            Ros1Reach::Network => "on the network",
        };
        terminal::say(&format!("ROS 1: master {}, {how}, {on}", settings.master_uri));
    }
    Ok(wire)
}

impl Ros1Connection {
    /// Connects.
    pub(crate) fn join(
        graph: &Graph,
        reach: Ros1Reach,
        mut parameters: Vec<(String, XmlRpcValue)>,
        is_quiet: bool,
    ) -> Result<Self, RunError> {
        // Programs that start from now on take their time from /clock.
        parameters.push(("/use_sim_time".to_owned(), true.into()));
        let wire = join_ros1(graph, reach, parameters, is_quiet)?;
        Ok(Self { wire, checked: Duration::ZERO, is_quiet })
    }

    /// Returns true if the next check for network problems is due.
    pub(crate) fn is_due(&mut self, wall: Duration) -> bool {
        let is_due = wall >= self.checked + POLL_PERIOD;
        if is_due {
            self.checked = wall;
        }
        is_due
    }

    /// Topics and nodes of other programs.
    pub(crate) fn remote(&self) -> Arc<SystemState> {
        self.wire.remote()
    }

    /// Prints network problems.
    pub(crate) fn print_findings(&self) -> io::Result<()> {
        let findings = self.wire.take_findings();
        if self.is_quiet {
            return Ok(());
        }
        terminal::print_findings(&findings)
    }
}
