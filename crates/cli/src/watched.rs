//! What a managed node of this program says and becomes.

use periplus_graph::{GraphError, Level, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::lifecycle_msgs::{State, TransitionEvent};
use periplus_msgs::rcl_interfaces::Log;

use crate::terminal::say;

/// What a managed node says and becomes.
pub(crate) struct Watched {
    logger: String,
    logs: Mailbox<Log>,
    events: Mailbox<TransitionEvent>,
    _node: Node,
}

impl Watched {
    pub(crate) fn new(watched: &Node) -> Result<Self, GraphError> {
        let name = format!("_{}_watch", watched.names().name());
        let node = watched.graph().node(NodeSettings::new(name).bare())?;
        let events = format!("{}/transition_event", watched.full_name());
        Ok(Self {
            logger: watched.logger(),
            logs: node.mailbox("/rosout", Qos::latched(100))?,
            events: node.mailbox(&events, Qos::reliable(100))?,
            _node: node,
        })
    }

    /// Writes what has been logged.
    pub(crate) fn tell(&self) {
        for line in self.logs.drain().iter().filter(|line| line.name == self.logger) {
            say(&format!("[{}] [{}]: {}", Level::of_number(line.level), line.name, line.msg));
        }
    }

    /// Whether it could not be configured, or ended; why has been logged.
    pub(crate) fn gave_up(&self) -> bool {
        let gave_up = [State::PRIMARY_STATE_UNCONFIGURED, State::PRIMARY_STATE_FINALIZED];
        self.events.drain().iter().any(|event| gave_up.contains(&event.goal_state.id))
    }
}
