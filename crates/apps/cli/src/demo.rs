//! `periplus demo`, also run by `periplus` without arguments.

pub(crate) mod browser;
mod explorer;
mod pictures;
mod report;
mod stage;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use periplus_geometry::Pose2;
use periplus_graph::NodeSettings;
use periplus_nav_nodes::slam_toolbox::Pace;
use periplus_os::Stopwatch;
use periplus_sim::{
    AssetFiles, Driver, Options, Run, Search, Services, Simulation, SimulationRecorder,
};

use crate::costmap::Costmaps;
use crate::error::CliError;
use crate::mapping::Mapping;
use crate::page::{About, PORT, Page, PageOptions};
use crate::stop;
use crate::terminal;

use explorer::Explorer;
use pictures::SnapshotRecorder;

/// Default duration of a run without a page \[s\].
const DEFAULT_DURATION_S: f64 = 60.0;

/// Default folder of the results.
const DEFAULT_OUT: &str = "periplus-demo";

/// Show a robot in a room: sensors, mapping, costmaps
///
/// Opens a page in the browser, where the robot is driven with keys or the mouse. With `--headless`
/// it explores autonomously and writes a map, a bag, a report and images.
#[derive(Debug, Args)]
pub(crate) struct DemoOptions {
    /// Run without a page, as fast as possible, exploring autonomously
    #[arg(long)]
    headless: bool,
    /// Duration of the run in simulated seconds [default with --headless: 60]
    #[arg(long, value_name = "SECONDS", value_parser = crate::sim::positive)]
    duration: Option<f64>,
    /// Folder for map, bag, report and images [default with --headless: `periplus-demo`]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Explore autonomously although there is a page
    #[arg(long)]
    explore: bool,
    /// Do not open a browser
    #[arg(long)]
    no_browser: bool,
    /// Seed of all noise
    #[arg(long, default_value_t = 0, value_name = "NUMBER")]
    seed: u64,
    #[command(flatten)]
    page: PageOptions,
}

impl Default for DemoOptions {
    fn default() -> Self {
        Self {
            headless: false,
            duration: None,
            out: None,
            explore: false,
            no_browser: false,
            seed: 0,
            page: PageOptions { page: None, token: None },
        }
    }
}

impl DemoOptions {
    fn out(&self) -> Option<PathBuf> {
        let usual = self.headless.then(|| PathBuf::from(DEFAULT_OUT));
        self.out.clone().or(usual)
    }

    fn duration(&self) -> Option<f64> {
        self.duration.or(self.headless.then_some(DEFAULT_DURATION_S))
    }
}

pub(crate) fn run(options: &DemoOptions) -> Result<ExitCode, CliError> {
    let start = Stopwatch::start();
    let words = |error: &dyn std::fmt::Display| error.to_string();
    let mut composition = stage::composition();
    let files = Arc::new(AssetFiles::default());
    let threads = terminal::processors();
    let settings = Options { seed: options.seed, threads, ..Options::default() };
    let mut simulation = Simulation::new(&mut composition, files, settings);
    let out = options.out();
    if let Some(out) = &out {
        crate::paths::make_folder(out)?;
    }
    let recorder = out.as_deref().map(|out| record(&simulation, out)).transpose()?;
    let search = Search { working_folder: terminal::working_folder(), ..Search::default() };
    let mut services = Services::new(&simulation, search).map_err(|error| words(&error))?;
    let graph = simulation.graph().clone();
    let (program, values) = stage::mapping();
    let pace = if options.headless { Pace::Whole } else { Pace::Sliced };
    let node = graph.node(NodeSettings::new(program.node_name()));
    let mapping = Mapping::new(node, program, values, pace, out.as_deref())?;
    let costmaps = Costmaps::of_text(&graph, "costmaps.yaml", stage::COSTMAPS, out.clone())?;
    let drives = options.headless || options.explore;
    let mut explorer =
        drives.then(|| Explorer::join(&graph)).transpose().map_err(|error| words(&error))?;
    let page =
        (!options.headless).then(|| open(options, &simulation, &mut services)).transpose()?;
    let end_ns = options.duration().map(|seconds| (seconds * 1e9).round() as i64);
    let mut eyes = match &out {
        Some(_) => Some(SnapshotRecorder::join(&graph, end_ns).map_err(|error| words(&error))?),
        None => None,
    };
    let stop = stop::on_signal();
    let factor = (!options.headless).then_some(1.0);
    let run = Run { end_ns, factor, stop: &stop, paused: false };
    let start_up = start.elapsed();
    if let Some(page) = &page {
        tell(options, page);
    }
    let stopwatch = Stopwatch::start();
    let outcome = run.go(&mut simulation, &mut services, &mut Driver::default(), &mut |progress| {
        if let Some(explorer) = &mut explorer {
            explorer.spin_once(progress.time_ns);
        }
        if let Some(eyes) = &mut eyes {
            eyes.look(progress.time_ns);
        }
    });
    let wall = stopwatch.elapsed();
    drop(page);
    outcome.map_err(|diverged| diverged.to_string())?;
    let Some(out) = out else { return Ok(ExitCode::SUCCESS) };
    let recording = recorder.map(|recorder| recorder.finish(&mut simulation)).transpose();
    let recording = recording.map_err(|error| format!("the bag is incomplete: {error}"))?;
    let map = mapping.node.with(|node| node.map());
    let truth = map.and_then(|map| simulation.beside_truth(&map, Pose2::IDENTITY));
    let run = crate::sim::Report {
        simulation: &simulation,
        start_up,
        wall,
        recording: recording.as_ref(),
    };
    let told = report::of(&run, &mapping, truth.as_ref(), explorer.as_ref());
    mapping.write()?;
    costmaps.write()?;
    if let Some(eyes) = &eyes {
        eyes.write(&out)?;
    }
    let text = format!("{told:#}\n");
    crate::paths::write(&out.join("report.json"), text.as_bytes())?;
    let mut err = anstream::stderr().lock();
    let said = run.tell(&mut err).and_then(|()| mapping.tell(&mut err));
    let said = said.and_then(|()| match &truth {
        None => Ok(()),
        Some(truth) => writeln!(
            err,
            "the walls of the map are {:.3} m from the true walls on average",
            truth.comparison.other_to_first.mean_m
        ),
    });
    said.and_then(|()| writeln!(err, "results are in {}", out.display()))
        .map_err(|error| words(&error))?;
    Ok(ExitCode::SUCCESS)
}

/// Records everything but images, which only a viewer subscribes to.
fn record(simulation: &Simulation, out: &Path) -> Result<SimulationRecorder, String> {
    let wanted = |name: &str| !name.starts_with("/depth_camera/");
    SimulationRecorder::start(simulation, &out.join("demo.mcap"), Box::new(wanted))
        .map_err(|error| format!("cannot record to {}: {error}", out.display()))
}

fn open(
    options: &DemoOptions,
    simulation: &Simulation,
    services: &mut Services,
) -> Result<Page, String> {
    services.show(simulation, Vec::new()).map_err(|error| error.to_string())?;
    let about = About { world: Some(stage::WORLD_NAME.to_owned()), ..About::default() };
    let token = &options.page.token;
    let usual = std::net::SocketAddr::from(([127, 0, 0, 1], PORT));
    let asked = options.page.page;
    Page::open(simulation.graph(), asked.unwrap_or(usual), token.clone(), about)
}

fn tell(options: &DemoOptions, page: &Page) {
    let url = page.url();
    terminal::say(&format!("page: {url} (Ctrl-C ends the demo)"));
    if !options.no_browser && !browser::open(&url) {
        terminal::say("no browser could be started; open the page yourself");
    }
}
