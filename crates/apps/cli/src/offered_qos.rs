//! QoS of subscriptions to what others publish.

use periplus_graph::{Durability, Qos, Reliability};

/// Queue depth of a subscription.
const DEPTH_COUNT: usize = 100;

/// Strongest QoS that all publishers offer.
pub(crate) fn strongest_request<'a>(mut offers: impl Iterator<Item = &'a Qos> + Clone) -> Qos {
    let mut qos = Qos::reliable(DEPTH_COUNT);
    if offers.clone().any(|offer| offer.reliability == Reliability::BestEffort) {
        qos = qos.with_reliability(Reliability::BestEffort);
    }
    if offers.all(|offer| offer.durability == Durability::TransientLocal) {
        qos = qos.with_durability(Durability::TransientLocal);
    }
    qos
}
