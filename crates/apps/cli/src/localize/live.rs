//! Localization on ROS 2.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;

use super::{Localization, LocalizeOptions};
use crate::arguments;
use crate::error::CliError;
use crate::live::{Live, NodeMonitor};
use crate::stop;
use crate::terminal::diagnostics;

/// Shortest and longest sleep of the loop: the filter polls for scans every 20 ms.
const MIN_SLEEP: Duration = Duration::from_millis(5);
const MAX_SLEEP: Duration = Duration::from_millis(20);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &LocalizeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let values = options.values()?;
    let arguments = arguments::read(ros)?;
    let stop = stop::on_signal();
    let is_simulated = values.flag("use_sim_time").unwrap_or_default();
    let mut live = Live::open(arguments).map_err(CliError::failed)?;
    let graph = &live.graph;
    let localization =
        Localization::new(graph, options.map.as_deref(), values).map_err(CliError::failed)?;
    for findings in [graph.take_findings(), graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    let node = localization.amcl().node();
    let ready = NodeMonitor::new(node).and_then(|monitor| {
        if is_simulated {
            live.follow_clock(node)?;
        }
        Ok(monitor)
    });
    let monitor = ready.map_err(CliError::failed)?;
    let mut code = ExitCode::SUCCESS;
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        live.sleep_until_due(MIN_SLEEP, MAX_SLEEP);
        if monitor.tell() {
            // The reason has been logged.
            code = ExitCode::FAILURE;
            break;
        }
    }
    live.end(FLUSH_TIMEOUT);
    Ok(code)
}
