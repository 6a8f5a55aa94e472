//! Introspection of a graph as plain data.

use crate::sample::EndpointId;
use crate::subscription_core::SubscriptionCounts;
use crate::{Policy, Qos};

/// A topic and its endpoints.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TopicInfo {
    /// Full name.
    pub name: String,
    /// Type, such as `sensor_msgs/msg/LaserScan`.
    pub type_name: String,
    /// Type hash, if known.
    pub type_hash: Option<String>,
    /// Publishers, sorted by node name.
    pub publishers: Vec<EndpointInfo>,
    /// Subscriptions, sorted by node name.
    pub subscriptions: Vec<EndpointInfo>,
    /// Pairs of publishers and subscriptions with incompatible QoS.
    pub mismatches: Vec<QosMismatch>,
    /// Number of taps.
    pub taps: usize,
}

/// A publisher or subscription of a topic.
#[derive(Clone, Debug, PartialEq)]
pub struct EndpointInfo {
    /// Id of the endpoint.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// QoS that it offers or requests.
    pub qos: Qos,
}

/// A publisher and a subscription with incompatible QoS: no messages are exchanged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct QosMismatch {
    /// Full name of the publishing node.
    pub publisher: String,
    /// Full name of the subscribing node.
    pub subscription: String,
    /// Policies in which the offer is too weak.
    pub policies: Vec<Policy>,
}

/// A service and its endpoints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServiceInfo {
    /// Full name.
    pub name: String,
    /// Type, such as `std_srvs/srv/Trigger`.
    pub type_name: String,
    /// Type hash, if known.
    pub type_hash: Option<String>,
    /// Full name of the node that serves it.
    pub server: Option<String>,
    /// Full names of the client nodes, sorted.
    pub clients: Vec<String>,
}

/// A node and its topics and services. All names are full and sorted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeInfo {
    /// Full name.
    pub name: String,
    /// Published topics.
    pub publishes: Vec<String>,
    /// Subscribed topics.
    pub subscribes: Vec<String>,
    /// Services that it serves.
    pub serves: Vec<String>,
    /// Services that it is a client of.
    pub calls: Vec<String>,
}

/// Message counts of a topic. The difference of two over the time between them is the rate.
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic {
    /// Full name of the topic.
    pub topic: String,
    /// Time of the count \[ns\].
    pub time_ns: i64,
    /// Messages published by all publishers, including removed ones.
    pub published: u64,
    /// Counts of each publisher.
    pub publishers: Vec<PublisherTraffic>,
    /// Counts of each subscription.
    pub subscriptions: Vec<SubscriptionTraffic>,
}

/// Message counts of a publisher.
#[derive(Clone, Debug, PartialEq)]
pub struct PublisherTraffic {
    /// Id of the endpoint.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// Messages published, with or without subscribers.
    pub published: u64,
    /// Deadlines that passed without a message.
    pub missed_deadlines: u64,
}

/// Message counts of a subscription.
#[derive(Clone, Debug, PartialEq)]
pub struct SubscriptionTraffic {
    /// Id of the endpoint.
    pub id: EndpointId,
    /// Full name of its node.
    pub node: String,
    /// Counts since it was created.
    pub counts: SubscriptionCounts,
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
