//! Ends of topics that do not fit, in the graph and beyond it, and how they are made to.

use std::collections::BTreeMap;

use periplus_graph::{EndpointId, Policy, Qos, TopicInfo, Unfit};

use super::{Shared, State};
use crate::foxglove::far::Far;
use crate::foxglove::protocol::{MismatchText, PartyText, PolicyText};

pub(super) type Mismatch = MismatchText;

/// One end of a topic.
#[derive(Clone, Copy)]
struct End<'a> {
    node: &'a str,
    qos: Qos,
    /// Which of the graph it is, if it is one.
    own: Option<EndpointId>,
}

/// All ends of a topic.
#[derive(Default)]
struct Ends<'a> {
    publishers: Vec<End<'a>>,
    subscriptions: Vec<End<'a>>,
}

/// The ends of each topic, by its name and type: between two types nothing flows anyway.
fn ends<'a>(topics: &'a [TopicInfo], far: &'a Far) -> BTreeMap<(&'a str, &'a str), Ends<'a>> {
    let mut all: BTreeMap<(&str, &str), Ends<'_>> = BTreeMap::new();
    for topic in topics {
        let of = all.entry((&topic.name, &topic.type_name)).or_default();
        let sides = [
            (&mut of.publishers, &topic.publishers),
            (&mut of.subscriptions, &topic.subscriptions),
        ];
        for (side, ends) in sides {
            // What stands in the graph for others is counted where they are.
            let own = ends.iter().filter(|end| !end.node.starts_with("/_wire"));
            side.extend(own.map(|end| End { node: &end.node, qos: end.qos, own: Some(end.id) }));
        }
    }
    for topic in &far.topics {
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

/// Two nodes with ends that do not fit.
struct Found {
    text: Mismatch,
    /// What happens to an end of ours when they are made to fit, and what is then said of it.
    change: Option<(EndpointId, Qos)>,
    done: String,
}

/// All ends that do not fit, by topic, publisher and subscription.
pub(super) fn mismatches(topics: &[TopicInfo], far: &Far) -> Vec<Mismatch> {
    find(topics, far).into_iter().map(|found| found.text).collect()
}

fn find(topics: &[TopicInfo], far: &Far) -> Vec<Found> {
    let mut all: BTreeMap<(&str, &str, &str), Found> = BTreeMap::new();
    for ((topic, _), ends) in ends(topics, far) {
        for publisher in &ends.publishers {
            for subscription in &ends.subscriptions {
                let unfit = Unfit::between(&publisher.qos, &subscription.qos);
                if unfit.is_empty() {
                    continue;
                }
                // Of several between the same two nodes the first is told.
                let key = (topic, publisher.node, subscription.node);
                all.entry(key).or_insert_with(|| describe(topic, publisher, subscription, &unfit));
            }
        }
    }
    all.into_values().collect()
}

fn describe(topic: &str, publisher: &End<'_>, subscription: &End<'_>, unfit: &[Unfit]) -> Found {
    let party = |end: &End<'_>| PartyText { node: end.node.to_owned(), is_ours: end.own.is_some() };
    let policies = unfit.iter().map(|one| PolicyText {
        policy: one.policy.to_string(),
        offered: one.offered.clone(),
        asked: one.asked.clone(),
    });
    let list = |value: fn(&Unfit) -> &str| {
        let values = unfit.iter().map(|one| format!("{} {}", one.policy, value(one)));
        values.collect::<Vec<_>>().join(" and ")
    };
    let (offer, ask) = (list(|one| &one.asked), list(|one| &one.offered));
    let (publishes, subscribes) = (publisher.node, subscription.node);
    let (repair, change, advice, done) = match which(publisher, subscription, unfit) {
        Some(Side::Publisher) => {
            let is_late = unfit.iter().any(|one| one.policy == Policy::Durability);
            let late = if is_late { "; what it published before was not kept" } else { "" };
            (
                Some("publisher"),
                publisher.own.map(|id| (id, publisher.qos.offering(&subscription.qos))),
                format!("let `{publishes}` offer {offer}"),
                format!("`{publishes}` now offers {offer}{late}"),
            )
        }
        Some(Side::Subscription) => (
            Some("subscription"),
            subscription.own.map(|id| (id, subscription.qos.asking(&publisher.qos))),
            format!("let `{subscribes}` ask for {ask}"),
            format!("`{subscribes}` now asks for {ask}"),
        ),
        None => {
            let advice =
                format!("in `{subscribes}`, ask for {ask}; or in `{publishes}`, offer {offer}");
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

/// The end that gives way.
enum Side {
    Publisher,
    Subscription,
}

/// Which end of ours gives way. Of two the publisher, which takes nothing from anybody; but a promise
/// to publish, or to show that it lives, in time is not ours to give.
fn which(publisher: &End<'_>, subscription: &End<'_>, unfit: &[Unfit]) -> Option<Side> {
    let is_kept = |one: &Unfit| matches!(one.policy, Policy::Reliability | Policy::Durability);
    match (publisher.own, subscription.own) {
        (Some(_), Some(_)) if unfit.iter().all(is_kept) => Some(Side::Publisher),
        (_, Some(_)) => Some(Side::Subscription),
        (Some(_), None) => Some(Side::Publisher),
        (None, None) => None,
    }
}

impl State {
    /// Makes two ends fit; what was done, or why nothing.
    pub(crate) fn repair(
        &mut self,
        shared: &Shared,
        topic: &str,
        publisher: &str,
        subscription: &str,
    ) -> Result<String, String> {
        let next = || {
            let all = find(&shared.graph.topics(), &self.far);
            all.into_iter().find(|Found { text, .. }| {
                (&*text.topic, &*text.publisher.node, &*text.subscription.node)
                    == (topic, publisher, subscription)
            })
        };
        let Some(first) = next() else {
            return Err(format!(
                "`{publisher}` and `{subscription}` fit on `{topic}`, or one of them is gone"
            ));
        };
        if first.change.is_none() {
            return Err(format!("neither end is part of this program: {}", first.text.advice));
        }
        // A node may have several ends on one topic; each has its turn.
        let changes = std::iter::from_fn(|| next().and_then(|found| found.change));
        for (id, qos) in changes.take(MOST_ENDS) {
            shared.graph.set_qos(id, qos);
        }
        self.look(shared);
        Ok(first.done)
    }
}

/// No node has more ends on one topic that are made to fit at once.
const MOST_ENDS: usize = 64;
