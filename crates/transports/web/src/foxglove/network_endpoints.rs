//! Remote topics and services of the network that the graph is attached to.

use std::collections::BTreeSet;

use periplus_graph::Qos;

/// Remote endpoints of the network. The graph lists only the topics that it uses itself; clients
/// can subscribe to these as well.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NetworkEndpoints {
    /// Topics.
    pub topics: Vec<NetworkTopic>,
    /// Services.
    pub services: Vec<NetworkService>,
}

/// A topic used by remote nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkTopic {
    /// Full name.
    pub name: String,
    /// Type.
    pub type_name: String,
    /// Type hash, if known.
    pub type_hash: Option<String>,
    /// Publishers with their offered QoS.
    pub publishers: Vec<NetworkEndpoint>,
    /// Subscriptions with their requested QoS.
    pub subscriptions: Vec<NetworkEndpoint>,
}

/// A remote publisher or subscription.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkEndpoint {
    /// Full name of its node.
    pub node: String,
    /// QoS offered or requested.
    pub qos: Qos,
}

/// A service with remote servers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkService {
    /// Full name.
    pub name: String,
    /// Type.
    pub type_name: String,
    /// Full names of the server nodes.
    pub servers: BTreeSet<String>,
}

impl NetworkTopic {
    /// The strongest request that is compatible with all offers.
    pub(crate) fn wanted(&self) -> Qos {
        let weakest = |one: Qos, other: &Qos| Qos {
            reliability: one.reliability.min(other.reliability),
            durability: one.durability.min(other.durability),
            depth: one.depth.max(other.depth),
            ..one
        };
        let mut offers = self.publishers.iter().map(|end| &end.qos);
        let first = offers.next().copied().unwrap_or_default();
        let depth = first.depth.max(DEPTH);
        let qos = Qos {
            reliability: first.reliability,
            durability: first.durability,
            ..Qos::reliable(depth)
        };
        offers.fold(qos, weakest)
    }
}

/// Queue depth per publisher if its depth is unknown; transforms come in bursts.
const DEPTH: usize = 100;
