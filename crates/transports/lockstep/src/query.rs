//! Questions of a process about the graph, and the endpoints that it creates.

use periplus_graph::{Durability, History, Liveliness, Qos, Reliability};
use serde::{Deserialize, Serialize};

/// Name of a node.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct NodeWords {
    /// Name without namespace.
    pub name: String,
    /// Namespace; empty for the root.
    pub namespace: String,
}

/// A publisher or subscription of a topic.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct EndpointWords {
    /// Full name of its node.
    pub node: String,
    /// Type of the topic.
    pub type_name: String,
    /// Type hash, if known.
    pub type_hash: Option<String>,
    /// QoS.
    #[serde(with = "QosWords")]
    pub qos: Qos,
}

/// Endpoint to create.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct NewEndpoint {
    pub(crate) id: u32,
    pub(crate) node: u32,
    pub(crate) name: String,
    pub(crate) type_name: String,
    pub(crate) type_hash: Option<String>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Query {
    Hello {
        token: String,
        pid: u32,
    },
    Node {
        id: u32,
        words: NodeWords,
    },
    Publisher(NewEndpoint, #[serde(with = "QosWords")] Qos),
    Subscription(NewEndpoint, #[serde(with = "QosWords")] Qos),
    Client(NewEndpoint),
    Server(NewEndpoint),
    /// Number of subscriptions of a publisher, publishers of a subscription, or servers of a client.
    Matched {
        id: u32,
    },
    Topics,
    Services,
    Nodes,
    Endpoints {
        topic: String,
        publishers: bool,
    },
    /// QoS events of a publisher or subscription since the last question.
    Events {
        id: u32,
    },
}

impl Query {
    /// Reply of a graph with nothing in it.
    pub(crate) fn reply_of_nobody(&self) -> Reply {
        match self {
            Self::Matched { .. } => Reply::Count(0),
            Self::Topics | Self::Services => Reply::Names(Vec::new()),
            Self::Nodes => Reply::Nodes(Vec::new()),
            Self::Endpoints { .. } => Reply::Endpoints(Vec::new()),
            Self::Events { .. } => Reply::Words(Vec::new()),
            Self::Hello { .. }
            | Self::Node { .. }
            | Self::Publisher(..)
            | Self::Subscription(..)
            | Self::Client(_)
            | Self::Server(_) => Reply::Done,
        }
    }
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Reply {
    Done,
    Count(usize),
    Names(Vec<(String, String)>),
    Words(Vec<String>),
    Nodes(Vec<NodeWords>),
    Endpoints(Vec<EndpointWords>),
    Failed(String),
}

/// Serialized form of [`Qos`].
#[derive(Serialize, Deserialize)]
#[serde(remote = "Qos")]
struct QosWords {
    #[serde(with = "ReliabilityWords")]
    reliability: Reliability,
    #[serde(with = "DurabilityWords")]
    durability: Durability,
    #[serde(with = "HistoryWords")]
    history: History,
    depth: usize,
    deadline_ns: Option<i64>,
    lifespan_ns: Option<i64>,
    #[serde(with = "LivelinessWords")]
    liveliness: Liveliness,
    lease_ns: Option<i64>,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Reliability")]
enum ReliabilityWords {
    BestEffort,
    Reliable,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Durability")]
enum DurabilityWords {
    Volatile,
    TransientLocal,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "History")]
enum HistoryWords {
    KeepLast,
    KeepAll,
}

#[derive(Serialize, Deserialize)]
#[serde(remote = "Liveliness")]
enum LivelinessWords {
    Automatic,
    ManualByTopic,
}
