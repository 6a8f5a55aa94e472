//! `periplus slam --live`: mapping on ROS 2.

use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::Duration;

use periplus_session::nodes::{MappingNode, MappingRequest, MappingSource, slam_parameters};
use periplus_session::{PollSleep, stop};

use super::options::SlamOptions;
use crate::arguments;
use crate::error::CliError;
use crate::terminal::say;

/// Period of clock updates: background work is split into slices of this duration.
const POLL_SLEEP: PollSleep = PollSleep::fixed(Duration::from_millis(4));
/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &SlamOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let arguments = arguments::read(ros)?;
    let file = options.live.params_file.as_deref();
    let (program, values) = slam_parameters(file, options.live.node)?;
    let told = arguments.parameters_of(&format!("/{}", program.node_name()));
    let is_simulated = told
        .get("use_sim_time")
        .map_or(values.flag("use_sim_time"), |value| Some(value.bool_value))
        .unwrap_or(false);
    let stop = stop::on_signal();
    let mut live = options.live.network.open(arguments)?;
    let out = Some(options.out.clone()).filter(|out| !out.as_os_str().is_empty());
    let request = MappingRequest { source: MappingSource::Values(program, values), out };
    let ending = if request.out.is_some() { " and writes the map" } else { "" };
    let mapping = MappingNode::live(&live.graph, request)?;
    live.print_start_findings()?;
    if !options.quiet {
        say(&format!(
            "mapping as {} on ROS 2 domain {}; Ctrl-C ends it{ending}",
            program.executable(),
            live.domain_id,
        ));
    }
    let monitor = live.monitor(mapping.node.node(), is_simulated)?;
    live.spin(&stop, POLL_SLEEP, || {
        monitor.print_log();
        ControlFlow::Continue(())
    });
    if !options.quiet {
        mapping.write_report(&mut anstream::stderr().lock())?;
    }
    let written = mapping.write_results();
    live.end(FLUSH_TIMEOUT);
    if let Some(folder) = written?.filter(|_| !options.quiet) {
        say(&format!("written: {}", folder.display()));
    }
    Ok(ExitCode::SUCCESS)
}
