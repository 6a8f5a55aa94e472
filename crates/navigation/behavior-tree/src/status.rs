//! Status of a node.

use std::fmt;

/// Status of a node, as BehaviorTree.CPP 4 has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NodeStatus {
    /// Not ticked since the tree started, or halted.
    #[default]
    Idle,
    /// Not finished.
    Running,
    /// Finished with success.
    Success,
    /// Finished with failure.
    Failure,
    /// Not executed because of a precondition. A node returns this value, but its own status stays idle.
    Skipped,
}

impl NodeStatus {
    /// All statuses, in the order of the numbers of BehaviorTree.CPP.
    pub const ALL: [Self; 5] =
        [Self::Idle, Self::Running, Self::Success, Self::Failure, Self::Skipped];

    /// True for success and failure.
    #[must_use]
    pub fn is_completed(self) -> bool {
        matches!(self, Self::Success | Self::Failure)
    }

    /// True unless idle or skipped. A node that returned success stays active until its parent resets it.
    #[must_use]
    pub fn is_active(self) -> bool {
        !matches!(self, Self::Idle | Self::Skipped)
    }

    /// Name in XML and in `nav2_msgs/BehaviorTreeStatusChange`, such as `RUNNING`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Idle => "IDLE",
            Self::Running => "RUNNING",
            Self::Success => "SUCCESS",
            Self::Failure => "FAILURE",
            Self::Skipped => "SKIPPED",
        }
    }

    /// Status of a name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|status| status.name() == name)
    }
}

impl fmt::Display for NodeStatus {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
