//! Incompatible endpoints, local and remote, and the repair of their QoS.

use std::collections::BTreeMap;

use periplus_graph::{EndpointId, IncompatiblePolicy, Policy, Qos, TopicInfo};

use super::{Shared, State};
use crate::foxglove::network_endpoints::NetworkEndpoints;
use crate::foxglove::protocol::{MismatchText, PartyText, PolicyText, QosRepairError};

pub(super) type Mismatch = MismatchText;

/// An endpoint of a topic.
#[derive(Clone, Copy)]
struct End<'a> {
    node: &'a str,
    qos: Qos,
    /// Id in the graph, for local endpoints.
    own: Option<EndpointId>,
}

/// Endpoints of a topic.
#[derive(Default)]
struct Ends<'a> {
    publishers: Vec<End<'a>>,
    subscriptions: Vec<End<'a>>,
}

/// Endpoints of each topic by name and type; endpoints of different types are not compared.
fn ends<'a>(
    topics: &'a [TopicInfo],
    network: &'a NetworkEndpoints,
) -> BTreeMap<(&'a str, &'a str), Ends<'a>> {
    let mut all: BTreeMap<(&str, &str), Ends<'_>> = BTreeMap::new();
    for topic in topics {
        let of = all.entry((&topic.name, &topic.type_name)).or_default();
        let sides = [
            (&mut of.publishers, &topic.publishers),
            (&mut of.subscriptions, &topic.subscriptions),
        ];
        for (side, ends) in sides {
            // Nodes that represent remote programs are left out: the remote endpoints are listed
            // themselves.
            let own = ends.iter().filter(|end| !end.node.starts_with("/_wire"));
            side.extend(own.map(|end| End { node: &end.node, qos: end.qos, own: Some(end.id) }));
        }
    }
    for topic in &network.topics {
        let of = all.entry((&topic.name, &topic.type_name)).or_default();
        let sides = [
            (&mut of.publishers, &topic.publishers),
            (&mut of.subscriptions, &topic.subscriptions),
        ];
        for (side, ends) in sides {
            side.extend(ends.iter().map(|end| End { node: &end.node, qos: end.qos, own: None }));
        }
    }
    all
}

/// Two nodes with incompatible endpoints.
struct Found {
    text: Mismatch,
    /// QoS change of a local endpoint that repairs the pair, and the message for the client.
    change: Option<(EndpointId, Qos)>,
    done: String,
}

/// Incompatible pairs by topic, publisher and subscription.
pub(super) fn mismatches(topics: &[TopicInfo], network: &NetworkEndpoints) -> Vec<Mismatch> {
    find(topics, network).into_iter().map(|found| found.text).collect()
}

fn find(topics: &[TopicInfo], network: &NetworkEndpoints) -> Vec<Found> {
    let mut all: BTreeMap<(&str, &str, &str), Found> = BTreeMap::new();
    for ((topic, _), ends) in ends(topics, network) {
        for publisher in &ends.publishers {
            for subscription in &ends.subscriptions {
                let unfit = IncompatiblePolicy::between(&publisher.qos, &subscription.qos);
                if unfit.is_empty() {
                    continue;
                }
                // The first of several pairs between the same two nodes is reported.
                let key = (topic, publisher.node, subscription.node);
                all.entry(key).or_insert_with(|| describe(topic, publisher, subscription, &unfit));
            }
        }
    }
    all.into_values().collect()
}

fn describe(
    topic: &str,
    publisher: &End<'_>,
    subscription: &End<'_>,
    unfit: &[IncompatiblePolicy],
) -> Found {
    let party = |end: &End<'_>| PartyText { node: end.node.to_owned(), is_ours: end.own.is_some() };
    let policies = unfit.iter().map(|one| PolicyText {
        policy: one.policy.to_string(),
        offered: one.offered.clone(),
        asked: one.asked.clone(),
    });
    let list = |value: fn(&IncompatiblePolicy) -> &str| {
        let values = unfit.iter().map(|one| format!("{} {}", one.policy, value(one)));
        values.collect::<Vec<_>>().join(" and ")
    };
    let (offer, ask) = (list(|one| &one.asked), list(|one| &one.offered));
    let (publishes, subscribes) = (publisher.node, subscription.node);
    let (repair, change, advice, done) = match which(publisher, subscription, unfit) {
        Some(Side::Publisher) => {
            let is_late = unfit.iter().any(|one| one.policy == Policy::Durability);
            let late = if is_late { "; earlier messages were not retained" } else { "" };
            (
                Some("publisher"),
                publisher.own.map(|id| (id, publisher.qos.strengthened_for(&subscription.qos))),
                format!("make `{publishes}` offer {offer}"),
                format!("`{publishes}` now offers {offer}{late}"),
            )
        }
        Some(Side::Subscription) => (
            Some("subscription"),
            subscription.own.map(|id| (id, subscription.qos.weakened_for(&publisher.qos))),
            format!("make `{subscribes}` request {ask}"),
            format!("`{subscribes}` now requests {ask}"),
        ),
        None => {
            let advice =
                format!("in `{subscribes}`, request {ask}; or in `{publishes}`, offer {offer}");
            (None, None, advice, String::new())
        }
    };
    let text = Mismatch {
        topic: topic.to_owned(),
        publisher: party(publisher),
        subscription: party(subscription),
        policies: policies.collect(),
        repair,
        advice,
    };
    Found { text, change, done }
}

/// Side of a pair.
enum Side {
    Publisher,
    Subscription,
}

/// Local side to change, preferably the publisher: that affects no other pair. Deadlines and
/// liveliness of a publisher are not changed, since it may not be able to keep them.
fn which(
    publisher: &End<'_>,
    subscription: &End<'_>,
    unfit: &[IncompatiblePolicy],
) -> Option<Side> {
    let is_kept =
        |one: &IncompatiblePolicy| matches!(one.policy, Policy::Reliability | Policy::Durability);
    match (publisher.own, subscription.own) {
        (Some(_), Some(_)) if unfit.iter().all(is_kept) => Some(Side::Publisher),
        (_, Some(_)) => Some(Side::Subscription),
        (Some(_), None) => Some(Side::Publisher),
        (None, None) => None,
    }
}

impl State {
    /// Repairs an incompatible pair; returns the change made, or the reason for making none.
    pub(crate) fn repair(
        &mut self,
        shared: &Shared,
        topic: &str,
        publisher: &str,
        subscription: &str,
    ) -> Result<String, QosRepairError> {
        let next = || {
            let all = find(&shared.graph.topics(), &self.network);
            all.into_iter().find(|Found { text, .. }| {
                (&*text.topic, &*text.publisher.node, &*text.subscription.node)
                    == (topic, publisher, subscription)
            })
        };
        let Some(first) = next() else {
            return Err(QosRepairError::Compatible {
                topic: topic.to_owned(),
                publisher: publisher.to_owned(),
                subscription: subscription.to_owned(),
            });
        };
        if first.change.is_none() {
            return Err(QosRepairError::Foreign(first.text.advice));
        }
        // A node may have several endpoints on one topic; all of them are changed.
        let changes = std::iter::from_fn(|| next().and_then(|found| found.change));
        for (id, qos) in changes.take(MOST_ENDS) {
            shared.graph.set_qos(id, qos);
        }
        self.look(shared);
        Ok(first.done)
    }
}

/// Maximum number of endpoints of a node on one topic that are repaired at once.
const MOST_ENDS: usize = 64;
