//! All servers of Nav2's navigation, created by the names of their nodes from one parameter file.

use std::sync::Arc;

use periplus_costmap::{CostmapConfig, Nav2Release};
use periplus_diagnostics::Diagnostics;
use periplus_graph::{Graph, GraphError, Lifecycle, LifecycleNode, Node, NodeSettings};
use periplus_resources::Host;
use periplus_yaml::YamlNode;

use crate::behavior_server::{BehaviorServerConfig, BehaviorServerNode};
use crate::bt_navigator::{BT_NAVIGATOR, BtNavigator, BtNavigatorParams};
use crate::collision_monitor::{CollisionDetectorNode, CollisionMonitorNode, MonitorConfig};
use crate::common_parameters::is_for_table;
use crate::controller_server::ControllerServer;
use crate::costmap_2d::CostmapNode;
use crate::navigation_plugins::NavigationPlugins;
use crate::planner_server::PlannerServer;
use crate::smoother_server::SmootherServer;
use crate::velocity_smoother::{VELOCITY_SMOOTHER, VelocitySmootherNode};
use crate::velocity_topics::uses_stamped_velocity;
use crate::waypoint_follower::{SavePhoto, WaypointFollowerConfig, WaypointFollowerNode};
use crate::{Files, NodeParameters};

/// Server of Nav2's navigation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum NavigationServer {
    /// `controller_server` with the local costmap.
    Controller,
    /// `smoother_server`.
    Smoother,
    /// `planner_server` with the global costmap.
    Planner,
    /// `behavior_server` (`recoveries_server` before Humble).
    Behaviors,
    /// `velocity_smoother`.
    VelocitySmoother,
    /// `collision_monitor`.
    CollisionMonitor,
    /// `collision_detector`.
    CollisionDetector,
    /// `bt_navigator`.
    Navigator,
    /// `waypoint_follower`.
    WaypointFollower,
}

impl NavigationServer {
    /// The servers of `navigation_launch.py` of Jazzy, in the order in which its lifecycle manager starts them.
    pub const STACK: [Self; 8] = [
        Self::Controller,
        Self::Smoother,
        Self::Planner,
        Self::Behaviors,
        Self::VelocitySmoother,
        Self::CollisionMonitor,
        Self::Navigator,
        Self::WaypointFollower,
    ];

    /// Name of its node in Nav2's launch and parameter files.
    #[must_use]
    pub fn node_name(self) -> &'static str {
        match self {
            Self::Controller => "controller_server",
            Self::Smoother => "smoother_server",
            Self::Planner => "planner_server",
            Self::Behaviors => "behavior_server",
            Self::VelocitySmoother => "velocity_smoother",
            Self::CollisionMonitor => "collision_monitor",
            Self::CollisionDetector => "collision_detector",
            Self::Navigator => "bt_navigator",
            Self::WaypointFollower => "waypoint_follower",
        }
    }

    fn sends_velocities(self) -> bool {
        matches!(
            self,
            Self::Controller | Self::Behaviors | Self::VelocitySmoother | Self::CollisionMonitor
        )
    }

    /// Name of the costmap that it owns, and of its namespace.
    #[must_use]
    pub fn costmap_name(self) -> Option<&'static str> {
        match self {
            Self::Controller => Some(LOCAL_COSTMAP),
            Self::Planner => Some(GLOBAL_COSTMAP),
            _ => None,
        }
    }
}

/// Parameter of nodes that send velocities.
const STAMPED: &str = "enable_stamped_cmd_vel";

/// Costmap of the controller server.
const LOCAL_COSTMAP: &str = "local_costmap";

/// Costmap of the planner server.
const GLOBAL_COSTMAP: &str = "global_costmap";

/// A running server.
pub enum NavigationNode {
    /// `controller_server`.
    Controller(LifecycleNode<ControllerServer>),
    /// `smoother_server`.
    Smoother(LifecycleNode<SmootherServer>),
    /// `planner_server`.
    Planner(LifecycleNode<PlannerServer>),
    /// `behavior_server`.
    Behaviors(LifecycleNode<BehaviorServerNode>),
    /// `velocity_smoother`.
    VelocitySmoother(LifecycleNode<VelocitySmootherNode>),
    /// `collision_monitor`.
    CollisionMonitor(LifecycleNode<CollisionMonitorNode>),
    /// `collision_detector`.
    CollisionDetector(LifecycleNode<CollisionDetectorNode>),
    /// `bt_navigator`.
    Navigator(LifecycleNode<BtNavigator>),
    /// `waypoint_follower`.
    WaypointFollower(LifecycleNode<WaypointFollowerNode>),
}

/// Calls a method of the node of every server.
macro_rules! of_each {
    ($node:expr, $lifecycle:ident => $value:expr) => {
        match $node {
            NavigationNode::Controller($lifecycle) => $value,
            NavigationNode::Smoother($lifecycle) => $value,
            NavigationNode::Planner($lifecycle) => $value,
            NavigationNode::Behaviors($lifecycle) => $value,
            NavigationNode::VelocitySmoother($lifecycle) => $value,
            NavigationNode::CollisionMonitor($lifecycle) => $value,
            NavigationNode::CollisionDetector($lifecycle) => $value,
            NavigationNode::Navigator($lifecycle) => $value,
            NavigationNode::WaypointFollower($lifecycle) => $value,
        }
    };
}

impl NavigationNode {
    /// Configures and activates the node, as a lifecycle manager would.
    pub fn start(&self) {
        of_each!(self, node => node.start());
    }

    /// Lifecycle of the node.
    #[must_use]
    pub fn lifecycle(&self) -> &Lifecycle {
        of_each!(self, node => node.lifecycle())
    }

    /// Kind of server.
    #[must_use]
    pub fn server(&self) -> NavigationServer {
        match self {
            Self::Controller(_) => NavigationServer::Controller,
            Self::Smoother(_) => NavigationServer::Smoother,
            Self::Planner(_) => NavigationServer::Planner,
            Self::Behaviors(_) => NavigationServer::Behaviors,
            Self::VelocitySmoother(_) => NavigationServer::VelocitySmoother,
            Self::CollisionMonitor(_) => NavigationServer::CollisionMonitor,
            Self::CollisionDetector(_) => NavigationServer::CollisionDetector,
            Self::Navigator(_) => NavigationServer::Navigator,
            Self::WaypointFollower(_) => NavigationServer::WaypointFollower,
        }
    }

    /// Calls a function with the costmap that the server owns.
    pub fn with_costmap<R>(&self, read: impl FnOnce(&mut CostmapNode) -> R) -> Option<R> {
        match self {
            Self::Controller(node) => Some(node.with(|server| server.costmap().with(read))),
            Self::Planner(node) => Some(node.with(|server| server.costmap().with(read))),
            _ => None,
        }
    }
}

/// Creation of servers from one parameter file.
pub struct NavigationSetup<'a> {
    /// Graph of the nodes.
    pub graph: &'a Graph,
    /// Tree of the parameter file; none for defaults.
    pub file: Option<&'a YamlNode>,
    /// Release whose messages and behaviour are used; none for the newest behaviour with the messages of Jazzy.
    pub release: Option<Nav2Release>,
    /// True for stamped velocities in nodes for which the file does not define it; none for those of the release.
    pub stamped_velocities: Option<bool>,
    /// Files of behavior trees.
    pub files: Arc<dyn Files>,
    /// Function that saves photos of waypoints.
    pub save_photo: SavePhoto,
    /// Plugins of other authors.
    pub plugins: NavigationPlugins,
}

impl NavigationSetup<'_> {
    /// Creates a server, not yet configured, on a node that has its name. `costmap_node` makes the node of its costmap
    /// from settings with name and namespace.
    ///
    /// # Errors
    /// When a name is not valid or exists with another type.
    pub fn create(
        &self,
        server: NavigationServer,
        node: Node,
        costmap_node: impl FnOnce(NodeSettings) -> Result<Node, GraphError>,
        diagnostics: &mut Diagnostics,
    ) -> Result<NavigationNode, GraphError> {
        let name = node.names().name().to_owned();
        let mut parameters =
            self.file.map(|file| NodeParameters::of_node(file, &name)).unwrap_or_default();
        let release = self.release;
        let forms = release.unwrap_or(Nav2Release::Jazzy);
        if server.sends_velocities() && parameters.text(STAMPED).is_none() {
            // The messages of all nodes are those of one release.
            let is_stamped =
                self.stamped_velocities.unwrap_or_else(|| uses_stamped_velocity(None, forms));
            parameters.push(STAMPED, is_stamped.to_string());
        }
        let (given, plugins) = (parameters.given(), &self.plugins);
        Ok(match server {
            NavigationServer::Controller => {
                let costmap = self.costmap(LOCAL_COSTMAP, &node, costmap_node, diagnostics)?;
                let server =
                    ControllerServer::with_plugins(&node, given, costmap, plugins, diagnostics)?;
                NavigationNode::Controller(server)
            }
            NavigationServer::Planner => {
                let costmap = self.costmap(GLOBAL_COSTMAP, &node, costmap_node, diagnostics)?;
                let from = (plugins, &*self.files as &dyn Host);
                let server = PlannerServer::with_plugins(&node, given, costmap, from, diagnostics)?;
                NavigationNode::Planner(server)
            }
            NavigationServer::Smoother => {
                let releases = (release.unwrap_or_default(), forms);
                NavigationNode::Smoother(SmootherServer::new(&node, given, releases, diagnostics)?)
            }
            NavigationServer::Behaviors => {
                let (config, registered) =
                    BehaviorServerConfig::read_with(given, Some(forms), plugins, diagnostics);
                let server = BehaviorServerNode::with_plugins(node, config, registered)?;
                NavigationNode::Behaviors(server)
            }
            NavigationServer::VelocitySmoother => {
                let given = given.filter(|one| is_for_table(one, &VELOCITY_SMOOTHER));
                let values = VELOCITY_SMOOTHER.check(given, None, diagnostics);
                NavigationNode::VelocitySmoother(VelocitySmootherNode::at(node, values)?)
            }
            NavigationServer::CollisionMonitor => {
                let config = MonitorConfig::read_monitor(given, Some(forms), diagnostics);
                NavigationNode::CollisionMonitor(CollisionMonitorNode::at(node, config)?)
            }
            NavigationServer::CollisionDetector => {
                let config = MonitorConfig::read_detector(given, Some(forms), diagnostics);
                NavigationNode::CollisionDetector(CollisionDetectorNode::at(node, config)?)
            }
            NavigationServer::Navigator => {
                let given = given.filter(|one| is_for_table(one, &BT_NAVIGATOR));
                let values = BtNavigatorParams::read(given, forms, diagnostics);
                let files = Arc::clone(&self.files);
                let server = BtNavigator::with_plugins(&node, values, forms, files, plugins)?;
                NavigationNode::Navigator(server)
            }
            NavigationServer::WaypointFollower => {
                let config = WaypointFollowerConfig::read(given, Some(forms), diagnostics);
                let save = Arc::clone(&self.save_photo);
                NavigationNode::WaypointFollower(WaypointFollowerNode::at(node, config, save)?)
            }
        })
    }

    /// Creates the costmap that a server owns, in the namespace of its name. Its transforms are those of the
    /// server: `/tf:=tf` of Nav2's launch files means the server's namespace, not the costmap's.
    fn costmap(
        &self,
        name: &str,
        server: &Node,
        costmap_node: impl FnOnce(NodeSettings) -> Result<Node, GraphError>,
        diagnostics: &mut Diagnostics,
    ) -> Result<LifecycleNode<CostmapNode>, GraphError> {
        let around = server.names().namespace().trim_end_matches('/');
        let mut settings = NodeSettings::new(name).namespace(&format!("{around}/{name}"));
        for topic in ["/tf", "/tf_static"] {
            settings = settings.remap(topic, &server.names().topic(topic)?);
        }
        let config = match self.file {
            Some(file) => CostmapConfig::read_yaml(file, name, self.release, diagnostics),
            None => CostmapConfig::read([], self.release, diagnostics),
        };
        CostmapNode::at(costmap_node(settings)?, config)
    }
}
