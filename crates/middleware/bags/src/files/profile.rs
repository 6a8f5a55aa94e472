//! Conversion of QoS between bags and graphs.

use crate as bags;
use crate::{BagTopic, QosProfile, TopicInformation};
use periplus_graph::{Durability, History, Liveliness, Qos, Reliability};

/// Metadata of a topic.
pub(crate) fn topic_info(topic: &BagTopic) -> TopicInformation {
    let about = |key: &str| topic.metadata.get(key).map_or("", String::as_str);
    TopicInformation {
        name: topic.name.clone(),
        type_name: topic.type_name.clone(),
        type_hash: about("topic_type_hash").into(),
        encoding: topic.encoding.clone(),
        qos: topic.offered_qos(),
        messages: 0,
    }
}

/// QoS profile of a publisher. A depth of 0 is unknown: DDS does not require announcing it, and
/// rosbag2 writes `unknown`.
pub(crate) fn profile(qos: &Qos) -> QosProfile {
    let span = |ns: Option<i64>| ns.and_then(|ns| u64::try_from(ns).ok());
    QosProfile {
        history: match qos.history {
            History::KeepLast if qos.depth == 0 => bags::History::Unknown,
            History::KeepLast => bags::History::KeepLast,
            History::KeepAll => bags::History::KeepAll,
        },
        depth: qos.depth as u64,
        reliability: match qos.reliability {
            Reliability::Reliable => bags::Reliability::Reliable,
            Reliability::BestEffort => bags::Reliability::BestEffort,
        },
        durability: match qos.durability {
            Durability::TransientLocal => bags::Durability::TransientLocal,
            Durability::Volatile => bags::Durability::Volatile,
        },
        deadline_ns: span(qos.deadline_ns),
        lifespan_ns: span(qos.lifespan_ns),
        liveliness: match qos.liveliness {
            Liveliness::Automatic => bags::Liveliness::Automatic,
            Liveliness::ManualByTopic => bags::Liveliness::ManualByTopic,
        },
        lease_ns: span(qos.lease_ns),
    }
}

/// QoS of a player's publisher from the recorded ones: reliable if all were, and transient local if
/// all were, so that every original subscriber is compatible. Deadlines and lifespans are not
/// applied.
pub(crate) fn offer(profiles: &[QosProfile]) -> Qos {
    let reliable = |one: &QosProfile| one.reliability != bags::Reliability::BestEffort;
    let latched = |one: &QosProfile| one.durability == bags::Durability::TransientLocal;
    let depth = profiles.iter().map(|one| one.depth).max().unwrap_or(0).clamp(1, 10_000);
    let mut qos = Qos::reliable(usize::try_from(depth).unwrap_or(10).max(10));
    if !profiles.is_empty() && profiles.iter().all(latched) {
        qos = Qos::latched(usize::try_from(depth).unwrap_or(1));
    }
    if !profiles.iter().all(reliable) {
        qos = qos.with_reliability(Reliability::BestEffort);
    }
    qos
}
