//! Simulation on the ROS 2 network.

use std::io;
use std::time::Duration;

use periplus_dds::{DdsTransport, DiscoveryRange, Remote, Settings};
use periplus_diagnostics::Diagnostics;
use periplus_os::Machine;
use periplus_sim::Simulation;

use crate::error::RunError;
use crate::terminal;

#[cfg(feature = "zenoh")]
mod zenoh;

/// Period of checking for network problems.
const POLL_PERIOD: Duration = Duration::from_millis(500);

/// Visibility of a session on ROS 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ros2Reach {
    /// No program.
    Off,
    /// ROS 2 programs on this machine.
    Loopback,
    /// ROS 2 programs in the range of multicast or named by `ROS_STATIC_PEERS`.
    Network,
    /// ROS 2 programs that use `rmw_zenoh`, through its router.
    Zenoh,
}

/// Connection of a session to ROS 2, if any.
#[derive(Default)]
pub(crate) struct Ros2Connection {
    wire: Option<Joined>,
    /// Wall time of the last check for network problems, since the start of the run.
    checked: Duration,
    is_quiet: bool,
}

/// Network of the connection.
enum Joined {
    Dds(DdsTransport),
    #[cfg(feature = "zenoh")]
    Zenoh(periplus_rmw_zenoh::ZenohTransport),
}

impl Joined {
    fn take_findings(&self) -> Diagnostics {
        match self {
            Self::Dds(wire) => wire.take_findings(),
            #[cfg(feature = "zenoh")]
            Self::Zenoh(wire) => wire.take_findings(),
        }
    }
}

impl Ros2Connection {
    /// Connects as requested. By default a real-time run joins on this machine, or as the
    /// environment sets, and continues without ROS 2 if that fails.
    pub(crate) fn join(
        simulation: &Simulation,
        asked: Option<Ros2Reach>,
        is_paced: bool,
        is_quiet: bool,
    ) -> Result<Self, RunError> {
        if asked == Some(Ros2Reach::Zenoh) {
            return join_zenoh(simulation, is_quiet);
        }
        let (mut settings, findings) = Settings::from_environment(&Machine);
        match asked {
            Some(Ros2Reach::Off) => settings.range = DiscoveryRange::Off,
            None if !is_paced => settings.range = DiscoveryRange::Off,
            None | Some(Ros2Reach::Zenoh) => {}
            Some(Ros2Reach::Loopback) => settings.range = DiscoveryRange::Localhost,
            Some(Ros2Reach::Network) if settings.range == DiscoveryRange::SystemDefault => {}
            Some(Ros2Reach::Network) => settings.range = DiscoveryRange::Subnet,
        }
        let mut joined = Self { is_quiet, ..Self::default() };
        if settings.range == DiscoveryRange::Off {
            return Ok(joined);
        }
        terminal::print_findings(&findings)?;
        let opened = DdsTransport::open(&settings).and_then(|wire| {
            wire.attach(simulation.graph())?;
            Ok(wire)
        });
        match opened {
            Ok(wire) => joined.wire = Some(Joined::Dds(wire)),
            Err(error) if asked.is_some() => return Err(error.into()),
            Err(error) => terminal::say(&format!("warning: {error}; running without ROS 2")),
        }
        if joined.wire.is_some() && !is_quiet {
            let domain = settings.domain_id;
            terminal::say(&match settings.range {
                DiscoveryRange::Localhost => format!(
                    "ROS 2: domain {domain}, this machine only; --ros2 network opens it, \
                     --ros2 off keeps it out"
                ),
                _ => format!("ROS 2: domain {domain}, on the network"),
            });
        }
        Ok(joined)
    }

    /// Returns true if the run is on the network.
    pub(crate) fn is_joined(&self) -> bool {
        self.wire.is_some()
    }

    /// Returns true if the next check for network problems is due.
    pub(crate) fn is_due(&mut self, wall: Duration) -> bool {
        let is_due = self.wire.is_some() && wall >= self.checked + POLL_PERIOD;
        if is_due {
            self.checked = wall;
        }
        is_due
    }

    /// Remote topics and nodes; `None` without a DDS network.
    pub(crate) fn remote(&self) -> Option<Remote> {
        match self.wire.as_ref()? {
            Joined::Dds(wire) => Some(wire.remote()),
            #[cfg(feature = "zenoh")]
            Joined::Zenoh(_) => None,
        }
    }

    /// Prints network problems.
    pub(crate) fn print_findings(&self) -> io::Result<()> {
        let Some(wire) = &self.wire else { return Ok(()) };
        let findings = wire.take_findings();
        if self.is_quiet {
            return Ok(());
        }
        terminal::print_findings(&findings)
    }
}

#[cfg(feature = "zenoh")]
use zenoh::join as join_zenoh;

/// Reports that this build has no Zenoh.
#[cfg(not(feature = "zenoh"))]
fn join_zenoh(_: &Simulation, _: bool) -> Result<Ros2Connection, RunError> {
    Err(RunError::WithoutZenoh)
}
