//! `periplus costmap`.

use std::ops::ControlFlow;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;
use periplus_costmap::Nav2Release;
use periplus_session::nodes::{CostmapRequest, CostmapSource, Costmaps, FloorPoint};
use periplus_session::{NodeMonitor, PollSleep, stop};

use super::floor_point;
use crate::arguments;
use crate::error::CliError;
use crate::run_options::LiveNetworkOptions;
use crate::terminal::say;

/// Polling period.
const POLL_SLEEP: PollSleep = PollSleep::fixed(Duration::from_millis(5));

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
    #[command(flatten)]
    pub(crate) network: LiveNetworkOptions,
}

pub(crate) fn run(options: &CostmapServeOptions, ros: Vec<String>) -> Result<ExitCode, CliError> {
    let remaps = options.remaps.iter().flat_map(|rule| ["-r".to_owned(), rule.clone()]);
    let arguments = arguments::read(remaps.chain(ros).collect())?;
    let stop = stop::on_signal();
    let mut live = options.network.open(arguments)?;
    let costmaps = Costmaps::new(&live.graph, options.request())?;
    live.print_start_findings()?;
    let nodes = costmaps.nodes();
    let monitors: Result<Vec<_>, _> =
        nodes.iter().map(|node| NodeMonitor::new(node.node())).collect();
    let monitors = monitors?;
    if options.use_sim_time || costmaps.wants_simulated_time() {
        if let Some(node) = nodes.first() {
            live.follow_clock(node.node())?;
        }
        say("using the time of /clock");
    }
    if !options.managed {
        costmaps.start();
    }
    live.spin(&stop, POLL_SLEEP, || {
        for monitor in &monitors {
            monitor.print_log();
        }
        ControlFlow::Continue(())
    });
    live.end(FLUSH_TIMEOUT);
    costmaps.write_report(&mut anstream::stdout().lock())?;
    Ok(ExitCode::SUCCESS)
}

impl CostmapServeOptions {
    fn request(&self) -> CostmapRequest {
        CostmapRequest {
            source: CostmapSource::File(self.file.clone(), self.compat),
            cells: self.cell.clone(),
            images: self.picture.clone(),
        }
    }
}
