//! Localization on ROS 2.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;

use super::{Localization, LocalizeOptions};
use crate::arguments;
use crate::live::{Live, NodeMonitor};
use crate::stop;
use crate::terminal::{complain, diagnostics};

/// Shortest and longest sleep of the loop: the filter polls for scans every 20 ms.
const MIN_SLEEP: Duration = Duration::from_millis(5);
const MAX_SLEEP: Duration = Duration::from_millis(20);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &LocalizeOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    let Some(values) = options.values()? else { return Ok(ExitCode::from(2)) };
    let Some(arguments) = arguments::read(ros)? else { return Ok(ExitCode::from(2)) };
    let stop = stop::on_signal();
    let is_simulated = values.flag("use_sim_time").unwrap_or_default();
    let mut live = match Live::open(arguments) {
        Ok(live) => live,
        Err(words) => {
            complain(&words);
            return Ok(ExitCode::FAILURE);
        }
    };
    let graph = &live.graph;
    let localization = match Localization::new(graph, options.map.as_deref(), values) {
        Ok(localization) => localization,
        Err(why) => {
            complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    };
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
    let monitor = match ready {
        Ok(monitor) => monitor,
        Err(error) => {
            complain(&error.to_string());
            return Ok(ExitCode::FAILURE);
        }
    };
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
