//! Services that tree nodes call.
//!
//! Source: `clear_costmap_service.cpp`, `validate_path_action.cpp`, `is_path_valid_condition.cpp`,
//! `remove_in_collision_goals_action.cpp`, `check_pose_occupancy_action.cpp` and others.

use periplus_behavior_tree::{NodeRun, NodeStatus, TreeError, TreeValue};
use periplus_costmap::Nav2Release;
use periplus_graph::{GraphError, Node};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::{Goals, Path};
use periplus_msgs::nav2_msgs_main::{
    self as msgs, ClearCostmapAroundPoseRequest, ClearCostmapAroundPoseResponse,
    ClearCostmapAroundRobotRequest, ClearCostmapAroundRobotResponse,
    ClearCostmapExceptRegionRequest, ClearCostmapExceptRegionResponse, ClearEntireCostmapRequest,
    ClearEntireCostmapResponse, GetCostsRequest, GetCostsResponse, IsPathValidRequest,
    IsPathValidResponse, ToggleRequest, ToggleResponse, WaypointStatus,
};
use periplus_msgs::std_srvs::{Empty, EmptyRequest, EmptyResponse};

use super::actions::count_recovery;
use super::data_nodes::mark_waypoint;
use super::service_node::{Caller, TreeService};

fn holds(is_true: bool) -> NodeStatus {
    if is_true { NodeStatus::Success } else { NodeStatus::Failure }
}

fn plugins(run: &NodeRun<'_>) -> Vec<String> {
    run.input_list("plugins").unwrap_or_default()
}

/// Implements a service that clears a costmap.
macro_rules! clearing {
    ($(#[$doc:meta])* $name:ident $request:ident $response:ident |$run:ident| { $($field:ident: $value:expr),* }) => {
        $(#[$doc])*
        #[derive(Default)]
        pub(super) struct $name;

        impl TreeService for $name {
            type Service = msgs::$name;
            const SERVER: &'static str = "";

            fn caller(
                node: &Node,
                release: Nav2Release,
                name: &str,
            ) -> Result<Caller<Self::Service>, GraphError> {
                Caller::of_release(node, release, name)
            }

            fn request(&mut self, $run: &mut NodeRun<'_>) -> Result<Option<$request>, TreeError> {
                count_recovery($run)?;
                Ok(Some($request { $($field: $value,)* plugins: plugins($run) }))
            }

            fn finish(
                &mut self,
                _: &mut NodeRun<'_>,
                response: &$response,
            ) -> Result<NodeStatus, TreeError> {
                Ok(holds(response.success))
            }

            fn failure(response: &$response) -> Option<String> {
                (!response.success).then(|| "the costmap was not cleared".to_owned())
            }
        }
    };
}

clearing! {
    /// Clears a costmap.
    ClearEntireCostmap ClearEntireCostmapRequest ClearEntireCostmapResponse |run| {}
}

clearing! {
    /// Clears a costmap outside of a square.
    ClearCostmapExceptRegion ClearCostmapExceptRegionRequest ClearCostmapExceptRegionResponse |run| {
        reset_distance: run.input_f64("reset_distance").unwrap_or(1.0) as f32
    }
}

clearing! {
    /// Clears a costmap around the robot.
    ClearCostmapAroundRobot ClearCostmapAroundRobotRequest ClearCostmapAroundRobotResponse |run| {
        reset_distance: run.input_f64("reset_distance").unwrap_or(1.0) as f32
    }
}

clearing! {
    /// Clears a costmap around a pose.
    ClearCostmapAroundPose ClearCostmapAroundPoseRequest ClearCostmapAroundPoseResponse |run| {
        pose: run.input_object("pose").unwrap_or_default(),
        reset_distance: run.input_f64("reset_distance").unwrap_or(1.0)
    }
}

/// Requests global localization.
#[derive(Default)]
pub(super) struct ReinitializeGlobalLocalization;

impl TreeService for ReinitializeGlobalLocalization {
    type Service = Empty;
    const SERVER: &'static str = "reinitialize_global_localization";

    fn caller(node: &Node, release: Nav2Release, name: &str) -> Result<Caller<Empty>, GraphError> {
        Caller::new(node, release, name)
    }

    fn request(&mut self, run: &mut NodeRun<'_>) -> Result<Option<EmptyRequest>, TreeError> {
        count_recovery(run)?;
        Ok(Some(EmptyRequest::default()))
    }

    fn finish(&mut self, _: &mut NodeRun<'_>, _: &EmptyResponse) -> Result<NodeStatus, TreeError> {
        Ok(NodeStatus::Success)
    }
}

/// Switches the collision monitor.
#[derive(Default)]
pub(super) struct ToggleCollisionMonitor;

impl TreeService for ToggleCollisionMonitor {
    type Service = msgs::Toggle;
    const SERVER: &'static str = "collision_monitor/toggle";

    fn caller(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Caller<msgs::Toggle>, GraphError> {
        Caller::new(node, release, name)
    }

    fn request(&mut self, run: &mut NodeRun<'_>) -> Result<Option<ToggleRequest>, TreeError> {
        Ok(Some(ToggleRequest { enable: run.input_bool("enable").unwrap_or(true) }))
    }

    fn finish(
        &mut self,
        _: &mut NodeRun<'_>,
        response: &ToggleResponse,
    ) -> Result<NodeStatus, TreeError> {
        Ok(holds(response.success))
    }
}

/// Checks a path: `ValidatePath` and the older condition `IsPathValid`.
#[derive(Default)]
pub(super) struct ValidatePath {
    path: Path,
}

impl TreeService for ValidatePath {
    type Service = msgs::IsPathValid;
    const SERVER: &'static str = "is_path_valid";

    fn caller(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Caller<msgs::IsPathValid>, GraphError> {
        Caller::of_release(node, release, name)
    }

    fn request(&mut self, run: &mut NodeRun<'_>) -> Result<Option<IsPathValidRequest>, TreeError> {
        self.path = run.input_object("path").unwrap_or_default();
        let usual = IsPathValidRequest::default();
        let max_cost = run.input_i64("max_cost").and_then(|cost| u8::try_from(cost).ok());
        Ok(Some(IsPathValidRequest {
            path: self.path.clone(),
            max_cost: max_cost.unwrap_or(usual.max_cost),
            consider_unknown_as_obstacle: run
                .input_bool("consider_unknown_as_obstacle")
                .unwrap_or_default(),
            layer_name: run.input_text("layer_name").unwrap_or_default(),
            footprint: run.input_text("footprint").unwrap_or_default(),
            stop_at_first_collision: run.input_bool("stop_at_first_collision").unwrap_or(true),
            max_lookahead_distance: run
                .input_f64("max_lookahead_distance")
                .unwrap_or(usual.max_lookahead_distance),
        }))
    }

    fn finish(
        &mut self,
        run: &mut NodeRun<'_>,
        response: &IsPathValidResponse,
    ) -> Result<NodeStatus, TreeError> {
        if !response.success {
            return Ok(NodeStatus::Failure);
        }
        let pose = |index: &i32| self.path.poses.get(usize::try_from(*index).ok()?).cloned();
        let poses: Vec<PoseStamped> = match response.is_valid {
            true => Vec::new(),
            false => response.invalid_pose_indices.iter().filter_map(pose).collect(),
        };
        run.set_output("collision_poses", TreeValue::object(poses))?;
        Ok(holds(response.is_valid))
    }

    fn failure(response: &IsPathValidResponse) -> Option<String> {
        (!response.success).then(|| "the path could not be checked".to_owned())
    }
}

/// Name of the service for costs of poses.
const GET_COSTS: &str = "/global_costmap/get_cost_global_costmap";

/// True if a pose of this cost is free by the ports.
fn is_free(run: &NodeRun<'_>, cost: f32) -> bool {
    let threshold = run.input_f64("cost_threshold").unwrap_or(254.0);
    let is_unknown_blocked = run.input_bool("consider_unknown_as_obstacle").unwrap_or_default();
    (cost == 255.0 && !is_unknown_blocked) || f64::from(cost) < threshold
}

/// Removes goals in obstacles.
#[derive(Default)]
pub(super) struct RemoveInCollisionGoals {
    goals: Goals,
}

impl TreeService for RemoveInCollisionGoals {
    type Service = msgs::GetCosts;
    const SERVER: &'static str = GET_COSTS;

    fn caller(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Caller<msgs::GetCosts>, GraphError> {
        Caller::new(node, release, name)
    }

    fn request(&mut self, run: &mut NodeRun<'_>) -> Result<Option<GetCostsRequest>, TreeError> {
        self.goals = run.input_object("input_goals").unwrap_or_default();
        if self.goals.goals.is_empty() {
            run.set_output("output_goals", TreeValue::object(self.goals.clone()))?;
            return Ok(None);
        }
        let use_footprint = run.input_bool("use_footprint").unwrap_or(true);
        Ok(Some(GetCostsRequest { use_footprint, poses: self.goals.goals.clone() }))
    }

    fn finish(
        &mut self,
        run: &mut NodeRun<'_>,
        response: &GetCostsResponse,
    ) -> Result<NodeStatus, TreeError> {
        if !response.success {
            run.set_output("output_goals", TreeValue::object(self.goals.clone()))?;
            return Ok(NodeStatus::Failure);
        }
        let mut statuses: Option<Vec<WaypointStatus>> = run.input_object("input_waypoint_statuses");
        let mut free = Goals { header: self.goals.header.clone(), goals: Vec::new() };
        for (goal, cost) in self.goals.goals.iter().zip(&response.costs) {
            if is_free(run, *cost) {
                free.goals.push(goal.clone());
            } else if let Some(statuses) = &mut statuses
                && !mark_waypoint(statuses, goal, WaypointStatus::SKIPPED)
            {
                return Ok(NodeStatus::Failure);
            }
        }
        run.set_output("output_goals", TreeValue::object(free))?;
        if let Some(statuses) = statuses {
            run.set_output("output_waypoint_statuses", TreeValue::object(statuses))?;
        }
        Ok(NodeStatus::Success)
    }

    fn failure(response: &GetCostsResponse) -> Option<String> {
        (!response.success).then(|| "the costs of the goals are not available".to_owned())
    }
}

/// Succeeds if a pose is in an obstacle.
#[derive(Default)]
pub(super) struct CheckPoseOccupancy;

impl TreeService for CheckPoseOccupancy {
    type Service = msgs::GetCosts;
    const SERVER: &'static str = GET_COSTS;

    fn caller(
        node: &Node,
        release: Nav2Release,
        name: &str,
    ) -> Result<Caller<msgs::GetCosts>, GraphError> {
        Caller::new(node, release, name)
    }

    fn request(&mut self, run: &mut NodeRun<'_>) -> Result<Option<GetCostsRequest>, TreeError> {
        let use_footprint = run.input_bool("use_footprint").unwrap_or(true);
        let poses = vec![run.input_object("pose").unwrap_or_default()];
        Ok(Some(GetCostsRequest { use_footprint, poses }))
    }

    fn finish(
        &mut self,
        run: &mut NodeRun<'_>,
        response: &GetCostsResponse,
    ) -> Result<NodeStatus, TreeError> {
        let cost = response.costs.first().filter(|_| response.success);
        Ok(holds(cost.is_some_and(|cost| !is_free(run, *cost))))
    }

    fn failure(response: &GetCostsResponse) -> Option<String> {
        (!response.success).then(|| "the cost of the pose is not available".to_owned())
    }
}
