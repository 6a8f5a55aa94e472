//! Execution of launch plans.

mod world;

use std::io::{self, Write as _};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::Args;
use periplus_diagnostics::SourceMap;
use periplus_graph::{Arguments, Graph, Level};
use periplus_launch::bringup::{LaunchRunner, PartOutcomeKind, Settings};
use periplus_launch::{Dialect, Plan};
use periplus_os::{Stopwatch, sleep};
use periplus_sim::{
    AssetFiles, Composition, Driver, Options, Run, Services, Simulation, SimulationRecorder, Tick,
};
use serde_json::json;

use crate::demo::browser;
use crate::error::CliError;
use crate::live::Live;
use crate::options::SearchOptions;
use crate::page::{About, PORT, Page, PageOptions};
use crate::sim::progress;
use crate::sim::ros2::{Reach, Ros2};
use crate::sim::{Factor, RecordingWatch, Report, factor, positive, tell_findings};
use crate::stop;
use crate::terminal;

/// Polling period without a simulated world.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Timeout of discovery.
const DISCOVERY: Duration = Duration::from_millis(1500);

/// Period of sending remote topics to the page.
const REMOTE_UPDATE_PERIOD: Duration = Duration::from_millis(200);

/// Timeout for delivering the last messages at the end.
const FLUSH_TIMEOUT: Duration = Duration::from_millis(500);

/// Options of running a plan.
#[derive(Debug, Args)]
pub(crate) struct PlayOptions {
    /// Duration of the run [s]; simulated seconds if there is a world [default: until Ctrl-C]
    #[arg(long, value_name = "SECONDS", value_parser = positive)]
    duration: Option<f64>,
    /// Record published topics to a bag: FILE.mcap, or a folder in the format of `ros2 bag`
    #[arg(long, visible_alias = "out", value_name = "FILE.mcap|FOLDER")]
    record: Option<PathBuf>,
    /// Record only topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    topics: Option<regex::Regex>,
    /// Do not record topics that match this regular expression
    #[arg(long, value_name = "REGEX")]
    exclude: Option<regex::Regex>,
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
    page: PageOptions,
    /// Show no page when the launch file starts RViz or a window of Gazebo
    #[arg(long)]
    headless: bool,
    /// Serve the page, but do not open a browser
    #[arg(long)]
    no_browser: bool,
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
    pub(super) plan: Plan,
    pub(super) dialect: Dialect,
    /// `--ros-args` for all nodes.
    pub(super) arguments: Arguments,
    /// Folder of built-in programs that its processes find at the end of the PATH.
    pub(super) tools: Option<PathBuf>,
    pub(super) start: Stopwatch,
}

/// Runs the plan.
pub(super) fn play(
    launched: Launched,
    options: &PlayOptions,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    let is_free = options.duration.is_some() && options.rtf.is_none();
    let settings = Settings {
        search: terminal::search(&search.resource_path),
        dialect: launched.dialect,
        is_wired: false,
        is_paced: !is_free && !matches!(options.rtf, Some(Factor::Max)),
        guarding_program: std::env::current_exe().ok(),
        tools: launched.tools.clone(),
    };
    let bringup = LaunchRunner::new(&launched.plan, settings);
    let is_alone = match options.ros2 {
        Some(reach) => reach == Reach::Off,
        None => is_free,
    };
    // Without a network, an empty world provides the time.
    if bringup.world().is_some() || is_alone {
        in_world(launched, bringup, options, search)
    } else {
        among_others(launched, bringup, options, search)
    }
}

/// Runs with a world that is simulated here.
fn in_world(
    launched: Launched,
    mut bringup: LaunchRunner,
    options: &PlayOptions,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    let stop = stop::on_signal();
    let mut teller = LogPrinter::new(options);
    prepare(&mut bringup, &mut teller, &stop);
    let wish = bringup.world().cloned().unwrap_or_default();
    let composed = world::compose(&wish, bringup.search());
    let mut composition = match composed {
        Ok(composition) => composition,
        Err(why) => {
            bringup.end_all(&Graph::new(), 0);
            teller.tell(&mut bringup, &|write| drop(write()));
            return Err(CliError::failed(why));
        }
    };
    let to_simulation = Options {
        seed: options.seed.or(wish.seed).unwrap_or_default(),
        threads: options.threads.unwrap_or_else(terminal::processors),
        arguments: launched.arguments,
        publishes_joint_states: !bringup.publishes_joint_states(),
        ..Options::default()
    };
    let mut simulation =
        Simulation::new(&mut composition, Arc::new(AssetFiles::default()), to_simulation);
    let whole = tell_findings(&composition, options.quiet)?;
    if let Some(missing) = composition.missing() {
        return Err(CliError::failed(format!("{} has nothing to simulate", missing.display())));
    }
    let recorder = match options.record.as_deref() {
        None => None,
        Some(path) => match SimulationRecorder::start(&simulation, path, options.wanted()) {
            Ok(recorder) => Some(recorder),
            Err(error) => {
                return Err(CliError::failed(format!(
                    "cannot record to {}: {error}",
                    path.display()
                )));
            }
        },
    };
    let mut services = Services::new(&simulation, bringup.search().clone()).map_err(|error| {
        CliError::failed(format!("cannot offer the services of the world: {error}"))
    })?;
    let factor = options.factor(&composition);
    let mut ros2 = Ros2::join(&simulation, options.ros2, factor.is_some(), options.quiet)?;
    bringup.set_wired(ros2.is_joined());
    let wants_page = options.wants_page(&bringup, factor.is_some());
    if wants_page {
        let around = composition.files.iter().filter_map(|file| file.path.parent());
        if let Err(error) = services.show(&simulation, around.map(Into::into).collect()) {
            return Err(CliError::failed(format!("the world cannot be shown: {error}")));
        }
    }
    let about = About {
        world: Some(composition.world.name.clone()),
        files: composition.files.iter().map(|file| file.path.clone()).collect(),
        resource_path: search.resource_path.clone(),
        view: bringup.views().into_iter().next(),
        fixed_frame: bringup.fixed_frame(),
    };
    let page = match wants_page.then(|| options.open(simulation.graph(), about, &bringup)) {
        None => None,
        Some(Ok(page)) => page,
        Some(Err(why)) => {
            return Err(CliError::failed(why));
        }
    };
    let is_heard = page.is_some() || ros2.is_joined();
    if wish.is_paused && !options.quiet {
        terminal::say(if is_heard {
            "the world is paused, as requested by the launch file: press play on the page, or call its service"
        } else {
            "the launch file starts the world paused; it runs, because no page and no network could resume it"
        });
    }
    let run = Run {
        end_ns: options.duration.map(|seconds| (seconds * 1e9).round() as i64),
        factor,
        stop: &stop,
        paused: wish.is_paused && is_heard,
    };
    let start_up = launched.start.elapsed();
    let mut line = progress::ProgressLine::new(options.duration, options.quiet || options.json);
    let stopwatch = Stopwatch::start();
    let mut driver = Driver::default();
    let mut watch = RecordingWatch::default();
    let line_cell = std::cell::RefCell::new(&mut line);
    let ros2_cell = std::cell::RefCell::new(&mut ros2);
    let outcome = run.go_with(
        &mut simulation,
        &mut services,
        &mut driver,
        &mut |simulation| {
            let (graph, now_ns) = (simulation.graph().clone(), simulation.time_ns());
            bringup.work(&graph, now_ns, Some(simulation));
            teller.tell(&mut bringup, &|write| line_cell.borrow().aside(write));
            if bringup.is_over() { Tick::End } else { Tick::Go }
        },
        &mut |progress| {
            line_cell.borrow_mut().show(progress);
            watch.look(recorder.as_ref(), progress, &|write| line_cell.borrow().aside(write));
            let mut ros2 = ros2_cell.borrow_mut();
            if ros2.is_due(progress.wall) {
                line_cell.borrow().aside(|| ros2.tell());
                if let (Some(page), Some(remote)) = (&page, ros2.remote()) {
                    page.set_remote(&remote);
                }
            }
        },
    );
    let wall = stopwatch.elapsed();
    drop(page);
    line.clear();
    bringup.end_all(simulation.graph(), simulation.time_ns());
    teller.tell(&mut bringup, &|write| drop(write()));
    ros2.tell()?;
    if !options.quiet {
        let mut err = anstream::stderr().lock();
        for findings in [simulation.take_findings(), services.take_findings()] {
            terminal::diagnostics(&mut err, &findings, &SourceMap::new())?;
        }
    }
    // Messages that nodes publish at shutdown belong into the bag.
    let lines = bringup.lines().to_vec();
    drop(bringup);
    let finished = recorder.map(|recorder| recorder.finish(&mut simulation)).transpose();
    let is_recorded = finished.is_ok();
    let recording = finished.unwrap_or_else(|error| {
        terminal::complain(&format!("the bag is incomplete: {error}"));
        None
    });
    let report = Report { simulation: &simulation, start_up, wall, recording: recording.as_ref() };
    if options.json {
        let mut json = report.to_json();
        json["launch"] = json!(lines);
        writeln!(io::stdout().lock(), "{json:#}")?;
    } else if !options.quiet {
        report.tell(&mut anstream::stderr().lock())?;
    }
    let cut_short = stop.load(Ordering::Relaxed) && options.duration.is_some();
    // Findings name each of them.
    if let Some(diverged) = simulation.diverged().first().filter(|_| outcome.is_ok()) {
        return Err(CliError::failed(format!("{diverged}; its model was removed")));
    }
    match outcome {
        Ok(()) if !is_recorded => Ok(ExitCode::FAILURE),
        Ok(()) if cut_short => Ok(ExitCode::from(terminal::INTERRUPTED)),
        Ok(()) if whole && !teller.has_failed => Ok(ExitCode::SUCCESS),
        Ok(()) => Err(CliError::failed("parts of the launch have errors and were not started")),
        Err(diverged) => Err(CliError::failed(diverged)),
    }
}

/// Runs the programs that must end before the world is loaded.
fn prepare(bringup: &mut LaunchRunner, teller: &mut LogPrinter, stop: &AtomicBool) {
    let graph = Graph::new();
    let since = Stopwatch::start();
    while !stop.load(Ordering::Relaxed) {
        let wall_ns = i64::try_from(since.elapsed().as_nanos()).unwrap_or(i64::MAX);
        let is_ready = bringup.prepare(&graph, wall_ns);
        teller.tell(bringup, &|write| drop(write()));
        if is_ready {
            break;
        }
        sleep(POLL_PERIOD);
    }
}

/// Runs without a world, on the ROS 2 network.
fn among_others(
    launched: Launched,
    mut bringup: LaunchRunner,
    options: &PlayOptions,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    if options.record.is_some() {
        return Err(CliError::usage(
            "this launch simulates no world; record it with `periplus bag record`",
        ));
    }
    let stop = stop::on_signal();
    let mut live = Live::open(launched.arguments).map_err(CliError::failed)?;
    bringup.set_wired(true);
    if !options.quiet {
        terminal::say(&format!("ROS 2: domain {}", live.domain_id));
    }
    let node = live.graph.node(periplus_graph::NodeSettings::new("periplus_launch").bare());
    // In ROS 1 all nodes use `/clock` once `/use_sim_time` is set; there is no master here that
    // stores it, so a publisher of `/clock` is searched for.
    let is_told = launched.dialect == Dialect::Ros1 && tells_time(&live);
    if (bringup.follows_clock() || is_told)
        && let Ok(node) = &node
    {
        match live.follow_clock(node) {
            Ok(()) if !options.quiet => terminal::say("using the time of /clock"),
            Ok(()) => {}
            Err(error) => {
                return Err(CliError::failed(error));
            }
        }
    }
    let page = match options.wants_page(&bringup, true).then(|| {
        let about = About {
            resource_path: search.resource_path.clone(),
            view: bringup.views().into_iter().next(),
            fixed_frame: bringup.fixed_frame(),
            ..About::default()
        };
        options.open(&live.graph, about, &bringup)
    }) {
        None => None,
        Some(Ok(page)) => page,
        Some(Err(why)) => {
            return Err(CliError::failed(why));
        }
    };
    let mut teller = LogPrinter::new(options);
    let mut looked = Stopwatch::start();
    let since = Stopwatch::start();
    let is_time = |since: &Stopwatch| {
        options.duration.is_some_and(|seconds| since.elapsed().as_secs_f64() >= seconds)
    };
    while !stop.load(Ordering::Relaxed) && !bringup.is_over() && !is_time(&since) {
        live.spin_once();
        let graph = live.graph.clone();
        // Timers of launch files use wall time, whatever clock the nodes use.
        let now_ns = i64::try_from(since.elapsed().as_nanos()).unwrap_or(i64::MAX);
        bringup.work(&graph, now_ns, None);
        teller.tell(&mut bringup, &|write| drop(write()));
        if bringup.is_idle() {
            terminal::say("all nodes and programs of the launch have ended");
            break;
        }
        live.tell();
        if let Some(page) = page.as_ref().filter(|_| looked.elapsed() >= REMOTE_UPDATE_PERIOD) {
            looked = Stopwatch::start();
            page.set_remote(&live.wire.remote());
        }
        sleep(POLL_PERIOD);
    }
    drop(page);
    bringup.end_all(&live.graph, i64::MAX);
    teller.tell(&mut bringup, &|write| drop(write()));
    if options.json {
        let json = json!({ "launch": bringup.lines() });
        writeln!(io::stdout().lock(), "{json:#}")?;
    }
    drop(bringup);
    live.end(FLUSH_TIMEOUT);
    if teller.has_failed {
        return Err(CliError::failed("parts of the launch have errors and were not started"));
    }
    Ok(ExitCode::SUCCESS)
}

/// Returns true if `/clock` has a publisher on the network, after some time for discovery.
fn tells_time(live: &Live) -> bool {
    let since = Stopwatch::start();
    while since.elapsed() < DISCOVERY {
        let remote = live.wire.remote();
        if remote.topic("/clock").is_some_and(|topic| !topic.publishers.is_empty()) {
            return true;
        }
        sleep(POLL_PERIOD);
    }
    false
}

/// Prints the log of a launch.
struct LogPrinter {
    told: usize,
    is_quiet: bool,
    has_failed: bool,
}

/// Writes to a terminal that also shows a progress bar.
type Aside<'a> = dyn Fn(&mut dyn FnMut() -> io::Result<()>) + 'a;

impl LogPrinter {
    fn new(options: &PlayOptions) -> Self {
        Self { told: 0, is_quiet: options.quiet, has_failed: false }
    }

    fn tell(&mut self, bringup: &mut LaunchRunner, aside: &Aside<'_>) {
        let said = bringup.take_log();
        let lines = &bringup.lines()[self.told..];
        if said.is_empty() && lines.is_empty() {
            return;
        }
        self.told = bringup.lines().len();
        self.has_failed |= said.iter().any(|one| one.level >= Level::Error);
        let is_quiet = self.is_quiet;
        aside(&mut || {
            let mut err = anstream::stderr().lock();
            for line in lines.iter().filter(|_| !is_quiet) {
                let sign = match line.outcome.kind {
                    PartOutcomeKind::World
                    | PartOutcomeKind::BuiltIn
                    | PartOutcomeKind::Program => "+",
                    PartOutcomeKind::Needless => "=",
                    PartOutcomeKind::Missing => "-",
                };
                let node = line.outcome.node.as_deref();
                let node = node.map(|node| format!("{node}: ")).unwrap_or_default();
                writeln!(err, "{sign} {}: {node}{}", short(&line.asked), line.outcome.told)?;
            }
            for one in said.iter().filter(|one| !is_quiet || one.level >= Level::Error) {
                match one.level {
                    level if level >= Level::Error => writeln!(err, "error: {}", one.text)?,
                    Level::Warn => writeln!(err, "warning: {}", one.text)?,
                    _ => writeln!(err, "{}", one.text)?,
                }
            }
            Ok(())
        });
    }
}

/// Truncates a long text.
fn short(text: &str) -> String {
    const MAX_CHARS: usize = 80;
    if text.chars().count() <= MAX_CHARS {
        return text.to_owned();
    }
    text.chars().take(MAX_CHARS).chain("...".chars()).collect()
}

impl PlayOptions {
    fn factor(&self, composition: &Composition) -> Option<f64> {
        match (self.rtf, self.duration) {
            (Some(Factor::Of(factor)), _) => Some(factor),
            (Some(Factor::Max), _) | (None, Some(_)) => None,
            (None, None) => composition.real_time_factor(),
        }
    }

    fn wanted(&self) -> periplus_sim::TopicFilter {
        let (topics, exclude) = (self.topics.clone(), self.exclude.clone());
        Box::new(move |name| {
            topics.as_ref().is_none_or(|topics| topics.is_match(name))
                && !exclude.as_ref().is_some_and(|exclude| exclude.is_match(name))
        })
    }

    /// Returns true if a page is requested, or replaces a window of the launch file.
    fn wants_page(&self, bringup: &LaunchRunner, is_paced: bool) -> bool {
        self.page.page.is_some() || (!self.headless && is_paced && bringup.wants_page())
    }

    /// Opens the page, and a browser if the launch file opens a window. A page that was not
    /// requested is optional: a failure is a warning.
    fn open(
        &self,
        graph: &periplus_graph::Graph,
        about: About,
        bringup: &LaunchRunner,
    ) -> Result<Option<Page>, String> {
        let is_asked = self.page.page.is_some();
        let usual = SocketAddr::from(([127, 0, 0, 1], PORT));
        let address = self.page.page.unwrap_or(usual);
        let page = match Page::open(graph, address, self.page.token.clone(), about) {
            Ok(page) => page,
            Err(why) if is_asked => return Err(why),
            Err(why) => {
                terminal::say(&format!("warning: {why}; running without"));
                return Ok(None);
            }
        };
        let url = page.url();
        if !self.quiet {
            terminal::say(&format!("page: {url}"));
            if let Some(view) = bringup.views().first() {
                terminal::say(&format!("it shows {}", view.display()));
            }
        }
        let opens = !self.headless && !self.no_browser && bringup.wants_page();
        if opens && !browser::open(&url) && !self.quiet {
            terminal::say("no browser could be started; open the page yourself");
        }
        Ok(Some(page))
    }
}
