//! Who else is there, as plain data.

use periplus_cyclonedds_sys::{Guid, Vendor};
use periplus_graph::Qos;

/// The nodes, topics and services of all others on the wire. Everything is sorted by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remote {
    /// Nodes.
    pub nodes: Vec<RemoteNode>,
    /// Topics that somebody publishes or subscribes to.
    pub topics: Vec<RemoteTopic>,
    /// Services that somebody answers or calls.
    pub services: Vec<RemoteService>,
}

/// How far discovery has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Number of participants, endpoints and nodes that came, changed or went so far.
    pub changes: u64,
    /// Number of participants found.
    pub participants: usize,
    /// Number of participants of ROS 2 that are known in part: their nodes, some endpoints, or the
    /// nodes of some endpoints are still missing.
    pub incomplete: usize,
}

/// A node elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct RemoteNode {
    /// Namespace and name. Two nodes can have one name; ROS only warns of it.
    pub name: String,
    /// Its security enclave.
    pub enclave: String,
    /// Who made its DDS.
    pub vendor: Vendor,
    /// Its participant.
    pub participant: Guid,
}

/// A topic that others use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemoteTopic {
    /// Its full name.
    pub name: String,
    /// Its types, such as `sensor_msgs/msg/LaserScan`; two or more when the ends do not agree.
    pub type_names: Vec<String>,
    /// Who publishes.
    pub publishers: Vec<RemoteEndpoint>,
    /// Who subscribes.
    pub subscriptions: Vec<RemoteEndpoint>,
}

/// One end of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct RemoteEndpoint {
    /// Its name in DDS.
    pub guid: Guid,
    /// Full name of its node; none for programs without ROS, and for a moment after it came.
    pub node: Option<String>,
    /// Its type.
    pub type_name: String,
    /// The hash of its type, as far as told; ROS 2 Humble does not tell.
    pub type_hash: Option<String>,
    /// What it offers or asks for. A depth of 0 is one that nobody told.
    pub qos: Qos,
    /// Who made its DDS.
    pub vendor: Vendor,
}

/// A service that others use.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemoteService {
    /// Its full name.
    pub name: String,
    /// Its types, such as `std_srvs/srv/Trigger`.
    pub type_names: Vec<String>,
    /// Full names of the nodes that answer it.
    pub servers: Vec<String>,
    /// Full names of the nodes that call it.
    pub clients: Vec<String>,
}

impl Remote {
    /// The topic of this full name.
    #[must_use]
    pub fn topic(&self, name: &str) -> Option<&RemoteTopic> {
        self.topics.iter().find(|topic| topic.name == name)
    }

    /// The service of this full name.
    #[must_use]
    pub fn service(&self, name: &str) -> Option<&RemoteService> {
        self.services.iter().find(|service| service.name == name)
    }

    /// Whether there is a node of this full name.
    #[must_use]
    pub fn has_node(&self, name: &str) -> bool {
        self.nodes.iter().any(|node| node.name == name)
    }
}
