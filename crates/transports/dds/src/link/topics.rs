//! Topics: what the graph publishes goes out, and what others publish comes in.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::sync::Arc;

use periplus_cyclonedds_sys::{Guid, Reader, Token};
use periplus_graph::{
    Durability, EndpointId, Graph, History, Liveliness, Node, Qos, RawPublisher, Reliability,
    TopicInfo,
};
use periplus_transport::{Taps, lock};

use super::net::{Net, Subject};
use crate::outgoing::Outgoing;
use crate::peers::Peers;
use crate::{names, qos};

/// Messages of publishers whose writer is not made yet; so many wait.
const MOST_EARLY: usize = 64;

#[derive(Default)]
pub(super) struct Topics {
    publishing: BTreeMap<EndpointId, Publishing>,
    taps: Taps<Outgoing>,
    subscribing: BTreeMap<(String, Asked), Subscribing>,
    feeds: BTreeMap<Guid, Feed>,
}

/// A publisher of the graph, on the network.
pub(super) struct Publishing {
    pub(super) node: String,
    pub(super) topic: String,
    pub(super) type_name: String,
    pub(super) type_hash: Option<String>,
    pub(super) qos: Qos,
    pub(super) outgoing: Arc<Outgoing>,
    token: Token,
}

/// Subscriptions of the graph that ask for the same, on the network.
pub(super) struct Subscribing {
    pub(super) nodes: Vec<String>,
    pub(super) topic: String,
    pub(super) type_name: String,
    pub(super) type_hash: Option<String>,
    pub(super) qos: Qos,
    reader: Reader,
    token: Token,
    /// What came from writers that discovery has not told of yet.
    early: VecDeque<(Guid, Vec<u8>)>,
}

/// What decides from whom a subscription gets anything.
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

/// A writer elsewhere, as the graph sees it.
struct Feed {
    publisher: RawPublisher,
    /// The reader that takes from it, of those that it matches: each message shall come once.
    by: (String, Asked),
}

impl Topics {
    /// Makes and drops endpoints. `topics` has only what belongs to the graph itself.
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
                // One that offers something else than before is made anew.
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

    /// Looks again at who listens where readers came or went.
    pub(super) fn notice(&mut self, graph: &Graph, tokens: &[Token]) {
        if self.publishing.values().any(|one| tokens.contains(&one.token)) {
            self.listen(graph);
        }
    }

    /// Listens to the topics of the graph that somebody elsewhere hears, and to those that keep
    /// messages for latecomers.
    fn listen(&mut self, graph: &Graph) {
        let ways = self.publishing.iter().map(|(id, one)| {
            one.outgoing.count_readers();
            (one.topic.as_str(), *id, &one.outgoing)
        });
        self.taps.listen(graph, ways);
    }

    /// Lets a publisher of the graph stand for each writer elsewhere that a subscription asks for.
    pub(super) fn feed(&mut self, net: &Net, node: &Node, peers: &Peers) {
        let mut wanted: BTreeMap<Guid, (String, Asked)> = BTreeMap::new();
        let mut offers: BTreeMap<Guid, (Qos, String)> = BTreeMap::new();
        for (key, subscribing) in &self.subscribing {
            let (topic, type_name) =
                (names::topic(&subscribing.topic), names::type_of(&subscribing.type_name));
            for (guid, end) in peers.ends(&topic, true) {
                if end.type_name != type_name || !end.qos.lacks(&subscribing.qos).is_empty() {
                    continue;
                }
                // The strongest of those that fit takes; their order is that of strength.
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
            // Age is what DDS looks at, on another clock.
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

    /// Takes what arrived.
    pub(super) fn take(&mut self, net: &Net, tokens: &[Token]) {
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

    /// Endpoints with the nodes that they belong to, and whether they write.
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
