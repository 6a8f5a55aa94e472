//! Launch with a world that is simulated here.

use std::io::{self, Write as _};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_diagnostics::plain_words;
use periplus_graph::{Arguments, Graph};
use periplus_launch::bringup::{LaunchRunner, WorldRequest};
use periplus_os::{Stopwatch, sleep};
use periplus_session::{
    PageContext, ProgressLine, Ros1Reach, RunEnd, RunSettings, SessionBuilder, SessionTask,
    SimulationSession, stop,
};
use periplus_sim::{Options, Simulation, Tick};
use serde_json::json;

use super::lockstep::RunLockstep;
use super::log::LogPrinter;
use super::watch::ProcessWatch;
use super::{Launched, PlayOptions, parameter_server, world};
use crate::error::CliError;
use crate::options::SearchOptions;
use crate::run_options::{Factor, exit_code};
use crate::terminal;

/// Polling period of programs that must end before the world is loaded.
const POLL_PERIOD: Duration = Duration::from_millis(5);

/// Runs the plan between the steps of the simulation.
struct LaunchTask {
    bringup: LaunchRunner,
    log: LogPrinter,
}

impl SessionTask for LaunchTask {
    fn before_step(&mut self, simulation: &mut Simulation, line: &ProgressLine) -> Tick {
        let (graph, now_ns) = (simulation.graph().clone(), simulation.time_ns());
        self.bringup.work(&graph, now_ns, Some(simulation));
        self.log.print(&mut self.bringup, Some(line));
        if self.bringup.is_over() { Tick::End } else { Tick::Go }
    }
}

pub(super) fn run(
    launched: Launched,
    mut bringup: LaunchRunner,
    options: &PlayOptions,
    ros1: Option<Ros1Reach>,
    search: &SearchOptions,
) -> Result<ExitCode, CliError> {
    let stop = stop::on_signal();
    let mut log = LogPrinter::new(options.quiet);
    prepare(&mut bringup, &mut log, &stop);
    let request = bringup.world().cloned().unwrap_or_default();
    let composition = world::compose(&request, bringup.search()).inspect_err(|_| {
        bringup.end_all(&Graph::new(), 0);
        log.print(&mut bringup, None);
    })?;
    let factor = Factor::of_run(options.rtf, options.duration, &composition);
    let context = || PageContext::of(&composition, &search.resource_path);
    let page = options.page(&bringup, factor.is_some(), context);
    let to_simulation = options.simulation(launched.arguments, &request, &bringup);
    let seed = to_simulation.seed;
    let mut session = SessionBuilder::new(composition, to_simulation, launched.start)
        .quiet(options.quiet)
        .progress(!options.quiet && !options.json)
        .factor(factor)
        .search(bringup.search().clone())
        .recording(options.recorded.recording(options.record.as_deref()))
        .command(Some(launched.recorded))
        .recording_truth(options.recorded.records_truth())
        .ros2(options.ros2.map(Into::into))
        .ros1(ros1)
        .ros1_parameters(parameter_server::parameters(&launched.plan))
        .page(page)
        .build()?;
    bringup.set_wired(session.is_on_ros2());
    let is_in_step = bringup.has_python_nodes() && !session.is_on_ros2() && !options.real_ros;
    let lockstep = is_in_step.then(|| RunLockstep::start(session.graph(), seed, stop.clone()));
    let lockstep = lockstep.transpose().map(|lockstep| lockstep.map(Arc::new));
    let lockstep = lockstep.map_err(|error| {
        let why = plain_words(&error);
        CliError::failed(format!("the nodes in Python cannot be connected: {why}"))
    })?;
    if let Some(lockstep) = &lockstep {
        bringup.set_lockstep(lockstep.clone());
    }
    let is_paused = starts_paused(&request, &session, options.quiet);
    let settings = RunSettings { duration_s: options.duration, stop: &stop, is_paused };
    let watch = lockstep
        .as_ref()
        .map(|_| ProcessWatch::start(bringup.processes(), stop.clone(), options.quiet));
    let mut task = LaunchTask { bringup, log };
    session.run(settings, &mut task);
    drop(watch);
    let LaunchTask { mut bringup, mut log } = task;
    bringup.end_all(session.graph(), session.simulation().time_ns());
    log.print(&mut bringup, None);
    session.print_findings()?;
    if let Some(lockstep) = lockstep {
        terminal::print_findings(&lockstep.take_findings())?;
    }
    // Messages that nodes publish at shutdown belong into the bag.
    let lines = bringup.lines().to_vec();
    drop(bringup);
    session.close_recording();
    if options.json {
        let mut json = session.report().to_json();
        json["launch"] = json!(lines);
        writeln!(io::stdout().lock(), "{json:#}")?;
    } else if !options.quiet {
        session.report().write_text(&mut anstream::stderr().lock())?;
    }
    match session.end() {
        RunEnd::Complete if log.has_failed || !session.is_whole() => {
            Err(CliError::failed("parts of the launch have failed: see the errors above"))
        }
        end => exit_code(end),
    }
}

/// Runs the programs that must end before the world is loaded.
fn prepare(bringup: &mut LaunchRunner, log: &mut LogPrinter, stop: &AtomicBool) {
    let graph = Graph::new();
    let since = Stopwatch::start();
    while !stop.load(Ordering::Relaxed) {
        let wall_ns = i64::try_from(since.elapsed().as_nanos()).unwrap_or(i64::MAX);
        let is_ready = bringup.prepare(&graph, wall_ns);
        log.print(bringup, None);
        if is_ready {
            break;
        }
        sleep(POLL_PERIOD);
    }
}

/// Returns true if the launch file pauses the world, and a client can resume it.
fn starts_paused(request: &WorldRequest, session: &SimulationSession, is_quiet: bool) -> bool {
    let has_clients = session.has_page() || session.is_on_ros2();
    if request.is_paused && !is_quiet {
        terminal::say(if has_clients {
            "the world is paused, as requested by the launch file: press play on the page, or call its service"
        } else {
            "the launch file starts the world paused; it runs, because no page and no network could resume it"
        });
    }
    request.is_paused && has_clients
}

impl PlayOptions {
    fn simulation(
        &self,
        arguments: Arguments,
        request: &WorldRequest,
        bringup: &LaunchRunner,
    ) -> Options {
        Options {
            seed: self.seed.or(request.seed).unwrap_or_default(),
            threads: self.threads.unwrap_or_else(terminal::processors),
            arguments,
            publishes_joint_states: !bringup.publishes_joint_states(),
            starts_controllers: !bringup.spawns_controllers(),
            bridges_transforms: bringup.bridges_transforms(),
            ..Options::default()
        }
    }
}
