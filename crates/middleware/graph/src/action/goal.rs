//! One goal: its name, and its states.

use std::fmt;

use periplus_msgs::action_msgs::GoalStatus;
use periplus_msgs::unique_identifier_msgs::UUID;

/// Names a goal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct GoalId(pub [u8; 16]);

impl GoalId {
    /// No goal: where a goal is asked for, all of them.
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
    /// As 32 hexadecimal digits.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

/// How far a goal is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum GoalState {
    /// There is no such goal.
    #[default]
    Unknown,
    /// It waits.
    Accepted,
    /// It is being worked on.
    Executing,
    /// Somebody asked to stop it, and it may.
    Canceling,
    /// It is done.
    Succeeded,
    /// It was stopped as asked.
    Canceled,
    /// It could not be done.
    Aborted,
}

/// What happens to a goal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GoalEvent {
    /// Work begins.
    Execute,
    /// Somebody asked to stop it, and it may.
    Cancel,
    /// It is done.
    Succeed,
    /// It cannot be done.
    Abort,
    /// It was stopped as asked.
    Canceled,
}

impl GoalState {
    /// All of them, as `action_msgs/msg/GoalStatus` counts.
    pub const ALL: [Self; 7] = [
        Self::Unknown,
        Self::Accepted,
        Self::Executing,
        Self::Canceling,
        Self::Succeeded,
        Self::Canceled,
        Self::Aborted,
    ];

    /// The state after an event; none where this cannot happen.
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

    /// Whether nothing happens to it any more.
    #[must_use]
    pub fn is_over(self) -> bool {
        matches!(self, Self::Succeeded | Self::Canceled | Self::Aborted)
    }

    /// As `action_msgs/msg/GoalStatus` counts.
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

    /// The state of a number; numbers that mean nothing are [`GoalState::Unknown`].
    #[must_use]
    pub fn of_number(number: i8) -> Self {
        Self::ALL.into_iter().find(|state| state.number() == number).unwrap_or_default()
    }
}

impl fmt::Display for GoalState {
    /// As `ros2 action send_goal` says it.
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
