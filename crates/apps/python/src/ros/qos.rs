//! QoS as a tuple of Python.

use periplus::graph::{Durability, History, Liveliness, Qos, Reliability};
use pyo3::prelude::*;

use crate::errors::value_error;

/// History, depth, reliability, durability, deadline, lifespan, liveliness and lease \[ns\].
pub(crate) type QosWords =
    (String, usize, String, String, Option<i64>, Option<i64>, String, Option<i64>);

/// Depth of a history whose depth is left to the system.
const DEFAULT_DEPTH: usize = 10;

/// Side of a topic: "best available" is the strongest for a publisher and the weakest for a subscription.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Side {
    Publisher,
    Subscription,
}

/// QoS of words.
///
/// # Errors
/// `ValueError` that names an unknown word.
pub(crate) fn read(words: QosWords, side: Side) -> PyResult<Qos> {
    let (history, depth, reliability, durability, deadline_ns, lifespan_ns, liveliness, lease_ns) =
        words;
    let unknown = |what: &str, word: &str| Err(value_error(format!("`{word}` is no {what}")));
    let history = match history.as_str() {
        "keep_last" | "system_default" => History::KeepLast,
        "keep_all" => History::KeepAll,
        word => return unknown("history", word),
    };
    let is_publisher = side == Side::Publisher;
    let reliability = match reliability.as_str() {
        "reliable" | "system_default" => Reliability::Reliable,
        "best_available" if is_publisher => Reliability::Reliable,
        "best_effort" | "best_available" => Reliability::BestEffort,
        word => return unknown("reliability", word),
    };
    let durability = match durability.as_str() {
        "volatile" | "system_default" => Durability::Volatile,
        "best_available" if !is_publisher => Durability::Volatile,
        "transient_local" | "best_available" => Durability::TransientLocal,
        word => return unknown("durability", word),
    };
    let liveliness = match liveliness.as_str() {
        "automatic" | "system_default" | "best_available" => Liveliness::Automatic,
        "manual_by_topic" => Liveliness::ManualByTopic,
        word => return unknown("liveliness", word),
    };
    let depth = if depth == 0 { DEFAULT_DEPTH } else { depth };
    Ok(Qos {
        reliability,
        durability,
        history,
        depth,
        deadline_ns,
        lifespan_ns,
        liveliness,
        lease_ns,
    })
}

/// Words of a QoS.
pub(crate) fn words(qos: &Qos) -> QosWords {
    let history = match qos.history {
        History::KeepLast => "keep_last",
        History::KeepAll => "keep_all",
    };
    let reliability = match qos.reliability {
        Reliability::Reliable => "reliable",
        Reliability::BestEffort => "best_effort",
    };
    let durability = match qos.durability {
        Durability::Volatile => "volatile",
        Durability::TransientLocal => "transient_local",
    };
    let liveliness = match qos.liveliness {
        Liveliness::Automatic => "automatic",
        Liveliness::ManualByTopic => "manual_by_topic",
    };
    (
        history.to_owned(),
        qos.depth,
        reliability.to_owned(),
        durability.to_owned(),
        qos.deadline_ns,
        qos.lifespan_ns,
        liveliness.to_owned(),
        qos.lease_ns,
    )
}
