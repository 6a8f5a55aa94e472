//! Log messages and lifecycle state of a node.

use periplus_graph::{GraphError, Level, Mailbox, Node, NodeSettings, Qos};
use periplus_msgs::lifecycle_msgs::{State, TransitionEvent};
use periplus_msgs::rcl_interfaces::Log;

use crate::terminal::say;

/// Monitor of the log messages and the lifecycle state of a node.
pub struct NodeMonitor {
    logger: String,
    logs: Mailbox<Log>,
    events: Mailbox<TransitionEvent>,
    _node: Node,
}

impl NodeMonitor {
    /// Monitors a node, from a hidden node.
    ///
    /// # Errors
    /// An error when the graph refuses the names.
    pub fn new(monitor: &Node) -> Result<Self, GraphError> {
        let name = monitor.full_name().replace('/', "_");
        let node = monitor.graph().node(NodeSettings::new(format!("{name}_watch")).bare())?;
        let events = format!("{}/transition_event", monitor.full_name());
        Ok(Self {
            logger: monitor.logger(),
            logs: node.mailbox("/rosout", Qos::latched(100))?,
            events: node.mailbox(&events, Qos::reliable(100))?,
            _node: node,
        })
    }

    /// Prints new log messages; returns true if the node failed.
    pub fn print_log(&self) -> bool {
        // Read before the log, whose lines come first.
        let events = self.events.drain();
        for line in self.logs.drain().iter().filter(|line| line.name == self.logger) {
            say(&format!("[{}] [{}]: {}", Level::of_number(line.level), line.name, line.msg));
        }
        let gave_up = [State::PRIMARY_STATE_UNCONFIGURED, State::PRIMARY_STATE_FINALIZED];
        events.iter().any(|event| gave_up.contains(&event.goal_state.id))
    }
}
