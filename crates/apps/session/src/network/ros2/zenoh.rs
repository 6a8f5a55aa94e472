//! Simulation on a Zenoh network with `rmw_zenoh`.

use periplus_os::Machine;
use periplus_rmw_zenoh::{Settings, ZenohTransport};
use periplus_sim::Simulation;

use super::{Joined, Ros2Connection};
use crate::error::RunError;
use crate::terminal;

/// Connects as the environment sets.
pub(super) fn join(simulation: &Simulation, is_quiet: bool) -> Result<Ros2Connection, RunError> {
    let (settings, findings) = Settings::from_environment(&Machine);
    terminal::print_findings(&findings)?;
    let opened = ZenohTransport::open(&settings).and_then(|wire| {
        wire.attach(simulation.graph())?;
        Ok(wire)
    });
    let wire = opened.map_err(RunError::Zenoh)?;
    if !is_quiet {
        let (domain, route) = (settings.domain_id, settings.way());
        terminal::say(&format!("ROS 2 on Zenoh: domain {domain}, through {route}"));
    }
    Ok(Ros2Connection { wire: Some(Joined::Zenoh(wire)), is_quiet, ..Ros2Connection::default() })
}
