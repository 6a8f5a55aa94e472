//! Transition request of a lifecycle node.

use periplus_graph::{Client, Graph, NodeSettings, Pending};
use periplus_msgs::lifecycle_msgs::{ChangeState, ChangeStateRequest, Transition};

use super::{Done, Task, TaskContext};
use crate::bringup::report::LaunchLog;

/// Task that requests one transition once the node exists.
pub(crate) struct TransitionTask {
    name: String,
    transition: Transition,
    client: Client<ChangeState>,
    pending: Option<Pending<ChangeState>>,
}

/// Number and label of a transition, as in `lifecycle_msgs/Transition`.
fn transition(label: &str) -> Option<Transition> {
    let id = match label {
        "configure" => Transition::TRANSITION_CONFIGURE,
        "cleanup" => Transition::TRANSITION_CLEANUP,
        "activate" => Transition::TRANSITION_ACTIVATE,
        "deactivate" => Transition::TRANSITION_DEACTIVATE,
        "unconfigured_shutdown" => Transition::TRANSITION_UNCONFIGURED_SHUTDOWN,
        "inactive_shutdown" => Transition::TRANSITION_INACTIVE_SHUTDOWN,
        "shutdown" | "active_shutdown" => Transition::TRANSITION_ACTIVE_SHUTDOWN,
        _ => return None,
    };
    Some(Transition { id, label: label.to_owned() })
}

impl TransitionTask {
    /// Creates the task for a node by its full name.
    ///
    /// # Errors
    /// A message when there is no such transition.
    pub(crate) fn new(graph: &Graph, name: &str, label: &str) -> Result<Self, String> {
        let transition = transition(label).ok_or_else(|| {
            format!(
                "unknown transition `{label}`; lifecycle nodes have `configure`, `activate`, ..."
            )
        })?;
        let client = graph
            .node(
                NodeSettings::new(format!(
                    "launch_{}_{label}",
                    name.trim_matches('/').replace('/', "_")
                ))
                .bare()
                .keep_names(),
            )
            .and_then(|node| node.client::<ChangeState>(&format!("{name}/change_state")))
            .map_err(|error| error.to_string())?;
        Ok(Self { name: name.to_owned(), transition, client, pending: None })
    }
}

impl Task for TransitionTask {
    fn work(&mut self, stage: &mut TaskContext<'_>) -> Done {
        let Some(pending) = &self.pending else {
            if self.client.is_ready() {
                let mut transition = self.transition.clone();
                // Nodes select by the label if there is one, and all shutdowns have the same label.
                if transition.label.ends_with("_shutdown") {
                    transition.label.clear();
                }
                self.pending = Some(self.client.call(ChangeStateRequest { transition }));
            }
            return Done::No;
        };
        let Some(answer) = pending.take() else { return Done::No };
        let label = &self.transition.label;
        match answer {
            Ok(answer) if answer.success => {}
            Ok(_) => {
                stage.said.push(LaunchLog::error(format!("{}: `{label}` failed", self.name)));
            }
            Err(error) => {
                stage.said.push(LaunchLog::error(format!("{}: `{label}`: {error}", self.name)));
            }
        }
        Done::Yes
    }
}
