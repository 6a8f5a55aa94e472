//! Built-in replacements of ROS programs: a table that is also part of the documentation.

use std::fmt::Write as _;

use periplus_maps::Distro;
use periplus_nav_nodes::navigation::NavigationServer;
use periplus_nav_nodes::slam_toolbox::Program;

/// Role of a built-in replacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// Robot state publisher.
    RobotStatePublisher,
    /// Joint state publisher.
    JointStatePublisher,
    /// Static transform publisher.
    StaticTransform,
    /// Simulation.
    Gazebo,
    /// Spawner of robots.
    Spawn,
    /// Bridge between Gazebo and ROS topics.
    Bridge,
    /// Web page.
    Viewer,
    /// SLAM node.
    Slam(Program),
    /// Map server; true if it waits for a lifecycle manager.
    MapServer { is_managed: bool },
    /// Map saver service.
    MapSaverServer,
    /// Map saver that saves one map.
    MapSaver(Distro),
    /// AMCL; true if it waits for a lifecycle manager.
    Amcl { is_managed: bool },
    /// Server of Nav2's navigation.
    Navigation(NavigationServer),
    /// Navigation of ROS 1.
    MoveBase,
    /// Stand-alone costmap.
    Costmap,
    /// Voxels as cubes.
    VoxelMarkers,
    /// Voxels as points.
    VoxelCloud,
    /// Lifecycle manager.
    LifecycleManager,
    /// EKF.
    Ekf,
    /// Spawner of controllers; true for its opposite.
    Controllers { unloads: bool },
    /// Command of `ros2 control` that loads a controller.
    ControlCommand,
    /// Multiplexer of velocity commands.
    TwistMux,
    /// Velocities with a time stamp.
    TwistStamper,
    /// Topic relay.
    Relay,
    /// Component container; each component has a separate entry.
    Container,
    /// Nothing: its task is already done.
    Needless,
    /// Nothing: not supported.
    Lacking,
}

/// Row of the table.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) packages: &'static [&'static str],
    /// Names of programs; `*` stands for all of the package.
    pub(crate) executables: &'static [&'static str],
    /// Classes of components.
    pub(crate) plugins: &'static [&'static str],
    /// Default node name.
    pub(crate) node: &'static str,
    pub(crate) role: Role,
    /// Description for the summary and the documentation.
    pub(crate) becomes: &'static str,
}

impl Entry {
    /// Returns true for a bridge between topics of Gazebo and ROS of any type.
    pub(crate) fn is_bridge_of_topics(&self) -> bool {
        self.role == Role::Bridge && self.packages != ["ros_gz_image", "ros_ign_image"]
    }
}

/// Constructor of a row.
const fn entry(
    packages: &'static [&'static str],
    executables: &'static [&'static str],
    plugins: &'static [&'static str],
    node: &'static str,
    role: Role,
    becomes: &'static str,
) -> Entry {
    Entry { packages, executables, plugins, node, role, becomes }
}

/// No classes.
const NONE: &[&str] = &[];

/// The table. Earlier rows take precedence.
pub(crate) static CATALOGUE: &[Entry] = &[
    entry(
        &["robot_state_publisher"],
        &["robot_state_publisher", "state_publisher"],
        &["robot_state_publisher::RobotStatePublisher"],
        "robot_state_publisher",
        Role::RobotStatePublisher,
        "the built-in node: `/tf`, `/tf_static`, `robot_description`",
    ),
    entry(
        &["joint_state_publisher"],
        &["joint_state_publisher", "joint_state_publisher.py"],
        NONE,
        "joint_state_publisher",
        Role::JointStatePublisher,
        "the built-in node: `joint_states` of the described robot",
    ),
    entry(
        &["joint_state_publisher_gui"],
        &["joint_state_publisher_gui", "joint_state_publisher_gui.py"],
        NONE,
        "joint_state_publisher_gui",
        Role::JointStatePublisher,
        "the built-in node, without sliders: joints keep their initial positions",
    ),
    entry(
        &["tf2_ros", "tf"],
        &["static_transform_publisher", "static_transform_publisher_node"],
        &["tf2_ros::StaticTransformBroadcasterNode"],
        "static_transform_publisher",
        Role::StaticTransform,
        "a transform on `/tf_static`; of ROS 1's `tf` on `/tf`, at its rate",
    ),
    entry(
        &["gazebo_ros", "gazebo"],
        &["gazebo", "gzserver", "debug", "gdbrun", "libcommon.sh"],
        NONE,
        "gazebo",
        Role::Gazebo,
        "the simulation of this world",
    ),
    entry(
        &["ros_gz_sim", "ros_ign_gazebo"],
        &["gzserver", "gz_server"],
        &["ros_gz_sim::GzServer"],
        "gz_server",
        Role::Gazebo,
        "the simulation of this world",
    ),
    entry(
        &["gazebo_ros"],
        &["gzclient", "gzclient_gui"],
        NONE,
        "gazebo_gui",
        Role::Viewer,
        "the page (`--page`)",
    ),
    entry(
        &["gazebo_ros"],
        &["spawn_entity.py", "spawn_entity", "spawn_model", "spawn_gazebo_model"],
        NONE,
        "spawn_entity",
        Role::Spawn,
        "a robot or model in the simulation; the program ends when it is spawned",
    ),
    entry(
        &["ros_gz_sim", "ros_ign_gazebo"],
        &["create"],
        NONE,
        "ros_gz_sim",
        Role::Spawn,
        "a robot or model in the simulation; the program ends when it is spawned",
    ),
    entry(
        &["ros_gz_bridge", "ros_ign_bridge"],
        &["parameter_bridge", "bridge_node", "static_bridge"],
        &["ros_gz_bridge::RosGzBridge"],
        "ros_gz_bridge",
        Role::Bridge,
        "simulated topics are ROS topics already, but `/tf` only where a bridge passes it on; remapped ones are relayed",
    ),
    entry(
        &["ros_gz_image", "ros_ign_image"],
        &["image_bridge"],
        NONE,
        "ros_gz_image",
        Role::Bridge,
        "simulated images are ROS topics already",
    ),
    entry(
        &["rviz2", "rviz"],
        &["rviz2", "rviz"],
        NONE,
        "rviz2",
        Role::Viewer,
        "the page (`--page`), which opens files of RViz",
    ),
    entry(
        &["slam_toolbox"],
        &["async_slam_toolbox_node"],
        &["slam_toolbox::AsynchronousSlamToolbox"],
        "slam_toolbox",
        Role::Slam(Program::Async),
        "the built-in SLAM node",
    ),
    entry(
        &["slam_toolbox"],
        &["sync_slam_toolbox_node"],
        &["slam_toolbox::SynchronousSlamToolbox"],
        "slam_toolbox",
        Role::Slam(Program::Sync),
        "the built-in SLAM node; every scan is processed",
    ),
    entry(
        &["slam_toolbox"],
        &["localization_slam_toolbox_node"],
        &["slam_toolbox::LocalizationSlamToolbox"],
        "slam_toolbox",
        Role::Slam(Program::Localization),
        "the built-in SLAM node, localizing on a stored pose graph",
    ),
    entry(
        &["slam_toolbox"],
        &["lifelong_slam_toolbox_node"],
        &["slam_toolbox::LifelongSlamToolbox"],
        "slam_toolbox",
        Role::Slam(Program::Lifelong),
        "the built-in SLAM node; old scans are pruned",
    ),
    entry(
        &["gmapping", "slam_gmapping"],
        &["slam_gmapping"],
        NONE,
        "slam_gmapping",
        Role::Slam(Program::Gmapping),
        "the built-in SLAM node with a particle filter",
    ),
    entry(
        &["nav2_map_server"],
        &["map_server"],
        &["nav2_map_server::MapServer"],
        "map_server",
        Role::MapServer { is_managed: true },
        "the built-in node, once a lifecycle manager activates it",
    ),
    entry(
        &["map_server"],
        &["map_server"],
        NONE,
        "map_server",
        Role::MapServer { is_managed: false },
        "the built-in node; `-f NAME` saves the map, as `map_saver` does",
    ),
    entry(
        &["nav2_map_server"],
        &["map_saver_server"],
        &["nav2_map_server::MapSaver"],
        "map_saver",
        Role::MapSaverServer,
        "the built-in node, once a lifecycle manager activates it",
    ),
    entry(
        &["nav2_map_server"],
        &["map_saver_cli"],
        NONE,
        "map_saver",
        Role::MapSaver(Distro::Jazzy),
        "saves one map and ends",
    ),
    entry(
        &["map_server"],
        &["map_saver"],
        NONE,
        "map_saver",
        Role::MapSaver(Distro::Noetic),
        "saves one map and ends",
    ),
    entry(
        &["nav2_amcl"],
        &["amcl"],
        &["nav2_amcl::AmclNode"],
        "amcl",
        Role::Amcl { is_managed: true },
        "the built-in node, once a lifecycle manager activates it",
    ),
    entry(
        &["amcl"],
        &["amcl"],
        NONE,
        "amcl",
        Role::Amcl { is_managed: false },
        "the built-in node",
    ),
    entry(
        &["nav2_controller"],
        &["controller_server"],
        &["nav2_controller::ControllerServer"],
        "controller_server",
        Role::Navigation(NavigationServer::Controller),
        "the built-in server with its `local_costmap`: MPPI, DWB, RegulatedPurePursuit, Graceful, RotationShim",
    ),
    entry(
        &["nav2_planner"],
        &["planner_server"],
        &["nav2_planner::PlannerServer"],
        "planner_server",
        Role::Navigation(NavigationServer::Planner),
        "the built-in server with its `global_costmap`: NavFn, Smac, Theta*",
    ),
    entry(
        &["nav2_smoother"],
        &["smoother_server"],
        &["nav2_smoother::SmootherServer"],
        "smoother_server",
        Role::Navigation(NavigationServer::Smoother),
        "the built-in server",
    ),
    entry(
        &["nav2_behaviors"],
        &["behavior_server"],
        &["behavior_server::BehaviorServer", "nav2_behaviors::BehaviorServer"],
        "behavior_server",
        Role::Navigation(NavigationServer::Behaviors),
        "the built-in server: spin, back up, drive on heading, wait, assisted teleoperation",
    ),
    entry(
        &["nav2_velocity_smoother"],
        &["velocity_smoother"],
        &["nav2_velocity_smoother::VelocitySmoother"],
        "velocity_smoother",
        Role::Navigation(NavigationServer::VelocitySmoother),
        "the built-in smoother",
    ),
    entry(
        &["nav2_collision_monitor"],
        &["collision_monitor"],
        &["nav2_collision_monitor::CollisionMonitor"],
        "collision_monitor",
        Role::Navigation(NavigationServer::CollisionMonitor),
        "the built-in monitor",
    ),
    entry(
        &["nav2_collision_monitor"],
        &["collision_detector"],
        &["nav2_collision_monitor::CollisionDetector"],
        "collision_detector",
        Role::Navigation(NavigationServer::CollisionDetector),
        "the built-in detector",
    ),
    entry(
        &["nav2_bt_navigator"],
        &["bt_navigator"],
        &["nav2_bt_navigator::BtNavigator"],
        "bt_navigator",
        Role::Navigation(NavigationServer::Navigator),
        "the built-in navigator: behavior trees with all nodes of Nav2's default trees",
    ),
    entry(
        &["nav2_waypoint_follower"],
        &["waypoint_follower"],
        &["nav2_waypoint_follower::WaypointFollower"],
        "waypoint_follower",
        Role::Navigation(NavigationServer::WaypointFollower),
        "the built-in follower",
    ),
    entry(
        &["nav2_costmap_2d"],
        &["nav2_costmap_2d"],
        NONE,
        "costmap",
        Role::Costmap,
        "a stand-alone costmap",
    ),
    entry(
        &["nav2_costmap_2d"],
        &["nav2_costmap_2d_markers"],
        NONE,
        "costmap_2d_marker",
        Role::VoxelMarkers,
        "voxels as cubes on `visualization_marker`",
    ),
    entry(
        &["nav2_costmap_2d"],
        &["nav2_costmap_2d_cloud"],
        NONE,
        "costmap_2d_cloud",
        Role::VoxelCloud,
        "voxels as points on `voxel_marked_cloud` and `voxel_unknown_cloud`",
    ),
    entry(
        &["nav2_lifecycle_manager"],
        &["lifecycle_manager"],
        &["nav2_lifecycle_manager::LifecycleManager"],
        "lifecycle_manager",
        Role::LifecycleManager,
        "configures and activates the nodes of `node_names` in order; nodes that are missing are skipped. It \
         keeps bonds (`bond_timeout`) and restarts the system when its nodes return \
         (`attempt_respawn_reconnection`, `bond_respawn_max_duration`)",
    ),
    entry(
        &["robot_localization"],
        &["ekf_node", "ekf_localization_node"],
        NONE,
        "ekf_filter_node",
        Role::Ekf,
        "the built-in extended Kalman filter",
    ),
    entry(
        &["topic_tools"],
        &["relay"],
        &["topic_tools::RelayNode"],
        "relay",
        Role::Relay,
        "the built-in relay from one topic to another",
    ),
    entry(
        &["rclcpp_components"],
        &[
            "component_container",
            "component_container_mt",
            "component_container_isolated",
            "component_container_event",
        ],
        NONE,
        "component_container",
        Role::Container,
        "nothing by itself: each component has its own row",
    ),
    entry(
        &["teleop_twist_keyboard"],
        &["teleop_twist_keyboard", "teleop_twist_keyboard.py"],
        NONE,
        "teleop_twist_keyboard",
        Role::Lacking,
        "nothing: it needs a terminal; run `periplus teleop` in one",
    ),
    entry(
        &["opennav_docking", "nav2_route", "nav2_bringup", "nav2_recoveries"],
        &["*"],
        NONE,
        "nav2",
        Role::Lacking,
        "nothing: docking and routes are not built in; the lifecycle manager goes on without it",
    ),
    entry(
        &["move_base"],
        &["move_base"],
        NONE,
        "move_base",
        Role::MoveBase,
        "the built-in node with its costmaps: NavfnROS, GlobalPlanner; TrajectoryPlannerROS, DWAPlannerROS, and a \
         controller in place of TebLocalPlannerROS",
    ),
    entry(
        &["controller_manager"],
        &["spawner", "spawner.py"],
        NONE,
        "controller_spawner",
        Role::Controllers { unloads: false },
        "loads, configures and activates controllers in the simulation, then ends",
    ),
    entry(
        &["controller_manager"],
        &["unspawner", "unspawner.py"],
        NONE,
        "controller_unspawner",
        Role::Controllers { unloads: true },
        "deactivates and unloads controllers in the simulation, then ends",
    ),
    entry(
        &["ros2controlcli"],
        &["load_controller"],
        NONE,
        "ros2_control",
        Role::ControlCommand,
        "`ros2 control load_controller` with the built-in spawner",
    ),
    entry(
        &["controller_manager"],
        &["hardware_spawner", "ros2_control_node"],
        NONE,
        "ros2_control_node",
        Role::Needless,
        "nothing: the plugin of the simulated robot has the controller manager, and its hardware is active",
    ),
    entry(
        &["controller_manager", "gazebo_ros2_control", "gz_ros2_control"],
        &["*"],
        NONE,
        "controller_manager",
        Role::Lacking,
        "nothing: only `spawner`, `unspawner` and `hardware_spawner` are built in",
    ),
    entry(
        &["twist_mux"],
        &["twist_mux"],
        NONE,
        "twist_mux",
        Role::TwistMux,
        "the built-in multiplexer of velocity commands, with locks",
    ),
    entry(
        &["twist_stamper"],
        &["twist_stamper", "twist_stamper.py"],
        NONE,
        "twist_stamper",
        Role::TwistStamper,
        "the built-in node: `Twist` becomes `TwistStamped`",
    ),
    entry(
        &[
            "rqt_gui",
            "rqt_console",
            "rqt_graph",
            "rqt_image_view",
            "rqt_plot",
            "rqt_reconfigure",
            "rqt_robot_steering",
            "rqt_tf_tree",
            "rqt_topic",
        ],
        &["*"],
        NONE,
        "rqt",
        Role::Viewer,
        "the page (`--page`)",
    ),
    entry(
        &["tf2_ros"],
        &["buffer_server"],
        NONE,
        "buffer_server",
        Role::Needless,
        "nothing: each node keeps its own transforms",
    ),
    entry(
        &["diagnostic_aggregator", "robot_pose_publisher"],
        &["*"],
        NONE,
        "diagnostic_aggregator",
        Role::Needless,
        "nothing: `/diagnostics` is published without it",
    ),
];

/// Entry of a program; `None` if it is unknown.
pub(crate) fn of_program(package: Option<&str>, executable: &str) -> Option<&'static Entry> {
    let name = executable.rsplit('/').next().unwrap_or(executable);
    CATALOGUE.iter().find(|entry| {
        let is_package = package.is_none_or(|package| entry.packages.contains(&package));
        // Without a package a `*` row does not match.
        let is_program =
            entry.executables.contains(&name) || package.is_some() && entry.executables == ["*"];
        is_package && is_program
    })
}

/// Entry of a component class.
pub(crate) fn of_plugin(package: &str, plugin: &str) -> Option<&'static Entry> {
    let by_class = CATALOGUE.iter().find(|entry| entry.plugins.contains(&plugin));
    by_class.or_else(|| {
        CATALOGUE
            .iter()
            .find(|entry| entry.packages.contains(&package) && entry.executables == ["*"])
    })
}

/// Table in Markdown for the documentation.
#[must_use]
pub fn table() -> String {
    let mut text =
        String::from("| package | program | component | what it becomes |\n|---|---|---|---|\n");
    let join = |words: &[&str]| {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        words.join(", ").replace("`*`", "all")
    };
    for entry in CATALOGUE {
        let (packages, programs) = (join(entry.packages), join(entry.executables));
        let plugins = join(entry.plugins);
        let _ = writeln!(text, "| {packages} | {programs} | {plugins} | {} |", entry.becomes);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_and_components_are_found() {
        let role = |package, executable| of_program(package, executable).map(|entry| entry.role);
        assert_eq!(role(Some("gazebo_ros"), "spawn_entity.py"), Some(Role::Spawn));
        assert_eq!(role(None, "/opt/ros/lib/gazebo_ros/gzserver"), Some(Role::Gazebo));
        assert_eq!(role(Some("nav2_amcl"), "amcl"), Some(Role::Amcl { is_managed: true }));
        assert_eq!(role(Some("amcl"), "amcl"), Some(Role::Amcl { is_managed: false }));
        assert_eq!(role(Some("nav2_route"), "route_server"), Some(Role::Lacking));
        assert_eq!(role(None, "route_server"), None);
        assert_eq!(role(Some("mine"), "amcl"), None);
        let class = of_plugin("nav2_map_server", "nav2_map_server::MapServer");
        assert_eq!(class.map(|entry| entry.role), Some(Role::MapServer { is_managed: true }));
    }
}
