//! Conditions on the robot, its odometry and its path.
//!
//! Source: `nav2_behavior_tree/plugins/condition/*.cpp`, `check_stop_status_action.cpp`.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::{Odometry, Path};
use periplus_msgs::nav2_msgs_main::TrackingFeedback;

use super::paths::{distance_m, first_after_m, length_m, min_by};
use super::shared::Shared;

fn holds(is_true: bool) -> NodeStatus {
    if is_true { NodeStatus::Success } else { NodeStatus::Failure }
}

fn frame(run: &NodeRun<'_>, port: &str) -> String {
    run.input_text(port).unwrap_or_default()
}

/// `GoalReached`: the robot is within the tolerance of the goal.
pub(super) fn goal_reached(
    shared: &Shared,
    run: &mut NodeRun<'_>,
) -> Result<NodeStatus, TreeError> {
    let goal: PoseStamped = run.input_object("goal").unwrap_or_default();
    let robot = shared.robot_pose(&goal.header.frame_id, &frame(run, "robot_base_frame"));
    let tolerance_m = shared.params.goal_reached_tol_m;
    Ok(holds(robot.is_ok_and(|robot| distance_m(&robot.pose, &goal.pose) <= tolerance_m)))
}

/// `ArePosesNear`: two poses are within a tolerance.
pub(super) fn are_poses_near(
    shared: &Shared,
    run: &mut NodeRun<'_>,
) -> Result<NodeStatus, TreeError> {
    let [a, b]: [PoseStamped; 2] =
        ["ref_pose", "target_pose"].map(|port| run.input_object(port).unwrap_or_default());
    let tolerance_m = run.input_f64("tolerance").unwrap_or(0.5);
    let global = run.input_text("global_frame").filter(|frame| !frame.is_empty());
    let global = global.unwrap_or_else(|| shared.params.global_frame.clone());
    let poses = if a.header.frame_id == b.header.frame_id {
        Ok([a, b])
    } else {
        shared.transformed(&a, &global).and_then(|a| Ok([a, shared.transformed(&b, &global)?]))
    };
    Ok(holds(poses.is_ok_and(|[a, b]| distance_m(&a.pose, &b.pose) <= tolerance_m)))
}

/// `IsWithinPathTrackingBounds`: the tracking errors are within their limits.
pub(super) fn is_within_bounds(run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
    let Some(feedback) = run.input_object::<TrackingFeedback>("tracking_feedback") else {
        return Ok(NodeStatus::Success);
    };
    // All three have defaults.
    let limit = |port: &str| run.input_f64(port).unwrap_or(f64::INFINITY).abs();
    let position = f64::from(feedback.position_tracking_error);
    let side = if position >= 0.0 { "max_error_left" } else { "max_error_right" };
    let heading = f64::from(feedback.heading_tracking_error).abs();
    let is_within = position.abs() <= limit(side) && heading <= limit("max_error_heading");
    Ok(holds(is_within))
}

/// `IsGoalNearby`: the rest of the path is shorter than a threshold.
pub(super) struct IsGoalNearby {
    shared: Arc<Shared>,
    path: Path,
    /// Index from which the closest pose is searched.
    begin: usize,
}

impl IsGoalNearby {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, path: Path::default(), begin: 0 }
    }
}

impl BehaviorNode for IsGoalNearby {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let new: Path = run.input_object("path").unwrap_or_default();
        let threshold_m = run.input_f64("proximity_threshold").unwrap_or(1.0);
        let search_m = run.input_f64("max_robot_pose_search_dist").unwrap_or(-1.0);
        if new.poses.is_empty() {
            return Ok(NodeStatus::Failure);
        }
        if search_m < 0.0 || new != self.path {
            (self.path, self.begin) = (new, 0);
        }
        let [global, base] = ["global_frame", "robot_base_frame"].map(|port| frame(run, port));
        let robot = self.shared.robot_pose(&global, &base);
        let own_frame = self.path.header.frame_id.clone();
        let robot = robot.and_then(|robot| match own_frame.is_empty() {
            true => Ok(robot),
            false => self.shared.transformed(&robot, &own_frame),
        });
        let Ok(robot) = robot else { return Ok(NodeStatus::Failure) };
        let rest = &self.path.poses[self.begin..];
        let limit_m = if search_m < 0.0 { f64::INFINITY } else { search_m };
        let searched = &rest[..first_after_m(rest, limit_m)];
        self.begin += min_by(searched, |pose| distance_m(&robot.pose, &pose.pose));
        Ok(holds(length_m(&self.path, self.begin) < threshold_m))
    }
}

/// `TransformAvailable`: a transform exists; once seen, it counts as available.
pub(super) struct TransformAvailable {
    shared: Arc<Shared>,
    is_found: bool,
}

impl TransformAvailable {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, is_found: false }
    }
}

impl BehaviorNode for TransformAvailable {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let [child, parent] = ["child", "parent"].map(|port| frame(run, port));
        if child.is_empty() || parent.is_empty() {
            return Err(run.error("the ports `child` and `parent` must name frames"));
        }
        self.is_found |= self.shared.has_transform(&child, &parent);
        Ok(holds(self.is_found))
    }
}

/// Acceleration below which the robot counts as stuck \[m/s²\].
const STUCK_ACCELERATION_M_PER_S2: f64 = -10.0;

/// `IsStuck`: the odometry brakes harder than the robot can.
pub(super) struct IsStuck {
    shared: Arc<Shared>,
    last: Option<Odometry>,
    is_stuck: bool,
}

impl IsStuck {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, last: None, is_stuck: false }
    }
}

impl BehaviorNode for IsStuck {
    fn tick(&mut self, _: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let newest = self.shared.odometry();
        if let (Some(last), Some(new)) = (&self.last, &newest) {
            let dt_ns = new.header.stamp.ns() - last.header.stamp.ns();
            if dt_ns > 0 {
                let dv = new.twist.twist.linear.x - last.twist.twist.linear.x;
                let acceleration = dv / (dt_ns as f64 / 1e9);
                self.is_stuck = acceleration < STUCK_ACCELERATION_M_PER_S2;
            }
        }
        self.last = newest;
        Ok(holds(self.is_stuck))
    }
}

/// `CheckStopStatus`: succeeds when the robot has not moved for a time, and fails when it moves.
pub(super) struct CheckStopStatus {
    shared: Arc<Shared>,
    since_ns: Option<i64>,
}

impl CheckStopStatus {
    pub(super) fn new(shared: Arc<Shared>) -> Self {
        Self { shared, since_ns: None }
    }
}

impl BehaviorNode for CheckStopStatus {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let threshold = run.input_f64("velocity_threshold").unwrap_or(0.01);
        let duration_ms = run.input_i64("duration_stopped").unwrap_or(1000);
        let newest = self.shared.odometry();
        let (stamp_ns, speeds) = match &newest {
            Some(odometry) => {
                let twist = &odometry.twist.twist;
                let speeds = [twist.linear.x, twist.linear.y, twist.angular.z];
                (odometry.header.stamp.ns(), speeds)
            }
            None => (run.now_ns(), [0.0; 3]),
        };
        if speeds.iter().any(|speed| speed.abs() >= threshold) {
            self.since_ns = None;
            return Ok(NodeStatus::Failure);
        }
        let since_ns = *self.since_ns.get_or_insert(stamp_ns);
        if run.now_ns() - since_ns > duration_ms.saturating_mul(1_000_000) {
            self.since_ns = None;
            return Ok(NodeStatus::Success);
        }
        Ok(NodeStatus::Running)
    }
}
