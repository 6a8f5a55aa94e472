//! Simulation on a Zenoh network with `rmw_zenoh`.

use std::io;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_os::Machine;
use periplus_rmw_zenoh::{Settings, Wire};
use periplus_sim::Simulation;

use super::{Joined, Ros2};
use crate::terminal;

/// Connects as the environment sets; `None` on failure.
pub(super) fn join(simulation: &Simulation, quiet: bool) -> io::Result<Option<Ros2>> {
    let (settings, findings) = Settings::from_environment(&Machine);
    terminal::diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    let opened = Wire::open(&settings).and_then(|wire| {
        wire.attach(simulation.graph())?;
        Ok(wire)
    });
    match opened {
        Ok(wire) => {
            if !quiet {
                let (domain, route) = (settings.domain_id, settings.way());
                terminal::say(&format!("ROS 2 on Zenoh: domain {domain}, through {route}"));
            }
            let wire = Some(Joined::Zenoh(wire));
            Ok(Some(Ros2 { wire, looked: Duration::ZERO, quiet }))
        }
        Err(error) => {
            terminal::complain(&error.to_string());
            Ok(None)
        }
    }
}
