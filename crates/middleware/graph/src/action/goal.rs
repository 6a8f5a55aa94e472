//! Goal ids and the goal state machine.

use std::fmt;

use periplus_msgs::action_msgs::GoalStatus;
use periplus_msgs::unique_identifier_msgs::UUID;

/// Id of a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GoalId(pub [u8; 16]);

impl GoalId {
    /// The null id: in requests it means all goals.
    pub const NONE: Self = Self([0; 16]);
}

impl From<&UUID> for GoalId {
    fn from(id: &UUID) -> Self {
        Self(id.uuid)
    }
}

impl From<GoalId> for UUID {
    fn from(id: GoalId) -> Self {
        Self { uuid: id.0 }
    }
}

impl fmt::Display for GoalId {
    /// Formats the id as 32 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// State of a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum GoalState {
    /// No goal has this id.
    #[default]
    Unknown,
    /// Accepted, not started.
    Accepted,
    /// Being executed.
    Executing,
    /// Cancellation was requested and accepted.
    Canceling,
    /// Finished successfully.
    Succeeded,
    /// Canceled on request.
    Canceled,
    /// Failed.
    Aborted,
}

/// Events of the goal state machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoalEvent {
    /// Execution starts.
    Execute,
    /// Cancellation was requested and accepted.
    Cancel,
    /// The goal succeeds.
    Succeed,
    /// The goal fails.
    Abort,
    /// The cancellation is complete.
    Canceled,
}

impl GoalState {
    /// All states, in the order of `action_msgs/msg/GoalStatus`.
    pub const ALL: [Self; 7] = [
        Self::Unknown,
        Self::Accepted,
        Self::Executing,
        Self::Canceling,
        Self::Succeeded,
        Self::Canceled,
        Self::Aborted,
    ];

    /// Returns the state after an event; none if the transition is not allowed.
    ///
    /// Source: `rcl_action/goal_state_machine.c`.
    #[must_use]
    pub fn after(self, event: GoalEvent) -> Option<Self> {
        match (self, event) {
            (Self::Accepted, GoalEvent::Execute) => Some(Self::Executing),
            (Self::Accepted | Self::Executing, GoalEvent::Cancel) => Some(Self::Canceling),
            (Self::Executing | Self::Canceling, GoalEvent::Succeed) => Some(Self::Succeeded),
            (Self::Executing | Self::Canceling, GoalEvent::Abort) => Some(Self::Aborted),
            (Self::Canceling, GoalEvent::Canceled) => Some(Self::Canceled),
            _ => None,
        }
    }

    /// True for the final states.
    #[must_use]
    pub fn is_over(self) -> bool {
        matches!(self, Self::Succeeded | Self::Canceled | Self::Aborted)
    }

    /// Number of the state in `action_msgs/msg/GoalStatus`.
    #[must_use]
    pub fn number(self) -> i8 {
        match self {
            Self::Unknown => GoalStatus::STATUS_UNKNOWN,
            Self::Accepted => GoalStatus::STATUS_ACCEPTED,
            Self::Executing => GoalStatus::STATUS_EXECUTING,
            Self::Canceling => GoalStatus::STATUS_CANCELING,
            Self::Succeeded => GoalStatus::STATUS_SUCCEEDED,
            Self::Canceled => GoalStatus::STATUS_CANCELED,
            Self::Aborted => GoalStatus::STATUS_ABORTED,
        }
    }

    /// State of a number; unknown numbers give [`GoalState::Unknown`].
    #[must_use]
    pub fn of_number(number: i8) -> Self {
        Self::ALL.into_iter().find(|state| state.number() == number).unwrap_or_default()
    }
}

impl fmt::Display for GoalState {
    /// Formats the state as `ros2 action send_goal` does.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Unknown => "UNKNOWN",
            Self::Accepted => "ACCEPTED",
            Self::Executing => "EXECUTING",
            Self::Canceling => "CANCELING",
            Self::Succeeded => "SUCCEEDED",
            Self::Canceled => "CANCELED",
            Self::Aborted => "ABORTED",
        })
    }
}
