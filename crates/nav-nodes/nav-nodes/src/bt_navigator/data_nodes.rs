//! Tree nodes that work on paths and goals of the blackboard.
//!
//! Source: `nav2_behavior_tree/plugins/action/*_action.cpp`.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError, TreeValue};
use periplus_geometry::DQuat;
use periplus_msgs::geometry_msgs::{Pose, PoseStamped, Quaternion};
use periplus_msgs::nav_msgs::{Goals, Path};
use periplus_msgs::nav2_msgs_main::{Route, WaypointStatus};
use periplus_msgs::std_msgs::Header;

use super::paths::{distance_m, first_after_m, min_by};
use super::shared::Shared;

/// Marks the first pending waypoint with the pose of a goal; false if there is none.
pub(super) fn mark_waypoint(
    statuses: &mut [WaypointStatus],
    goal: &PoseStamped,
    status: u8,
) -> bool {
    let matches = |one: &&mut WaypointStatus| {
        one.waypoint_status == WaypointStatus::PENDING && one.waypoint_pose == *goal
    };
    match statuses.iter_mut().find(matches) {
        Some(found) => {
            found.waypoint_status = status;
            true
        }
        None => false,
    }
}

fn path(run: &NodeRun<'_>, port: &str) -> Path {
    run.input_object(port).unwrap_or_default()
}

fn goals(run: &NodeRun<'_>, port: &str) -> Goals {
    run.input_object(port).unwrap_or_default()
}

/// Removes the end of a path; its new end points at the old one.
pub(super) fn truncate_path(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let limit_m = run.input_f64("distance").unwrap_or(1.0);
    let mut truncated = path(run, "input_path");
    if let Some(end) = truncated.poses.last().cloned() {
        while truncated.poses.len() > 2
            && truncated
                .poses
                .last()
                .is_some_and(|last| distance_m(&last.pose, &end.pose) < limit_m)
        {
            truncated.poses.pop();
        }
        if let Some(last) = truncated.poses.last_mut() {
            let [dx, dy] = [
                end.pose.position.x - last.pose.position.x,
                end.pose.position.y - last.pose.position.y,
            ];
            let yaw = libm::atan2(dy, dx);
            last.pose.orientation =
                Quaternion { x: 0.0, y: 0.0, z: libm::sin(yaw / 2.0), w: libm::cos(yaw / 2.0) };
        }
    }
    run.set_output("output_path", TreeValue::object(truncated))?;
    Ok(NodeStatus::Success)
}

/// `TruncatePathLocal`: keeps the part of a path around the robot.
pub(super) struct TruncatePathLocal {
    shared: Arc<Shared>,
    path: Path,
    /// Index from which the closest pose is searched.
    begin: usize,
}

impl TruncatePathLocal {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, path: Path::default(), begin: 0 }
    }

    fn robot(&self, run: &NodeRun<'_>) -> Result<PoseStamped, String> {
        if let Some(pose) = run.input_object("pose") {
            return Ok(pose);
        }
        let base = run.input_text("robot_base_frame").or(run.input_text("robot_frame"));
        self.shared.robot_pose(&self.path.header.frame_id, &base.unwrap_or_default())
    }
}

/// Distance with the angle between two poses, weighted.
fn weighted_distance(a: &Pose, b: &Pose, angular_weight: f64) -> f64 {
    let rotation = |q: &Quaternion| DQuat::from_xyzw(q.x, q.y, q.z, q.w);
    let dot = rotation(&a.orientation).dot(rotation(&b.orientation)).abs().min(1.0);
    let angle = 2.0 * libm::acos(dot);
    libm::hypot(distance_m(a, b), angular_weight * angle)
}

impl BehaviorNode for TruncatePathLocal {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let forward_m = run.input_f64("distance_forward").unwrap_or(8.0);
        let forward_m = if forward_m < 0.0 { f64::MAX } else { forward_m };
        let backward_m = run.input_f64("distance_backward").unwrap_or(4.0);
        let weight = run.input_f64("angular_distance_weight").unwrap_or_default();
        let search_m = run.input_f64("max_robot_pose_search_dist").unwrap_or(f64::INFINITY);
        let new = path(run, "input_path");
        if !search_m.is_finite() || new != self.path {
            (self.path, self.begin) = (new, 0);
        }
        let robot = match self.robot(run) {
            Ok(robot) => robot,
            Err(error) => {
                self.shared.node.log(periplus_graph::Level::Error, error);
                return Ok(NodeStatus::Failure);
            }
        };
        let poses = &self.path.poses;
        if poses.is_empty() {
            run.set_output("output_path", TreeValue::object(self.path.clone()))?;
            return Ok(NodeStatus::Success);
        }
        let rest = &poses[self.begin..];
        let searched = &rest[..first_after_m(rest, search_m)];
        let measure = |pose: &PoseStamped| weighted_distance(&robot.pose, &pose.pose, weight);
        let closest = self.begin + min_by(searched, measure);
        let end = closest + first_after_m(&poses[closest..], forward_m);
        let behind = first_after_m(poses[..=closest].iter().rev(), backward_m);
        let start = closest + 1 - behind;
        let part = Path { header: self.path.header.clone(), poses: poses[start..end].to_vec() };
        if search_m.is_finite() {
            self.begin = closest;
        }
        run.set_output("output_path", TreeValue::object(part))?;
        Ok(NodeStatus::Success)
    }
}

/// Removes goals that the robot has passed; the last one stays.
pub(super) fn remove_passed_goals(
    shared: &Shared,
    run: &mut NodeRun<'_>,
) -> Result<NodeStatus, TreeError> {
    let mut left = goals(run, "input_goals");
    let Some(first) = left.goals.first() else {
        run.set_output("output_goals", TreeValue::object(left))?;
        return Ok(NodeStatus::Success);
    };
    let radius_m = run.input_f64("radius").unwrap_or(0.5);
    let base = run.input_text("robot_base_frame").unwrap_or_default();
    let Ok(robot) = shared.robot_pose(&first.header.frame_id, &base) else {
        return Ok(NodeStatus::Failure);
    };
    let mut statuses: Option<Vec<WaypointStatus>> = run.input_object("input_waypoint_statuses");
    let mut passed = 0;
    while left.goals.len() - passed > 1
        && distance_m(&left.goals[passed].pose, &robot.pose) <= radius_m
    {
        if let Some(statuses) = &mut statuses
            && !mark_waypoint(statuses, &left.goals[passed], WaypointStatus::COMPLETED)
        {
            return Ok(NodeStatus::Failure);
        }
        passed += 1;
    }
    left.goals.drain(..passed);
    run.set_output("output_goals", TreeValue::object(left))?;
    if let Some(statuses) = statuses {
        run.set_output("output_waypoint_statuses", TreeValue::object(statuses))?;
    }
    Ok(NodeStatus::Success)
}

/// Takes one pose of a path; negative indices count from its end.
pub(super) fn get_pose_from_path(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let path = path(run, "path");
    let index = run.input_i64("index").unwrap_or_default();
    let count = i64::try_from(path.poses.len()).unwrap_or(i64::MAX);
    let index = if index < 0 { index + count } else { index };
    let pose = usize::try_from(index).ok().and_then(|index| path.poses.get(index));
    let Some(mut pose) = pose.cloned() else { return Ok(NodeStatus::Failure) };
    if pose.header.frame_id.is_empty() {
        pose.header.frame_id = path.header.frame_id;
    }
    run.set_output("pose", TreeValue::object(pose))?;
    Ok(NodeStatus::Success)
}

/// Writes the pose of the robot.
pub(super) fn get_current_pose(
    shared: &Shared,
    run: &mut NodeRun<'_>,
) -> Result<NodeStatus, TreeError> {
    let [global, base] =
        ["global_frame", "robot_base_frame"].map(|port| run.input_text(port).unwrap_or_default());
    let Ok(pose) = shared.robot_pose(&global, &base) else { return Ok(NodeStatus::Failure) };
    run.set_output("current_pose", TreeValue::object(pose))?;
    Ok(NodeStatus::Success)
}

/// Joins two paths.
pub(super) fn concatenate_paths(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let [mut first, second] = ["input_path1", "input_path2"].map(|port| path(run, port));
    if first.poses.is_empty() && second.poses.is_empty() {
        return Ok(NodeStatus::Failure);
    }
    if first.header == Header::default() {
        first.header = second.header;
    }
    first.poses.extend(second.poses);
    run.set_output("output_path", TreeValue::object(first))?;
    Ok(NodeStatus::Success)
}

/// Appends a goal to a list.
pub(super) fn append_goal(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let mut list = goals(run, "input_goals");
    list.goals.push(run.input_object("goal_pose").unwrap_or_default());
    run.set_output("output_goals", TreeValue::object(list))?;
    Ok(NodeStatus::Success)
}

/// Takes the first goals of a list.
pub(super) fn get_next_few_goals(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let mut list = goals(run, "input_goals");
    if list.goals.is_empty() {
        return Ok(NodeStatus::Failure);
    }
    let count = run.input_i64("num_goals").unwrap_or_default();
    list.goals.truncate(usize::try_from(count).unwrap_or_default());
    run.set_output("output_goals", TreeValue::object(list))?;
    Ok(NodeStatus::Success)
}

/// Converts the nodes of a route to goals.
pub(super) fn extract_route_nodes(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let route: Route = run.input_object("route").unwrap_or_default();
    if route.nodes.is_empty() {
        return Ok(NodeStatus::Failure);
    }
    let goal = |node: &periplus_msgs::nav2_msgs_main::RouteNode| {
        let mut goal = PoseStamped { header: route.header.clone(), ..PoseStamped::default() };
        goal.pose.position.x = node.position.x;
        goal.pose.position.y = node.position.y;
        goal
    };
    let list =
        Goals { header: route.header.clone(), goals: route.nodes.iter().map(goal).collect() };
    run.set_output("goals", TreeValue::object(list))?;
    Ok(NodeStatus::Success)
}
