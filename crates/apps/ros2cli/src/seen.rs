//! Who is there, as plain data.

use std::collections::BTreeMap;

use periplus_graph::{EndpointInfo, Graph, Qos, TopicInfo};

/// The nodes, topics and services on the network, those of the command itself left out. Everything
/// is sorted by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    /// Nodes; two can have one name.
    pub nodes: Vec<SeenNode>,
    /// Topics.
    pub topics: Vec<SeenTopic>,
    /// Services.
    pub services: Vec<SeenService>,
}

/// A node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenNode {
    /// Namespace and name.
    pub name: String,
}

/// A topic.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenTopic {
    /// Its full name.
    pub name: String,
    /// Its types; two or more when its ends do not agree.
    pub types: Vec<String>,
    /// Who publishes.
    pub publishers: Vec<SeenEnd>,
    /// Who subscribes.
    pub subscriptions: Vec<SeenEnd>,
}

/// One end of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenEnd {
    /// Full name of its node, as far as known.
    pub node: Option<String>,
    /// Its type.
    pub type_name: String,
    /// The hash of its type, as far as told.
    pub type_hash: Option<String>,
    /// Its name on the network, as `ros2 topic info -v` prints it.
    pub gid: String,
    /// What it offers or asks for. A depth of 0 is one that nobody told.
    pub qos: Qos,
}

/// A service.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SeenService {
    /// Its full name.
    pub name: String,
    /// Its types.
    pub types: Vec<String>,
    /// Full names of the nodes that answer it.
    pub servers: Vec<String>,
    /// Full names of the nodes that call it.
    pub clients: Vec<String>,
}

impl SeenService {
    /// As one JSON object.
    pub(crate) fn to_json(&self) -> serde_json::Value {
        serde_json::json!({
            "name": self.name,
            "types": self.types,
            "servers": self.servers,
            "clients": self.clients,
        })
    }
}

/// Whether ROS hides a name unless it is asked for: a part of it begins with `_`.
#[must_use]
pub fn is_hidden(name: &str) -> bool {
    name.split('/').any(|part| part.starts_with('_'))
}

impl Seen {
    /// What a graph has, without the nodes whose names `is_own` accepts.
    #[must_use]
    pub fn of_graph(graph: &Graph, is_own: impl Fn(&str) -> bool) -> Self {
        let end = |topic: &TopicInfo, end: &EndpointInfo| SeenEnd {
            node: Some(end.node.clone()),
            type_name: topic.type_name.clone(),
            type_hash: topic.type_hash.clone(),
            gid: String::new(),
            qos: end.qos,
        };
        let others = |ends: &[EndpointInfo], topic: &TopicInfo| -> Vec<SeenEnd> {
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

    /// The topic of this full name.
    #[must_use]
    pub fn topic(&self, name: &str) -> Option<&SeenTopic> {
        self.topics.iter().find(|topic| topic.name == name)
    }

    /// The service of this full name.
    #[must_use]
    pub fn service(&self, name: &str) -> Option<&SeenService> {
        self.services.iter().find(|service| service.name == name)
    }

    /// How many nodes have this full name.
    #[must_use]
    pub fn count_nodes(&self, name: &str) -> usize {
        self.nodes.iter().filter(|node| node.name == name).count()
    }

    /// Full names of the nodes, sorted, each as often as it is there.
    #[must_use]
    pub fn node_names(&self, with_hidden: bool) -> Vec<&str> {
        let names = self.nodes.iter().map(|node| node.name.as_str());
        let mut names: Vec<&str> = names.filter(|name| with_hidden || !is_hidden(name)).collect();
        names.sort_unstable();
        names
    }

    /// Actions that some node has a server for, or a client: name, types, servers, clients. They
    /// are known by the service that begins a task and by the topic that tells how tasks go.
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
