//! Asks a managed node for a transition, once it is there.

use periplus_graph::{Client, Graph, NodeSettings, Pending};
use periplus_msgs::lifecycle_msgs::{ChangeState, ChangeStateRequest, Transition};

use super::{Done, Hand, Stage};
use crate::bringup::told::Said;

/// Asks for one transition.
pub(crate) struct Changer {
    name: String,
    transition: Transition,
    client: Client<ChangeState>,
    pending: Option<Pending<ChangeState>>,
}

/// The number and label of a transition, as `lifecycle_msgs/Transition` has them.
pub(crate) fn transition(label: &str) -> Option<Transition> {
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

impl Changer {
    /// Of a node by its full name.
    ///
    /// # Errors
    /// In words, when there is no such transition.
    pub(crate) fn new(graph: &Graph, name: &str, label: &str) -> Result<Self, String> {
        let transition = transition(label).ok_or_else(|| {
            format!(
                "managed nodes know no transition `{label}`; they know `configure`, `activate`, ..."
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

impl Hand for Changer {
    fn work(&mut self, stage: &mut Stage<'_>) -> Done {
        let Some(pending) = &self.pending else {
            if self.client.is_ready() {
                let transition = self.transition.clone();
                self.pending = Some(self.client.call(ChangeStateRequest { transition }));
            }
            return Done::No;
        };
        let Some(answer) = pending.take() else { return Done::No };
        let label = &self.transition.label;
        match answer {
            Ok(answer) if answer.success => {}
            Ok(_) => {
                stage.said.push(Said::error(format!("{}: `{label}` has failed", self.name)));
            }
            Err(error) => {
                stage.said.push(Said::error(format!("{}: `{label}`: {error}", self.name)));
            }
        }
        Done::Yes
    }
}
