//! Navigation in Python: the servers of Nav2 beside a robot, with planners, controllers, behaviors and tree nodes that
//! are classes of Python.

mod behavior;
mod controller;
mod costmap_view;
mod drive;
mod parameters;
mod planner;
mod plugin;
mod tree_node;

use std::path::PathBuf;
use std::sync::Mutex;

use periplus::diagnostics::{Diagnostics, Severity, SourceMap};
use periplus::graph::{ActionClient, Graph, GraphError, Node, NodeSettings, Qos};
use periplus::msgs::geometry_msgs::PoseWithCovarianceStamped;
use periplus::msgs::nav2_msgs::NavigateToPose;
use periplus::nav_nodes::ekf_node::EkfNode;
use periplus::nav_nodes::navigation_plugins::NavigationPlugins;
use periplus::nav_nodes::slam_toolbox::{Pace, Program};
use periplus_session::nodes::{
    Localization, MappingNode, MappingRequest, MappingSource, Navigation, NavigationDefaults,
    PlanningMap, RobotBase, RobotProfile, slam_parameters,
};
use periplus_session::{RunError, files};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use self::drive::PyGoalOutcome;
use self::parameters::{ServerParameters, Shortcut};
use self::plugin::Raised;
use crate::errors::{finding_error, require_file, runtime_error};
use crate::estimator_parameters::warn;
use crate::poses::{pose_argument, pose2_argument};
use crate::simulation::{PySimulation, Running};
use crate::work::lock;

pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<PyNavigation>()?;
    module.add_class::<PyGoalOutcome>()?;
    module.add_class::<costmap_view::PyCostmapView>()
}

/// The servers of Nav2 beside the robot of a simulation: planner, controller, behaviors and the navigator with its
/// behavior tree.
///
/// Parameters
/// ----------
/// simulation : Simulation
///     A simulation with one robot that has a lidar and takes velocity commands.
/// parameters : path or dict, optional
///     A parameter file of Nav2, or values by node that change the defaults:
///     ``{"controller_server": {"FollowPath": {"vx_max": 0.3}}}``. The defaults follow from the robot. A group with
///     ``plugin`` replaces that of the defaults.
/// map : path, optional
///     YAML of a map, in which AMCL localizes the robot.
/// slam : bool
///     Without a map: True to map while driving, False to plan in the odometry frame, on obstacles in view only.
/// start_pose : pose
///     Pose from which AMCL starts.
/// planners, controllers : dict, optional
///     Classes of plugins, or functions that return one. A key such as ``"my_package/StraightLine"`` is the class that
///     ``plugin`` names in the parameters; a key without ``/`` is the name of the plugin itself, such as
///     ``"GridBased"`` or ``"FollowPath"``, which then is of this class.
/// behaviors : dict, optional
///     Classes of behaviors; a key without ``/`` is the name of the behavior and of its action.
/// tree_nodes : list, optional
///     Classes of tree nodes; the name of the class is that of its element in XML.
/// base : {"differential", "omni", "ackermann"}
///     Motion that the wheels allow, for the default parameters.
/// max_speed, max_turn_rate, min_turning_radius : float
///     Limits of the default parameters [m/s, rad/s, m].
///
/// The robot's topics and frames are detected in a short run, after which the simulation is in its present state again.
/// Raises ``FileError`` or ``ValueError`` for parameters that cannot be used, and what a plugin raises when it is made.
///
/// >>> from periplus import Simulation, World
/// >>> from periplus.navigation import Navigation
/// >>> navigation = Navigation(Simulation(World.demo(), physics="kinematic"), slam=False)
/// >>> navigation.frame
/// 'odom'
#[pyclass(name = "Navigation", module = "periplus.navigation", frozen)]
pub(crate) struct PyNavigation {
    simulation: Py<PySimulation>,
    state: Mutex<NavigationState>,
    raised: Raised,
}

/// Nodes that a navigation has added to a graph.
pub(crate) struct NavigationState {
    navigation: Navigation,
    client: ActionClient<NavigateToPose>,
    _node: Node,
    _localization: Option<Localization>,
    _mapping: Option<MappingNode>,
    _filter: Option<EkfNode>,
}

/// Parts of a navigation.
struct NavigationSettings {
    defaults: NavigationDefaults,
    parameters: ServerParameters,
    map: Option<PathBuf>,
    start_pose: periplus::geometry::Pose,
    plugins: NavigationPlugins,
}

/// Reason why navigation does not start.
enum StartError {
    /// Findings about the parameters, of which at least one is an error.
    Findings(Box<(Diagnostics, SourceMap)>),
    Other(String),
}

impl From<RunError> for StartError {
    fn from(error: RunError) -> Self {
        Self::Other(error.to_string())
    }
}

impl From<GraphError> for StartError {
    fn from(error: GraphError) -> Self {
        Self::Other(error.to_string())
    }
}

#[pymethods]
impl PyNavigation {
    #[new]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
    #[pyo3(signature = (simulation, *, parameters=None, map=None, slam=true, start_pose=None, planners=None, controllers=None, behaviors=None, tree_nodes=None, base="differential", max_speed=0.5, max_turn_rate=1.9, min_turning_radius=0.5))]
    fn new(
        simulation: Bound<'_, PySimulation>,
        parameters: Option<&Bound<'_, PyAny>>,
        map: Option<PathBuf>,
        slam: bool,
        start_pose: Option<&Bound<'_, PyAny>>,
        planners: Option<&Bound<'_, PyDict>>,
        controllers: Option<&Bound<'_, PyDict>>,
        behaviors: Option<&Bound<'_, PyDict>>,
        tree_nodes: Option<Vec<Bound<'_, PyAny>>>,
        base: &str,
        max_speed: f64,
        max_turn_rate: f64,
        min_turning_radius: f64,
    ) -> PyResult<Self> {
        let py = simulation.py();
        if let Some(map) = &map {
            require_file(map)?;
        }
        for (name, value) in [
            ("max_speed", max_speed),
            ("max_turn_rate", max_turn_rate),
            ("min_turning_radius", min_turning_radius),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(PyValueError::new_err(format!(
                    "`{name}` must be above 0, not {value}"
                )));
            }
        }
        let base = match base {
            "differential" => RobotBase::Differential,
            "omni" => RobotBase::Omnidirectional,
            "ackermann" => RobotBase::Ackermann { min_turning_radius_m: min_turning_radius },
            other => {
                return Err(PyValueError::new_err(format!(
                    "`base` must be \"differential\", \"omni\" or \"ackermann\", not {other:?}"
                )));
            }
        };
        let planning_map = match (&map, slam) {
            (Some(_), _) => PlanningMap::Known,
            (None, true) => PlanningMap::Growing,
            (None, false) => PlanningMap::Absent,
        };
        let start_pose = start_pose.map(|it| pose_argument(it, "start_pose")).transpose()?;
        let (raised, mut shortcuts) = (Raised::default(), Vec::new());
        let mut plugins = NavigationPlugins::new();
        for (class, factory) in
            parameters::classes(planners, "planners", Shortcut::Planner, &mut shortcuts)?
        {
            plugins = planner::add(plugins, &class, &factory, &raised);
        }
        for (class, factory) in
            parameters::classes(controllers, "controllers", Shortcut::Controller, &mut shortcuts)?
        {
            plugins = controller::add(plugins, &class, &factory, &raised);
        }
        for (class, factory) in
            parameters::classes(behaviors, "behaviors", Shortcut::Behavior, &mut shortcuts)?
        {
            plugins = behavior::add(plugins, &class, &factory, &raised)?;
        }
        for node in tree_nodes.into_iter().flatten() {
            plugins = tree_node::add(plugins, &node, &raised)?;
        }
        let settings = NavigationSettings {
            defaults: NavigationDefaults {
                base,
                max_speed_m_s: max_speed,
                max_turn_rate_rad_s: max_turn_rate,
                map: planning_map,
                ..NavigationDefaults::default()
            },
            parameters: ServerParameters::new(parameters, shortcuts)?,
            map,
            start_pose: start_pose
                .unwrap_or_else(|| periplus::geometry::Pose::from_xyz(0.0, 0.0, 0.0)),
            plugins,
        };
        let started = simulation.get().with(py, |running| start(running, &settings))?;
        if let Some(error) = raised.take() {
            return Err(error);
        }
        let (state, warnings) = started.map_err(|error| match error {
            StartError::Other(message) => runtime_error(message),
            StartError::Findings(found) => {
                let (findings, sources) = *found;
                let error = findings.iter().find(|one| one.severity == Severity::Error);
                error.map_or_else(
                    || runtime_error("the parameters have errors"),
                    |error| finding_error(py, error, &sources),
                )
            }
        })?;
        for warning in warnings {
            warn(py, &warning)?;
        }
        Ok(Self { simulation: simulation.unbind(), state: Mutex::new(state), raised })
    }

    /// Drive to a pose in the global frame of the navigator, and return when the goal has ended.
    ///
    /// Parameters
    /// ----------
    /// goal : pose
    ///     Pose to reach, in ``frame``.
    /// timeout_s : float
    ///     Simulated time after which the goal is canceled.
    /// behavior_tree : str
    ///     File of a behavior tree for this goal; the default tree if empty.
    ///
    /// The simulation steps as in ``Simulation.run``. An exception of a plugin becomes the error of its server, with
    /// file and line, and is in ``GoalOutcome.message``. Raises ``KeyboardInterrupt`` after Ctrl-C.
    #[pyo3(signature = (goal, *, timeout_s=120.0, behavior_tree=""))]
    fn go_to(
        &self,
        py: Python<'_>,
        goal: &Bound<'_, PyAny>,
        timeout_s: f64,
        behavior_tree: &str,
    ) -> PyResult<PyGoalOutcome> {
        if !(timeout_s > 0.0 && timeout_s.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "`timeout_s` must be above 0, not {timeout_s}"
            )));
        }
        let goal = pose2_argument(goal, "goal")?;
        self.drive_to(py, goal, timeout_s, behavior_tree)
    }

    /// Frame of goals: that in which paths are planned.
    #[getter]
    fn frame(&self) -> String {
        lock(&self.state).navigation.global_frame()
    }

    /// Activity of the navigator and the reason for it, in one sentence.
    #[getter]
    fn status(&self, py: Python<'_>) -> PyResult<String> {
        self.simulation.get().with(py, |_| {
            let status = lock(&self.state).navigation.status();
            status.map(|status| status.to_string()).unwrap_or_default()
        })
    }

    fn __repr__(&self) -> String {
        format!("<periplus.navigation.Navigation in {}>", self.frame())
    }
}

/// Variances of an initial pose, as RViz publishes it: 0.5 m and 15 degrees.
const INITIAL_VARIANCES: [(usize, f64); 3] = [(0, 0.25), (7, 0.25), (35, 0.068_538_9)];

/// Detects the robot and starts all nodes. Returns them with warnings about the parameters.
fn start(
    running: &mut Running,
    settings: &NavigationSettings,
) -> Result<(NavigationState, Vec<String>), StartError> {
    let profile = detect(running)?;
    let graph = running.graph().clone();
    let (mut sources, mut findings) = (SourceMap::new(), Diagnostics::new());
    let default_text = settings.defaults.yaml(&profile);
    let (name, text) = settings.parameters.file(default_text).map_err(StartError::Other)?;
    let file = sources.add(name, text);
    let filter = profile.needs_filter().then(|| profile.filter(&graph)).transpose()?;
    let mut localization = None;
    let mut mapping = None;
    match (&settings.map, settings.defaults.map) {
        (Some(map), _) => {
            let paths = [map.clone()];
            localization = Some(Localization::from_files(&graph, &paths, Some(&profile))?);
        }
        (None, PlanningMap::Growing) => {
            let (program, values) = slam_parameters(None, Some(Program::Async))?;
            let request =
                MappingRequest { source: MappingSource::Values(program, values), out: None };
            let node = MappingNode::in_simulation(&graph, request, Pace::Whole, Some(&profile))?;
            mapping = Some(node);
        }
        (None, _) => {}
    }
    let plugins = &settings.plugins;
    let navigation =
        Navigation::start_from(&graph, file, &profile, plugins, &sources, &mut findings);
    let navigation = match navigation {
        Ok(navigation) => navigation,
        Err(RunError::Reported) => {
            return Err(StartError::Findings(Box::new((findings, sources))));
        }
        Err(error) => return Err(error.into()),
    };
    let warnings = findings.iter().filter(|one| one.severity == Severity::Warning);
    let warnings = warnings.map(|one| one.message.clone()).collect();
    let (node, client) = client(&graph)?;
    if localization.is_some() {
        let mut message = PoseWithCovarianceStamped::default();
        message.header.frame_id = "map".into();
        message.pose.pose = periplus::tf_ros::pose(settings.start_pose);
        for (index, variance) in INITIAL_VARIANCES {
            message.pose.covariance[index] = variance;
        }
        node.publisher("/initialpose", Qos::reliable(1))?.publish(message);
    }
    running.settle();
    let state = NavigationState {
        navigation,
        client,
        _node: node,
        _localization: localization,
        _mapping: mapping,
        _filter: filter,
    };
    Ok((state, warnings))
}

fn client(graph: &Graph) -> Result<(Node, ActionClient<NavigateToPose>), GraphError> {
    let node = graph.node(NodeSettings::new("python_navigation"))?;
    let client = node.action_client("navigate_to_pose")?;
    Ok((node, client))
}

/// Detects topics and frames of the robot, and returns to the present state.
fn detect(running: &mut Running) -> Result<RobotProfile, StartError> {
    let present = running.session.snapshot();
    running.session.simulation_mut().reset();
    let profile = RobotProfile::detect(running.session.simulation_mut());
    let restored = running.session.restore(&present);
    running.forget();
    restored.map_err(|error| StartError::Other(error.to_string()))?;
    let profile = profile?;
    if profile.scan.is_none() {
        return Err(StartError::Other(
            "no sensor of the robot publishes laser scans, which navigation needs: give the robot \
             a lidar"
                .to_owned(),
        ));
    }
    Ok(profile)
}

/// Text of a file of parameters.
fn file_text(path: &std::path::Path) -> Result<String, String> {
    files::text(path).map_err(|error| error.to_string())
}
