//! Goal on which the node works.

use periplus_geometry::Pose2;
use periplus_msgs::geometry_msgs::PoseStamped;

use super::recovery::Rotation;

/// State of the work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JobState {
    /// Searches for a plan.
    Planning,
    /// Follows the plan.
    Controlling,
    /// Recovers.
    Clearing,
}

/// Reason of a recovery.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RecoveryTrigger {
    /// There is no plan.
    Planning,
    /// There is no valid velocity.
    Controlling,
    /// The robot does not get ahead.
    Oscillation,
}

impl RecoveryTrigger {
    /// Text of a goal that is aborted after all recoveries.
    pub(super) fn text(self) -> &'static str {
        match self {
            Self::Planning => {
                "Failed to find a valid plan. Even after executing recovery behaviors."
            }
            Self::Controlling => {
                "Failed to find a valid control. Even after executing recovery behaviors."
            }
            Self::Oscillation => "Robot is oscillating. Even after executing recovery behaviors.",
        }
    }
}

/// A goal being worked on.
pub(super) struct Job {
    /// Goal as it was sent.
    pub(super) goal: PoseStamped,
    /// Goal in the frame of the global costmap, once there is a transform.
    pub(super) global_goal: Option<Pose2>,
    pub(super) state: JobState,
    pub(super) trigger: RecoveryTrigger,
    /// Index of the next recovery.
    pub(super) recovery_index: usize,
    /// Rotation that runs.
    pub(super) rotation: Option<Rotation>,
    /// Frame of the plan.
    pub(super) plan_frame: String,
    /// Number of failed plans since the last one that succeeded.
    pub(super) failed_plan_count: i64,
    /// Time of the next plan while the robot drives \[ns\].
    pub(super) next_plan_ns: i64,
    pub(super) last_plan_ns: i64,
    pub(super) last_control_ns: i64,
    pub(super) last_move_ns: i64,
    /// Pose at which the robot last made progress.
    pub(super) moved_from: Option<Pose2>,
    /// Reason of the last failure.
    pub(super) last_failure: String,
}

impl Job {
    pub(super) fn new(goal: PoseStamped, now_ns: i64) -> Self {
        Self {
            goal,
            global_goal: None,
            state: JobState::Planning,
            trigger: RecoveryTrigger::Planning,
            recovery_index: 0,
            rotation: None,
            plan_frame: String::new(),
            failed_plan_count: 0,
            next_plan_ns: now_ns,
            last_plan_ns: now_ns,
            last_control_ns: now_ns,
            last_move_ns: now_ns,
            moved_from: None,
            last_failure: String::new(),
        }
    }

    /// Goes on with a new plan.
    pub(super) fn start_planning(&mut self, now_ns: i64) {
        self.state = JobState::Planning;
        self.last_plan_ns = now_ns;
        self.failed_plan_count = 0;
    }

    /// Starts a recovery.
    pub(super) fn start_clearing(&mut self, trigger: RecoveryTrigger) {
        self.state = JobState::Clearing;
        self.trigger = trigger;
    }

    /// Starts with the first recovery again, once what had failed succeeds.
    pub(super) fn forget_recoveries(&mut self, trigger: RecoveryTrigger) {
        if self.trigger == trigger {
            self.recovery_index = 0;
        }
    }
}
