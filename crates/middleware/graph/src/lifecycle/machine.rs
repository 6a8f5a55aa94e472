//! State machine of managed nodes.

use std::fmt;

use periplus_msgs::lifecycle_msgs::{self, State};

use LifecycleState as S;
use lifecycle_msgs::Transition as T;

/// State of a managed node: a primary state or a transition state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LifecycleState {
    /// Unknown.
    Unknown,
    /// Created, not configured.
    Unconfigured,
    /// Configured, not active.
    Inactive,
    /// Active.
    Active,
    /// Shut down.
    Finalized,
    /// Transition from unconfigured to inactive.
    Configuring,
    /// Transition from inactive to unconfigured.
    CleaningUp,
    /// Transition to finalized.
    ShuttingDown,
    /// Transition from inactive to active.
    Activating,
    /// Transition from active to inactive.
    Deactivating,
    /// Cleanup after an error.
    ErrorProcessing,
}

/// Callbacks of a managed node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Allocate resources.
    Configure,
    /// Release resources.
    Cleanup,
    /// Start operation.
    Activate,
    /// Stop operation.
    Deactivate,
    /// Shut down.
    Shutdown,
    /// Clean up after an error, to restart unconfigured.
    Error,
}

/// Return value of a callback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepOutcome {
    /// Succeeded.
    Success,
    /// Failed; the state is as before.
    Failure,
    /// Failed; the state is undefined.
    Error,
}

/// Transitions that other nodes can request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transition {
    /// From unconfigured to inactive.
    Configure,
    /// From inactive to unconfigured.
    Cleanup,
    /// From inactive to active.
    Activate,
    /// From active to inactive.
    Deactivate,
    /// From any primary state to finalized.
    Shutdown,
}

/// An edge of the state machine.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub(super) id: u8,
    pub(super) label: &'static str,
    pub(super) start: LifecycleState,
    pub(super) goal: LifecycleState,
}

const fn edge(id: u8, label: &'static str, start: S, goal: S) -> Edge {
    Edge { id, label, start, goal }
}

const SUCCESS: &str = "transition_success";
const FAILURE: &str = "transition_failure";
const ERROR: &str = "transition_error";

/// All edges.
pub(super) const EDGES: [Edge; 25] = [
    edge(T::TRANSITION_CONFIGURE, "configure", S::Unconfigured, S::Configuring),
    edge(T::TRANSITION_ON_CONFIGURE_SUCCESS, SUCCESS, S::Configuring, S::Inactive),
    edge(T::TRANSITION_ON_CONFIGURE_FAILURE, FAILURE, S::Configuring, S::Unconfigured),
    edge(T::TRANSITION_ON_CONFIGURE_ERROR, ERROR, S::Configuring, S::ErrorProcessing),
    edge(T::TRANSITION_CLEANUP, "cleanup", S::Inactive, S::CleaningUp),
    edge(T::TRANSITION_ON_CLEANUP_SUCCESS, SUCCESS, S::CleaningUp, S::Unconfigured),
    edge(T::TRANSITION_ON_CLEANUP_FAILURE, FAILURE, S::CleaningUp, S::Inactive),
    edge(T::TRANSITION_ON_CLEANUP_ERROR, ERROR, S::CleaningUp, S::ErrorProcessing),
    edge(T::TRANSITION_ACTIVATE, "activate", S::Inactive, S::Activating),
    edge(T::TRANSITION_ON_ACTIVATE_SUCCESS, SUCCESS, S::Activating, S::Active),
    edge(T::TRANSITION_ON_ACTIVATE_FAILURE, FAILURE, S::Activating, S::Inactive),
    edge(T::TRANSITION_ON_ACTIVATE_ERROR, ERROR, S::Activating, S::ErrorProcessing),
    edge(T::TRANSITION_DEACTIVATE, "deactivate", S::Active, S::Deactivating),
    edge(T::TRANSITION_ON_DEACTIVATE_SUCCESS, SUCCESS, S::Deactivating, S::Inactive),
    edge(T::TRANSITION_ON_DEACTIVATE_FAILURE, FAILURE, S::Deactivating, S::Active),
    edge(T::TRANSITION_ON_DEACTIVATE_ERROR, ERROR, S::Deactivating, S::ErrorProcessing),
    edge(T::TRANSITION_UNCONFIGURED_SHUTDOWN, "shutdown", S::Unconfigured, S::ShuttingDown),
    edge(T::TRANSITION_INACTIVE_SHUTDOWN, "shutdown", S::Inactive, S::ShuttingDown),
    edge(T::TRANSITION_ACTIVE_SHUTDOWN, "shutdown", S::Active, S::ShuttingDown),
    edge(T::TRANSITION_ON_SHUTDOWN_SUCCESS, SUCCESS, S::ShuttingDown, S::Finalized),
    edge(T::TRANSITION_ON_SHUTDOWN_FAILURE, FAILURE, S::ShuttingDown, S::Finalized),
    edge(T::TRANSITION_ON_SHUTDOWN_ERROR, ERROR, S::ShuttingDown, S::ErrorProcessing),
    edge(T::TRANSITION_ON_ERROR_SUCCESS, SUCCESS, S::ErrorProcessing, S::Unconfigured),
    edge(T::TRANSITION_ON_ERROR_FAILURE, FAILURE, S::ErrorProcessing, S::Finalized),
    edge(T::TRANSITION_ON_ERROR_ERROR, ERROR, S::ErrorProcessing, S::Finalized),
];

/// Edges from a state.
pub(super) fn edges_from(state: LifecycleState) -> impl Iterator<Item = &'static Edge> {
    EDGES.iter().filter(move |edge| edge.start == state)
}

/// Edge from a transition state for an outcome.
pub(super) fn after(state: LifecycleState, outcome: StepOutcome) -> Option<&'static Edge> {
    let label = match outcome {
        StepOutcome::Success => SUCCESS,
        StepOutcome::Failure => FAILURE,
        StepOutcome::Error => ERROR,
    };
    edges_from(state).find(|edge| edge.label == label)
}

impl Transition {
    fn label(self) -> &'static str {
        match self {
            Self::Configure => "configure",
            Self::Cleanup => "cleanup",
            Self::Activate => "activate",
            Self::Deactivate => "deactivate",
            Self::Shutdown => "shutdown",
        }
    }

    /// Edge of this transition from a state, if there is one.
    pub(super) fn at(self, state: LifecycleState) -> Option<&'static Edge> {
        edges_from(state).find(|edge| edge.label == self.label())
    }
}

impl LifecycleState {
    /// All states, in the order of ROS.
    pub const ALL: [Self; 11] = [
        Self::Unknown,
        Self::Unconfigured,
        Self::Inactive,
        Self::Active,
        Self::Finalized,
        Self::Configuring,
        Self::CleaningUp,
        Self::ShuttingDown,
        Self::Activating,
        Self::Deactivating,
        Self::ErrorProcessing,
    ];

    /// Number of the state in `lifecycle_msgs/msg/State`.
    #[must_use]
    pub fn number(self) -> u8 {
        match self {
            Self::Unknown => State::PRIMARY_STATE_UNKNOWN,
            Self::Unconfigured => State::PRIMARY_STATE_UNCONFIGURED,
            Self::Inactive => State::PRIMARY_STATE_INACTIVE,
            Self::Active => State::PRIMARY_STATE_ACTIVE,
            Self::Finalized => State::PRIMARY_STATE_FINALIZED,
            Self::Configuring => State::TRANSITION_STATE_CONFIGURING,
            Self::CleaningUp => State::TRANSITION_STATE_CLEANINGUP,
            Self::ShuttingDown => State::TRANSITION_STATE_SHUTTINGDOWN,
            Self::Activating => State::TRANSITION_STATE_ACTIVATING,
            Self::Deactivating => State::TRANSITION_STATE_DEACTIVATING,
            Self::ErrorProcessing => State::TRANSITION_STATE_ERRORPROCESSING,
        }
    }

    /// Callback of a transition state.
    pub(super) fn step(self) -> Option<Step> {
        match self {
            Self::Configuring => Some(Step::Configure),
            Self::CleaningUp => Some(Step::Cleanup),
            Self::Activating => Some(Step::Activate),
            Self::Deactivating => Some(Step::Deactivate),
            Self::ShuttingDown => Some(Step::Shutdown),
            Self::ErrorProcessing => Some(Step::Error),
            _ => None,
        }
    }

    pub(super) fn message(self) -> State {
        State { id: self.number(), label: self.to_string() }
    }
}

impl fmt::Display for LifecycleState {
    /// Formats the label of ROS.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Unknown => "unknown",
            Self::Unconfigured => "unconfigured",
            Self::Inactive => "inactive",
            Self::Active => "active",
            Self::Finalized => "finalized",
            Self::Configuring => "configuring",
            Self::CleaningUp => "cleaningup",
            Self::ShuttingDown => "shuttingdown",
            Self::Activating => "activating",
            Self::Deactivating => "deactivating",
            Self::ErrorProcessing => "errorprocessing",
        })
    }
}

impl Edge {
    pub(super) fn message(&self) -> T {
        T { id: self.id, label: self.label.to_owned() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_state_on_the_way_leads_on_whatever_happens() {
        for state in LifecycleState::ALL.into_iter().filter(|state| state.step().is_some()) {
            for outcome in [StepOutcome::Success, StepOutcome::Failure, StepOutcome::Error] {
                assert!(after(state, outcome).is_some(), "{state} {outcome:?}");
            }
        }
        assert_eq!(edges_from(S::Finalized).count(), 0);
    }

    #[test]
    fn ids_are_unique() {
        let mut ids: Vec<u8> = EDGES.iter().map(|edge| edge.id).collect();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), EDGES.len());
    }
}
