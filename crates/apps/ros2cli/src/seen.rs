//! Snapshot of the ROS graph.

use std::collections::BTreeMap;

use periplus_graph::{EndpointInfo, Graph, Qos, TopicInfo};

/// Nodes, topics and services on the network, without those of the command itself, sorted by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// Nodes; names may be duplicated.
    pub nodes: Vec<SeenNode>,
    /// Topics.
    pub topics: Vec<SeenTopic>,
    /// Services.
    pub services: Vec<SeenService>,
}

/// Node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenNode {
    /// Namespace and name.
    pub name: String,
}

/// Topic.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenTopic {
    /// Full name.
    pub name: String,
    /// Types; two or more if its endpoints disagree.
    pub types: Vec<String>,
    /// Publishers.
    pub publishers: Vec<TopicEndpoint>,
    /// Subscriptions.
    pub subscriptions: Vec<TopicEndpoint>,
}

/// Endpoint of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct TopicEndpoint {
    /// Full name of its node, if known.
    pub node: Option<String>,
    /// Message type.
    pub type_name: String,
    /// Type hash, if reported.
    pub type_hash: Option<String>,
    /// GID, in the format of `ros2 topic info -v`.
    pub gid: String,
    /// Offered or requested QoS. A depth of 0 is unknown.
    pub qos: Qos,
}

/// Service.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenService {
    /// Full name.
    pub name: String,
    /// Types.
    pub types: Vec<String>,
    /// Full names of the nodes with a server.
    pub servers: Vec<String>,
    /// Full names of the nodes with a client.
    pub clients: Vec<String>,
}

impl SeenService {
    /// JSON object of the service.
    pub(crate) fn to_json(&self) -> serde_json::Value {
        serde_json::json!({
            "name": self.name,
            "types": self.types,
            "servers": self.servers,
            "clients": self.clients,
        })
    }
}

/// Returns true for hidden names: a part of the name begins with `_`.
#[must_use]
pub fn is_hidden(name: &str) -> bool {
    name.split('/').any(|part| part.starts_with('_'))
}

impl Seen {
    /// Snapshot of a graph, without the nodes whose names `is_own` accepts.
    #[must_use]
    pub fn of_graph(graph: &Graph, is_own: impl Fn(&str) -> bool) -> Self {
        let end = |topic: &TopicInfo, end: &EndpointInfo| TopicEndpoint {
            node: Some(end.node.clone()),
            type_name: topic.type_name.clone(),
            type_hash: topic.type_hash.clone(),
            gid: String::new(),
            qos: end.qos,
        };
        let others = |ends: &[EndpointInfo], topic: &TopicInfo| -> Vec<TopicEndpoint> {
            let ends = ends.iter().filter(|end| !is_own(&end.node));
            ends.map(|one| end(topic, one)).collect()
        };
        let topics = graph.topics();
        let topics = topics.iter().map(|topic| SeenTopic {
            name: topic.name.clone(),
            types: vec![topic.type_name.clone()],
            publishers: others(&topic.publishers, topic),
            subscriptions: others(&topic.subscriptions, topic),
        });
        let services = graph.services().into_iter().map(|service| SeenService {
            name: service.name,
            types: vec![service.type_name],
            servers: service.server.into_iter().filter(|node| !is_own(node)).collect(),
            clients: service.clients.into_iter().filter(|node| !is_own(node)).collect(),
        });
        let nodes = graph.nodes().into_iter().map(|node| node.name);
        Self {
            nodes: nodes.filter(|name| !is_own(name)).map(|name| SeenNode { name }).collect(),
            topics: topics
                .filter(|topic| !topic.publishers.is_empty() || !topic.subscriptions.is_empty())
                .collect(),
            services: services
                .filter(|service| !service.servers.is_empty() || !service.clients.is_empty())
                .collect(),
        }
    }

    /// Topic of this full name.
    #[must_use]
    pub fn topic(&self, name: &str) -> Option<&SeenTopic> {
        self.topics.iter().find(|topic| topic.name == name)
    }

    /// Service of this full name.
    #[must_use]
    pub fn service(&self, name: &str) -> Option<&SeenService> {
        self.services.iter().find(|service| service.name == name)
    }

    /// Number of nodes of this full name.
    #[must_use]
    pub fn count_nodes(&self, name: &str) -> usize {
        self.nodes.iter().filter(|node| node.name == name).count()
    }

    /// Full names of the nodes, sorted, with duplicates.
    #[must_use]
    pub fn node_names(&self, with_hidden: bool) -> Vec<&str> {
        let names = self.nodes.iter().map(|node| node.name.as_str());
        let mut names: Vec<&str> = names.filter(|name| with_hidden || !is_hidden(name)).collect();
        names.sort_unstable();
        names
    }

    /// Actions with a server or client: name, types, servers, clients. They are recognized by their
    /// `send_goal` service and status topic.
    #[must_use]
    pub fn actions(&self) -> Vec<SeenService> {
        let mut actions: BTreeMap<&str, SeenService> = BTreeMap::new();
        for service in &self.services {
            let Some(name) = service.name.strip_suffix("/_action/send_goal") else { continue };
            let types = service.types.iter();
            let types = types.filter_map(|name| name.strip_suffix("_SendGoal"));
            actions.insert(
                name,
                SeenService {
                    name: name.to_owned(),
                    types: types.map(str::to_owned).collect(),
                    servers: service.servers.clone(),
                    clients: service.clients.clone(),
                },
            );
        }
        actions.into_values().collect()
    }
}
