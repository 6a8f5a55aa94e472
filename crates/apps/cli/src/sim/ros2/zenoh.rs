//! Simulation on a Zenoh network with `rmw_zenoh`.

use std::io;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_os::Machine;
use periplus_rmw_zenoh::{Settings, ZenohTransport};
use periplus_sim::Simulation;

use super::{Joined, Ros2};
use crate::error::CliError;
use crate::terminal;

/// Connects as the environment sets.
pub(super) fn join(simulation: &Simulation, quiet: bool) -> Result<Ros2, CliError> {
    let (settings, findings) = Settings::from_environment(&Machine);
    terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    let opened = ZenohTransport::open(&settings).and_then(|wire| {
        wire.attach(simulation.graph())?;
        Ok(wire)
    });
    let wire = opened.map_err(CliError::failed)?;
    if !quiet {
        let (domain, route) = (settings.domain_id, settings.way());
        terminal::say(&format!("ROS 2 on Zenoh: domain {domain}, through {route}"));
    }
    Ok(Ros2 { wire: Some(Joined::Zenoh(wire)), looked: Duration::ZERO, quiet })
}
