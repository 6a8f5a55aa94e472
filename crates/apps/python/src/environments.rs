//! Navigation environments for reinforcement learning: the native part of `periplus.gym`.

mod settings;
mod worlds;

use std::num::NonZero;
use std::sync::Mutex;

use numpy::{
    Element, PyArrayDyn, PyArrayMethods as _, PyReadwriteArrayDyn, PyUntypedArrayMethods as _,
};
use periplus::environments::{
    Agent, AgentState, BatchError, ENVIRONMENT_ROBOT, EnvironmentRobot, EnvironmentRobotParams,
    NAVIGATION_REWARD, NAVIGATION_TASK, NavigationBatch, NavigationRewardParams,
    NavigationSettings, NavigationTaskParams, ObstacleArea, REWARD_TERMS, ResetRequest,
    StepOutputs, StepResult, reward_terms,
};
use periplus::geometry::{Pose2, Twist2};
use pyo3::exceptions::{PyIndexError, PyRuntimeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};

use self::worlds::WorldSource;
use crate::arrays::{contiguous, moved};
use crate::errors::value_error;
use crate::work::{lock, with_locked};

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyNavigationBatch>()?;
    module.add_function(wrap_pyfunction!(environment_parameters, module)?)?;
    module.add_function(wrap_pyfunction!(generated_world_sdf, module)?)
}

/// Parameters of the environments: those of ``"robot"``, ``"task"``, ``"reward"`` or ``"world"``, a dictionary for
/// each.
#[pyfunction]
fn environment_parameters<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyList>> {
    settings::list(py, name)
}

/// SDF of a generated world.
#[pyfunction]
fn generated_world_sdf(py: Python<'_>, world: &Bound<'_, PyDict>) -> PyResult<String> {
    worlds::sdf_text(py, &WorldSource::of(world)?)
}

/// Navigation environments that are stepped together. Arrays have a row for each agent, environment by environment.
///
/// Parameters
/// ----------
/// worlds : list of paths and dicts
///     Files, or parameters of the generator of worlds with a ``seed``. Each episode is in one of them.
/// count : int
///     Number of environments.
/// robot, task, reward : dict, optional
///     Parameters by name; ``environment_parameters`` lists them.
/// agents : int
///     Number of robots in each environment.
/// threads : int
///     Number of threads; 0 for all cores.
/// resets_in_next_step : bool
///     Autoreset in the step after the end of an episode.
#[pyclass(name = "NavigationBatch", module = "periplus._native", frozen)]
pub(crate) struct PyNavigationBatch {
    batch: Mutex<NavigationBatch>,
}

#[pymethods]
impl PyNavigationBatch {
    #[new]
    #[pyo3(signature = (
        worlds, count=1, *, robot=None, task=None, reward=None, agents=1, threads=0, resets_in_next_step=true
    ))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        worlds: Vec<Bound<'_, PyAny>>,
        count: usize,
        robot: Option<&Bound<'_, PyDict>>,
        task: Option<&Bound<'_, PyDict>>,
        reward: Option<&Bound<'_, PyDict>>,
        agents: usize,
        threads: usize,
        resets_in_next_step: bool,
    ) -> PyResult<Self> {
        let robot = settings::read(py, &ENVIRONMENT_ROBOT, robot)?;
        let robot = EnvironmentRobot::new(EnvironmentRobotParams::from_values(&robot))
            .map_err(value_error)?;
        let task = NavigationTaskParams::from_values(&settings::read(py, &NAVIGATION_TASK, task)?);
        let reward =
            NavigationRewardParams::from_values(&settings::read(py, &NAVIGATION_REWARD, reward)?);
        let sources: Vec<WorldSource> =
            worlds.iter().map(WorldSource::of).collect::<PyResult<_>>()?;
        let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = if threads == 0 { cores } else { threads };
        let worlds = worlds::prepare(py, &sources, &robot, threads)?;
        let settings =
            NavigationSettings { worlds, robot, task, reward, agents, resets_in_next_step };
        let batch = NavigationBatch::new(settings, count, threads).map_err(value_error)?;
        Ok(Self { batch: Mutex::new(batch) })
    }

    /// Number of rows of the arrays: agents of all environments.
    #[getter]
    fn rows(&self) -> usize {
        lock(&self.batch).agents().len()
    }

    /// Number of numbers of an observation.
    #[getter]
    fn observation_size(&self) -> usize {
        lock(&self.batch).observation_size()
    }

    /// Number of numbers of an action.
    #[getter]
    fn action_size(&self) -> usize {
        lock(&self.batch).settings().robot.action_size()
    }

    /// Time between two steps [s].
    #[getter]
    fn step_period(&self) -> f64 {
        lock(&self.batch).settings().task.step_period_s
    }

    /// Parts of an observation: name, first index, minima and maxima.
    #[getter]
    fn layout<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let parts = PyList::empty(py);
        for slice in lock(&self.batch).layout() {
            let low = moved(py, slice.low.clone(), &[slice.low.len()])?;
            let high = moved(py, slice.high.clone(), &[slice.high.len()])?;
            parts.append((slice.name, slice.start, low, high))?;
        }
        Ok(parts)
    }

    /// Names of the terms of the reward.
    #[getter]
    fn reward_term_names(&self) -> Vec<&'static str> {
        REWARD_TERMS.to_vec()
    }

    /// Resets environments and writes their observations. Without seeds the next episodes follow.
    #[pyo3(signature = (observations, seeds=None, mask=None, starts=None, goals=None))]
    fn reset(
        &self,
        py: Python<'_>,
        observations: &Bound<'_, PyAny>,
        seeds: Option<Vec<u64>>,
        mask: Option<Vec<bool>>,
        starts: Option<Vec<[f64; 3]>>,
        goals: Option<Vec<[f64; 2]>>,
    ) -> PyResult<()> {
        let mut observations = writable::<f32>(observations, "observations")?;
        let observations = observations.as_slice_mut()?;
        let starts = starts.map(|starts| {
            starts.into_iter().map(|[x, y, yaw]| Pose2::new(x, y, yaw)).collect::<Vec<_>>()
        });
        with_locked(py, "resetting environments", &self.batch, |batch| {
            let request = ResetRequest {
                seeds: seeds.as_deref(),
                mask: mask.as_deref(),
                starts: starts.as_deref(),
                goals_m: goals.as_deref(),
            };
            batch.reset(request, observations)
        })?
        .map_err(batch_error)
    }

    /// Steps all environments and writes the results into the arrays.
    fn step(
        &self,
        py: Python<'_>,
        actions: &Bound<'_, PyAny>,
        observations: &Bound<'_, PyAny>,
        rewards: &Bound<'_, PyAny>,
        terminated: &Bound<'_, PyAny>,
        truncated: &Bound<'_, PyAny>,
    ) -> PyResult<()> {
        let actions = contiguous::<f32>(actions, "actions")?;
        let actions = actions.as_slice()?;
        let mut observations = writable::<f32>(observations, "observations")?;
        let mut rewards = writable::<f64>(rewards, "rewards")?;
        let mut terminated = writable::<bool>(terminated, "terminated")?;
        let mut truncated = writable::<bool>(truncated, "truncated")?;
        let outputs = StepOutputs {
            observations: observations.as_slice_mut()?,
            rewards: rewards.as_slice_mut()?,
            terminated: terminated.as_slice_mut()?,
            truncated: truncated.as_slice_mut()?,
        };
        with_locked(py, "stepping environments", &self.batch, |batch| batch.step(actions, outputs))?
            .map_err(batch_error)
    }

    /// State of all agents: arrays by name.
    fn info<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let batch = lock(&self.batch);
        let agents = batch.agents();
        let info = PyDict::new(py);
        let flags = |state: AgentState| -> Vec<bool> {
            agents.iter().map(|agent| agent.state == state).collect()
        };
        let numbers = |of: fn(&Agent) -> f64| -> Vec<f64> { agents.iter().map(of).collect() };
        let rows = [agents.len()];
        info.set_item("is_success", moved(py, flags(AgentState::Reached), &rows)?)?;
        info.set_item("is_collision", moved(py, flags(AgentState::Collided), &rows)?)?;
        for (name, of) in [
            ("goal_distance_m", (|agent| agent.goal_distance_m) as fn(&Agent) -> f64),
            ("clearance_m", |agent| agent.clearance_m),
            ("path_length_m", |agent| agent.path_length_m),
        ] {
            info.set_item(name, moved(py, numbers(of), &rows)?)?;
        }
        Ok(info)
    }

    /// State of one agent.
    fn agent_info<'py>(&self, py: Python<'py>, row: usize) -> PyResult<Bound<'py, PyDict>> {
        let batch = lock(&self.batch);
        let count = batch.agents().len();
        let Some(agent) = batch.agents().get(row) else {
            return Err(PyIndexError::new_err(format!("row {row} of {count}")));
        };
        let info = PyDict::new(py);
        info.set_item(intern!(py, "is_success"), agent.state == AgentState::Reached)?;
        info.set_item(intern!(py, "is_collision"), agent.state == AgentState::Collided)?;
        info.set_item(intern!(py, "goal_distance_m"), agent.goal_distance_m)?;
        info.set_item(intern!(py, "clearance_m"), agent.clearance_m)?;
        info.set_item(intern!(py, "path_length_m"), agent.path_length_m)?;
        Ok(info)
    }

    /// Terms of the last rewards, weighted, float64, shape (rows, terms).
    fn reward_terms<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let batch = lock(&self.batch);
        let terms = batch.agents().iter().flat_map(|agent| agent.reward_terms).collect();
        moved(py, terms, &[batch.agents().len(), REWARD_TERMS.len()])
    }

    /// Distance between the footprint at a pose and the obstacles of an environment, at most the `clearance_distance`
    /// of the reward [m]; zero in collision.
    fn clearance(&self, environment: usize, x: f64, y: f64, yaw: f64) -> PyResult<f64> {
        let batch = self.environment(environment)?;
        let max_m = batch.settings().reward.clearance_distance_m;
        Ok(batch.clearance_m(environment, Pose2::new(x, y, yaw), max_m))
    }

    /// Terms of the reward of a step that was simulated elsewhere, weighted.
    fn reward_terms_of(
        &self,
        progress: f64,
        is_success: bool,
        is_collision: bool,
        turn_rate: f64,
        clearance: f64,
    ) -> [f64; 6] {
        let batch = lock(&self.batch);
        let state = match (is_collision, is_success) {
            (true, _) => AgentState::Collided,
            (false, true) => AgentState::Reached,
            (false, false) => AgentState::Driving,
        };
        let velocity = Twist2::new(0.0, 0.0, turn_rate);
        let result = StepResult { progress_m: progress, state, velocity, clearance_m: clearance };
        reward_terms(&result, &batch.settings().robot, &batch.settings().reward)
    }

    /// Velocity that an action commands: forwards, to the left [m/s], turn rate [rad/s].
    #[expect(clippy::needless_pass_by_value, reason = "it is converted from a sequence")]
    fn commanded(&self, action: Vec<f32>) -> [f64; 3] {
        let Twist2 { vx_m_s, vy_m_s, wz_rad_s } =
            lock(&self.batch).settings().robot.commanded(&action);
        [vx_m_s, vy_m_s, wz_rad_s]
    }

    /// Distance from the goal at which it is reached [m].
    #[getter]
    fn goal_tolerance(&self) -> f64 {
        lock(&self.batch).settings().task.goal_tolerance_m
    }

    /// Poses of all agents: x [m], y [m], yaw [rad], float64, shape (rows, 3).
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let batch = lock(&self.batch);
        let pose = |agent: &Agent| [agent.pose.x_m, agent.pose.y_m, agent.pose.yaw_rad];
        let poses = batch.agents().iter().flat_map(pose).collect();
        moved(py, poses, &[batch.agents().len(), 3])
    }

    /// Goals of all agents [m], float64, shape (rows, 2).
    fn goals<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let batch = lock(&self.batch);
        let goals = batch.agents().iter().flat_map(|agent| agent.goal_m).collect();
        moved(py, goals, &[batch.agents().len(), 2])
    }

    /// Lengths of the shortest paths from start to goal [m], float64, shape (rows,); NaN without a path.
    fn shortest_paths<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let lengths = with_locked(py, "planning paths", &self.batch, |batch| {
            let rows = batch.settings().agents;
            let of = |(row, agent): (usize, &Agent)| {
                let free_space = batch.world_of(row / rows).free_space();
                let start = [agent.start.x_m, agent.start.y_m];
                free_space.path_length_m(start, agent.goal_m).unwrap_or(f64::NAN)
            };
            batch.agents().iter().enumerate().map(of).collect::<Vec<f64>>()
        })?;
        let rows = lengths.len();
        moved(py, lengths, &[rows])
    }

    /// RobotFootprint: corners in the base frame [m], or the radius of a circle [m].
    #[getter]
    fn footprint<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let batch = lock(&self.batch);
        let footprint = batch.settings().robot.footprint();
        match footprint.corners() {
            Some(corners) => Ok(moved(py, corners.concat(), &[corners.len(), 2])?.into_any()),
            None => Ok(footprint.circumscribed_radius_m().into_pyobject(py)?.into_any()),
        }
    }

    /// Name of the world of an environment's episode.
    fn world_name(&self, environment: usize) -> PyResult<String> {
        let batch = self.environment(environment)?;
        Ok(batch.world_of(environment).name().to_owned())
    }

    /// Obstacles of an environment as a picture from above, uint8, shape (height, width): 0 free, 1 obstacle; row 0 has
    /// the highest y. Also returns the lower left corner and the side of a pixel [m].
    fn picture<'py>(
        &self,
        py: Python<'py>,
        environment: usize,
        width: usize,
    ) -> PyResult<(Bound<'py, PyArrayDyn<u8>>, [f64; 2], f64)> {
        let world = std::sync::Arc::clone(self.environment(environment)?.world_of(environment));
        if !(1..=MAX_PICTURE_SIDE_PX).contains(&width) {
            return Err(PyValueError::new_err(format!(
                "`width` must be from 1 to {MAX_PICTURE_SIDE_PX} pixels, not {width}"
            )));
        }
        let [low, high] = world.free_space().bounds_m();
        #[expect(clippy::cast_precision_loss, reason = "widths are small")]
        let pixel_m = (high[0] - low[0]) / width as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited")]
        let height = (((high[1] - low[1]) / pixel_m).ceil() as usize).clamp(1, MAX_PICTURE_SIDE_PX);
        let pixels = crate::work::released(py, "drawing a picture", || {
            #[expect(clippy::cast_precision_loss, reason = "pictures are small")]
            let at = |index: usize| (index as f64 + 0.5) * pixel_m;
            let pixel = |index: usize| {
                let (column, row) = (index % width, height - 1 - index / width);
                let point = [low[0] + at(column), low[1] + at(row)];
                // Thin walls are at least a pixel wide.
                let near_m = pixel_m / 2.0;
                u8::from(world.obstacles().distance_to_point_m(point, near_m) < near_m)
            };
            (0..width * height).map(pixel).collect::<Vec<u8>>()
        })?;
        Ok((moved(py, pixels, &[height, width])?, low, pixel_m))
    }

    /// Obstacles of an environment: a list of corners (N, 2) or of (x, y, radius) [m].
    fn obstacles<'py>(&self, py: Python<'py>, environment: usize) -> PyResult<Bound<'py, PyList>> {
        let batch = self.environment(environment)?;
        let areas = PyList::empty(py);
        for area in batch.world_of(environment).obstacles().areas() {
            match area {
                ObstacleArea::Circle { centre: [x, y], radius_m } => {
                    areas.append(moved(py, vec![*x, *y, *radius_m], &[3])?)?;
                }
                ObstacleArea::Polygon(corners) => {
                    areas.append(moved(py, corners.concat(), &[corners.len(), 2])?)?;
                }
            }
        }
        Ok(areas)
    }
}

/// Maximum side of a picture [pixels].
const MAX_PICTURE_SIDE_PX: usize = 8192;

impl PyNavigationBatch {
    fn environment(&self, index: usize) -> PyResult<std::sync::MutexGuard<'_, NavigationBatch>> {
        let batch = lock(&self.batch);
        let count = batch.environment_count();
        if index < count {
            Ok(batch)
        } else {
            Err(PyIndexError::new_err(format!("environment {index} of {count}")))
        }
    }
}

/// An argument as an array of numpy that is written.
fn writable<'py, T: Element>(
    argument: &Bound<'py, PyAny>,
    name: &str,
) -> PyResult<PyReadwriteArrayDyn<'py, T>> {
    let wrong = || {
        PyValueError::new_err(format!(
            "`{name}` must be a contiguous, writable array of {}",
            T::get_dtype(argument.py())
        ))
    };
    let array = argument.cast::<PyArrayDyn<T>>().map_err(|_| wrong())?;
    if !array.is_c_contiguous() {
        return Err(wrong());
    }
    array.try_readwrite().map_err(|_| wrong())
}

fn batch_error(error: BatchError) -> PyErr {
    match error {
        BatchError::NotReset(_) => PyRuntimeError::new_err(error.to_string()),
        other => value_error(other),
    }
}
