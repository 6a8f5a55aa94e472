//! `periplus costmap`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::Ordering;
use std::time::Duration;

use clap::Args;
use periplus_costmap::Nav2Release;
use periplus_diagnostics::SourceMap;
use periplus_os::sleep;

use super::{Costmaps, FloorPoint, floor_point};
use crate::arguments;
use crate::error::CliError;
use crate::live::{Live, NodeMonitor};
use crate::stop;
use crate::terminal::{diagnostics, say};

/// Polling period.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

/// Run the costmaps of a Nav2 parameter file for a robot on ROS 2: `local_costmap` and
/// `global_costmap`, if the file has them
///
/// Lifecycle nodes that configure and activate themselves; with `--managed` they wait for a
/// lifecycle manager. They have the topics and services of Nav2's. Ctrl-C stops them and prints a
/// report: silent topics, dropped points, and the parameter to change. `--ros-args` is understood.
#[derive(Debug, Args)]
pub(crate) struct CostmapServeOptions {
    /// Parameter file
    #[arg(value_name = "nav2_params.yaml")]
    file: PathBuf,
    /// Release of Nav2 whose behaviour is reproduced where releases differ
    #[arg(long, value_name = "humble|jazzy|main")]
    compat: Option<Nav2Release>,
    /// Wait for a lifecycle manager to configure and activate them
    #[arg(long)]
    managed: bool,
    /// At the end explain why the cell at this position is marked or free, for each costmap, in its
    /// frame [m]
    #[arg(long, value_name = "X,Y", value_parser = floor_point, allow_hyphen_values = true)]
    cell: Vec<FloorPoint>,
    /// At the end write each costmap to a folder as images in RViz's colours: costmap, map and raw
    #[arg(long, value_name = "FOLDER")]
    picture: Option<PathBuf>,
    /// Use simulated time (/clock), even if the file does not set it
    #[arg(long)]
    use_sim_time: bool,
    /// Remap a topic or node: `from:=to`
    #[arg(long = "remap", short = 'r', value_name = "FROM:=TO")]
    remaps: Vec<String>,
}

pub(crate) fn run(options: &CostmapServeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let remaps = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let arguments = arguments::read(remaps.chain(ros).collect())?;
    let stop = stop::on_signal();
    let mut live = Live::open(arguments).map_err(CliError::failed)?;
    let costmaps = Costmaps::of_file(&live.graph, &options.file, options.compat)?;
    let (cells, pictures) = (options.cell.clone(), options.picture.clone());
    let costmaps = Costmaps { cells, pictures, ..costmaps };
    for findings in [live.graph.take_findings(), live.graph.unused_arguments()] {
        diagnostics(&mut anstream::stderr().lock(), &findings, &SourceMap::new())?;
    }
    let monitor: Result<Vec<_>, _> =
        costmaps.nodes.iter().map(|node| NodeMonitor::new(node.node())).collect();
    let follows_clock = options.use_sim_time || costmaps.wants_simulated_time();
    let ready = monitor.and_then(|monitor| {
        if let Some(node) = costmaps.nodes.first().filter(|_| follows_clock) {
            live.follow_clock(node.node())?;
        }
        Ok(monitor)
    });
    let monitor = ready.map_err(CliError::failed)?;
    if follows_clock {
        say("using the time of /clock");
    }
    if !options.managed {
        costmaps.start();
    }
    while !stop.load(Ordering::Relaxed) {
        live.spin_once();
        sleep(POLL_PERIOD);
        for one in &monitor {
            one.tell();
        }
    }
    live.end(FLUSH_TIMEOUT);
    costmaps.tell(&mut anstream::stdout().lock())?;
    Ok(ExitCode::SUCCESS)
}
