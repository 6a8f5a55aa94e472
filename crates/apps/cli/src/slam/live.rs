//! `periplus slam --live`: mapping on ROS 2.

use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_graph::NodeSettings;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_os::sleep;

use super::options::SlamOptions;
use crate::arguments;
use crate::error::CliError;
use crate::live::{Live, NodeMonitor};
use crate::mapping::{Mapping, parameters};
use crate::stop;
use crate::terminal::{diagnostics, say};

/// Period of clock updates: background work is split into slices of this duration.
const POLL_PERIOD: Duration = Duration::from_millis(4);
/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &SlamOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let arguments = arguments::read(ros)?;
    let file = options.live.params_file.as_deref();
    let (program, values) = parameters(file, options.live.node)?;
    let told = arguments.parameters_of(&format!("/{}", program.node_name()));
    let is_simulated = told
        .get("use_sim_time")
        .map_or(values.flag("use_sim_time"), |value| Some(value.bool_value))
        .unwrap_or(false);
    let stop = stop::on_signal();
    let mut live = Live::open(arguments).map_err(CliError::failed)?;
    let graph = &live.graph;
    let out = Some(options.out.as_path()).filter(|out| !out.as_os_str().is_empty());
    let node = graph.node(NodeSettings::new(program.node_name()));
    let mapping = Mapping::new(node, program, values, Pace::Whole, out)?;
    for findings in [graph.take_findings(), graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    if !options.quiet {
        say(&format!(
            "mapping as {} on ROS 2 domain {}; Ctrl-C ends it{}",
            program.executable(),
            live.domain_id,
            if out.is_some() { " and writes the map" } else { "" }
        ));
    }
    let ready = NodeMonitor::new(mapping.node.node()).and_then(|monitor| {
        if is_simulated {
            live.follow_clock(mapping.node.node())?;
        }
        Ok(monitor)
    });
    let monitor = ready.map_err(CliError::failed)?;
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        sleep(POLL_PERIOD);
        monitor.tell();
    }
    if !options.quiet {
        mapping.tell(&mut anstream::stderr().lock())?;
    }
    let written = mapping.write();
    live.end(FLUSH_TIMEOUT);
    match written {
        Ok(Some(folder)) if !options.quiet => say(&format!("written: {}", folder.display())),
        Ok(_) => {}
        Err(why) => {
            return Err(CliError::failed(why));
        }
    }
    Ok(ExitCode::SUCCESS)
}
