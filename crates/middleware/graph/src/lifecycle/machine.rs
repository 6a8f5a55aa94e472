//! The states of a managed node, and how one leads to another.

use std::fmt;

use periplus_msgs::lifecycle_msgs::{self, State};

use LifecycleState as S;
use lifecycle_msgs::Transition as T;

/// The state of a managed node: one of rest, or one on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum LifecycleState {
    /// Nobody knows.
    Unknown,
    /// It has nothing yet.
    Unconfigured,
    /// It has all it needs, and rests.
    Inactive,
    /// It works.
    Active,
    /// It is over.
    Finalized,
    /// On the way from unconfigured to inactive.
    Configuring,
    /// On the way back.
    CleaningUp,
    /// On the way to its end.
    ShuttingDown,
    /// On the way from inactive to active.
    Activating,
    /// On the way back.
    Deactivating,
    /// Something went wrong, and it cleans up.
    ErrorProcessing,
}

/// What a managed node is asked to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step {
    /// Get all it needs.
    Configure,
    /// Give it back.
    Cleanup,
    /// Begin to work.
    Activate,
    /// Stop working.
    Deactivate,
    /// End.
    Shutdown,
    /// Clean up after an error, to begin anew.
    Error,
}

/// How it went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepOutcome {
    /// Well.
    Success,
    /// Not, and all is as before.
    Failure,
    /// Not, and nobody knows how it is.
    Error,
}

/// A change that others may ask for.
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
    /// From anywhere to the end.
    Shutdown,
}

/// One way from a state to another.
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

/// All ways.
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

/// The ways out of a state.
pub(super) fn edges_from(state: LifecycleState) -> impl Iterator<Item = &'static Edge> {
    EDGES.iter().filter(move |edge| edge.start == state)
}

/// The way out of a state on the way.
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

    /// Its way from a state, if there is one.
    pub(super) fn at(self, state: LifecycleState) -> Option<&'static Edge> {
        edges_from(state).find(|edge| edge.label == self.label())
    }
}

impl LifecycleState {
    /// All of them, in the order in which ROS lists them.
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

    /// As `lifecycle_msgs/msg/State` counts.
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

    /// What is done in a state on the way.
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
    /// As ROS labels it.
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
