//! Parameters of the navigator.

use periplus_costmap::Nav2Release;
use periplus_diagnostics::Diagnostics;
use periplus_params::{Given, NamedEntity, ParamValue, ParamValues, params};

params! {
    /// The navigator.
    #[table(BT_NAVIGATOR, "bt_navigator")]
    pub struct BtNavigatorParams {
        /// Frame of goals and of the pose of the robot.
        #[param("global_frame", naming(NamedEntity::Frame))]
        global_frame: String = "map",
        /// Base frame of the robot.
        #[param("robot_base_frame", naming(NamedEntity::Frame))]
        robot_base_frame: String = "base_link",
        /// Maximum age of transforms.
        #[param("transform_tolerance", unit("s"), min(0.0))]
        transform_tolerance_s: f64 = 0.1,
        /// Topic of the odometry.
        #[param("odom_topic", naming(NamedEntity::Topic))]
        odom_topic: String = "odom",
        /// Time over which the velocity is averaged.
        #[param("filter_duration", unit("s"), min(0.0))]
        filter_duration_s: f64 = 0.3,
        /// Period of the ticks of the tree.
        #[param("bt_loop_duration", unit("ms"), within(1.0, 10_000.0))]
        bt_loop_duration_ms: i64 = 10,
        /// Maximum time until a server acknowledges a goal or answers a request.
        #[param("default_server_timeout", unit("ms"), min(0.0))]
        default_server_timeout_ms: i64 = 20,
        /// Maximum time that a result waits until canceled goals are over (Jazzy: 20).
        #[param("default_cancel_timeout", unit("ms"), min(0.0))]
        default_cancel_timeout_ms: i64 = 50,
        /// Maximum time that a tree node waits for its server to exist.
        #[param("wait_for_service_timeout", unit("ms"), min(0.0))]
        wait_for_service_timeout_ms: i64 = 1000,
        /// Time for which results are kept (main: not a parameter).
        #[param("action_server_result_timeout", unit("s"), min(0.0))]
        action_server_result_timeout_s: f64 = 900,
        /// Names of the navigators.
        #[param("navigators")]
        navigators: Vec<String> = "navigate_to_pose navigate_through_poses",
        /// Libraries of tree nodes. All nodes are built in; names of others have no effect.
        #[param("plugin_lib_names")]
        plugin_lib_names: Vec<String> = "",
        /// Blackboard entries with error codes (Jazzy).
        #[param("error_code_names")]
        error_code_names: Vec<String> = "compute_path_error_code follow_path_error_code",
        /// Prefixes of blackboard entries with error codes and messages (main).
        #[param("error_code_name_prefixes")]
        error_code_name_prefixes: Vec<String> = "assisted_teleop backup compute_path dock_robot drive_on_heading follow_object follow_path nav_thru_poses nav_to_pose spin undock_robot wait",
        /// Reads the file of a tree again for each goal.
        #[param("always_reload_bt_xml")]
        always_reload_bt_xml: bool = false,
        /// Publishes status changes to idle.
        #[param("bt_log_idle_transitions")]
        bt_log_idle_transitions: bool = true,
        /// Folders with files of trees that goals may name by ID (main).
        #[param("bt_search_directories")]
        bt_search_directories: Vec<String> = "",
        /// File of the default tree of `navigate_to_pose`; empty for the built-in one.
        #[param("default_nav_to_pose_bt_xml")]
        default_nav_to_pose_bt_xml: String = "",
        /// File of the default tree of `navigate_through_poses`; empty for the built-in one.
        #[param("default_nav_through_poses_bt_xml")]
        default_nav_through_poses_bt_xml: String = "",
        /// Tolerance of the condition `GoalReached`.
        #[param("goal_reached_tol", unit("m"), min(0.0))]
        goal_reached_tol_m: f64 = 0.25,
        /// Topic of the decorator `GoalUpdater`.
        #[param("goal_updater_topic", naming(NamedEntity::Topic))]
        goal_updater_topic: String = "goal_update",
        /// Topic of the decorator `GoalUpdater` for lists of goals.
        #[param("goals_updater_topic", naming(NamedEntity::Topic))]
        goals_updater_topic: String = "goals_update",
        /// Class of the navigator to one pose.
        #[param("navigate_to_pose.plugin")]
        to_pose_plugin: String = "nav2_bt_navigator::NavigateToPoseNavigator",
        /// Blackboard entry of the goal.
        #[param("navigate_to_pose.goal_blackboard_id")]
        goal_blackboard_id: String = "goal",
        /// Blackboard entry of the path.
        #[param("navigate_to_pose.path_blackboard_id")]
        to_pose_path_blackboard_id: String = "path",
        /// Blackboard entry of the tracking feedback (main).
        #[param("navigate_to_pose.tracking_feedback_blackboard_id")]
        to_pose_tracking_feedback_blackboard_id: String = "tracking_feedback",
        /// Length of path in which the closest segment is searched (main).
        #[param("navigate_to_pose.search_window", unit("m"), above(0.0))]
        to_pose_search_window_m: f64 = 2,
        /// Connection of Groot, which does not exist here.
        #[param("navigate_to_pose.enable_groot_monitoring")]
        to_pose_enable_groot_monitoring: bool = false,
        /// Port of Groot.
        #[param("navigate_to_pose.groot_server_port")]
        to_pose_groot_server_port: i64 = 1669,
        /// Class of the navigator through several poses.
        #[param("navigate_through_poses.plugin")]
        through_poses_plugin: String = "nav2_bt_navigator::NavigateThroughPosesNavigator",
        /// Blackboard entry of the goals.
        #[param("navigate_through_poses.goals_blackboard_id")]
        goals_blackboard_id: String = "goals",
        /// Blackboard entry of the path.
        #[param("navigate_through_poses.path_blackboard_id")]
        through_poses_path_blackboard_id: String = "path",
        /// Blackboard entry of the tracking feedback (main).
        #[param("navigate_through_poses.tracking_feedback_blackboard_id")]
        through_poses_tracking_feedback_blackboard_id: String = "tracking_feedback",
        /// Blackboard entry of the statuses of the poses (main).
        #[param("navigate_through_poses.waypoint_statuses_blackboard_id")]
        waypoint_statuses_blackboard_id: String = "waypoint_statuses",
        /// Length of path in which the closest segment is searched (main).
        #[param("navigate_through_poses.search_window", unit("m"), above(0.0))]
        through_poses_search_window_m: f64 = 2,
        /// Connection of Groot, which does not exist here.
        #[param("navigate_through_poses.enable_groot_monitoring")]
        through_poses_enable_groot_monitoring: bool = false,
        /// Port of Groot.
        #[param("navigate_through_poses.groot_server_port")]
        through_poses_groot_server_port: i64 = 1669,
    }
}

/// One millisecond in nanoseconds.
const MILLISECOND_NS: i64 = 1_000_000;

impl BtNavigatorParams {
    /// Reads parameters; those that are not given have the defaults of a release.
    pub fn read<'a>(
        given: impl IntoIterator<Item = Given<'a>>,
        release: Nav2Release,
        diagnostics: &mut Diagnostics,
    ) -> ParamValues {
        let given: Vec<Given<'a>> = given.into_iter().collect();
        let has_timeout = given.iter().any(|one| one.name == "default_cancel_timeout");
        let mut values = BT_NAVIGATOR.check(given, None, diagnostics);
        if release < Nav2Release::Main && !has_timeout {
            values.set("default_cancel_timeout", ParamValue::Integer(20));
        }
        values
    }

    pub(super) fn loop_duration_ns(&self) -> i64 {
        self.bt_loop_duration_ms.max(1) * MILLISECOND_NS
    }

    pub(super) fn server_timeout_ns(&self) -> i64 {
        self.default_server_timeout_ms * MILLISECOND_NS
    }

    pub(super) fn cancel_timeout_ns(&self) -> i64 {
        self.default_cancel_timeout_ms * MILLISECOND_NS
    }

    pub(super) fn wait_for_service_ns(&self) -> i64 {
        self.wait_for_service_timeout_ms * MILLISECOND_NS
    }

    pub(super) fn filter_duration_ns(&self) -> i64 {
        (self.filter_duration_s * 1e9) as i64
    }

    pub(super) fn result_timeout_ns(&self) -> i64 {
        (self.action_server_result_timeout_s * 1e9) as i64
    }
}
