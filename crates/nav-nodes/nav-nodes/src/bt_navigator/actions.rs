//! Actions that tree nodes call: goals from ports, results to ports.
//!
//! Source: `nav2_behavior_tree/plugins/action/*_action.cpp`.

use periplus_behavior_tree::{NodeRun, NodeStatus, TreeError, TreeValue};
use periplus_msgs::builtin_interfaces::Duration;
use periplus_msgs::geometry_msgs::{Point, PoseStamped};
use periplus_msgs::nav_msgs::{Goals, Path};
use periplus_msgs::nav2_msgs_main::{
    self as msgs, AssistedTeleopGoal, BackUpGoal, ComputeAndTrackRouteFeedback,
    ComputeAndTrackRouteGoal, ComputePathThroughPosesGoal, ComputePathThroughPosesResult,
    ComputePathToPoseGoal, ComputeRouteGoal, DockRobotGoal, DriveOnHeadingGoal, FollowObjectGoal,
    FollowPathGoal, FollowPathResult, NavigateThroughPosesGoal, NavigateToPoseGoal, SmoothPathGoal,
    SpinGoal, TrackingFeedback, UndockRobotGoal, WaitGoal,
};

use super::action_node::{ActionResult, End, Feedback, Goal, TreeAction};

/// Nanoseconds per second.
const SECOND_NS: i64 = 1_000_000_000;

/// Duration of a number of seconds.
pub(super) fn duration(seconds: f64) -> Duration {
    duration_ns((seconds * SECOND_NS as f64) as i64)
}

/// Duration of a number of nanoseconds.
pub(super) fn duration_ns(ns: i64) -> Duration {
    let sec = i32::try_from(ns.div_euclid(SECOND_NS)).unwrap_or(i32::MAX);
    let nanosec = u32::try_from(ns.rem_euclid(SECOND_NS)).unwrap_or_default();
    Duration { sec, nanosec }
}

/// Number of a port, 0 without a value.
fn number(run: &NodeRun<'_>, port: &str) -> f64 {
    run.input_f64(port).unwrap_or_default()
}

fn flag(run: &NodeRun<'_>, port: &str) -> bool {
    run.input_bool(port).unwrap_or_default()
}

fn text(run: &NodeRun<'_>, port: &str) -> String {
    run.input_text(port).unwrap_or_default()
}

fn object<T: Clone + Default + 'static>(run: &NodeRun<'_>, port: &str) -> T {
    run.input_object(port).unwrap_or_default()
}

fn id(run: &NodeRun<'_>, port: &str) -> u16 {
    run.input_i64(port).and_then(|id| u16::try_from(id).ok()).unwrap_or_default()
}

/// Adds 1 to the recoveries that the feedback reports.
pub(super) fn count_recovery(run: &mut NodeRun<'_>) -> Result<(), TreeError> {
    let key = "@number_recoveries";
    let count = run.entry(key).and_then(TreeValue::as_i64).unwrap_or_default();
    run.set_entry(key, count + 1)
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// Implements the parts that are equal for all actions with an error in their result.
macro_rules! action {
    ($name:ident, $server:literal, $timeout:expr) => {
        type Action = msgs::$name;
        const SERVER: &'static str = $server;
        const TIMEOUT: u16 = $timeout;

        fn error(result: &ActionResult<Self>) -> (u16, &str) {
            (result.error_code, &result.error_msg)
        }
    };
}

/// Plans to a pose.
#[derive(Default)]
pub(super) struct ComputePathToPose;

impl TreeAction for ComputePathToPose {
    action!(ComputePathToPose, "compute_path_to_pose", msgs::ComputePathToPoseResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        let start: Option<PoseStamped> = run.input_object("start");
        let use_start = run.input_bool("use_start").unwrap_or(true) && start.is_some();
        Ok(ComputePathToPoseGoal {
            goal: run.input_object("goal").ok_or_else(|| run.missing("goal"))?,
            start: start.unwrap_or_default(),
            viapoints: object(run, "viapoints"),
            planner_id: text(run, "planner_id"),
            use_start,
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let path = match end {
            End::Succeeded(result) => result.path.clone(),
            End::Failed => return Ok(()),
            End::Aborted(_) | End::Canceled => Path::default(),
        };
        run.set_output("path", TreeValue::object(path))
    }
}

/// Plans through poses.
#[derive(Default)]
pub(super) struct ComputePathThroughPoses;

impl TreeAction for ComputePathThroughPoses {
    action!(
        ComputePathThroughPoses,
        "compute_path_through_poses",
        ComputePathThroughPosesResult::TIMEOUT
    );

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        let start: Option<PoseStamped> = run.input_object("start");
        let use_start = start.is_some();
        Ok(ComputePathThroughPosesGoal {
            goals: run.input_object::<Goals>("goals").ok_or_else(|| run.missing("goals"))?,
            start: start.unwrap_or_default(),
            planner_id: text(run, "planner_id"),
            use_start,
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let (path, index) = match end {
            End::Succeeded(result) => (Some(result.path.clone()), result.last_reached_index),
            End::Failed => (None, ComputePathThroughPosesResult::ALL_GOALS),
            End::Aborted(_) | End::Canceled => {
                (Some(Path::default()), ComputePathThroughPosesResult::ALL_GOALS)
            }
        };
        if let Some(path) = path {
            run.set_output("path", TreeValue::object(path))?;
        }
        run.set_output("last_reached_index", i64::from(index))
    }
}

/// Smooths a path.
#[derive(Default)]
pub(super) struct SmoothPath;

impl TreeAction for SmoothPath {
    action!(SmoothPath, "smooth_path", msgs::SmoothPathResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(SmoothPathGoal {
            path: object(run, "unsmoothed_path"),
            smoother_id: text(run, "smoother_id"),
            max_smoothing_duration: duration(number(run, "max_smoothing_duration")),
            check_for_collisions: flag(run, "check_for_collisions"),
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let End::Succeeded(result) = end else { return Ok(()) };
        run.set_output("smoothed_path", TreeValue::object(result.path.clone()))?;
        run.set_output("smoothing_duration", result.smoothing_duration.ns() as f64 / 1e9)?;
        run.set_output("was_completed", result.was_completed)
    }
}

/// Follows a path. The goal is sent again when the path or one of the names of plugins changes.
#[derive(Default)]
pub(super) struct FollowPath;

impl FollowPath {
    /// Goal with the names of plugins, without a path.
    fn plugins(run: &NodeRun<'_>) -> FollowPathGoal {
        FollowPathGoal {
            path: Path::default(),
            controller_id: text(run, "controller_id"),
            goal_checker_id: text(run, "goal_checker_id"),
            progress_checker_id: text(run, "progress_checker_id"),
            path_handler_id: text(run, "path_handler_id"),
        }
    }
}

impl TreeAction for FollowPath {
    action!(FollowPath, "follow_path", FollowPathResult::CONTROLLER_TIMED_OUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(FollowPathGoal { path: object(run, "path"), ..Self::plugins(run) })
    }

    fn update(&mut self, run: &mut NodeRun<'_>, goal: &mut Goal<Self>) -> bool {
        let path = std::mem::take(&mut goal.path);
        let new = Self::plugins(run);
        let mut is_new = new != *goal;
        *goal = new;
        // Paths are long: they are copied only when they have changed.
        let value = run.input("path");
        let other = value.as_ref().and_then(|value| value.get::<Path>());
        goal.path = match other.filter(|other| !other.poses.is_empty() && **other != path) {
            Some(other) => {
                is_new = true;
                other.clone()
            }
            None => path,
        };
        is_new
    }

    fn feedback(run: &mut NodeRun<'_>, feedback: Feedback<Self>) -> Result<(), TreeError> {
        run.set_output("tracking_feedback", TreeValue::object(feedback.tracking_feedback))
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        match end {
            End::Failed => Ok(()),
            _ => {
                run.set_output("tracking_feedback", TreeValue::object(TrackingFeedback::default()))
            }
        }
    }
}

/// Turns on the spot.
#[derive(Default)]
pub(super) struct Spin;

impl TreeAction for Spin {
    action!(Spin, "spin", msgs::SpinResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        if flag(run, "is_recovery") {
            count_recovery(run)?;
        }
        Ok(SpinGoal {
            target_yaw: number(run, "spin_dist") as f32,
            time_allowance: duration(number(run, "time_allowance")),
            disable_collision_checks: flag(run, "disable_collision_checks"),
        })
    }
}

/// Drives back.
#[derive(Default)]
pub(super) struct BackUp;

impl TreeAction for BackUp {
    action!(BackUp, "backup", msgs::BackUpResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        count_recovery(run)?;
        Ok(BackUpGoal {
            target: Point { x: number(run, "backup_dist"), ..Point::default() },
            speed: number(run, "backup_speed") as f32,
            time_allowance: duration(number(run, "time_allowance")),
            disable_collision_checks: flag(run, "disable_collision_checks"),
        })
    }
}

/// Drives straight.
#[derive(Default)]
pub(super) struct DriveOnHeading;

impl TreeAction for DriveOnHeading {
    action!(DriveOnHeading, "drive_on_heading", msgs::DriveOnHeadingResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(DriveOnHeadingGoal {
            target: Point { x: number(run, "dist_to_travel"), ..Point::default() },
            speed: number(run, "speed") as f32,
            time_allowance: duration(number(run, "time_allowance")),
            disable_collision_checks: flag(run, "disable_collision_checks"),
        })
    }
}

/// Waits.
#[derive(Default)]
pub(super) struct Wait;

impl TreeAction for Wait {
    action!(Wait, "wait", msgs::WaitResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        count_recovery(run)?;
        Ok(WaitGoal { time: duration(number(run, "wait_duration").abs()) })
    }
}

/// Lets a person drive.
#[derive(Default)]
pub(super) struct AssistedTeleop {
    is_recovery: bool,
}

impl TreeAction for AssistedTeleop {
    action!(AssistedTeleop, "assisted_teleop", msgs::AssistedTeleopResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        self.is_recovery = flag(run, "is_recovery");
        if self.is_recovery {
            count_recovery(run)?;
        }
        Ok(AssistedTeleopGoal { time_allowance: duration(number(run, "time_allowance")) })
    }

    fn aborted(&self) -> NodeStatus {
        if self.is_recovery { NodeStatus::Failure } else { NodeStatus::Success }
    }
}

/// Navigates to a pose with another tree.
#[derive(Default)]
pub(super) struct NavigateToPose;

impl TreeAction for NavigateToPose {
    action!(NavigateToPose, "navigate_to_pose", msgs::NavigateToPoseResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        let pose = run.input_object("goal").ok_or_else(|| run.missing("goal"))?;
        Ok(NavigateToPoseGoal { pose, behavior_tree: text(run, "behavior_tree") })
    }
}

/// Navigates through poses with another tree.
#[derive(Default)]
pub(super) struct NavigateThroughPoses;

impl TreeAction for NavigateThroughPoses {
    action!(
        NavigateThroughPoses,
        "navigate_through_poses",
        msgs::NavigateThroughPosesResult::TIMEOUT
    );

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        let poses = run.input_object("goals").ok_or_else(|| run.missing("goals"))?;
        Ok(NavigateThroughPosesGoal { poses, behavior_tree: text(run, "behavior_tree") })
    }
}

/// Computes a route on a graph.
#[derive(Default)]
pub(super) struct ComputeRoute;

/// Start and goal of a route.
fn route_ends(run: &NodeRun<'_>) -> ComputeRouteGoal {
    ComputeRouteGoal {
        start_id: id(run, "start_id"),
        start: object(run, "start"),
        goal_id: id(run, "goal_id"),
        goal: object(run, "goal"),
        use_start: flag(run, "use_start"),
        use_poses: flag(run, "use_poses"),
    }
}

impl TreeAction for ComputeRoute {
    action!(ComputeRoute, "compute_route", msgs::ComputeRouteResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(route_ends(run))
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let (path, route, time) = match end {
            End::Succeeded(result) => {
                (result.path.clone(), result.route.clone(), result.planning_time.clone())
            }
            End::Failed => return Ok(()),
            End::Aborted(_) | End::Canceled => Default::default(),
        };
        run.set_output("path", TreeValue::object(path))?;
        run.set_output("route", TreeValue::object(route))?;
        run.set_output("planning_time", TreeValue::object(time))
    }
}

/// Computes a route and tracks it.
#[derive(Default)]
pub(super) struct ComputeAndTrackRoute;

impl TreeAction for ComputeAndTrackRoute {
    action!(
        ComputeAndTrackRoute,
        "compute_and_track_route",
        msgs::ComputeAndTrackRouteResult::TIMEOUT
    );

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(track_goal(route_ends(run)))
    }

    fn update(&mut self, run: &mut NodeRun<'_>, goal: &mut Goal<Self>) -> bool {
        let new = track_goal(route_ends(run));
        let is_new = new != *goal;
        *goal = new;
        is_new
    }

    fn feedback(run: &mut NodeRun<'_>, feedback: Feedback<Self>) -> Result<(), TreeError> {
        set_tracking(run, feedback)
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        if let End::Succeeded(result) | End::Aborted(result) = end {
            let time = TreeValue::object(result.execution_duration.clone());
            run.set_output("execution_duration", time)?;
        }
        match end {
            End::Failed => Ok(()),
            _ => set_tracking(run, ComputeAndTrackRouteFeedback::default()),
        }
    }
}

fn track_goal(ends: ComputeRouteGoal) -> ComputeAndTrackRouteGoal {
    let ComputeRouteGoal { start_id, start, goal_id, goal, use_start, use_poses } = ends;
    ComputeAndTrackRouteGoal { start_id, start, goal_id, goal, use_start, use_poses }
}

fn set_tracking(
    run: &mut NodeRun<'_>,
    feedback: ComputeAndTrackRouteFeedback,
) -> Result<(), TreeError> {
    run.set_output("last_node_id", i64::from(feedback.last_node_id))?;
    run.set_output("next_node_id", i64::from(feedback.next_node_id))?;
    run.set_output("current_edge_id", i64::from(feedback.current_edge_id))?;
    run.set_output("rerouted", feedback.rerouted)?;
    if !is_default(&feedback.route) {
        run.set_output("route", TreeValue::object(feedback.route))?;
    }
    if !is_default(&feedback.path) {
        run.set_output("path", TreeValue::object(feedback.path))?;
    }
    Ok(())
}

/// Follows an object.
#[derive(Default)]
pub(super) struct FollowObject;

impl TreeAction for FollowObject {
    action!(FollowObject, "follow_object", msgs::FollowObjectResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(FollowObjectGoal {
            pose_topic: text(run, "pose_topic"),
            tracked_frame: text(run, "tracked_frame"),
            max_duration: duration(number(run, "max_duration")),
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let (End::Succeeded(result) | End::Aborted(result)) = end else { return Ok(()) };
        run.set_output("total_elapsed_time", TreeValue::object(result.total_elapsed_time.clone()))
    }
}

/// Drives into a dock.
#[derive(Default)]
pub(super) struct DockRobot;

impl TreeAction for DockRobot {
    action!(DockRobot, "dock_robot", msgs::DockRobotResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(DockRobotGoal {
            use_dock_id: flag(run, "use_dock_id"),
            dock_id: text(run, "dock_id"),
            dock_pose: object(run, "dock_pose"),
            dock_type: text(run, "dock_type"),
            max_staging_time: number(run, "max_staging_time") as f32,
            navigate_to_staging_pose: flag(run, "navigate_to_staging_pose"),
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let (success, retries) = match end {
            End::Succeeded(result) | End::Aborted(result) => (result.success, result.num_retries),
            End::Canceled | End::Failed => (false, 0),
        };
        run.set_output("success", success)?;
        run.set_output("num_retries", i64::from(retries))
    }
}

/// Leaves a dock.
#[derive(Default)]
pub(super) struct UndockRobot;

impl TreeAction for UndockRobot {
    action!(UndockRobot, "undock_robot", msgs::UndockRobotResult::TIMEOUT);

    fn goal(&mut self, run: &mut NodeRun<'_>) -> Result<Goal<Self>, TreeError> {
        Ok(UndockRobotGoal {
            dock_type: text(run, "dock_type"),
            max_undocking_time: number(run, "max_undocking_time") as f32,
        })
    }

    fn finish(
        &self,
        run: &mut NodeRun<'_>,
        end: &End<'_, ActionResult<Self>>,
    ) -> Result<(), TreeError> {
        let success = match end {
            End::Succeeded(result) | End::Aborted(result) => result.success,
            End::Canceled | End::Failed => false,
        };
        run.set_output("success", success)
    }
}
