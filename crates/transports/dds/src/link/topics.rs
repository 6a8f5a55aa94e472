//! Topics: sends messages of the graph and receives those of other participants.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use periplus_cyclonedds_sys::{DataReader, Guid, WaitToken};
use periplus_graph::{
    Durability, EndpointId, Graph, History, Liveliness, Node, Qos, RawPublisher, Reliability,
    TopicInfo,
};
use periplus_transport::{Taps, lock};

use super::net::{Net, Subject};
use crate::outgoing::Outgoing;
use crate::peers::Peers;
use crate::{names, qos};

/// Maximum number of queued messages of publishers without a writer yet.
const MOST_EARLY: usize = 64;

#[derive(Default)]
pub(super) struct Topics {
    publishing: BTreeMap<EndpointId, Publishing>,
    taps: Taps<Outgoing>,
    subscribing: BTreeMap<(String, Asked), Subscribing>,
    feeds: BTreeMap<Guid, Feed>,
}

/// A publisher of the graph on the network.
pub(super) struct Publishing {
    pub(super) node: String,
    pub(super) topic: String,
    pub(super) type_name: String,
    pub(super) type_hash: Option<String>,
    pub(super) qos: Qos,
    pub(super) outgoing: Arc<Outgoing>,
    token: WaitToken,
}

/// Subscriptions of the graph with the same request, as one DDS reader.
pub(super) struct Subscribing {
    pub(super) nodes: Vec<String>,
    pub(super) topic: String,
    pub(super) type_name: String,
    pub(super) type_hash: Option<String>,
    pub(super) qos: Qos,
    reader: DataReader,
    token: WaitToken,
    /// Samples of writers that discovery has not reported yet.
    early: VecDeque<(Guid, Vec<u8>)>,
}

/// Policies that decide which writers match a subscription.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Asked {
    reliability: Reliability,
    durability: Durability,
    liveliness: Liveliness,
    deadline_ns: Option<i64>,
    lease_ns: Option<i64>,
}

impl Asked {
    fn of(qos: &Qos) -> Self {
        Self {
            reliability: qos.reliability,
            durability: qos.durability,
            liveliness: qos.liveliness,
            deadline_ns: qos.deadline_ns,
            lease_ns: qos.lease_ns,
        }
    }
}

/// A remote writer, as seen by the graph.
struct Feed {
    publisher: RawPublisher,
    /// The matched reader that delivers its samples, so that each message is delivered once.
    by: (String, Asked),
}

impl Topics {
    /// Creates and removes endpoints. `topics` has only the graph's own.
    pub(super) fn sync(&mut self, net: &Net, graph: &Graph, topics: &[TopicInfo]) {
        let mut gone: BTreeSet<EndpointId> = self.publishing.keys().copied().collect();
        let mut unasked: BTreeSet<(String, Asked)> = self.subscribing.keys().cloned().collect();
        for subscribing in self.subscribing.values_mut() {
            subscribing.nodes.clear();
        }
        for topic in topics {
            let (name, type_name) = (names::topic(&topic.name), names::type_of(&topic.type_name));
            let type_hash = topic.type_hash.as_deref();
            let subject = Subject { topic: &name, type_name: &type_name, type_hash };
            for end in &topic.publishers {
                gone.remove(&end.id);
                // A publisher with changed QoS gets a new writer.
                if self.publishing.get(&end.id).is_none_or(|one| one.qos != end.qos) {
                    self.publishing.remove(&end.id);
                    self.publish(net, &subject, topic, end.id, &end.node, end.qos);
                }
            }
            for end in &topic.subscriptions {
                let key = (topic.name.clone(), Asked::of(&end.qos));
                unasked.remove(&key);
                if !self.subscribing.contains_key(&key) {
                    self.subscribe(net, &subject, topic, key.clone(), end.qos);
                }
                if let Some(subscribing) = self.subscribing.get_mut(&key) {
                    subscribing.nodes.push(end.node.clone());
                }
            }
        }
        self.publishing.retain(|id, _| !gone.contains(id));
        self.subscribing.retain(|key, _| !unasked.contains(key));
        self.listen(graph);
    }

    fn publish(
        &mut self,
        net: &Net,
        subject: &Subject<'_>,
        topic: &TopicInfo,
        id: EndpointId,
        node: &str,
        qos: Qos,
    ) {
        let keeps = qos.durability == Durability::TransientLocal;
        let Some((outgoing, token)) = net.watched_writer(subject, &qos::to_dds(&qos), keeps) else {
            return;
        };
        let publishing = Publishing {
            node: node.to_owned(),
            topic: topic.name.clone(),
            type_name: topic.type_name.clone(),
            type_hash: topic.type_hash.clone(),
            qos,
            outgoing,
            token,
        };
        self.publishing.insert(id, publishing);
    }

    fn subscribe(
        &mut self,
        net: &Net,
        subject: &Subject<'_>,
        topic: &TopicInfo,
        key: (String, Asked),
        qos: Qos,
    ) {
        let Some((reader, token)) = net.reader(subject, &qos::to_dds(&qos)) else { return };
        let subscribing = Subscribing {
            nodes: Vec::new(),
            topic: topic.name.clone(),
            type_name: topic.type_name.clone(),
            type_hash: topic.type_hash.clone(),
            qos,
            reader,
            token,
            early: VecDeque::new(),
        };
        self.subscribing.insert(key, subscribing);
    }

    /// Updates the subscriptions of topics whose readers changed.
    pub(super) fn notice(&mut self, graph: &Graph, tokens: &[WaitToken]) {
        if self.publishing.values().any(|one| tokens.contains(&one.token)) {
            self.listen(graph);
        }
    }

    /// Taps the topics of the graph that have remote readers, and those that retain messages for
    /// late subscribers.
    fn listen(&mut self, graph: &Graph) {
        let ways = self.publishing.iter().map(|(id, one)| {
            one.outgoing.count_readers();
            (one.topic.as_str(), *id, &one.outgoing)
        });
        self.taps.listen(graph, ways);
    }

    /// Creates a publisher in the graph for each remote writer that a subscription matches.
    pub(super) fn feed(&mut self, net: &Net, node: &Node, peers: &Peers) {
        let mut wanted: BTreeMap<Guid, (String, Asked)> = BTreeMap::new();
        let mut offers: BTreeMap<Guid, (Qos, String)> = BTreeMap::new();
        for (key, subscribing) in &self.subscribing {
            let (topic, type_name) =
                (names::topic(&subscribing.topic), names::type_of(&subscribing.type_name));
            for (guid, end) in peers.ends(&topic, true) {
                if end.type_name != type_name
                    || !end.qos.incompatible_policies(&subscribing.qos).is_empty()
                {
                    continue;
                }
                // The strongest compatible reader takes the samples; the keys are in order of
                // strength.
                wanted.insert(guid, key.clone());
                let (offer, _) =
                    offers.entry(guid).or_insert_with(|| (end.qos, subscribing.type_name.clone()));
                offer.depth = offer.depth.max(subscribing.qos.depth).max(1);
            }
        }
        let foreign = self.taps.foreign().clone();
        self.feeds.retain(|guid, feed| {
            let stays = wanted.contains_key(guid);
            if !stays {
                lock(&foreign).remove(&feed.publisher.id());
            }
            stays
        });
        for (guid, by) in wanted {
            if let Some(feed) = self.feeds.get_mut(&guid) {
                feed.by = by;
                continue;
            }
            let Some((offer, type_name)) = offers.remove(&guid) else { continue };
            // DDS checks the lifespan itself, on another clock.
            let offer = Qos { lifespan_ns: None, history: History::KeepLast, ..offer };
            match node.raw_publisher(&by.0, &type_name, None, offer) {
                Ok(publisher) => {
                    lock(&foreign).insert(publisher.id());
                    self.feeds.insert(guid, Feed { publisher, by });
                }
                Err(error) => net.complain("wire", error.to_string()),
            }
        }
        let feeds = &self.feeds;
        for (key, subscribing) in &mut self.subscribing {
            subscribing.early.retain_mut(|(writer, bytes)| match feeds.get(writer) {
                Some(feed) => {
                    if feed.by == *key {
                        feed.publisher.publish(std::mem::take(bytes));
                    }
                    false
                }
                None => true,
            });
        }
    }

    /// Receives samples.
    pub(super) fn take(&mut self, net: &Net, tokens: &[WaitToken]) {
        for (key, subscribing) in &mut self.subscribing {
            if !tokens.contains(&subscribing.token) {
                continue;
            }
            loop {
                let sample = match subscribing.reader.take() {
                    Ok(Some(sample)) => sample,
                    Ok(None) => break,
                    Err(error) => {
                        net.complain("wire", error.to_string());
                        break;
                    }
                };
                let Some(source) = sample.source else { continue };
                match self.feeds.get(&source.writer) {
                    Some(feed) if feed.by == *key => feed.publisher.publish(sample.bytes),
                    Some(_) => {}
                    None => {
                        if subscribing.early.len() == MOST_EARLY {
                            subscribing.early.pop_front();
                        }
                        subscribing.early.push_back((source.writer, sample.bytes));
                    }
                }
            }
        }
    }

    /// Endpoints with their nodes; true for writers.
    pub(super) fn ends(&self) -> impl Iterator<Item = (&str, Guid, bool)> {
        let writers = self.publishing.values();
        let writers = writers.map(|one| (one.node.as_str(), one.outgoing.writer.guid(), true));
        let readers = self
            .subscribing
            .values()
            .flat_map(|one| one.nodes.iter().map(|node| (node.as_str(), one.reader.guid(), false)));
        writers.chain(readers)
    }

    pub(super) fn publishing(&self) -> impl Iterator<Item = (EndpointId, &Publishing)> {
        self.publishing.iter().map(|(id, one)| (*id, one))
    }

    pub(super) fn subscribing(&self) -> impl Iterator<Item = &Subscribing> {
        self.subscribing.values()
    }
}
