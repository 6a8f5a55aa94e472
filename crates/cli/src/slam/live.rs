//! `periplus slam --live`: the map of what is heard on ROS 2.

use std::io;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use periplus_diagnostics::SourceMap;
use periplus_graph::{Graph, GraphError, Level, Mailbox, Node, NodeSettings, Qos};
use periplus_host::{Machine, sleep, unix_ns};
use periplus_msgs::rcl_interfaces::Log;
use periplus_msgs::rosgraph_msgs::Clock;
use periplus_slam_nodes::Pace;
use periplus_wire_ros2::{Settings, Wire};

use super::options::SlamOptions;
use crate::arguments;
use crate::mapping::{Mapping, parameters};
use crate::terminal::{complain, diagnostics, say, stop_on_ctrl_c};

/// How often time is told: work beside the scans comes in slices of this.
const LOOK: Duration = Duration::from_millis(4);
/// How long the last words may take to arrive.
const LAST_WORD: Duration = Duration::from_millis(500);

pub(super) fn run(options: &SlamOptions, ros: Vec<String>) -> io::Result<ExitCode> {
    let Some(arguments) = arguments::read(ros)? else {
        return Ok(ExitCode::from(2));
    };
    let live = &options.live;
    let file = live.params_file.as_deref();
    let Some((program, values)) = parameters(file, live.node)? else {
        return Ok(ExitCode::FAILURE);
    };
    let told = arguments.parameters_of(&format!("/{}", program.node_name()));
    let is_simulated = told
        .get("use_sim_time")
        .map_or(values.flag("use_sim_time"), |value| Some(value.bool_value))
        .unwrap_or(false);
    let stop = stop_on_ctrl_c();
    let graph = Graph::live();
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
    let watched = match Watched::new(&graph) {
        Ok(watched) => watched,
        Err(error) => {
            complain(&error.to_string());
            return Ok(ExitCode::FAILURE);
        }
    };
    let out = Some(options.out.as_path()).filter(|out| !out.as_os_str().is_empty());
    let Ok(mapping) = Mapping::new(&graph, program, values, Pace::Whole, out) else {
        return Ok(ExitCode::FAILURE);
    };
    for findings in [graph.take_findings(), graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    if !options.quiet {
        say(&format!(
            "mapping as {} on ROS 2 domain {}; Ctrl-C ends it{}",
            program.executable(),
            settings.domain_id,
            if out.is_some() { " and writes the map" } else { "" }
        ));
    }
    let logger = mapping.node.node().logger();
    while !stop.load(Ordering::Relaxed) {
        if is_simulated {
            if let Some(clock) = watched.clock.latest() {
                let time = &clock.clock;
                graph.advance_to(i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec));
            }
        } else {
            graph.advance_to(unix_ns());
        }
        sleep(LOOK);
        for line in watched.logs.drain().iter().filter(|line| line.name == logger) {
            say(&format!("[{}] [{}]: {}", Level::of_number(line.level), line.name, line.msg));
        }
    }
    if !options.quiet {
        mapping.tell(&mut anstream::stderr().lock())?;
    }
    let written = mapping.write();
    let _ = wire.flush(LAST_WORD);
    diagnostics(&mut anstream::stderr().lock(), &wire.take_findings(), &SourceMap::new())?;
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

/// What the node says, and the time of a simulation.
struct Watched {
    logs: Mailbox<Log>,
    clock: Mailbox<Clock>,
    _node: Node,
}

impl Watched {
    fn new(graph: &Graph) -> Result<Self, GraphError> {
        let node = graph.node(NodeSettings::new("_slam_watch").bare())?;
        Ok(Self {
            logs: node.mailbox("/rosout", Qos::latched(100))?,
            clock: node.mailbox("/clock", Qos::clock())?,
            _node: node,
        })
    }
}
