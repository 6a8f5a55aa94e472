//! Registry of all tree nodes of Nav2, with their ports.
//!
//! The ports are those of main with the older names; a tree of an earlier release may use them as well.
//! Source: `nav2_behavior_tree/nav2_tree_nodes.xml` and the nodes.

use std::sync::Arc;

use periplus_behavior_tree::nav2::{self, Nav2NodeRules};
use periplus_behavior_tree::{NodeKind, NodeModel, NodeRegistry, PortType};
use periplus_costmap::Nav2Release;

use super::action_node::{ActionNode, TreeAction};
use super::cancel_node::CancelNode;
use super::service_node::{ServiceNode, TreeService};
use super::shared::Shared;
use super::topic_nodes::{Battery, BatteryCheck, GoalUpdater, PauseResume, Selector};
use super::{actions, condition_nodes, data_nodes, services};

fn object(name: &str) -> PortType {
    PortType::object(name)
}

fn pose() -> PortType {
    object("geometry_msgs/PoseStamped")
}

fn poses() -> PortType {
    object("vector<geometry_msgs/PoseStamped>")
}

fn goals() -> PortType {
    object("nav_msgs/Goals")
}

fn path() -> PortType {
    object("nav_msgs/Path")
}

fn statuses() -> PortType {
    object("vector<nav2_msgs/WaypointStatus>")
}

fn text() -> PortType {
    PortType::Text
}

fn real() -> PortType {
    PortType::real()
}

fn int() -> PortType {
    PortType::int()
}

fn model(name: &str) -> NodeModel {
    NodeModel::new(name, NodeKind::Action)
}

fn condition(name: &str) -> NodeModel {
    NodeModel::new(name, NodeKind::Condition)
}

/// Ports of every client.
fn timeout(model: NodeModel) -> NodeModel {
    model.input("server_timeout", PortType::Milliseconds)
}

/// Creates the registry for trees that work on `shared`.
pub(super) fn registry(shared: &Arc<Shared>) -> NodeRegistry {
    let mut registry = NodeRegistry::new();
    let is_main = shared.release == Nav2Release::Main;
    let rules = if is_main { Nav2NodeRules::MAIN } else { Nav2NodeRules::JAZZY };
    nav2::register(&mut registry, rules);
    let mut nodes = Nodes { registry: &mut registry, shared };
    nodes.planning();
    nodes.behaviors();
    nodes.routes_and_docks();
    nodes.cancel();
    nodes.services();
    nodes.data();
    nodes.selectors();
    nodes.conditions();
    registry
}

struct Nodes<'a> {
    registry: &'a mut NodeRegistry,
    shared: &'a Arc<Shared>,
}

impl Nodes<'_> {
    fn action<T: TreeAction>(&mut self, model: NodeModel) {
        let model = timeout(model)
            .input("server_name", text())
            .output("error_code_id", PortType::uint16())
            .output("error_msg", text());
        let shared = self.shared.clone();
        self.registry.register(model, move || ActionNode::<T>::new(shared.clone()));
    }

    fn service<T: TreeService>(&mut self, model: NodeModel) {
        let model = timeout(model).input("service_name", text());
        let shared = self.shared.clone();
        self.registry.register(model, move || ServiceNode::<T>::new(shared.clone()));
    }

    fn planning(&mut self) {
        let compute = model("ComputePathToPose")
            .input("start", pose())
            .input("use_start", PortType::Bool)
            .input("goal", pose())
            .input("viapoints", poses())
            .input_or("planner_id", text(), "")
            .output("path", path());
        self.action::<actions::ComputePathToPose>(compute);
        let through = model("ComputePathThroughPoses")
            .input("start", pose())
            .input("goals", goals())
            .input_or("planner_id", text(), "")
            .output("path", path())
            .output("last_reached_index", int());
        self.action::<actions::ComputePathThroughPoses>(through);
        let smooth = model("SmoothPath")
            .input("unsmoothed_path", path())
            .input_or("max_smoothing_duration", real(), "3.0")
            .input_or("check_for_collisions", PortType::Bool, "false")
            .input("smoother_id", text())
            .output("smoothed_path", path())
            .output("smoothing_duration", real())
            .output("was_completed", PortType::Bool);
        self.action::<actions::SmoothPath>(smooth);
        let follow = model("FollowPath")
            .input("path", path())
            .input_or("controller_id", text(), "")
            .input("goal_checker_id", text())
            .input("progress_checker_id", text())
            .input("path_handler_id", text())
            .output("tracking_feedback", object("nav2_msgs/TrackingFeedback"));
        self.action::<actions::FollowPath>(follow);
        let to_pose = model("NavigateToPose").input("goal", pose()).input("behavior_tree", text());
        self.action::<actions::NavigateToPose>(to_pose);
        let through =
            model("NavigateThroughPoses").input("goals", goals()).input("behavior_tree", text());
        self.action::<actions::NavigateThroughPoses>(through);
    }

    fn behaviors(&mut self) {
        let moving = |name: &str| {
            model(name).input_or("time_allowance", real(), "10.0").input_or(
                "disable_collision_checks",
                PortType::Bool,
                "false",
            )
        };
        let recovery =
            |model: NodeModel, usual: &str| model.input_or("is_recovery", PortType::Bool, usual);
        let spin = recovery(moving("Spin").input_or("spin_dist", real(), "1.57"), "true");
        self.action::<actions::Spin>(spin);
        let back_up = moving("BackUp").input_or("backup_dist", real(), "0.15").input_or(
            "backup_speed",
            real(),
            "0.025",
        );
        self.action::<actions::BackUp>(back_up);
        let drive = moving("DriveOnHeading").input_or("dist_to_travel", real(), "0.15").input_or(
            "speed",
            real(),
            "0.025",
        );
        self.action::<actions::DriveOnHeading>(drive);
        self.action::<actions::Wait>(model("Wait").input_or("wait_duration", real(), "1.0"));
        let teleop = model("AssistedTeleop").input_or("time_allowance", real(), "10.0");
        self.action::<actions::AssistedTeleop>(recovery(teleop, "false"));
    }

    fn routes_and_docks(&mut self) {
        let ends = |name: &str| {
            model(name)
                .input("start", pose())
                .input("goal", pose())
                .input("start_id", PortType::of_cpp("unsigned int"))
                .input("goal_id", PortType::of_cpp("unsigned int"))
                .input_or("use_start", PortType::Bool, "false")
                .input_or("use_poses", PortType::Bool, "false")
                .output("route", object("nav2_msgs/Route"))
                .output("path", path())
        };
        let duration = || object("builtin_interfaces/Duration");
        self.action::<actions::ComputeRoute>(
            ends("ComputeRoute").output("planning_time", duration()),
        );
        let track = ends("ComputeAndTrackRoute")
            .output("execution_duration", duration())
            .output("last_node_id", PortType::uint16())
            .output("next_node_id", PortType::uint16())
            .output("current_edge_id", PortType::uint16())
            .output("rerouted", PortType::Bool);
        self.action::<actions::ComputeAndTrackRoute>(track);
        let follow = model("FollowObject")
            .input_or("pose_topic", text(), "dynamic_pose")
            .input_or("max_duration", PortType::of_cpp("float"), "0.0")
            .input("tracked_frame", text())
            .output("total_elapsed_time", duration());
        self.action::<actions::FollowObject>(follow);
        let dock = model("DockRobot")
            .input_or("use_dock_id", PortType::Bool, "true")
            .input("dock_id", text())
            .input("dock_pose", pose())
            .input("dock_type", text())
            .input_or("max_staging_time", PortType::of_cpp("float"), "1000.0")
            .input_or("navigate_to_staging_pose", PortType::Bool, "true")
            .output("success", PortType::Bool)
            .output("num_retries", PortType::uint16());
        self.action::<actions::DockRobot>(dock);
        let undock = model("UndockRobot")
            .input("dock_type", text())
            .input_or("max_undocking_time", PortType::of_cpp("float"), "30.0")
            .output("success", PortType::Bool);
        self.action::<actions::UndockRobot>(undock);
    }

    fn cancel(&mut self) {
        for (name, server) in [
            ("CancelControl", "follow_path"),
            ("CancelBackUp", "backup"),
            ("CancelDriveOnHeading", "drive_on_heading"),
            ("CancelSpin", "spin"),
            ("CancelAssistedTeleop", "assisted_teleop"),
            ("CancelWait", "wait"),
            ("CancelComputeAndTrackRoute", "compute_and_track_route"),
            ("CancelFollowObject", "follow_object"),
        ] {
            let shared = self.shared.clone();
            let model = timeout(model(name)).input("server_name", text());
            self.registry.register(model, move || CancelNode::new(shared.clone(), server));
        }
    }

    fn services(&mut self) {
        let plugins = || PortType::List("vector<string>".into());
        let clear = |name: &str| model(name).input("plugins", plugins());
        let region = |name: &str| clear(name).input_or("reset_distance", real(), "1.0");
        self.service::<services::ClearEntireCostmap>(clear("ClearEntireCostmap"));
        self.service::<services::ClearCostmapExceptRegion>(region("ClearCostmapExceptRegion"));
        self.service::<services::ClearCostmapAroundRobot>(region("ClearCostmapAroundRobot"));
        let around = region("ClearCostmapAroundPose").input("pose", pose());
        self.service::<services::ClearCostmapAroundPose>(around);
        let global = model("ReinitializeGlobalLocalization");
        self.service::<services::ReinitializeGlobalLocalization>(global);
        let toggle = model("ToggleCollisionMonitor").input_or("enable", PortType::Bool, "true");
        self.service::<services::ToggleCollisionMonitor>(toggle);
        let unsigned = || PortType::of_cpp("unsigned int");
        let check = |model: NodeModel| {
            model
                .input("path", path())
                .input_or("max_cost", unsigned(), "254")
                .input_or("consider_unknown_as_obstacle", PortType::Bool, "false")
                .input_or("layer_name", text(), "")
                .input_or("footprint", text(), "")
        };
        let validate = check(model("ValidatePath"))
            .input_or("stop_at_first_collision", PortType::Bool, "true")
            .input_or("max_lookahead_distance", real(), "-1.0")
            .output("collision_poses", poses());
        self.service::<services::ValidatePath>(validate);
        self.service::<services::ValidatePath>(check(condition("IsPathValid")));
        let costs = |name: &str| {
            model(name)
                .input_or("cost_threshold", real(), "254.0")
                .input_or("use_footprint", PortType::Bool, "true")
                .input_or("consider_unknown_as_obstacle", PortType::Bool, "false")
        };
        let remove = costs("RemoveInCollisionGoals")
            .input("input_goals", goals())
            .input("input_waypoint_statuses", statuses())
            .output("output_goals", goals())
            .output("output_waypoint_statuses", statuses());
        self.service::<services::RemoveInCollisionGoals>(remove);
        let occupancy = costs("CheckPoseOccupancy").input("pose", pose());
        self.service::<services::CheckPoseOccupancy>(occupancy);
    }

    fn data(&mut self) {
        let truncate = model("TruncatePath")
            .input("input_path", path())
            .input_or("distance", real(), "1.0")
            .output("output_path", path());
        self.registry.register_leaf(truncate, data_nodes::truncate_path);
        let local = model("TruncatePathLocal")
            .input("input_path", path())
            .input_or("distance_forward", real(), "8.0")
            .input_or("distance_backward", real(), "4.0")
            .input("robot_base_frame", text())
            // The name up to Jazzy.
            .input("robot_frame", text())
            .input_or("transform_tolerance", real(), "0.2")
            .input("pose", pose())
            .input_or("angular_distance_weight", real(), "0.0")
            .input_or("max_robot_pose_search_dist", real(), "inf")
            .output("output_path", path());
        let shared = self.shared.clone();
        let local_node = move || data_nodes::TruncatePathLocal::new(shared.clone());
        self.registry.register(local, local_node);
        let passed = model("RemovePassedGoals")
            .input_or("radius", real(), "0.5")
            .input("global_frame", text())
            .input("robot_base_frame", text())
            .input("input_goals", goals())
            .input("input_waypoint_statuses", statuses())
            .output("output_goals", goals())
            .output("output_waypoint_statuses", statuses());
        let shared = self.shared.clone();
        self.registry
            .register_leaf(passed, move |run| data_nodes::remove_passed_goals(&shared, run));
        let from_path = model("GetPoseFromPath")
            .input("path", path())
            .input_or("index", int(), "0")
            .output("pose", pose());
        self.registry.register_leaf(from_path, data_nodes::get_pose_from_path);
        let current = model("GetCurrentPose")
            .input("robot_base_frame", text())
            .input("global_frame", text())
            .output("current_pose", pose());
        let shared = self.shared.clone();
        self.registry.register_leaf(current, move |run| data_nodes::get_current_pose(&shared, run));
        let join = model("ConcatenatePaths")
            .input("input_path1", path())
            .input("input_path2", path())
            .output("output_path", path());
        self.registry.register_leaf(join, data_nodes::concatenate_paths);
        let append = model("AppendGoalPoseToGoals")
            .input("goal_pose", pose())
            .input("input_goals", goals())
            .output("output_goals", goals());
        self.registry.register_leaf(append, data_nodes::append_goal);
        let few = model("GetNextFewGoals")
            .input("num_goals", int())
            .input("input_goals", goals())
            .output("output_goals", goals());
        self.registry.register_leaf(few, data_nodes::get_next_few_goals);
        let extract = model("ExtractRouteNodesAsGoals")
            .input("route", object("nav2_msgs/Route"))
            .output("goals", goals());
        self.registry.register_leaf(extract, data_nodes::extract_route_nodes);
        let stop = model("CheckStopStatus")
            .input_or("velocity_threshold", real(), "0.01")
            .input_or("duration_stopped", PortType::Milliseconds, "1000");
        let shared = self.shared.clone();
        let stop_node = move || condition_nodes::CheckStopStatus::new(shared.clone());
        self.registry.register(stop, stop_node);
    }

    fn selectors(&mut self) {
        for (name, plugin) in [
            ("PlannerSelector", "planner"),
            ("ControllerSelector", "controller"),
            ("SmootherSelector", "smoother"),
            ("GoalCheckerSelector", "goal_checker"),
            ("ProgressCheckerSelector", "progress_checker"),
            ("PathHandlerSelector", "path_handler"),
        ] {
            let model = model(name)
                .input_or("topic_name", text(), &format!("{plugin}_selector"))
                .input(&format!("default_{plugin}"), text())
                .output(&format!("selected_{plugin}"), text());
            let shared = self.shared.clone();
            self.registry.register(model, move || Selector::new(shared.clone(), plugin));
        }
        let updater = NodeModel::new("GoalUpdater", NodeKind::Decorator)
            .input("input_goal", pose())
            .input("input_goals", goals())
            .output("output_goal", pose())
            .output("output_goals", goals());
        let shared = self.shared.clone();
        self.registry.register(updater, move || GoalUpdater::new(shared.clone()));
        let pause = NodeModel::new("PauseResumeController", NodeKind::Control)
            .input("pause_service_name", text())
            .input("resume_service_name", text());
        let shared = self.shared.clone();
        self.registry.register(pause, move || PauseResume::new(shared.clone()));
    }

    fn conditions(&mut self) {
        let frames = |model: NodeModel| {
            model.input("global_frame", text()).input("robot_base_frame", text())
        };
        let reached = frames(condition("GoalReached").input("goal", pose()));
        let shared = self.shared.clone();
        self.registry
            .register_leaf(reached, move |run| condition_nodes::goal_reached(&shared, run));
        let near = condition("ArePosesNear")
            .input("ref_pose", pose())
            .input("target_pose", pose())
            .input("global_frame", text())
            .input_or("tolerance", real(), "0.5");
        let shared = self.shared.clone();
        self.registry.register_leaf(near, move |run| condition_nodes::are_poses_near(&shared, run));
        let bounds = condition("IsWithinPathTrackingBounds")
            .input_or("max_error_left", real(), "0.5")
            .input_or("max_error_right", real(), "0.5")
            .input_or("max_error_heading", real(), "3.14")
            .input("tracking_feedback", object("nav2_msgs/TrackingFeedback"));
        self.registry.register_leaf(bounds, condition_nodes::is_within_bounds);
        let nearby = frames(condition("IsGoalNearby"))
            .input("path", path())
            .input_or("proximity_threshold", real(), "1.0")
            .input_or("max_robot_pose_search_dist", real(), "-1.0");
        let shared = self.shared.clone();
        self.registry.register(nearby, move || condition_nodes::IsGoalNearby::new(shared.clone()));
        let available = condition("TransformAvailable").input_or("child", text(), "").input_or(
            "parent",
            text(),
            "",
        );
        let shared = self.shared.clone();
        let node = move || condition_nodes::TransformAvailable::new(shared.clone());
        self.registry.register(available, node);
        let shared = self.shared.clone();
        let stuck = move || condition_nodes::IsStuck::new(shared.clone());
        self.registry.register(condition("IsStuck"), stuck);
        let battery =
            |name: &str| condition(name).input_or("battery_topic", text(), "/battery_status");
        let low = battery("IsBatteryLow").input("min_battery", real()).input_or(
            "is_voltage",
            PortType::Bool,
            "false",
        );
        for (model, check) in
            [(low, BatteryCheck::Low), (battery("IsBatteryCharging"), BatteryCheck::Charging)]
        {
            let shared = self.shared.clone();
            self.registry.register(model, move || Battery::new(shared.clone(), check));
        }
    }
}
