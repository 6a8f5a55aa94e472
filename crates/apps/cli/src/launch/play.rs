//! Execution of launch plans.

mod lockstep;
mod log;
mod network;
mod parameter_server;
mod simulated;
mod watch;
mod world;

use std::io::{self, Write as _};
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use periplus_graph::Arguments;
use periplus_launch::bringup::{LaunchRunner, Settings};
use periplus_launch::{Dialect, LaunchPlan};
use periplus_os::Stopwatch;
use periplus_session::{PageContext, PageSettings, Ros1Reach};
use serde_json::json;

use crate::error::CliError;
use crate::options::SearchOptions;
use crate::page::PageOptions;
use crate::run_options::{Factor, Reach, Ros1Options, TopicSelection, factor, positive};
use crate::{own_command, terminal};

/// Options of running a plan.
#[derive(Debug, Args)]
pub(crate) struct PlayOptions {
    /// Duration of the run [s]; simulated seconds if there is a world [default: until Ctrl-C]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: Option<f64>,
    /// Record published topics to a bag: FILE.mcap, or a folder in the format of `ros2 bag`
    #[arg(long, visible_alias = "out", value_name = "FILE.mcap|FOLDER")]
    record: Option<PathBuf>,
    #[command(flatten)]
    recorded: TopicSelection,
    /// Real-time factor, or `max` for full speed
    #[arg(long, visible_alias = "speed", value_name = "FACTOR|max", value_parser = factor)]
    rtf: Option<Factor>,
    /// Seed of all noise, in place of Gazebo's
    #[arg(long, value_name = "NUMBER")]
    seed: Option<u64>,
    /// Visibility of the run on ROS 2 [default: at real time `loopback` or
    /// ROS_AUTOMATIC_DISCOVERY_RANGE, at full speed `off`]
    #[arg(long, value_enum, value_name = "off|loopback|network|zenoh")]
    ros2: Option<Reach>,
    #[command(flatten)]
    ros1: Ros1Options,
    #[command(flatten)]
    page: PageOptions,
    /// Show no page when the launch file starts RViz or a window of Gazebo
    #[arg(long)]
    headless: bool,
    /// Serve the page, but do not open a browser
    #[arg(long)]
    no_browser: bool,
    /// Run nodes in Python with the installed ROS instead of the modules of Periplus
    #[arg(long)]
    real_ros: bool,
    /// Number of threads for rays; results do not depend on it
    #[arg(long, value_name = "NUMBER")]
    threads: Option<usize>,
    /// Print a report as JSON
    #[arg(long)]
    json: bool,
    /// Print only errors
    #[arg(long, short)]
    pub(super) quiet: bool,
}

/// Launch plan with its context.
pub(super) struct Launched {
    pub(super) plan: LaunchPlan,
    pub(super) dialect: Dialect,
    /// `--ros-args` for all nodes.
    pub(super) arguments: Arguments,
    /// Folder of built-in programs that its processes find at the end of the PATH.
    pub(super) tools: Option<PathBuf>,
    pub(super) start: Stopwatch,
    /// The command, for recordings.
    pub(super) recorded: String,
}

/// Runs the plan.
pub(super) fn play(
    launched: Launched,
    options: &PlayOptions,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    let ros1 = options.ros1.reach();
    let bringup = runner(&launched, options, ros1, search);
    // Without a network, an empty world provides the time.
    if bringup.world().is_some() || options.is_alone() {
        simulated::run(launched, bringup, options, ros1, search)
    } else {
        network::run(launched, bringup, options, ros1, search)
    }
}

/// Prints the outcome of each part of the plan; starts nothing.
pub(super) fn preview(
    launched: &Launched,
    options: &PlayOptions,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    let outcomes = runner(launched, options, options.ros1.reach(), search).preview();
    let mut out = anstream::AutoStream::auto(io::stdout().lock());
    if options.json {
        writeln!(out, "{:#}", json!({ "launch": outcomes }))?;
    } else {
        for outcome in &outcomes {
            log::write_outcome(&mut out, outcome)?;
        }
    }
    Ok(ExitCode::SUCCESS)
}

fn runner(
    launched: &Launched,
    options: &PlayOptions,
    ros1: Option<Ros1Reach>,
    search: &SearchOptions,
) -> LaunchRunner {
    let settings = Settings {
        search: terminal::search(&search.resource_path),
        dialect: launched.dialect,
        is_wired: false,
        has_ros1_master: ros1.is_some(),
        is_paced: !options.is_free() && !matches!(options.rtf, Some(Factor::Max)),
        guarding_command: own_command::own_command().to_vec(),
        tools: launched.tools.clone(),
        python: own_command::interpreter(),
        uses_real_ros: options.real_ros,
        node_environment: options.node_environment(),
    };
    LaunchRunner::new(&launched.plan, settings)
}

impl PlayOptions {
    /// Returns true if the run is as fast as possible.
    fn is_free(&self) -> bool {
        self.duration.is_some() && self.rtf.is_none()
    }

    /// Returns true if the run has no network.
    fn is_alone(&self) -> bool {
        self.ros2.map_or_else(|| self.is_free(), |reach| reach == Reach::Off)
    }

    /// Environment variables with which nodes in other processes join the network of the run.
    fn node_environment(&self) -> Vec<(String, String)> {
        let range = match self.ros2 {
            Some(Reach::Loopback) => "LOCALHOST",
            Some(Reach::Network) => "SUBNET",
            Some(Reach::Off | Reach::Zenoh) | None => return Vec::new(),
        };
        vec![("ROS_AUTOMATIC_DISCOVERY_RANGE".to_owned(), range.to_owned())]
    }

    /// Page that is requested, or that replaces a window of the launch file. The latter is
    /// optional. A browser opens if the launch file opens a window.
    fn page(
        &self,
        bringup: &LaunchRunner,
        is_paced: bool,
        context: impl FnOnce() -> PageContext,
    ) -> Option<PageSettings> {
        let is_requested = self.page.page.is_some();
        let opens_window = !self.headless && bringup.wants_page();
        if !(is_requested || opens_window && is_paced) {
            return None;
        }
        let context = PageContext {
            view: bringup.views().into_iter().next(),
            fixed_frame: bringup.fixed_frame(),
            ..context()
        };
        Some(PageSettings {
            is_required: is_requested,
            is_quiet: self.quiet,
            opens_browser: opens_window && !self.no_browser,
            ..self.page.settings(context)
        })
    }
}
