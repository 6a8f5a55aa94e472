//! Conditions on blackboard entries and time.

use super::timing::{number, seconds_ns};
use crate::{BehaviorNode, NodeRun, NodeStatus, TreeError, TreeValue};

fn holds(is_true: bool) -> NodeStatus {
    if is_true { NodeStatus::Success } else { NodeStatus::Failure }
}

/// Goal and goals as last seen.
#[derive(Default)]
pub(super) struct Goals {
    goal: Option<TreeValue>,
    goals: Option<TreeValue>,
}

impl Goals {
    /// Reads both; true if one differs from the last reading.
    pub(super) fn update(&mut self, run: &NodeRun<'_>) -> bool {
        let new = Self { goal: run.input_or_entry("goal"), goals: run.input_or_entry("goals") };
        let is_changed = new.goal != self.goal || new.goals != self.goals;
        *self = new;
        is_changed
    }
}

/// `GlobalUpdatedGoal`: succeeds when the goal has changed since the last tick, however long ago that was,
/// and at the first tick.
///
/// Source: `globally_updated_goal_condition.cpp`.
#[derive(Default)]
pub(super) struct GlobalUpdatedGoal {
    goals: Goals,
    was_ticked: bool,
}

impl BehaviorNode for GlobalUpdatedGoal {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let is_changed = self.goals.update(run);
        let is_first = !std::mem::replace(&mut self.was_ticked, true);
        Ok(holds(is_first || is_changed))
    }
}

/// `GoalUpdated`: succeeds when the goal has changed since the last tick of the tree.
///
/// Nav2's node begins again whenever its status is idle. A reactive parent resets it in each tick in which
/// a sibling is running, so that there it never succeeds, and a new goal does not end a recovery
/// (navigation2#6082). Here it begins again after a tick of the tree in which it was not ticked.
///
/// Source: `goal_updated_condition.cpp`.
#[derive(Default)]
pub(super) struct GoalUpdated {
    goals: Goals,
    last_tick: Option<u64>,
}

impl BehaviorNode for GoalUpdated {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let is_changed = self.goals.update(run);
        let now = run.tick_count();
        let last = self.last_tick.replace(now);
        let goes_on = last.is_some_and(|last| now - last <= 1);
        Ok(holds(goes_on && is_changed))
    }
}

/// Server whose error codes a recovery may help against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RecoveryServer {
    /// Controller server.
    Controller,
    /// Planner server.
    Planner,
    /// Smoother server.
    Smoother,
    /// Route server.
    Route,
}

impl RecoveryServer {
    /// Error codes after which the conditions `WouldA...RecoveryHelp` succeed. A goal or start in an
    /// obstacle, a missing transform and an invalid path are not among them.
    ///
    /// Source: `would_a_controller_recovery_help_condition.cpp` and the three beside it.
    #[must_use]
    pub fn helpful_codes(self) -> &'static [u16] {
        match self {
            // UNKNOWN, PATIENCE_EXCEEDED, FAILED_TO_MAKE_PROGRESS, NO_VALID_CONTROL
            Self::Controller => &[100, 104, 105, 106],
            // UNKNOWN, TIMEOUT, NO_VALID_PATH of both planning actions
            Self::Planner => &[200, 207, 208, 300, 307, 308],
            // UNKNOWN, TIMEOUT, FAILED_TO_SMOOTH_PATH, SMOOTHED_PATH_IN_COLLISION
            Self::Smoother => &[500, 502, 503, 504],
            // UNKNOWN, NO_VALID_ROUTE, TIMEOUT
            Self::Route => &[400, 404, 405],
        }
    }
}

/// True if a recovery may help against an error code of a server.
#[must_use]
pub fn would_recovery_help(server: RecoveryServer, error_code: u16) -> bool {
    server.helpful_codes().contains(&error_code)
}

/// `AreErrorCodesPresent` and the conditions `WouldA...RecoveryHelp`.
pub(super) struct HasErrorCode(pub(super) Option<RecoveryServer>);

impl BehaviorNode for HasErrorCode {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let code = run.input_i64("error_code").and_then(|code| u16::try_from(code).ok());
        let code = code.unwrap_or_default();
        if let Some(server) = self.0 {
            return Ok(holds(would_recovery_help(server, code)));
        }
        let codes = run.input_list("error_codes_to_check").unwrap_or_default();
        Ok(holds(codes.iter().any(|text| text.parse() == Ok(code))))
    }
}

/// Succeeds each time a period has passed since its activation or its last success.
///
/// Source: `time_expired_condition.cpp`.
#[derive(Default)]
pub(super) struct TimeExpired {
    start_ns: i64,
}

impl BehaviorNode for TimeExpired {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let now_ns = run.now_ns();
        if !run.status().is_active() {
            self.start_ns = now_ns;
            return Ok(NodeStatus::Failure);
        }
        if now_ns.saturating_sub(self.start_ns) < seconds_ns(number(run, "seconds")?) {
            return Ok(NodeStatus::Failure);
        }
        self.start_ns = now_ns;
        Ok(NodeStatus::Success)
    }
}

/// Succeeds when a path has not changed for a period.
///
/// Source: `path_expiring_timer_condition.cpp`.
#[derive(Default)]
pub(super) struct PathExpiringTimer {
    path: Option<TreeValue>,
    start_ns: Option<i64>,
}

impl BehaviorNode for PathExpiringTimer {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let now_ns = run.now_ns();
        let path = run.input("path");
        let Some(start_ns) = &mut self.start_ns else {
            (self.path, self.start_ns) = (path, Some(now_ns));
            return Ok(NodeStatus::Failure);
        };
        if path != self.path {
            self.path = path;
            *start_ns = now_ns;
        }
        if now_ns.saturating_sub(*start_ns) < seconds_ns(number(run, "seconds")?) {
            return Ok(NodeStatus::Failure);
        }
        *start_ns = now_ns;
        Ok(NodeStatus::Success)
    }
}

/// Succeeds once the initial pose of the robot is known.
///
/// Source: `initial_pose_received_condition.cpp`.
pub(super) struct InitialPoseReceived;

impl BehaviorNode for InitialPoseReceived {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let received = run.input_or_entry("initial_pose_received");
        Ok(holds(received.and_then(|value| value.as_bool()).unwrap_or_default()))
    }
}
