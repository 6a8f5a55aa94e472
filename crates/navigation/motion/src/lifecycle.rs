//! Order in which a lifecycle manager changes the states of its nodes.
//!
//! Nodes are configured and activated in the order of their list, and deactivated, cleaned up and
//! shut down in reverse. Source: `nav2_lifecycle_manager/src/lifecycle_manager.cpp`.

use std::collections::VecDeque;

/// Command to a lifecycle manager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ManagerCommand {
    /// Configures and activates all nodes.
    Startup,
    /// Deactivates all nodes.
    Pause,
    /// Activates all nodes.
    Resume,
    /// Deactivates and cleans up all nodes.
    Reset,
    /// Deactivates, cleans up and finalizes all nodes.
    Shutdown,
    /// Configures all nodes.
    Configure,
    /// Cleans up all nodes.
    Cleanup,
}

/// Transition of a managed node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ManagedTransition {
    /// Unconfigured to inactive.
    Configure,
    /// Inactive to active.
    Activate,
    /// Active to inactive.
    Deactivate,
    /// Inactive to unconfigured.
    Cleanup,
    /// Unconfigured to finalized.
    Shutdown,
}

/// State of all nodes of a manager, as it reports it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ManagedState {
    /// A transition failed.
    Unknown,
    /// All nodes are unconfigured.
    #[default]
    Unconfigured,
    /// All nodes are inactive.
    Inactive,
    /// All nodes are active.
    Active,
    /// All nodes are shut down.
    Finalized,
}

impl ManagerCommand {
    /// All commands with their numbers in `nav2_msgs/srv/ManageLifecycleNodes`.
    pub const ALL: [(u8, Self); 7] = [
        (0, Self::Startup),
        (1, Self::Pause),
        (2, Self::Resume),
        (3, Self::Reset),
        (4, Self::Shutdown),
        (5, Self::Configure),
        (6, Self::Cleanup),
    ];

    /// Command of a number; none for an unknown one.
    #[must_use]
    pub fn of_number(number: u8) -> Option<Self> {
        Self::ALL.iter().find(|(known, _)| *known == number).map(|(_, command)| *command)
    }

    /// Transitions of each node, in order.
    #[must_use]
    pub fn transitions(self) -> &'static [ManagedTransition] {
        use ManagedTransition::{Activate, Cleanup, Configure, Deactivate, Shutdown};
        match self {
            Self::Startup => &[Configure, Activate],
            Self::Configure => &[Configure],
            Self::Resume => &[Activate],
            Self::Pause => &[Deactivate],
            Self::Cleanup => &[Cleanup],
            Self::Reset => &[Deactivate, Cleanup],
            Self::Shutdown => &[Deactivate, Cleanup, Shutdown],
        }
    }

    /// State of the nodes after all transitions succeeded.
    #[must_use]
    pub fn goal(self) -> ManagedState {
        match self {
            Self::Startup | Self::Resume => ManagedState::Active,
            Self::Configure | Self::Pause => ManagedState::Inactive,
            Self::Cleanup | Self::Reset => ManagedState::Unconfigured,
            Self::Shutdown => ManagedState::Finalized,
        }
    }
}

impl ManagedTransition {
    /// Label of the transition in lifecycle services.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Configure => "configure",
            Self::Activate => "activate",
            Self::Deactivate => "deactivate",
            Self::Cleanup => "cleanup",
            Self::Shutdown => "shutdown",
        }
    }

    /// True if nodes make it in the order of their list, false if in reverse.
    #[must_use]
    pub fn is_in_list_order(self) -> bool {
        matches!(self, Self::Configure | Self::Activate)
    }
}

/// Effect of a failed transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum OnFailure {
    /// The command ends; all nodes stay as they are.
    End,
    /// The same transition is not made by the other nodes; later transitions are.
    NextTransition,
    /// All goes on: the state of the nodes is unknown anyway.
    Continue,
}

/// Execution of a [`ManagerCommand`], one transition of one node at a time.
///
/// ```
/// use periplus_motion::{CommandExecution, ManagedState, ManagerCommand};
///
/// let names = ["map_server".to_owned(), "amcl".to_owned()];
/// let mut execution = CommandExecution::new(ManagerCommand::Pause, &names);
/// let mut paused = Vec::new();
/// while let Some((name, transition)) = execution.next_step() {
///     paused.push(format!("{} {name}", transition.label()));
///     execution.finish_step(true);
/// }
/// assert_eq!(paused, ["deactivate amcl", "deactivate map_server"]);
/// assert_eq!(execution.outcome(), Some((true, ManagedState::Inactive)));
/// ```
#[derive(Clone, Debug)]
pub struct CommandExecution {
    steps: VecDeque<(String, ManagedTransition)>,
    on_failure: OnFailure,
    goal: ManagedState,
    has_failed: bool,
}

impl CommandExecution {
    /// Starts a command for nodes in the order of their list.
    #[must_use]
    pub fn new(command: ManagerCommand, names: &[String]) -> Self {
        let mut steps = VecDeque::new();
        for &transition in command.transitions() {
            let step = |name: &String| (name.clone(), transition);
            if transition.is_in_list_order() {
                steps.extend(names.iter().map(step));
            } else {
                steps.extend(names.iter().rev().map(step));
            }
        }
        // Nav2 ignores the result of each of the three rounds of a shutdown.
        let on_failure = match command {
            ManagerCommand::Shutdown => OnFailure::NextTransition,
            _ => OnFailure::End,
        };
        Self { steps, on_failure, goal: command.goal(), has_failed: false }
    }

    /// Starts a reset that goes on when a transition fails, as after a node is gone.
    #[must_use]
    pub fn hard_reset(names: &[String]) -> Self {
        let reset = Self::new(ManagerCommand::Reset, names);
        Self { on_failure: OnFailure::Continue, ..reset }
    }

    /// True if failed transitions have no effect.
    #[must_use]
    pub fn is_hard(&self) -> bool {
        self.on_failure == OnFailure::Continue
    }

    /// Makes transitions before all others.
    pub fn prepend(&mut self, steps: Vec<(String, ManagedTransition)>) {
        for step in steps.into_iter().rev() {
            self.steps.push_front(step);
        }
    }

    /// The transition to make now, and the node; none once the command is done.
    #[must_use]
    pub fn next_step(&self) -> Option<(&str, ManagedTransition)> {
        self.steps.front().map(|(name, transition)| (name.as_str(), *transition))
    }

    /// Reports the result of [`Self::next_step`].
    pub fn finish_step(&mut self, has_succeeded: bool) {
        let Some((_, transition)) = self.steps.pop_front() else { return };
        if has_succeeded {
            return;
        }
        match self.on_failure {
            OnFailure::End => {
                self.has_failed = true;
                self.steps.clear();
            }
            OnFailure::NextTransition => self.steps.retain(|(_, other)| *other != transition),
            OnFailure::Continue => {}
        }
    }

    /// Result and state of the nodes; none before the command is done.
    #[must_use]
    pub fn outcome(&self) -> Option<(bool, ManagedState)> {
        let state = if self.has_failed { ManagedState::Unknown } else { self.goal };
        self.steps.is_empty().then_some((!self.has_failed, state))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Executes a command; `failing` is the node and transition that fails.
    fn check(
        mut execution: CommandExecution,
        failing: &str,
        expected: &str,
        outcome: (bool, ManagedState),
    ) {
        let mut made = Vec::new();
        while let Some((name, transition)) = execution.next_step() {
            let step = format!("{name}:{}", transition.label());
            execution.finish_step(step != failing);
            made.push(step);
        }
        assert_eq!(made.join(" "), expected);
        assert_eq!(execution.outcome(), Some(outcome));
    }

    #[test]
    fn commands_make_their_transitions_in_order() {
        use ManagedState::{Active, Finalized, Inactive, Unconfigured, Unknown};
        let names = ["a".to_owned(), "b".to_owned()];
        let run = |command| CommandExecution::new(command, &names);
        let startup = "a:configure b:configure a:activate b:activate";
        check(run(ManagerCommand::Startup), "", startup, (true, Active));
        let failed = "a:configure b:configure a:activate";
        check(run(ManagerCommand::Startup), "a:activate", failed, (false, Unknown));
        let reset = "b:deactivate a:deactivate b:cleanup a:cleanup";
        check(run(ManagerCommand::Reset), "", reset, (true, Unconfigured));
        check(run(ManagerCommand::Reset), "b:deactivate", "b:deactivate", (false, Unknown));
        check(CommandExecution::hard_reset(&names), "b:deactivate", reset, (true, Unconfigured));
        check(run(ManagerCommand::Configure), "", "a:configure b:configure", (true, Inactive));
        check(run(ManagerCommand::Cleanup), "", "b:cleanup a:cleanup", (true, Unconfigured));
        let shutdown = "b:deactivate b:cleanup a:cleanup b:shutdown a:shutdown";
        check(run(ManagerCommand::Shutdown), "b:deactivate", shutdown, (true, Finalized));
    }

    #[test]
    fn steps_before_the_command_keep_their_order() {
        let names = ["a".to_owned()];
        let mut execution = CommandExecution::new(ManagerCommand::Resume, &names);
        let steps = [ManagedTransition::Deactivate, ManagedTransition::Cleanup];
        execution.prepend(steps.map(|step| ("a".to_owned(), step)).to_vec());
        let expected = "a:deactivate a:cleanup a:activate";
        check(execution, "", expected, (true, ManagedState::Active));
    }
}
