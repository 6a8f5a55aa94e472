//! Navigation nodes: the servers of Nav2.

mod defaults;
mod goals;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use periplus_diagnostics::{Diagnostics, FileId, SourceMap};
use periplus_geometry::Pose2;
use periplus_graph::{Graph, GraphError};
use periplus_nav_nodes::NodeParameters;
use periplus_nav_nodes::bt_navigator::NavigatorStatus;
use periplus_nav_nodes::navigation::{NavigationNode, NavigationServer, NavigationSetup};
use periplus_nav_nodes::navigation_plugins::NavigationPlugins;
use periplus_os::Machine;
use periplus_resources::{FileWriteError, Store as _};
use periplus_yaml::YamlNode;

pub use defaults::{NavigationDefaults, PathController, PlanningMap, RobotBase};
pub use goals::{GoalDriver, GoalOutcome, GoalReport};

use super::profile::RobotProfile;
use crate::error::RunError;
use crate::{files, terminal};

/// Navigation to run beside a robot.
#[derive(Clone, Debug, Default)]
pub struct NavigationRequest {
    /// Parameter file of Nav2; default parameters for the robot without one.
    pub parameters: Option<PathBuf>,
    /// Inputs of the default parameters.
    pub defaults: NavigationDefaults,
}

/// Findings about the parameters that are printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Findings {
    /// All.
    All,
    /// Errors only: the parameters are those of a robot before.
    Errors,
}

/// Text in a parameter file that stands for the namespace of the robot, as in `bringup_launch.py` of Nav2.
const NAMESPACE_MARK: &str = "<robot_namespace>";

/// Running servers of a robot.
#[derive(Default)]
pub struct Navigation {
    nodes: Vec<NavigationNode>,
    global_frame: String,
}

/// Topic of velocity commands that the controller and the behaviors publish where a velocity smoother follows.
const UNSMOOTHED_TOPIC: &str = "cmd_vel_nav";

impl Navigation {
    /// Adds the servers to a graph and starts them, as `nav2_bringup` does. Of a parameter file those run that it has
    /// parameters for; the navigator, the planner and the controller always do.
    ///
    /// # Errors
    /// When the parameters cannot be read or have errors, or a node cannot start.
    pub fn start(
        graph: &Graph,
        request: &NavigationRequest,
        profile: &RobotProfile,
        findings: Findings,
    ) -> Result<Self, RunError> {
        let (name, text) = match &request.parameters {
            // As the launch files of Nav2 do.
            Some(path) => {
                let text = files::text(path)?;
                let prefix = format!("/{}", profile.namespace.name());
                (path.display().to_string(), text.replace(NAMESPACE_MARK, &prefix))
            }
            None => ("the default parameters".to_owned(), request.defaults.yaml(profile)),
        };
        let (mut sources, mut diagnostics) = (SourceMap::new(), Diagnostics::new());
        let file = sources.add(name, text);
        let none = NavigationPlugins::new();
        let started = Self::start_from(graph, file, profile, &none, &sources, &mut diagnostics);
        if findings == Findings::All || diagnostics.has_errors() {
            terminal::diagnostics(&mut terminal::messages(), &diagnostics, &sources)?;
        }
        started
    }

    /// Adds the servers as [`Self::start`] does, with the parameters of a file that has been read, and with plugins of
    /// other authors. The caller shows the findings.
    ///
    /// # Errors
    /// [`RunError::Reported`] when a finding is an error; when a node cannot start.
    pub fn start_from(
        graph: &Graph,
        file: FileId,
        profile: &RobotProfile,
        plugins: &NavigationPlugins,
        sources: &SourceMap,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, RunError> {
        let tree = match periplus_yaml::parse(file, sources) {
            Ok(tree) => tree,
            Err(error) => {
                diagnostics.push(*error);
                None
            }
        };
        let created = Self::create(graph, tree.as_ref(), profile, plugins, diagnostics);
        if diagnostics.has_errors() {
            return Err(RunError::Reported);
        }
        let navigation = created.map_err(|error| RunError::node("navigation", error))?;
        for node in &navigation.nodes {
            node.with_costmap(|costmap| costmap.name_lines_of(sources.clone()));
            node.start();
        }
        Ok(navigation)
    }

    fn create(
        graph: &Graph,
        file: Option<&YamlNode>,
        profile: &RobotProfile,
        plugins: &NavigationPlugins,
        diagnostics: &mut Diagnostics,
    ) -> Result<Self, GraphError> {
        let setup = NavigationSetup {
            graph,
            file,
            release: None,
            stamped_velocities: Some(profile.takes_stamped_velocities()),
            files: Arc::new(Machine),
            save_photo: Arc::new(save_photo),
            plugins: plugins.clone(),
        };
        let has = |server: NavigationServer| {
            file.is_some_and(|file| has_section(file, server.node_name(), 0))
        };
        let is_smoothed = has(NavigationServer::VelocitySmoother);
        let frame =
            file.map(|file| NodeParameters::of_node(file, NavigationServer::Navigator.node_name()));
        let frame = frame.as_ref().and_then(|given| given.text("global_frame")).unwrap_or("map");
        let mut navigation = Self { nodes: Vec::new(), global_frame: frame.to_owned() };
        for server in NavigationServer::STACK {
            let is_needed = matches!(
                server,
                NavigationServer::Controller
                    | NavigationServer::Planner
                    | NavigationServer::Navigator
                    | NavigationServer::Behaviors
            );
            if !is_needed && !has(server) {
                continue;
            }
            let mut settings = profile.namespace.settings(server.node_name());
            if let Some(topic) = velocity_topic(server, is_smoothed, profile) {
                settings = settings.remap("cmd_vel", topic);
            }
            let node = graph.node(settings)?;
            let costmap_node = |settings| graph.node(profile.namespace.with_rules(settings));
            navigation.nodes.push(setup.create(server, node, costmap_node, diagnostics)?);
        }
        Ok(navigation)
    }

    /// Returns true if there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// Returns true if all servers are active.
    #[must_use]
    pub fn is_active(&self) -> bool {
        self.nodes.iter().all(|node| node.lifecycle().is_active())
    }

    /// Returns why it cannot plan: a server that is not active, or a costmap without its data. `None` once it can.
    #[must_use]
    pub fn obstacle(&self) -> Option<String> {
        self.nodes.iter().find_map(|node| {
            if !node.lifecycle().is_active() {
                return Some(format!("{} is not active", node.server().node_name()));
            }
            node.with_costmap(|costmap| {
                let status = costmap.status();
                let name = node.server().costmap_name().unwrap_or_default();
                match status.trouble {
                    Some(trouble) => Some(format!("{name}: {trouble}")),
                    None if status.updates == 0 => Some(format!("{name} was not updated yet")),
                    None => None,
                }
            })
            .flatten()
        })
    }

    /// Frame in which the navigator plans, and in which goals are given by default.
    #[must_use]
    pub fn global_frame(&self) -> String {
        self.global_frame.clone()
    }

    /// Activity of the navigator.
    #[must_use]
    pub fn status(&self) -> Option<NavigatorStatus> {
        self.nodes.iter().find_map(|node| match node {
            NavigationNode::Navigator(node) => Some(node.with(|navigator| navigator.status())),
            _ => None,
        })
    }
}

/// Topic to which a node's `cmd_vel` is remapped, as in `navigation_launch.py`.
fn velocity_topic(
    server: NavigationServer,
    is_smoothed: bool,
    profile: &RobotProfile,
) -> Option<&str> {
    match server {
        NavigationServer::Controller | NavigationServer::Behaviors if is_smoothed => {
            Some(UNSMOOTHED_TOPIC)
        }
        NavigationServer::VelocitySmoother => Some(UNSMOOTHED_TOPIC),
        NavigationServer::Controller
        | NavigationServer::Behaviors
        | NavigationServer::CollisionMonitor => profile.velocity_topic(),
        _ => None,
    }
}

/// Returns true if a parameter file has a section of a node, also within namespaces.
fn has_section(at: &YamlNode, node: &str, depth: usize) -> bool {
    const MAX_NAMESPACE_DEPTH: usize = 4;
    at.entries().filter(|_| depth < MAX_NAMESPACE_DEPTH).unwrap_or_default().iter().any(
        |(key, value)| {
            let name = key.text().unwrap_or_default();
            let name = name.rsplit('/').next().unwrap_or(name);
            match value.get("ros__parameters") {
                Some(_) => name == node,
                None => has_section(value, node, depth + 1),
            }
        },
    )
}

/// Saves the photo of a waypoint.
fn save_photo(path: &Path, bytes: &[u8]) -> Result<(), FileWriteError> {
    if let Some(folder) = path.parent() {
        files::make_folder(folder).map_err(|error| FileWriteError::Other(error.to_string()))?;
    }
    Machine.replace(path, bytes)
}

/// Pose in the text form `X,Y,YAW`.
#[must_use]
pub fn pose_text(pose: Pose2) -> String {
    format!("{:.3},{:.3},{:.3}", pose.x_m, pose.y_m, pose.yaw_rad)
}
