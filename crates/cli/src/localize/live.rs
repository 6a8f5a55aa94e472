//! Localization among the programs of ROS 2.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_graph::{Graph, GraphError, Mailbox, Node, NodeSettings, Qos};
use periplus_host::{Machine, sleep, unix_ns};
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_wire_ros2::{Settings, Wire};

use super::{Localization, LocalizeOptions};
use crate::arguments;
use crate::terminal::{complain, diagnostics, stop_on_ctrl_c};
use crate::watched::Watched;

/// How often it is looked what time it is, and whether it is over.
const LOOK: Duration = Duration::from_millis(5);

/// How long the last words may take to arrive.
const LAST_WORD: Duration = Duration::from_millis(500);

pub(super) fn run(options: &LocalizeOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    let Some(values) = options.values()? else { return Ok(ExitCode::from(2)) };
    let Some(arguments) = arguments::read(ros)? else { return Ok(ExitCode::from(2)) };
    let stop = stop_on_ctrl_c();
    let graph = Graph::live();
    let is_simulated = values.flag("use_sim_time").unwrap_or_default();
    graph.set_simulated_time(is_simulated);
    if !is_simulated {
        graph.advance_to(unix_ns());
    }
    graph.set_arguments(arguments);
    let (settings, said) = Settings::from_environment(&Machine);
    diagnostics(&mut anstream::stderr().lock(), &said, &SourceMap::new())?;
    let attached = Wire::open(&settings).and_then(|wire| wire.attach(&graph).map(|()| wire));
    let wire = match attached {
        Ok(wire) => wire,
        Err(error) => {
            complain(&format!("cannot join ROS 2: {error}"));
            return Ok(ExitCode::FAILURE);
        }
    };
    let localization = match Localization::new(&graph, options.map.as_deref(), values) {
        Ok(localization) => localization,
        Err(why) => {
            complain(&why);
            return Ok(ExitCode::FAILURE);
        }
    };
    for findings in [graph.take_findings(), graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    let watched = Watched::new(localization.amcl().node());
    let Ok(watched) = watched.map_err(|error| complain(&error.to_string())) else {
        return Ok(ExitCode::FAILURE);
    };
    let clock = match clock(&graph) {
        Ok(clock) => clock,
        Err(error) => {
            complain(&error.to_string());
            return Ok(ExitCode::FAILURE);
        }
    };
    let mut code = ExitCode::SUCCESS;
    while !stop.load(Ordering::Relaxed) {
        if !is_simulated {
            graph.advance_to(unix_ns());
        } else if let Some(told) = clock.1.latest() {
            follow(&graph, &told.clock);
        }
        sleep(LOOK);
        watched.tell();
        if watched.gave_up() {
            // It has been logged why.
            code = ExitCode::FAILURE;
            break;
        }
    }
    let _ = wire.flush(LAST_WORD);
    diagnostics(&mut anstream::stderr().lock(), &wire.take_findings(), &SourceMap::new())?;
    Ok(code)
}

/// Who tells the time of a simulation; the node has to stay.
fn clock(graph: &Graph) -> Result<(Node, Mailbox<Clock>), GraphError> {
    let node = graph.node(NodeSettings::new("_amcl_clock").bare())?;
    let clock = node.mailbox("/clock", Qos::clock())?;
    Ok((node, clock))
}

/// Goes on to a time, or back to it when a simulation began anew.
fn follow(graph: &Graph, time: &Time) {
    let time_ns = i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec);
    if time_ns < graph.now_ns() {
        graph.jump_to(time_ns);
    } else {
        graph.advance_to(time_ns);
    }
}
