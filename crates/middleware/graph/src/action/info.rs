//! The actions of a graph.

use std::collections::BTreeMap;

use crate::graph::Graph;

/// An action with its servers and clients.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ActionInfo {
    /// Full name.
    pub name: String,
    /// Type, such as `nav2_msgs/action/Spin`.
    pub type_name: String,
    /// Full names of the nodes that serve it, sorted.
    pub servers: Vec<String>,
    /// Full names of the nodes that send goals, sorted.
    pub clients: Vec<String>,
}

impl Graph {
    /// Returns the actions with a server or a client, by name. They are found by their feedback
    /// topics, as in `rcl_action`, so that those of other programs are included.
    #[must_use]
    pub fn actions(&self) -> Vec<ActionInfo> {
        let mut actions = BTreeMap::<String, ActionInfo>::new();
        for topic in self.topics() {
            let Some(name) = topic.name.strip_suffix("/_action/feedback") else { continue };
            let Some(type_name) = topic.type_name.strip_suffix("_FeedbackMessage") else {
                continue;
            };
            let nodes = |ends: &[crate::EndpointInfo]| {
                let mut nodes: Vec<String> = ends.iter().map(|end| end.node.clone()).collect();
                nodes.sort();
                nodes.dedup();
                nodes
            };
            let info = ActionInfo {
                name: name.to_owned(),
                type_name: type_name.to_owned(),
                servers: nodes(&topic.publishers),
                clients: nodes(&topic.subscriptions),
            };
            actions.insert(name.to_owned(), info);
        }
        actions.into_values().collect()
    }
}
