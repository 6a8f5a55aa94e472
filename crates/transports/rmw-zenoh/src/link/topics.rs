//! Topics: sends messages of the graph and receives those of other programs.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_graph::{
    Durability, EndpointId, Graph, History, KEEP_ALL_MAX_MESSAGES, Node, Qos, RawPublisher,
    Reliability, TopicInfo,
};
use periplus_transport::Taps;
use zenoh::Wait;
use zenoh::liveliness::LivelinessToken;
use zenoh::qos::CongestionControl;
use zenoh::sample::Locality;
use zenoh_ext::{
    AdvancedPublisher, AdvancedPublisherBuilderExt, AdvancedSubscriber,
    AdvancedSubscriberBuilderExt, CacheConfig, HistoryConfig, MissDetectionConfig, RecoveryConfig,
};

use super::inbox::Inbox;
use super::net::Net;
use crate::attachment::Attachment;
use crate::outgoing::Outgoing;
use crate::token::{End, EntityKind};

/// Period at which a transient-local publisher announces its last sequence number, as `rmw_zenoh`
/// does.
const HEARTBEAT: Duration = Duration::from_millis(500);

/// Timeout for the retained messages of a publisher.
const HISTORY: Duration = Duration::from_secs(60);

#[derive(Default)]
pub(super) struct Topics {
    publishing: BTreeMap<EndpointId, Publishing>,
    subscribing: BTreeMap<String, Subscribing>,
    taps: Taps<Outgoing>,
    /// Set when the remote subscribers have changed.
    is_due: Arc<AtomicBool>,
}

/// A publisher of the graph on the network.
pub(super) struct Publishing {
    pub(super) node: String,
    pub(super) end: End,
    pub(super) outgoing: Arc<Outgoing>,
    _token: LivelinessToken,
}

/// Subscriptions of the graph to one topic on the network.
pub(super) struct Subscribing {
    /// Their nodes and tokens.
    pub(super) ends: BTreeMap<EndpointId, (String, LivelinessToken)>,
    /// The topic, with the strongest QoS that any of them requests.
    pub(super) end: End,
    inbox: Arc<Inbox>,
    _subscriber: AdvancedSubscriber<()>,
}

impl Topics {
    /// Creates and removes endpoints. `topics` has only the graph's own.
    pub(super) fn sync(&mut self, net: &Net, topics: &[TopicInfo]) {
        let mut gone: BTreeSet<EndpointId> = self.publishing.keys().copied().collect();
        let mut unasked: BTreeSet<String> = self.subscribing.keys().cloned().collect();
        for topic in topics {
            for one in &topic.publishers {
                gone.remove(&one.id);
                if self.publishing.get(&one.id).is_none_or(|made| made.end.qos != one.qos)
                    && let Some(made) = self.publish(net, end(topic, one.qos), &one.node)
                {
                    self.publishing.insert(one.id, made);
                }
            }
            let asked = topic.subscriptions.iter().map(|one| one.qos);
            let Some(asked) = asked.reduce(strongest) else { continue };
            unasked.remove(&topic.name);
            self.subscribe(net, topic, end(topic, asked));
        }
        self.publishing.retain(|id, _| !gone.contains(id));
        self.subscribing.retain(|name, one| {
            let stays = !unasked.contains(name);
            if !stays {
                one.inbox.close(self.taps.foreign());
            }
            stays
        });
    }

    fn publish(&self, net: &Net, end: End, node: &str) -> Option<Publishing> {
        let is_heard = Arc::new(AtomicBool::new(false));
        let publisher = self.publisher(net, &end, &is_heard);
        let publisher = publisher.map_err(|error| net.complain(&error)).ok()?;
        let (gid, token) = net.token(EntityKind::Publisher, node, Some(end.clone()))?;
        let keeps = end.qos.durability == Durability::TransientLocal;
        let outgoing = Outgoing::new(publisher, gid, depth(&end.qos), keeps, is_heard, &net.lane);
        Some(Publishing { node: node.to_owned(), end, outgoing, _token: token })
    }

    /// Creates a publisher as `rmw_zenoh` does: only reliable `KEEP_ALL` publishers block on slow
    /// subscribers.
    fn publisher(
        &self,
        net: &Net,
        end: &End,
        is_heard: &Arc<AtomicBool>,
    ) -> zenoh::Result<AdvancedPublisher<'static>> {
        let qos = &end.qos;
        let is_reliable = qos.reliability == Reliability::Reliable;
        let waits = is_reliable && qos.history == History::KeepAll;
        let congestion = if waits { CongestionControl::Block } else { CongestionControl::Drop };
        let reliability = if is_reliable {
            zenoh::qos::Reliability::Reliable
        } else {
            zenoh::qos::Reliability::BestEffort
        };
        // Subscribers in the same graph get messages directly.
        let mut making = net
            .session
            .declare_publisher(end.key(net.domain_id))
            .congestion_control(congestion)
            .reliability(reliability)
            .allowed_destination(Locality::Remote)
            .advanced();
        if qos.durability == Durability::TransientLocal {
            let cache = CacheConfig::default().max_samples(depth(qos));
            making = making.cache(cache).publisher_detection();
            if is_reliable {
                let misses = MissDetectionConfig::default().sporadic_heartbeat(HEARTBEAT);
                making = making.sample_miss_detection(misses);
            }
        }
        let publisher = making.wait()?;
        let (heard, due, shared) = (is_heard.clone(), self.is_due.clone(), net.shared.clone());
        publisher
            .matching_listener()
            .callback(move |status| {
                heard.store(status.matching(), Ordering::Relaxed);
                due.store(true, Ordering::Release);
                shared.wake();
            })
            .background()
            .wait()?;
        Ok(publisher)
    }

    fn subscribe(&mut self, net: &Net, topic: &TopicInfo, end: End) {
        let known = self.subscribing.get(&topic.name).map(|one| &one.end);
        if known != Some(&end) {
            if let Some(old) = self.subscribing.remove(&topic.name) {
                old.inbox.close(self.taps.foreign());
            }
            match subscribing(net, end) {
                Ok(made) => _ = self.subscribing.insert(topic.name.clone(), made),
                Err(error) => return net.complain(&error),
            }
        }
        let Some(one) = self.subscribing.get_mut(&topic.name) else { return };
        one.ends.retain(|id, _| topic.subscriptions.iter().any(|end| end.id == *id));
        for subscription in &topic.subscriptions {
            let Entry::Vacant(place) = one.ends.entry(subscription.id) else { continue };
            let (node, end) = (&subscription.node, self::end(topic, subscription.qos));
            if let Some((_, token)) = net.token(EntityKind::Subscription, node, Some(end)) {
                place.insert((node.clone(), token));
            }
        }
    }

    /// Creates publishers in the graph for the remote ones.
    pub(super) fn feed(&mut self, net: &Net, node: &Node) {
        for one in self.subscribing.values() {
            let known = net.heard_by(&one.end, EntityKind::Publisher);
            one.inbox.feed(&known, self.taps.foreign(), || one.feed(net, node));
        }
    }

    /// Accepts messages of publishers whose tokens did not arrive in time.
    pub(super) fn take_strangers(&mut self, net: &Net, node: &Node) {
        for one in self.subscribing.values() {
            one.inbox.take_strangers(self.taps.foreign(), || one.feed(net, node));
        }
    }

    /// Taps the topics with remote subscribers, if these may have changed.
    pub(super) fn listen(&mut self, graph: &Graph, is_new: bool) {
        if self.is_due.swap(false, Ordering::AcqRel) || is_new {
            let ways = self.publishing.iter();
            let ways = ways.map(|(id, one)| (one.end.name.as_str(), *id, &one.outgoing));
            self.taps.listen(graph, ways);
        }
    }

    pub(super) fn publishing(&self) -> impl Iterator<Item = (EndpointId, &Publishing)> {
        self.publishing.iter().map(|(id, one)| (*id, one))
    }

    pub(super) fn subscribing(&self) -> impl Iterator<Item = &Subscribing> {
        self.subscribing.values()
    }
}

fn end(topic: &TopicInfo, qos: Qos) -> End {
    let (name, type_name) = (topic.name.clone(), topic.type_name.clone());
    End { name, type_name, type_hash: topic.type_hash.clone(), qos }
}

/// A `KEEP_ALL` history gets a limit.
fn depth(qos: &Qos) -> usize {
    match qos.history {
        History::KeepLast => qos.depth.clamp(1, KEEP_ALL_MAX_MESSAGES),
        History::KeepAll => KEEP_ALL_MAX_MESSAGES,
    }
}

/// The weakest QoS that satisfies both.
fn strongest(a: Qos, b: Qos) -> Qos {
    let least = |a: Option<i64>, b: Option<i64>| match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (one, other) => one.or(other),
    };
    Qos {
        reliability: if a.reliability == Reliability::Reliable {
            a.reliability
        } else {
            b.reliability
        },
        durability: if a.durability == Durability::TransientLocal {
            a.durability
        } else {
            b.durability
        },
        history: if a.history == History::KeepAll { a.history } else { b.history },
        depth: a.depth.max(b.depth),
        deadline_ns: least(a.deadline_ns, b.deadline_ns),
        lifespan_ns: None,
        liveliness: a.liveliness.max(b.liveliness),
        lease_ns: least(a.lease_ns, b.lease_ns),
    }
}

/// Creates a subscriber as `rmw_zenoh` does: with transient local durability it gets retained
/// messages, also those of publishers that appear later.
fn subscribing(net: &Net, end: End) -> zenoh::Result<Subscribing> {
    let inbox = Arc::new(Inbox::default());
    let (taking, shared) = (inbox.clone(), net.shared.clone());
    let mut making = net
        .session
        .declare_subscriber(end.keys(net.domain_id))
        .callback(move |sample| {
            let beside = sample.attachment().and_then(|one| Attachment::read(&one.to_bytes()));
            // Messages without an attachment are not from ROS.
            let Some(beside) = beside else { return };
            if taking.take(beside.gid, sample.payload().to_bytes().into_owned()) {
                shared.wake();
            }
        })
        .allowed_origin(Locality::Remote)
        .advanced();
    if end.qos.durability == Durability::TransientLocal {
        let history = HistoryConfig::default().detect_late_publishers();
        making = making
            .subscriber_detection()
            .query_timeout(HISTORY)
            .history(history.max_samples(depth(&end.qos)));
        if end.qos.reliability == Reliability::Reliable {
            making = making.recovery(RecoveryConfig::default().heartbeat());
        }
    }
    let subscriber = making.wait()?;
    Ok(Subscribing { ends: BTreeMap::new(), end, inbox, _subscriber: subscriber })
}

impl Subscribing {
    /// Creates a publisher in the graph for a remote one. In Zenoh all QoS are compatible, so it
    /// offers what is requested.
    fn feed(&self, net: &Net, node: &Node) -> Option<RawPublisher> {
        let End { name, type_name, type_hash, qos } = &self.end;
        let made = node.raw_publisher(name, type_name, type_hash.as_deref(), *qos);
        made.map_err(|error| net.complain_of_graph(error)).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_of_two_satisfies_both() {
        let all = [
            Qos::sensor_data(),
            Qos::latched(1),
            Qos::reliable(10).with_deadline_ns(5),
            Qos::best_effort(3).with_deadline_ns(7).with_durability(Durability::TransientLocal),
        ];
        for a in all {
            for b in all {
                let both = strongest(a, b);
                assert_eq!(both.incompatible_policies(&a), [], "{a:?} {b:?}");
                assert_eq!(both.incompatible_policies(&b), [], "{a:?} {b:?}");
            }
        }
    }
}
