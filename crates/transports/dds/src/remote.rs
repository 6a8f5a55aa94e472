//! Remote nodes, topics and services as plain data.

use periplus_cyclonedds_sys::{Guid, Vendor};
use periplus_graph::Qos;

/// Nodes, topics and services of all remote participants, sorted by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remote {
    /// Nodes.
    pub nodes: Vec<RemoteNode>,
    /// Topics with a publisher or subscription.
    pub topics: Vec<RemoteTopic>,
    /// Services with a server or client.
    pub services: Vec<RemoteService>,
}

/// Progress of discovery.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DiscoveryProgress {
    /// Number of changes of participants, endpoints and nodes so far.
    pub changes: u64,
    /// Number of participants found.
    pub participants: usize,
    /// Number of ROS 2 participants that are known in part: their nodes, some endpoints, or the
    /// nodes of some endpoints are missing.
    pub incomplete: usize,
}

/// A remote node.
#[derive(Clone, Debug, PartialEq)]
pub struct RemoteNode {
    /// Namespace and name. Names are not unique; ROS only warns about duplicates.
    pub name: String,
    /// Security enclave.
    pub enclave: String,
    /// DDS vendor.
    pub vendor: Vendor,
    /// GUID of its participant.
    pub participant: Guid,
}

/// A topic used by remote nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemoteTopic {
    /// Full name.
    pub name: String,
    /// Types, such as `sensor_msgs/msg/LaserScan`; more than one if the endpoints disagree.
    pub type_names: Vec<String>,
    /// Publishers.
    pub publishers: Vec<RemoteEndpoint>,
    /// Subscriptions.
    pub subscriptions: Vec<RemoteEndpoint>,
}

/// A remote publisher or subscription.
#[derive(Clone, Debug, PartialEq)]
pub struct RemoteEndpoint {
    /// GUID of the endpoint.
    pub guid: Guid,
    /// Full name of its node; none for programs without ROS, and until discovery reports it.
    pub node: Option<String>,
    /// Type.
    pub type_name: String,
    /// Type hash, if announced; ROS 2 Humble does not announce it.
    pub type_hash: Option<String>,
    /// QoS offered or requested. A depth of 0 is unknown.
    pub qos: Qos,
    /// DDS vendor.
    pub vendor: Vendor,
}

/// A service used by remote nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RemoteService {
    /// Full name.
    pub name: String,
    /// Types, such as `std_srvs/srv/Trigger`.
    pub type_names: Vec<String>,
    /// Full names of the server nodes.
    pub servers: Vec<String>,
    /// Full names of the client nodes.
    pub clients: Vec<String>,
}

impl Remote {
    /// Returns the topic of this full name.
    #[must_use]
    pub fn topic(&self, name: &str) -> Option<&RemoteTopic> {
        self.topics.iter().find(|topic| topic.name == name)
    }

    /// Returns the service of this full name.
    #[must_use]
    pub fn service(&self, name: &str) -> Option<&RemoteService> {
        self.services.iter().find(|service| service.name == name)
    }

    /// True if there is a node of this full name.
    #[must_use]
    pub fn has_node(&self, name: &str) -> bool {
        self.nodes.iter().any(|node| node.name == name)
    }
}
