//! `periplus slam --live`: mapping on ROS 2.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_graph::NodeSettings;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_os::sleep;

use super::options::SlamOptions;
use crate::arguments;
use crate::live::{Live, NodeMonitor};
use crate::mapping::{Mapping, parameters};
use crate::stop;
use crate::terminal::{complain, diagnostics, say};

/// Period of clock updates: background work is split into slices of this duration.
const POLL_PERIOD: Duration = Duration::from_millis(4);
/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

pub(super) fn run(options: &SlamOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    let Some(arguments) = arguments::read(ros)? else {
        return Ok(ExitCode::from(2));
    };
    let file = options.live.params_file.as_deref();
    let Some((program, values)) = parameters(file, options.live.node)? else {
        return Ok(ExitCode::FAILURE);
    };
    let told = arguments.parameters_of(&format!("/{}", program.node_name()));
    let is_simulated = told
        .get("use_sim_time")
        .map_or(values.flag("use_sim_time"), |value| Some(value.bool_value))
        .unwrap_or(false);
    let stop = stop::on_signal();
    let mut live = match Live::open(arguments) {
        Ok(live) => live,
        Err(words) => {
            complain(&words);
            return Ok(ExitCode::FAILURE);
        }
    };
    let graph = &live.graph;
    let out = Some(options.out.as_path()).filter(|out| !out.as_os_str().is_empty());
    let node = graph.node(NodeSettings::new(program.node_name()));
    let Ok(mapping) = Mapping::new(node, program, values, Pace::Whole, out) else {
        return Ok(ExitCode::FAILURE);
    };
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
    let monitor = match ready {
        Ok(monitor) => monitor,
        Err(error) => {
            complain(&error.to_string());
            return Ok(ExitCode::FAILURE);
        }
    };
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
            complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    }
    Ok(ExitCode::SUCCESS)
}
