//! `periplus demo`, also run by `periplus` without arguments.

mod report;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use periplus_geometry::Pose2;
use periplus_maps::BesideTruth;
use periplus_os::Stopwatch;
use periplus_session::demo::{self, DemoTask};
use periplus_session::nodes::MappingNode;
use periplus_session::{
    PageContext, PageSettings, RecordingRequest, RunEnd, RunSettings, SessionBuilder,
    SimulationSession, stop,
};
use periplus_sim::{Options, Search};

use crate::error::CliError;
use crate::page::PageOptions;
use crate::run_options::{BagCompression, exit_code, positive};
use crate::{paths, terminal};

pub(crate) use periplus_session::demo::composition;

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
    /// Compression of the bag
    #[arg(long, value_enum, default_value_t, value_name = "KIND")]
    bag_compression: BagCompression,
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
    let explores = options.headless || options.explore;
    let end_ns = options.duration().map(|seconds| (seconds * 1e9).round() as i64);
    let mut task = DemoTask::join(session.graph(), explores, out.is_some(), end_ns)?;
    let stop = stop::on_signal();
    let settings = RunSettings { duration_s: options.duration(), stop: &stop, is_paused: false };
    session.run(settings, &mut task);
    if let RunEnd::Diverged(diverged) = session.end() {
        return Err(CliError::failed(diverged));
    }
    let Some(out) = out else { return Ok(ExitCode::SUCCESS) };
    session.finish()?;
    write(&task, &mut session, &out)?;
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
        let recording = out.map(|out| RecordingRequest {
            compression: self.bag_compression.into(),
            ..demo::recording(&out.join("demo.mcap"))
        });
        demo::builder(simulation, out, start)
            .factor((!self.headless).then_some(1.0))
            .search(search)
            .recording(recording)
            .page((!self.headless).then(|| self.page_settings()))
    }

    fn page_settings(&self) -> PageSettings {
        let world = Some(demo::WORLD_NAME.to_owned());
        PageSettings {
            opens_browser: !self.no_browser,
            hint: " (Ctrl-C ends the demo)",
            ..self.page.settings(PageContext { world, ..PageContext::default() })
        }
    }
}

/// Writes all results and prints the report.
fn write(task: &DemoTask, session: &mut SimulationSession, out: &Path) -> Result<(), CliError> {
    let map = session.mapping().and_then(|mapping| mapping.node.with(|node| node.map()));
    let truth = map.and_then(|map| session.simulation_mut().beside_truth(&map, Pose2::IDENTITY));
    let Some(mapping) = session.mapping() else { return Ok(()) };
    let report = report::of(&session.report(), mapping, truth.as_ref(), task.explorer());
    mapping.write_results()?;
    for robot in session.estimators() {
        robot.costmaps.write_images()?;
    }
    task.write_images(out)?;
    let text = format!("{report:#}\n");
    paths::write(&out.join("report.json"), text.as_bytes())?;
    print_report(session, mapping, truth.as_ref(), out)
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
