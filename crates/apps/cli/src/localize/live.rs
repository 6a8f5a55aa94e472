//! Localization on ROS 2.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Duration;

use periplus_session::nodes::Localization;
use periplus_session::{PollSleep, stop};

use super::LocalizeOptions;
use crate::arguments;
use crate::error::CliError;

/// Sleep of the loop: the filter polls for scans every 20 ms.
const POLL_SLEEP: PollSleep =
    PollSleep { min: Duration::from_millis(5), max: Duration::from_millis(20) };

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &LocalizeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let values = options.values()?;
    let arguments = arguments::read(ros)?;
    let stop = stop::on_signal();
    let is_simulated = values.flag("use_sim_time").unwrap_or_default();
    let mut live = options.network.open(arguments)?;
    let localization = Localization::new(&live.graph, options.map.as_deref(), values)?;
    live.print_start_findings()?;
    let monitor = live.monitor(localization.amcl().node(), is_simulated)?;
    let has_failed = live.spin(&stop, POLL_SLEEP, || {
        // The reason has been logged.
        if monitor.print_log() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    live.end(FLUSH_TIMEOUT);
    Ok(if has_failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
