//! `periplus demo`, also run by `periplus` without arguments.

mod explorer;
mod pictures;
mod report;
mod stage;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_geometry::Pose2;
use periplus_graph::{Graph, GraphError};
use periplus_maps::BesideTruth;
use periplus_os::Stopwatch;
use periplus_session::nodes::{
    CostmapRequest, CostmapSource, EstimatorRequest, MappingNode, MappingRequest, MappingSource,
};
use periplus_session::{
    PageContext, PageSettings, RecordingRequest, RunEnd, RunSettings, SessionBuilder, SessionTask,
    SimulationSession, stop,
};
use periplus_sim::{Options, RunProgress, Search};

use crate::error::CliError;
use crate::page::PageOptions;
use crate::run_options::{exit_code, positive};
use crate::{paths, terminal};

use explorer::Explorer;
use pictures::SnapshotRecorder;

pub(crate) use stage::composition;

/// Default duration of a run without a page \[s\].
const DEFAULT_DURATION_S: f64 = 60.0;

/// Default folder of the results.
const DEFAULT_OUT: &str = "periplus-demo";

/// Show a robot in a room: sensors, mapping, costmaps
///
/// Opens a page in the browser, where the robot is driven with keys or the mouse. With `--headless`
/// it explores autonomously and writes a map, a bag, a report and images.
#[derive(Debug, Default, Args)]
pub(crate) struct DemoOptions {
    /// Run without a page, as fast as possible, exploring autonomously
    #[arg(long)]
    headless: bool,
    /// Duration of the run in simulated seconds [default with --headless: 60]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
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
    let out = options.out();
    if let Some(out) = &out {
        paths::make_folder(out)?;
    }
    let mut session = options.session(out.as_deref(), start).build()?;
    let mut task = DemoTask::new(session.graph(), options, out.is_some())?;
    let stop = stop::on_signal();
    let settings = RunSettings { duration_s: options.duration(), stop: &stop, is_paused: false };
    session.run(settings, &mut task);
    if let RunEnd::Diverged(diverged) = session.end() {
        return Err(CliError::failed(diverged));
    }
    let Some(out) = out else { return Ok(ExitCode::SUCCESS) };
    session.finish()?;
    task.write(&mut session, &out)?;
    match session.end() {
        // The results of a shorter run are complete, too.
        RunEnd::Interrupted => Ok(ExitCode::SUCCESS),
        end => exit_code(end),
    }
}

impl DemoOptions {
    fn session(&self, out: Option<&Path>, start: Stopwatch) -> SessionBuilder {
        let simulation =
            Options { seed: self.seed, threads: terminal::processors(), ..Options::default() };
        let search = Search { working_folder: terminal::working_folder(), ..Search::default() };
        let (program, values) = stage::mapping();
        let estimators = EstimatorRequest {
            costmaps: Some(CostmapRequest {
                source: CostmapSource::Text("costmaps.yaml", stage::COSTMAPS.to_owned()),
                cells: Vec::new(),
                images: out.map(Path::to_owned),
            }),
            mapping: Some(MappingRequest {
                source: MappingSource::Values(program, values),
                out: out.map(Path::to_owned),
            }),
            ..EstimatorRequest::default()
        };
        SessionBuilder::new(stage::composition(), simulation, start)
            .quiet(true)
            .factor((!self.headless).then_some(1.0))
            .search(search)
            .recording(out.map(recording))
            .estimators(estimators)
            .page((!self.headless).then(|| self.page_settings()))
    }

    fn page_settings(&self) -> PageSettings {
        let world = Some(stage::WORLD_NAME.to_owned());
        PageSettings {
            opens_browser: !self.no_browser,
            hint: " (Ctrl-C ends the demo)",
            ..self.page.settings(PageContext { world, ..PageContext::default() })
        }
    }
}

/// Records everything but images, which only a viewer subscribes to.
fn recording(out: &Path) -> RecordingRequest {
    let wanted = |name: &str| !name.starts_with("/depth_camera/");
    RecordingRequest { path: out.join("demo.mcap"), wanted: Box::new(wanted) }
}

/// Exploration, and images at the end.
struct DemoTask {
    explorer: Option<Explorer>,
    images: Option<SnapshotRecorder>,
}

impl SessionTask for DemoTask {
    fn after_step(&mut self, progress: RunProgress) {
        if let Some(explorer) = &mut self.explorer {
            explorer.spin_once(progress.time_ns);
        }
        if let Some(images) = &mut self.images {
            images.look(progress.time_ns);
        }
    }
}

impl DemoTask {
    fn new(graph: &Graph, options: &DemoOptions, has_images: bool) -> Result<Self, GraphError> {
        let explores = options.headless || options.explore;
        let explorer = explores.then(|| Explorer::join(graph)).transpose()?;
        let end_ns = options.duration().map(|seconds| (seconds * 1e9).round() as i64);
        let images = has_images.then(|| SnapshotRecorder::join(graph, end_ns)).transpose()?;
        Ok(Self { explorer, images })
    }

    /// Writes all results and prints the report.
    fn write(&self, session: &mut SimulationSession, out: &Path) -> Result<(), CliError> {
        let map = session
            .estimators()
            .mapping
            .as_ref()
            .and_then(|mapping| mapping.node.with(|node| node.map()));
        let truth =
            map.and_then(|map| session.simulation_mut().beside_truth(&map, Pose2::IDENTITY));
        let estimators = session.estimators();
        let Some(mapping) = &estimators.mapping else { return Ok(()) };
        let report = report::of(&session.report(), mapping, truth.as_ref(), self.explorer.as_ref());
        mapping.write_results()?;
        estimators.costmaps.write_images()?;
        if let Some(images) = &self.images {
            images.write(out)?;
        }
        let text = format!("{report:#}\n");
        paths::write(&out.join("report.json"), text.as_bytes())?;
        print_report(session, mapping, truth.as_ref(), out)
    }
}

fn print_report(
    session: &SimulationSession,
    mapping: &MappingNode,
    truth: Option<&BesideTruth>,
    out: &Path,
) -> Result<(), CliError> {
    let mut err = anstream::stderr().lock();
    session.report().write_text(&mut err)?;
    mapping.write_report(&mut err)?;
    if let Some(truth) = truth {
        writeln!(
            err,
            "the walls of the map are {:.3} m from the true walls on average",
            truth.comparison.other_to_first.mean_m
        )?;
    }
    writeln!(err, "results are in {}", out.display())?;
    Ok(())
}
