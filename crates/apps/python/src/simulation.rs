//! Simulations in Python.

mod models;
mod readings;
mod running;
mod show;
mod topics;
mod watch;
mod world;

use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use periplus::graph::{GraphError, NodeSettings};
use periplus::os::Stopwatch;
use periplus::sim::{Diverged, Options, PhysicsMode, Quirks, RealTimePacer};
use periplus_session::terminal::processors;
use periplus_session::{
    GazeboReach, GazeboSettings, RecordingRequest, Ros2Reach, SessionBuilder, SessionSnapshot,
};
use pyo3::exceptions::{PyFileExistsError, PyValueError};
use pyo3::prelude::*;

pub(crate) use self::running::Running;
use self::running::{Goal, SLICE, SliceEnd, Transforms};
use self::topics::Callbacks;
use self::world::PyWorld;
use crate::errors::{require_no_errors, runtime_error};
use crate::work::{is_in_plugin, lock, released, with_locked};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyWorld>()?;
    module.add_class::<PySimulation>()?;
    module.add_class::<PySnapshot>()?;
    module.add_class::<models::PyModel>()?;
    module.add_class::<models::PyContact>()?;
    module.add_class::<topics::PySubscription>()?;
    readings::register(module)
}

/// A running simulation of a world.
///
/// Parameters
/// ----------
/// world : World
///     The world with its robots; its files are read again.
/// seed : int
///     Seed of all noise. The same files, seed and calls give the same numbers, to the bit.
/// physics : {"rigid", "kinematic"}
///     Bodies with contacts and friction, or motion exactly as commanded on a flat floor.
/// step_s : float, optional
///     Step [s]; default: that of the world.
/// threads : int, optional
///     Threads for rays; results do not depend on it. Default: one for each processor.
/// ros2 : {"off", "loopback", "network"}
///     Visibility on ROS 2: topics, services and nodes.
/// gazebo : {"off", "loopback", "network"}
///     Visibility on Gazebo Transport.
/// record : path, optional
///     Records all topics from the start; see ``record``.
/// rolling_scans : bool
///     Measures the beams of a lidar one after the other while the robot moves.
///
/// Raises ``FileError`` with line and column if a file of the world cannot be used.
///
/// >>> from periplus import Simulation, World
/// >>> sim = Simulation(World.demo(), seed=1)
/// >>> sim.run(0.5)
/// >>> sim.time_s
/// 0.5
#[pyclass(name = "Simulation", module = "periplus", frozen)]
pub(crate) struct PySimulation {
    running: Mutex<Running>,
    callbacks: Callbacks,
    /// True after `paused` was set from Python.
    is_paused_here: AtomicBool,
}

#[pymethods]
impl PySimulation {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    #[pyo3(signature = (world, *, seed=0, physics="rigid", step_s=None, threads=None, ros2="off", gazebo="off", record=None, rolling_scans=false))]
    fn new(
        py: Python<'_>,
        world: &PyWorld,
        seed: u64,
        physics: &str,
        step_s: Option<f64>,
        threads: Option<usize>,
        ros2: &str,
        gazebo: &str,
        record: Option<PathBuf>,
        rolling_scans: bool,
    ) -> PyResult<Self> {
        let options = Options {
            seed,
            mode: choice(
                "physics",
                physics,
                &[("rigid", PhysicsMode::Rigid), ("kinematic", PhysicsMode::Kinematic)],
            )?,
            step_s: step_s.map(valid_step).transpose()?,
            threads: threads.unwrap_or_else(processors).max(1),
            quirks: Quirks::default(),
            rolling_scans,
            ..Options::default()
        };
        let ros2 = choice(
            "ros2",
            ros2,
            &[
                ("off", Ros2Reach::Off),
                ("loopback", Ros2Reach::Loopback),
                ("network", Ros2Reach::Network),
            ],
        )?;
        let gazebo = choice(
            "gazebo",
            gazebo,
            &[
                ("off", None),
                ("loopback", Some(GazeboReach::Machine)),
                ("network", Some(GazeboReach::Network)),
            ],
        )?;
        let gazebo = gazebo.map(|reach| GazeboSettings { reach, dialect: Default::default() });
        let files = world.files();
        let search = files.search().clone();
        let composition = released(py, "reading the world", || files.compose())?;
        for loaded in &composition.files {
            require_no_errors(py, &loaded.diagnostics, &loaded.sources)?;
        }
        let builder = SessionBuilder::new(composition, options, Stopwatch::start())
            .quiet(true)
            .search(search.clone())
            .recording(record.map(recording).transpose()?)
            .ros2(Some(ros2))
            .gazebo(gazebo);
        let built = released(py, "starting the simulation", || {
            let session = builder.build().map_err(|error| error.to_string())?;
            let told = |error: GraphError| error.to_string();
            let node = session.graph().node(NodeSettings::new("python").keep_names());
            let node = node.map_err(told)?;
            let transforms = Transforms::new(&node).map_err(told)?;
            Ok((session, node, transforms))
        })?;
        let (session, node, transforms) = built.map_err(|error: String| runtime_error(error))?;
        Ok(Self {
            running: Mutex::new(Running {
                session,
                node,
                search,
                subscriptions: Vec::new(),
                services: Vec::new(),
                due: std::collections::VecDeque::new(),
                transforms,
                pacer: None,
            }),
            callbacks: Callbacks::default(),
            is_paused_here: AtomicBool::new(false),
        })
    }

    /// Simulated time [s].
    #[getter]
    fn time_s(&self, py: Python<'_>) -> PyResult<f64> {
        Ok(self.time_ns(py)? as f64 * 1e-9)
    }

    /// Simulated time [ns].
    #[getter]
    fn time_ns(&self, py: Python<'_>) -> PyResult<i64> {
        self.with(py, |running| running.simulation().time_ns())
    }

    /// Step [s].
    #[getter]
    fn step_s(&self, py: Python<'_>) -> PyResult<f64> {
        self.with(py, |running| running.simulation().step_ns() as f64 * 1e-9)
    }

    /// True while the world is paused: ``run`` waits, ``step`` steps nevertheless.
    #[getter]
    fn paused(&self, py: Python<'_>) -> PyResult<bool> {
        self.with(py, |running| running.session.is_paused())
    }

    #[setter]
    fn set_paused(&self, py: Python<'_>, paused: bool) -> PyResult<()> {
        self.is_paused_here.store(paused, Ordering::Relaxed);
        self.with(py, |running| running.session.set_paused(paused))
    }

    /// Take ``n`` steps. Callbacks of subscriptions and services run after the step in which their messages arrive.
    ///
    /// Raises what a callback raises, ``KeyboardInterrupt`` after Ctrl-C, and ``RuntimeError`` if the motion
    /// diverges; the simulation can go on afterwards in the first two cases.
    #[pyo3(signature = (n=1))]
    fn step(&self, py: Python<'_>, n: u64) -> PyResult<()> {
        self.advance(py, Goal::Steps(n))
    }

    /// Run for a simulated time [s], as fast as possible, or at a factor of real time.
    ///
    /// Raises as ``step`` does; ``ValueError`` for a negative or infinite time; ``RuntimeError`` if the world was
    /// paused by ``paused = True``. A world that is paused on the page or by a service waits until it continues.
    #[pyo3(signature = (seconds, *, real_time_factor=None))]
    fn run(&self, py: Python<'_>, seconds: f64, real_time_factor: Option<f64>) -> PyResult<()> {
        if !(0.0..=MAX_RUN_S).contains(&seconds) {
            return Err(PyValueError::new_err(format!(
                "`seconds` must be from 0 to {MAX_RUN_S:e}, not {seconds}"
            )));
        }
        if real_time_factor.is_some_and(|factor| !(factor > 0.0 && factor.is_finite())) {
            return Err(PyValueError::new_err("`real_time_factor` must be positive and finite"));
        }
        if self.is_paused_here.load(Ordering::Relaxed) && self.paused(py)? {
            return Err(runtime_error("the world is paused: set `paused = False`, or call `step`"));
        }
        let end_ns = self.with(py, |running| {
            let now_ns = running.simulation().time_ns();
            running.pacer = real_time_factor.map(|it| RealTimePacer::new(Some(it), now_ns));
            now_ns + (seconds * 1e9).round() as i64
        })?;
        let outcome = self.advance(py, Goal::Time(end_ns));
        self.with(py, |running| running.pacer = None)?;
        outcome
    }

    /// Reset time to zero and all models to their initial poses, at rest, with another seed if given. The same
    /// steps then give the same numbers as in a new simulation. Models that were inserted stay.
    #[pyo3(signature = (seed=None))]
    fn reset(&self, py: Python<'_>, seed: Option<u64>) -> PyResult<()> {
        self.with(py, |running| {
            let simulation = running.session.simulation_mut();
            if let Some(seed) = seed {
                simulation.set_seed(seed);
            }
            simulation.reset();
            running.forget();
        })
    }

    /// Save the state: bodies, joints, contacts, sensors and drives with the commands that wait, models, lights, forces,
    /// seed and time. Subscriptions, services of Python, recordings and networks are not part of it.
    ///
    /// >>> from periplus import Simulation, World
    /// >>> sim = Simulation(World.demo())
    /// >>> sim.run(0.1)
    /// >>> start = sim.snapshot()
    /// >>> sim.run(1.0)
    /// >>> sim.restore(start)
    /// >>> sim.time_s
    /// 0.1
    fn snapshot(slf: Bound<'_, Self>) -> PyResult<PySnapshot> {
        let py = slf.py();
        let state = slf.get().with(py, |running| running.session.snapshot())?;
        Ok(PySnapshot { time_s: state.time_ns() as f64 * 1e-9, state: Mutex::new(state) })
    }

    /// Return to a snapshot of this simulation, any number of times. The same calls then give the same messages, to
    /// the byte, as they did after the snapshot. Models that were inserted since are removed, removed ones return.
    ///
    /// Raises ``ValueError`` for a snapshot of another simulation.
    fn restore(&self, py: Python<'_>, snapshot: &Bound<'_, PySnapshot>) -> PyResult<()> {
        let state = &snapshot.get().state;
        let restored = self.with(py, |running| {
            let restored = running.session.restore(&lock(state));
            running.forget();
            restored.map_err(|error| error.to_string())
        })?;
        restored.map_err(PyValueError::new_err)
    }

    /// Record published messages from now on to a bag: a file ``.mcap``, or a folder in the format of ``ros2 bag``.
    /// A recording that runs is closed first.
    ///
    /// Raises ``FileExistsError`` for a folder that exists, ``RuntimeError`` if the file cannot be created.
    #[pyo3(signature = (path, *, topics=None))]
    fn record(&self, py: Python<'_>, path: PathBuf, topics: Option<Vec<String>>) -> PyResult<()> {
        let mut request = recording(path)?;
        if let Some(topics) = topics {
            request.wanted = Box::new(move |topic| topics.iter().any(|wanted| wanted == topic));
        }
        let started = self.with(py, |running| {
            running.session.start_recording(request).map_err(|error| error.to_string())
        })?;
        started.map_err(runtime_error)
    }

    /// Close the recording. Returns its path, None if none runs. Raises ``RuntimeError`` if it is incomplete.
    fn stop_recording(&self, py: Python<'_>) -> PyResult<Option<PathBuf>> {
        let closed = self.with(py, |running| {
            running.session.stop_recording().map_err(|error| error.to_string())
        })?;
        Ok(closed
            .map_err(|error| runtime_error(format!("the bag is incomplete: {error}")))?
            .map(|summary| summary.path))
    }

    /// Warnings since the last call: incompatible QoS, models that diverged, and the like.
    fn take_findings(&self, py: Python<'_>) -> PyResult<Vec<String>> {
        self.with(py, |running| {
            let findings = running.session.simulation_mut().take_findings();
            findings.iter().map(|finding| finding.message.clone()).collect()
        })
    }

    fn __enter__(slf: Bound<'_, Self>) -> Bound<'_, Self> {
        slf
    }

    /// Close the recording and the page.
    #[pyo3(signature = (*_error))]
    fn __exit__(&self, py: Python<'_>, _error: &Bound<'_, pyo3::types::PyTuple>) -> PyResult<()> {
        self.stop_recording(py)?;
        self.with(py, |running| running.session.close_page())
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |running| {
            let names: Vec<&str> = running.simulation().models().collect();
            let time_s = running.simulation().time_ns() as f64 * 1e-9;
            format!("<periplus.Simulation at {time_s} s: {}>", names.join(", "))
        })
    }
}

/// State of a simulation, to which ``Simulation.restore`` returns.
///
/// >>> from periplus import Simulation, World
/// >>> Simulation(World()).snapshot().time_s
/// 0.0
#[pyclass(name = "Snapshot", module = "periplus", frozen)]
pub(crate) struct PySnapshot {
    state: Mutex<SessionSnapshot>,
    #[pyo3(get)]
    /// Simulated time [s].
    time_s: f64,
}

#[pymethods]
impl PySnapshot {
    fn __repr__(&self) -> String {
        format!("<periplus.Snapshot at {} s>", self.time_s)
    }
}

/// Longest run \[s\].
const MAX_RUN_S: f64 = 1e9;

impl PySimulation {
    /// Works with the simulation, without the interpreter. A plugin, which the simulation calls, cannot do so.
    pub(crate) fn with<T: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut Running) -> T + Send,
    ) -> PyResult<T> {
        if is_in_plugin() {
            return Err(runtime_error(
                "a plugin of navigation cannot use the simulation while it is called: its \
                 arguments are what it knows",
            ));
        }
        with_locked(py, "the simulation", &self.running, work)
    }

    /// Steps until a task ends the run.
    pub(crate) fn advance_task(
        &self,
        py: Python<'_>,
        task: &mut (dyn DriveTask + Send),
    ) -> PyResult<()> {
        loop {
            self.callbacks.run_due(py, self)?;
            let is_over = self.with(py, |running| -> Result<bool, Diverged> {
                let stopwatch = Stopwatch::start();
                while stopwatch.elapsed() < SLICE {
                    if task.before_step(running) {
                        return Ok(true);
                    }
                    if running.slice(&mut Goal::Steps(1))? == SliceEnd::Pause {
                        break;
                    }
                }
                Ok(false)
            })?;
            let is_over = is_over.map_err(runtime_error)?;
            py.check_signals()?;
            self.callbacks.run_due(py, self)?;
            if is_over {
                return Ok(());
            }
        }
    }

    fn advance(&self, py: Python<'_>, mut goal: Goal) -> PyResult<()> {
        loop {
            self.callbacks.run_due(py, self)?;
            let end = self.with(py, |running| running.slice(&mut goal))?;
            let end = end.map_err(runtime_error)?;
            py.check_signals()?;
            self.callbacks.run_due(py, self)?;
            if end == SliceEnd::Done {
                return Ok(());
            }
        }
    }
}

/// Work before each step of a run.
pub(crate) trait DriveTask {
    /// Returns true to end the run.
    fn before_step(&mut self, running: &mut Running) -> bool;
}

fn recording(path: PathBuf) -> PyResult<RecordingRequest> {
    let is_file = path.extension().is_some_and(|extension| extension == "mcap");
    if !is_file && path.exists() {
        return Err(PyFileExistsError::new_err(format!("{}: the folder exists", path.display())));
    }
    Ok(RecordingRequest::new(path, |_| true))
}

fn valid_step(step_s: f64) -> PyResult<f64> {
    let [shortest_s, longest_s] = periplus::sim::STEP_RANGE_S;
    if (shortest_s..=longest_s).contains(&step_s) {
        return Ok(step_s);
    }
    Err(PyValueError::new_err(format!(
        "`step_s` must be from {shortest_s} to {longest_s}, not {step_s}"
    )))
}

/// One of several words.
fn choice<T: Clone>(name: &str, word: &str, choices: &[(&str, T)]) -> PyResult<T> {
    let found = choices.iter().find(|(known, _)| *known == word);
    found.map(|(_, value)| value.clone()).ok_or_else(|| {
        let words: Vec<String> = choices.iter().map(|(known, _)| format!("{known:?}")).collect();
        PyValueError::new_err(format!("`{name}` must be {}, not {word:?}", words.join(" or ")))
    })
}
