//! Which actions there are.

use std::collections::BTreeMap;

use crate::graph::Graph;

/// An action and its ends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ActionInfo {
    /// Its full name.
    pub name: String,
    /// Its type, such as `nav2_msgs/action/Spin`.
    pub type_name: String,
    /// Full names of the nodes that work on its goals, sorted.
    pub servers: Vec<String>,
    /// Full names of the nodes that send goals, sorted.
    pub clients: Vec<String>,
}

impl Graph {
    /// The actions that somebody works on or sends goals of, by name. They are known by their
    /// topics of feedback, as `rcl_action` knows them, so that those of others are seen, too.
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
