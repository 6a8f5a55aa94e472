//! What there is in a graph, as plain data.

use crate::inlet::InletCounts;
use crate::sample::EndpointId;
use crate::{Policy, Qos};

/// A topic and its ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TopicInfo {
    /// Its full name.
    pub name: String,
    /// Its type, such as `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// The hash of its type, as far as known.
    pub type_hash: Option<String>,
    /// Who publishes, by name of the node.
    pub publishers: Vec<EndpointInfo>,
    /// Who subscribes, by name of the node.
    pub subscriptions: Vec<EndpointInfo>,
    /// Who does not get what whom publishes.
    pub mismatches: Vec<Mismatch>,
    /// How many taps listen.
    pub taps: usize,
}

/// One end of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct EndpointInfo {
    /// Which.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// What it offers or asks for.
    pub qos: Qos,
}

/// A publisher and a subscription whose QoS do not fit: nothing flows between them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// Full name of the node that publishes.
    pub publisher: String,
    /// Full name of the node that subscribes.
    pub subscription: String,
    /// In which policies the offer is too weak.
    pub policies: Vec<Policy>,
}

/// A service and its ends.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceInfo {
    /// Its full name.
    pub name: String,
    /// Its type, such as `std_srvs/srv/Trigger`.
    pub type_name: String,
    /// The hash of its type, as far as known.
    pub type_hash: Option<String>,
    /// Full name of the node that answers it.
    pub server: Option<String>,
    /// Full names of the nodes that call it, sorted.
    pub clients: Vec<String>,
}

/// A node and what it uses. All names are full and sorted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeInfo {
    /// Its full name.
    pub name: String,
    /// Topics that it publishes.
    pub publishes: Vec<String>,
    /// Topics that it subscribes to.
    pub subscribes: Vec<String>,
    /// Services that it answers.
    pub serves: Vec<String>,
    /// Services that it calls.
    pub calls: Vec<String>,
}

/// How much went through a topic. The difference of two over the time between them is the rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic {
    /// Full name of the topic.
    pub topic: String,
    /// When this was counted \[ns\].
    pub time_ns: i64,
    /// Messages of all publishers that it ever had.
    pub published: u64,
    /// Each publisher.
    pub publishers: Vec<PublisherTraffic>,
    /// Each subscription.
    pub subscriptions: Vec<SubscriptionTraffic>,
}

/// How much a publisher published.
#[derive(Clone, Debug, PartialEq)]
pub struct PublisherTraffic {
    /// Which.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// Messages, heard or not.
    pub published: u64,
    /// Deadlines that passed without a message.
    pub missed_deadlines: u64,
}

/// What happened at a subscription.
#[derive(Clone, Debug, PartialEq)]
pub struct SubscriptionTraffic {
    /// Which.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// Counted since it began.
    pub counts: InletCounts,
}

impl Traffic {
    /// Messages per second since an earlier count; none if no time has passed.
    #[must_use]
    pub fn rate_hz_since(&self, earlier: &Self) -> Option<f64> {
        let span_ns = self.time_ns - earlier.time_ns;
        let messages = self.published.saturating_sub(earlier.published);
        (0 < span_ns).then(|| messages as f64 * 1e9 / span_ns as f64)
    }
}
