//! Tree nodes that cancel the goals of an action server.
//!
//! Source: `nav2_behavior_tree/bt_cancel_action_node.hpp`.

use std::sync::Arc;

use periplus_behavior_tree::{BehaviorNode, NodeRun, NodeStatus, TreeError};
use periplus_graph::{Client, Level, Pending};
use periplus_msgs::action_msgs::{CancelGoal, CancelGoalRequest, GoalInfo};
use periplus_msgs::builtin_interfaces::Time;

use super::shared::Shared;

/// Goals that were accepted within this time are not canceled \[ns\].
const MIN_AGE_NS: i64 = 10_000_000;

/// Node that cancels all goals of a server.
pub(super) struct CancelNode {
    shared: Arc<Shared>,
    server: &'static str,
    client: Option<(String, Client<CancelGoal>)>,
    sent: Option<Pending<CancelGoal>>,
    since_ns: i64,
}

impl CancelNode {
    pub(super) fn new(shared: Arc<Shared>, server: &'static str) -> Self {
        Self { shared, server, client: None, sent: None, since_ns: 0 }
    }
}

impl BehaviorNode for CancelNode {
    fn tick(&mut self, run: &mut NodeRun<'_>) -> Result<NodeStatus, TreeError> {
        let now_ns = run.now_ns();
        if run.status() != NodeStatus::Running {
            self.sent = None;
        }
        let name = run.input_text("server_name").filter(|name| !name.is_empty());
        let name = name.unwrap_or_else(|| self.server.to_owned());
        if self.client.as_ref().is_none_or(|(known, _)| *known != name) {
            let client = self.shared.node.client(&format!("{name}/_action/cancel_goal"));
            self.client =
                Some((name.clone(), client.map_err(|error| run.error(error.to_string()))?));
        }
        let Some(sent) = &self.sent else {
            let Some((_, client)) = &self.client else { return Ok(NodeStatus::Failure) };
            let stamp = Time::of_ns((now_ns - MIN_AGE_NS).max(1));
            let goal_info = GoalInfo { stamp, ..GoalInfo::default() };
            self.sent = Some(client.call(CancelGoalRequest { goal_info }));
            self.since_ns = now_ns;
            return Ok(NodeStatus::Running);
        };
        match sent.take() {
            Some(Ok(_)) => Ok(NodeStatus::Success),
            None if now_ns - self.since_ns < self.shared.params.server_timeout_ns() => {
                Ok(NodeStatus::Running)
            }
            _ => {
                let text = format!("Failed to cancel the action server for {name}");
                self.shared.node.log(Level::Error, text);
                Ok(NodeStatus::Failure)
            }
        }
    }

    fn halt(&mut self, _: &mut NodeRun<'_>) -> Result<(), TreeError> {
        self.sent = None;
        Ok(())
    }
}
