//! Running sessions.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::Graph;
use periplus_os::Stopwatch;
use periplus_sim::{
    Diverged, Driver, RecordingSummary, Run, RunProgress, Services, Simulation, SimulationRecorder,
    Tick,
};

use crate::error::RunError;
use crate::network::{GazeboConnection, Ros1Connection, Ros2Connection};
use crate::nodes::{Estimators, MappingNode, Navigation, OpenRmfFleet, RobotProfile};
use crate::page::Page;
use crate::progress::ProgressLine;
use crate::recording::RecordingWatch;
use crate::report::RunReport;
use crate::terminal;

/// Limits of a run.
#[derive(Clone, Copy, Debug)]
pub struct RunSettings<'a> {
    /// Simulated duration \[s\]; `None` runs until stopped.
    pub duration_s: Option<f64>,
    /// Flag that ends the run after the current step; can be set from any thread.
    pub stop: &'a AtomicBool,
    /// True if the run starts paused.
    pub is_paused: bool,
}

/// Work between the steps of a session.
pub trait SessionTask {
    /// Called before each step, and periodically while the world is paused. Lines beside the
    /// progress bar are written through it.
    fn before_step(&mut self, _simulation: &mut Simulation, _line: &ProgressLine) -> Tick {
        Tick::Go
    }

    /// Called after each step.
    fn after_step(&mut self, _progress: RunProgress) {}
}

/// No work between the steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoTask;

impl SessionTask for NoTask {}

/// Result of a run.
#[derive(Clone, Debug, PartialEq)]
pub enum RunEnd {
    /// The run is complete.
    Complete,
    /// A signal ended a run before its duration had passed.
    Interrupted,
    /// The run is complete, its recording is not; the reason has been printed.
    RecordingIncomplete,
    /// A model that diverged was removed.
    ModelRemoved(Diverged),
    /// The run ended at a step that diverged.
    Diverged(Diverged),
}

/// Parts of a session, from its builder.
///
/// Fields are dropped in this order: clients and networks leave the graph before the simulation
/// ends.
pub(crate) struct SessionParts {
    pub(crate) page: Option<Page>,
    pub(crate) gazebo: Option<GazeboConnection>,
    pub(crate) ros1: Option<Ros1Connection>,
    pub(crate) ros2: Ros2Connection,
    /// Nodes of each robot.
    pub(crate) estimators: Vec<Estimators>,
    /// Attachment to Open-RMF.
    pub(crate) _fleet: Option<OpenRmfFleet>,
    /// Detected topics and frames of the robots, if the estimators needed them.
    pub(crate) profiles: Vec<RobotProfile>,
    pub(crate) services: Services,
    pub(crate) recorder: Option<SimulationRecorder>,
    /// Facts of the run that its recordings contain.
    pub(crate) description: BTreeMap<String, String>,
    pub(crate) driver: Driver,
    pub(crate) simulation: Simulation,
    /// Start of the program.
    pub(crate) start: Stopwatch,
    pub(crate) factor: Option<f64>,
    pub(crate) is_quiet: bool,
    pub(crate) has_progress: bool,
    /// False if files of the world have errors.
    pub(crate) is_whole: bool,
}

/// Simulation with its recording, estimator nodes, networks and page.
pub struct SimulationSession {
    pub(crate) parts: SessionParts,
    start_up: Duration,
    wall: Duration,
    is_cut_short: bool,
    diverged: Option<Diverged>,
    is_recorded: bool,
    recording: Option<RecordingSummary>,
}

impl SimulationSession {
    pub(crate) fn new(parts: SessionParts) -> Self {
        Self {
            parts,
            start_up: Duration::ZERO,
            wall: Duration::ZERO,
            is_cut_short: false,
            diverged: None,
            is_recorded: true,
            recording: None,
        }
    }

    /// The simulation.
    #[must_use]
    pub fn simulation(&self) -> &Simulation {
        &self.parts.simulation
    }

    /// The simulation, to compare results with the truth.
    pub fn simulation_mut(&mut self) -> &mut Simulation {
        &mut self.parts.simulation
    }

    /// Graph of all nodes.
    #[must_use]
    pub fn graph(&self) -> &Graph {
        self.parts.simulation.graph()
    }

    /// Estimator nodes, those of each robot; one set if they do not belong to several robots.
    #[must_use]
    pub fn estimators(&self) -> &[Estimators] {
        &self.parts.estimators
    }

    /// Mapping node of the first robot.
    #[must_use]
    pub fn mapping(&self) -> Option<&MappingNode> {
        self.parts.estimators.first()?.mapping.as_ref()
    }

    /// Topics and frames of the first robot, if the estimators needed them.
    #[must_use]
    pub fn profile(&self) -> Option<&RobotProfile> {
        self.parts.profiles.first()
    }

    /// Topics and frames of all robots, if the estimators needed them.
    #[must_use]
    pub fn profiles(&self) -> &[RobotProfile] {
        &self.parts.profiles
    }

    /// Servers of navigation of each robot; the caller keeps them alive.
    pub fn take_navigation(&mut self) -> Vec<Navigation> {
        let robots = self.parts.estimators.iter_mut();
        robots.map(|robot| std::mem::take(&mut robot.navigation)).collect()
    }

    /// Estimator nodes of each robot; the caller keeps them alive, and the session writes no reports and maps of them.
    pub fn take_estimators(&mut self) -> Vec<Estimators> {
        std::mem::take(&mut self.parts.estimators)
    }

    /// Writes the reports of the estimator nodes.
    ///
    /// # Errors
    /// A failed write.
    pub fn write_estimator_reports(&self, out: &mut dyn Write) -> io::Result<()> {
        self.parts.estimators.iter().try_for_each(|robot| robot.write_reports(out))
    }

    /// Writes the requested maps, and prints their folders.
    ///
    /// # Errors
    /// When there is no map, or a file cannot be written.
    pub fn write_maps(&self, is_quiet: bool) -> Result<(), RunError> {
        self.parts.estimators.iter().try_for_each(|robot| robot.write_map(is_quiet))
    }

    /// Returns true if the session is on a ROS 2 network.
    #[must_use]
    pub fn is_on_ros2(&self) -> bool {
        self.parts.ros2.is_joined()
    }

    /// Returns true if the session has a page.
    #[must_use]
    pub fn has_page(&self) -> bool {
        self.parts.page.is_some()
    }

    /// Returns false if files of the world have errors, so that parts are missing.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.parts.is_whole
    }

    /// Runs, and closes the page. Call [`SimulationSession::finish`] afterwards.
    pub fn run(&mut self, settings: RunSettings<'_>, task: &mut dyn SessionTask) {
        let parts = &mut self.parts;
        let run = Run {
            end_ns: settings.duration_s.map(|seconds| (seconds * 1e9).round() as i64),
            factor: parts.factor,
            stop: settings.stop,
            paused: settings.is_paused,
        };
        self.start_up = parts.start.elapsed();
        let line = ProgressLine::new(settings.duration_s, !parts.has_progress);
        let (line, task) = (RefCell::new(line), RefCell::new(task));
        #[cfg(not(target_family = "wasm"))]
        let page = &parts.page;
        let (recorder, ros1, ros2) = (&parts.recorder, &mut parts.ros1, &mut parts.ros2);
        let mut watch = RecordingWatch::default();
        let stopwatch = Stopwatch::start();
        let outcome = run.go_with(
            &mut parts.simulation,
            &mut parts.services,
            &mut parts.driver,
            &mut |simulation| task.borrow_mut().before_step(simulation, &line.borrow()),
            &mut |progress| {
                task.borrow_mut().after_step(progress);
                let mut line = line.borrow_mut();
                line.show(progress);
                watch.check(recorder.as_ref(), progress, &line);
                let is_ros1_due = ros1.as_mut().is_some_and(|ros1| ros1.is_due(progress.wall));
                let is_ros2_due = ros2.is_due(progress.wall);
                if let Some(ros1) = ros1.as_ref().filter(|_| is_ros1_due) {
                    line.aside(|| ros1.print_findings());
                }
                if is_ros2_due {
                    line.aside(|| ros2.print_findings());
                }
                #[cfg(not(target_family = "wasm"))]
                if let Some(page) = page
                    && (is_ros1_due || is_ros2_due)
                {
                    let (remote, state) =
                        (ros2.remote(), ros1.as_ref().map(Ros1Connection::remote));
                    page.set_remote(remote.as_ref(), state.as_deref());
                }
            },
        );
        self.wall = stopwatch.elapsed();
        self.diverged = outcome.err();
        self.is_cut_short = settings.stop.load(Ordering::Relaxed) && settings.duration_s.is_some();
        parts.page = None;
        line.borrow().clear();
    }

    /// Ends a run whose nodes need no separate shutdown:
    /// [`SimulationSession::print_findings`], then [`SimulationSession::close_recording`].
    ///
    /// # Errors
    /// A failed write to stderr.
    pub fn finish(&mut self) -> Result<(), RunError> {
        self.print_findings()?;
        self.close_recording();
        Ok(())
    }

    /// Prints the findings of the run and of the networks, and leaves Gazebo Transport.
    ///
    /// # Errors
    /// A failed write to stderr.
    pub fn print_findings(&mut self) -> Result<(), RunError> {
        let parts = &mut self.parts;
        if let Some(gazebo) = parts.gazebo.take() {
            gazebo.print_findings()?;
        }
        if let Some(ros1) = parts.ros1.take() {
            ros1.print_findings()?;
        }
        parts.ros2.print_findings()?;
        if !parts.is_quiet {
            for findings in [parts.simulation.take_findings(), parts.services.take_findings()] {
                terminal::print_findings(&findings)?;
            }
        }
        Ok(())
    }

    /// Closes the recording; it contains all messages that nodes published before. An incomplete
    /// recording is printed, and [`SimulationSession::end`] returns it.
    pub fn close_recording(&mut self) {
        let parts = &mut self.parts;
        let finished = parts.recorder.take().map(|it| it.finish(&mut parts.simulation));
        match finished.transpose() {
            Ok(recording) => self.recording = recording,
            // A broken bag does not affect maps and reports.
            Err(error) => {
                self.is_recorded = false;
                terminal::complain(&format!("the bag is incomplete: {error}"));
            }
        }
    }

    /// Report of the run.
    #[must_use]
    pub fn report(&self) -> RunReport<'_> {
        RunReport {
            simulation: &self.parts.simulation,
            start_up: self.start_up,
            wall: self.wall,
            recording: self.recording.as_ref(),
        }
    }

    /// Result of the run.
    #[must_use]
    pub fn end(&self) -> RunEnd {
        match (&self.diverged, self.parts.simulation.diverged().first()) {
            (Some(diverged), _) => RunEnd::Diverged(diverged.clone()),
            (None, Some(diverged)) => RunEnd::ModelRemoved(diverged.clone()),
            _ if !self.is_recorded => RunEnd::RecordingIncomplete,
            _ if self.is_cut_short => RunEnd::Interrupted,
            _ => RunEnd::Complete,
        }
    }
}
