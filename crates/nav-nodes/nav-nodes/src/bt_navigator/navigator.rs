//! Execution of a tree for the goals of one action.
//!
//! Source: `nav2_behavior_tree/bt_action_server_impl.hpp`, `behavior_tree_engine.cpp` and
//! `nav2_core/behavior_tree_navigator.hpp`.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorTree, Blackboard, NodeStatus, TreeValue};
use periplus_costmap::Nav2Release;
use periplus_graph::{Level, Publisher};
use periplus_msgs::builtin_interfaces::{Duration, Time};
use periplus_msgs::geometry_msgs::PoseStamped;
use periplus_msgs::nav_msgs::Path;
use periplus_msgs::nav2_msgs::{BehaviorTreeLog, BehaviorTreeStatusChange};
use periplus_msgs::nav2_msgs_main::TrackingFeedback;
use periplus_msgs::{Action, Nav2Action};

use super::actions::{duration, duration_ns};
use super::loading::TreeLoader;
use super::parameters::BtNavigatorParams;
use super::paths::{self, RemainingLengths};
use super::shared::{Context, Shared};
use super::status::NavigatorStatus;
use crate::simple_action_server::SimpleActionServer;

/// Speed above which the remaining time is estimated \[m/s\].
const MIN_SPEED_M_PER_S: f64 = 0.01;
/// Distance above which the remaining time is estimated \[m\].
const MIN_DISTANCE_M: f64 = 0.1;

/// Everything that navigators share.
#[derive(Clone)]
pub(super) struct Environment {
    pub(super) shared: Arc<Shared>,
    pub(super) loader: Arc<TreeLoader>,
    pub(super) log: Option<Arc<Publisher<BehaviorTreeLog>>>,
}

/// Numbers of an action's own errors, in main.
pub(super) struct OwnCodes {
    pub(super) unknown: u16,
    pub(super) failed_to_load: u16,
    pub(super) tf_error: u16,
}

/// Part of the feedback that all navigators have.
pub(super) struct CommonFeedback {
    pub(super) current_pose: PoseStamped,
    pub(super) navigation_time: Duration,
    pub(super) estimated_time_remaining: Duration,
    pub(super) number_of_recoveries: i16,
    pub(super) distance_remaining: f32,
    pub(super) position_tracking_error: f32,
    pub(super) heading_tracking_error: f32,
}

/// Error of a goal: code and message.
pub(super) type GoalError = (u16, String);

/// Action of a navigator.
pub(super) trait NavigatorKind: Send + 'static {
    type Action: Nav2Action;
    /// Name of the action.
    const NAME: &'static str;
    /// Built-in default tree.
    const DEFAULT_FILE: &'static str;
    const CODES: OwnCodes;

    /// File of the default tree by the parameters.
    fn default_tree(params: &BtNavigatorParams) -> &str;
    /// Blackboard entries of the path and the tracking feedback, and the search window \[m\].
    fn entries(params: &BtNavigatorParams) -> (&str, &str, f64);
    /// Tree that a goal names.
    fn tree_name(goal: &<Self::Action as Action>::Goal) -> &str;
    /// Poses of a goal.
    fn poses(goal: &<Self::Action as Action>::Goal) -> &[PoseStamped];
    /// Entries of the blackboard for a goal whose poses are in the global frame.
    fn entries_of_goal(
        params: &BtNavigatorParams,
        goal: &<Self::Action as Action>::Goal,
        poses: Vec<PoseStamped>,
    ) -> Vec<(String, TreeValue)>;
    /// Feedback.
    fn feedback(
        params: &BtNavigatorParams,
        common: CommonFeedback,
        blackboard: &Blackboard,
    ) -> <Self::Action as Action>::Feedback;
    /// Result.
    fn result(
        params: &BtNavigatorParams,
        error: GoalError,
        blackboard: Option<&Blackboard>,
        is_success: bool,
    ) -> <Self::Action as Action>::Result;
}

/// Outcome of a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TreeOutcome {
    Succeeded,
    Failed,
    Canceled,
}

/// Stage of the current goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Idle,
    Running,
    /// The tree is over, and canceled goals of servers are not over yet.
    Stopping {
        outcome: TreeOutcome,
        since_ns: i64,
    },
}

struct LoadedTree {
    /// Name as in the goal or the parameter.
    name: String,
    tree: BehaviorTree,
}

/// Navigator of one action.
pub(super) struct Navigator<K: NavigatorKind> {
    pub(super) server: SimpleActionServer<K::Action>,
    loaded: Option<LoadedTree>,
    stage: Stage,
    internal_error: Option<GoalError>,
    start_ns: i64,
    lengths: RemainingLengths,
    previous_path: Path,
    /// Index of the segment of the path at which the robot is.
    segment: usize,
}

impl<K: NavigatorKind> Default for Navigator<K> {
    fn default() -> Self {
        Self {
            server: SimpleActionServer::default(),
            loaded: None,
            stage: Stage::Idle,
            internal_error: None,
            start_ns: 0,
            previous_path: Path::default(),
            lengths: RemainingLengths::default(),
            segment: 0,
        }
    }
}

impl<K: NavigatorKind> Navigator<K> {
    /// True while a goal is being executed.
    pub(super) fn is_navigating(&self) -> bool {
        self.stage != Stage::Idle
    }

    /// Status while a goal is being executed.
    pub(super) fn status(&self) -> Option<NavigatorStatus> {
        let loaded = self.loaded.as_ref().filter(|_| self.is_navigating())?;
        Some(NavigatorStatus::of_tree(K::NAME, &loaded.tree))
    }

    fn default_name(params: &BtNavigatorParams) -> &str {
        match K::default_tree(params) {
            "" => K::DEFAULT_FILE,
            name => name,
        }
    }

    /// Name of the tree of a goal.
    fn tree_of(params: &BtNavigatorParams, goal: &<K::Action as Action>::Goal) -> String {
        match K::tree_name(goal) {
            "" => Self::default_name(params).to_owned(),
            name => name.to_owned(),
        }
    }

    /// Loads the default tree and accepts goals.
    ///
    /// # Errors
    /// The errors of the tree.
    pub(super) fn activate(&mut self, env: &Environment) -> Result<(), Vec<String>> {
        self.load(env, Self::default_name(&env.shared.params).to_owned())?;
        self.server.activate();
        Ok(())
    }

    /// Stops the tree and rejects goals.
    pub(super) fn deactivate(&mut self, env: &Environment, now_ns: i64) {
        self.halt(env, now_ns);
        self.server.deactivate();
        self.stage = Stage::Idle;
    }

    /// Unloads the tree.
    pub(super) fn cleanup(&mut self) {
        self.loaded = None;
    }

    fn load(&mut self, env: &Environment, name: String) -> Result<(), Vec<String>> {
        let is_loaded = self.loaded.as_ref().is_some_and(|loaded| loaded.name == name);
        if is_loaded && !env.shared.params.always_reload_bt_xml {
            return Ok(());
        }
        let blackboard = self.loaded.as_ref().map(|loaded| loaded.tree.blackboard().clone());
        let tree = env.loader.load(&env.shared, &name, blackboard.unwrap_or_default())?;
        self.loaded = Some(LoadedTree { name, tree });
        Ok(())
    }

    /// Checks that the robot has a pose and the poses of a goal can be transformed.
    ///
    /// # Errors
    /// The reason why not.
    pub(super) fn check(
        shared: &Shared,
        goal: &<K::Action as Action>::Goal,
    ) -> Result<Vec<PoseStamped>, String> {
        shared.receive();
        shared
            .robot_pose("", "")
            .map_err(|error| format!("Initial robot pose is not available: {error}"))?;
        let global = &shared.params.global_frame;
        K::poses(goal).iter().map(|pose| shared.transformed(pose, global)).collect()
    }

    /// Begins the current goal of the server, and ticks its tree once.
    pub(super) fn start(&mut self, env: &Environment, now_ns: i64) {
        let Some(goal) = self.server.current_goal() else {
            // It was canceled before it began.
            return self.complete(env, TreeOutcome::Canceled, now_ns);
        };
        env.shared.clear_error();
        let name = Self::tree_of(&env.shared.params, &goal);
        if let Err(errors) = self.load(env, name.clone()) {
            for error in &errors {
                env.shared.node.log(Level::Error, format!("tree `{name}`: {error}"));
            }
            let first = errors.into_iter().next().unwrap_or_default();
            let message = format!("cannot load the tree `{name}`: {first}");
            self.internal_error = Some((K::CODES.failed_to_load, message));
            return self.complete(env, TreeOutcome::Failed, now_ns);
        }
        match Self::check(&env.shared, &goal) {
            Ok(poses) => self.set_goal(env, &goal, poses, now_ns),
            Err(reason) => {
                env.shared.node.log(Level::Error, &reason);
                self.internal_error = Some((K::CODES.tf_error, reason));
                return self.complete(env, TreeOutcome::Failed, now_ns);
            }
        }
        self.stage = Stage::Running;
        self.tick(env, now_ns);
    }

    /// Writes a goal to the blackboard.
    fn set_goal(
        &mut self,
        env: &Environment,
        goal: &<K::Action as Action>::Goal,
        poses: Vec<PoseStamped>,
        now_ns: i64,
    ) {
        let Some(loaded) = &mut self.loaded else { return };
        if let Some(last) = poses.last() {
            let position = &last.pose.position;
            let text = format!("Begin navigating to ({:.2}, {:.2})", position.x, position.y);
            env.shared.node.log(Level::Info, text);
        }
        self.start_ns = now_ns;
        self.previous_path = Path::default();
        self.segment = 0;
        let params = &env.shared.params;
        let mut entries = K::entries_of_goal(params, goal, poses);
        entries.push(("number_recoveries".to_owned(), TreeValue::Int(0)));
        entries.push((K::entries(params).0.to_owned(), TreeValue::object(Path::default())));
        for (key, value) in entries {
            if let Err(error) = loaded.tree.blackboard_mut().set(&key, value) {
                env.shared.node.log(Level::Error, error);
            }
        }
    }

    /// Continues the current goal.
    pub(super) fn tick(&mut self, env: &Environment, now_ns: i64) {
        match self.stage {
            Stage::Idle => {}
            Stage::Running => self.run(env, now_ns),
            Stage::Stopping { outcome, since_ns } => {
                let is_late = now_ns - since_ns >= env.shared.params.cancel_timeout_ns();
                if !env.shared.is_canceling() || is_late {
                    env.shared.forget_canceling();
                    self.complete(env, outcome, now_ns);
                }
            }
        }
    }

    fn run(&mut self, env: &Environment, now_ns: i64) {
        env.shared.is_canceling();
        if self.server.is_cancel_requested() {
            return self.stop(env, TreeOutcome::Canceled, now_ns);
        }
        let Some(loaded) = &mut self.loaded else { return };
        match loaded.tree.tick(now_ns, &mut Context(&env.shared)) {
            Ok(NodeStatus::Running | NodeStatus::Idle) => {
                self.preempt(env, now_ns);
                self.publish_log(env, now_ns);
                self.publish_feedback(env, now_ns);
            }
            Ok(NodeStatus::Success) => self.stop(env, TreeOutcome::Succeeded, now_ns),
            Ok(_) => self.stop(env, TreeOutcome::Failed, now_ns),
            Err(error) => {
                env.shared.node.log(Level::Error, format!("the tree failed at {error}"));
                self.internal_error =
                    Some((K::CODES.unknown, format!("the tree failed at {error}")));
                self.stop(env, TreeOutcome::Failed, now_ns);
            }
        }
    }

    /// Takes a pending goal for the same tree; refuses one for another tree.
    fn preempt(&mut self, env: &Environment, now_ns: i64) {
        if !self.server.is_preempt_requested() {
            return;
        }
        let Some(goal) = self.server.pending_goal() else {
            return self.server.terminate_pending_goal();
        };
        let name = Self::tree_of(&env.shared.params, &goal);
        if self.loaded.as_ref().is_none_or(|loaded| loaded.name != name) {
            let text = format!(
                "a goal for the tree `{name}` was refused, since the current goal uses another one: \
                 cancel the current goal first"
            );
            env.shared.node.log(Level::Warn, text);
            return self.server.terminate_pending_goal();
        }
        match Self::check(&env.shared, &goal) {
            Ok(poses) => {
                if let Some(goal) = self.server.accept_pending_goal() {
                    self.set_goal(env, &goal, poses, now_ns);
                }
            }
            Err(reason) => {
                env.shared.node.log(Level::Warn, format!("a new goal was refused: {reason}"));
                self.server.terminate_pending_goal();
            }
        }
    }

    fn halt(&mut self, env: &Environment, now_ns: i64) {
        let Some(loaded) = &mut self.loaded else { return };
        if let Err(error) = loaded.tree.halt(now_ns, &mut Context(&env.shared)) {
            env.shared.node.log(Level::Error, error);
        }
    }

    fn stop(&mut self, env: &Environment, outcome: TreeOutcome, now_ns: i64) {
        self.halt(env, now_ns);
        self.publish_log(env, now_ns);
        self.stage = Stage::Stopping { outcome, since_ns: now_ns };
        if !env.shared.is_canceling() {
            self.complete(env, outcome, now_ns);
        }
    }

    /// Ends the current goal; a pending one begins.
    fn complete(&mut self, env: &Environment, outcome: TreeOutcome, now_ns: i64) {
        self.stage = Stage::Idle;
        let params = &env.shared.params;
        let is_success = outcome == TreeOutcome::Succeeded;
        let blackboard = self.loaded.as_ref().map(|loaded| loaded.tree.blackboard());
        let mut error = super::errors::of_goal(
            env.shared.release,
            params,
            blackboard,
            self.internal_error.take(),
        );
        if outcome == TreeOutcome::Failed && error.0 == 0 {
            if env.shared.release == Nav2Release::Main {
                error.0 = K::CODES.unknown;
            }
            if error.1.is_empty() {
                let last = env.shared.last_error();
                error.1 = last.map_or_else(
                    || "the tree failed".to_owned(),
                    |last| format!("the tree failed: {last}"),
                );
            }
        }
        let node = &env.shared.node;
        let text = match outcome {
            TreeOutcome::Succeeded => "Goal succeeded".to_owned(),
            TreeOutcome::Canceled => "Goal canceled".to_owned(),
            TreeOutcome::Failed => {
                format!("Goal failed error_code:{} error_msg:'{}'", error.0, error.1)
            }
        };
        let level = if outcome == TreeOutcome::Failed { Level::Error } else { Level::Info };
        node.log(level, &text);
        env.shared.report_outcome(&text);
        let result = K::result(params, error, blackboard, is_success);
        match outcome {
            TreeOutcome::Succeeded => self.server.succeeded_current(result),
            TreeOutcome::Failed => self.server.terminate_current(result),
            TreeOutcome::Canceled => self.server.terminate_all(result),
        }
        if let Some(loaded) = &mut self.loaded {
            super::errors::clear(params, env.shared.release, loaded.tree.blackboard_mut());
        }
        if self.server.finish() {
            self.start(env, now_ns);
        }
    }

    fn publish_log(&mut self, env: &Environment, now_ns: i64) {
        let Some(loaded) = &mut self.loaded else { return };
        let logs_idle = env.shared.params.bt_log_idle_transitions;
        let changes = loaded.tree.take_status_changes().into_iter();
        let events: Vec<BehaviorTreeStatusChange> = changes
            .filter(|change| logs_idle || change.current != NodeStatus::Idle)
            .map(|change| BehaviorTreeStatusChange {
                timestamp: Time::of_ns(change.time_ns),
                node_name: change.node.to_string(),
                uid: change.uid,
                previous_status: change.previous.name().to_owned(),
                current_status: change.current.name().to_owned(),
            })
            .collect();
        if let Some(log) = env.log.as_ref().filter(|_| !events.is_empty()) {
            log.publish(BehaviorTreeLog { timestamp: Time::of_ns(now_ns), event_log: events });
        }
    }

    fn publish_feedback(&mut self, env: &Environment, now_ns: i64) {
        let Some(loaded) = &self.loaded else { return };
        let Ok(current_pose) = env.shared.robot_pose("", "") else { return };
        let params = &env.shared.params;
        let (path_key, tracking_key, window_m) = K::entries(params);
        let blackboard = loaded.tree.blackboard();
        let mut distance_m = 0.0;
        if let Some(path) = blackboard.get(path_key).and_then(|value| value.get::<Path>())
            && !path.poses.is_empty()
        {
            if paths::is_path_updated(path, &self.previous_path)
                || paths::is_goal_updated(path, &self.previous_path)
                || self.previous_path.poses.is_empty()
            {
                self.segment = 0;
                self.previous_path = path.clone();
            }
            self.segment = match env.shared.release {
                Nav2Release::Main => {
                    paths::closest_segment(path, &current_pose.pose, self.segment, window_m)
                }
                // The closest pose of the whole path.
                _ => paths::min_by(&path.poses, |pose| {
                    paths::squared_distance_m2(&pose.pose, &current_pose.pose)
                }),
            };
            distance_m = self.lengths.remaining_m(path, self.segment);
        }
        let [x, y, _] = env.shared.mean_velocity();
        let speed = libm::hypot(x, y);
        let is_moving = speed > MIN_SPEED_M_PER_S && distance_m > MIN_DISTANCE_M;
        let remaining_s = if is_moving { distance_m / speed } else { 0.0 };
        let recoveries = blackboard.get("number_recoveries").and_then(TreeValue::as_i64);
        let tracking = blackboard.get(tracking_key).and_then(|it| it.get::<TrackingFeedback>());
        let common = CommonFeedback {
            current_pose,
            navigation_time: duration_ns(now_ns - self.start_ns),
            estimated_time_remaining: duration(remaining_s),
            number_of_recoveries: i16::try_from(recoveries.unwrap_or_default()).unwrap_or(i16::MAX),
            distance_remaining: distance_m as f32,
            position_tracking_error: tracking.map_or(0.0, |it| it.position_tracking_error),
            heading_tracking_error: tracking.map_or(0.0, |it| it.heading_tracking_error),
        };
        self.server.publish_feedback(K::feedback(params, common, blackboard));
    }
}
