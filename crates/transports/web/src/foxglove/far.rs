//! What is on a network beyond the graph, where the graph is on one.

use std::collections::BTreeSet;

use periplus_graph::Qos;

/// What others have on a network that the graph is attached to. A graph knows of it only what it
/// uses itself, so that clients would not see what they may ask for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Far {
    /// Topics.
    pub topics: Vec<FarTopic>,
    /// Services.
    pub services: Vec<FarService>,
}

/// A topic that others use.
#[derive(Clone, Debug, PartialEq)]
pub struct FarTopic {
    /// Its full name.
    pub name: String,
    /// Its type.
    pub type_name: String,
    /// The hash of its type, as far as known.
    pub type_hash: Option<String>,
    /// Who publishes, and what each offers.
    pub publishers: Vec<FarEnd>,
    /// Who subscribes, and what each asks for.
    pub subscriptions: Vec<FarEnd>,
}

/// One end of a topic.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FarEnd {
    /// Full name of its node.
    pub node: String,
    /// What it offers or asks for.
    pub qos: Qos,
}

/// A service that others answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FarService {
    /// Its full name.
    pub name: String,
    /// Its type.
    pub type_name: String,
    /// Full names of the nodes that answer it.
    pub servers: BTreeSet<String>,
}

impl FarTopic {
    /// What to ask for, so that all offers fit and the best of them is had.
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

/// Messages of one publisher that wait where nothing is told of it: transforms come in bursts.
const DEPTH: usize = 100;
