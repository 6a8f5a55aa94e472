//! Topics: sends messages of the graph and receives those of other programs.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{
    Durability, EndpointId, Graph, History, KEEP_ALL_MAX_MESSAGES, Node, Qos, RawPublisher,
    TopicInfo,
};
use periplus_transport::{Foreign, Since, Taps, lock};

use super::{Net, Ports, addresses, port};
use crate::codec::Codec;
use crate::names::{Ros1Type, message_definition, ros1_type};
use crate::node::{NodePort, SubscriptionReport, SubscriptionReporter};
use crate::outgoing::Outgoing;
use crate::tcpros::{Header, Publication, Receive, Receiver, Subscription};
use crate::wire::Shared;

/// Period at which outgoing traffic is checked.
const LOOK: Duration = Duration::from_millis(250);

/// Queue depth of the graph's publisher for a remote one.
const DEPTH: usize = 100;

#[derive(Default)]
pub(super) struct Topics {
    /// By the node in the graph and the topic.
    publishing: BTreeMap<(String, String), Publishing>,
    /// By topic.
    subscribing: Arc<Mutex<BTreeMap<String, Subscribing>>>,
    taps: Taps<Outgoing>,
    /// Set when the remote subscribers have changed.
    is_due: Arc<AtomicBool>,
    slow: BTreeSet<String>,
    looked: Option<Since>,
}

/// A published topic of a node.
struct Publishing {
    /// Publishers of the graph.
    ids: BTreeSet<EndpointId>,
    outgoing: Arc<Outgoing>,
    qos: Qos,
    of: String,
}

/// Subscriptions of the graph to one topic.
struct Subscribing {
    of: Ros1Type,
    /// Nodes in the graph, with their names in ROS 1.
    nodes: BTreeMap<String, String>,
    is_latched: Arc<AtomicBool>,
    subscription: Subscription,
}

impl Topics {
    /// Registers and unregisters topics. `topics` has only the graph's own endpoints.
    pub(super) fn sync(&mut self, net: &Net, ports: &mut Ports, node: &Node, topics: &[TopicInfo]) {
        let mut gone: BTreeSet<(String, String)> = self.publishing.keys().cloned().collect();
        for topic in topics {
            let Some(of) = ros1_type(&topic.type_name) else { continue };
            let mut by_node: BTreeMap<&str, (BTreeSet<EndpointId>, Qos)> = BTreeMap::new();
            for end in &topic.publishers {
                let (ids, _) = by_node.entry(&end.node).or_insert((BTreeSet::new(), end.qos));
                ids.insert(end.id);
            }
            for (publisher, (ids, qos)) in by_node {
                let key = (publisher.to_owned(), topic.name.clone());
                gone.remove(&key);
                match self.publishing.get_mut(&key) {
                    Some(known) if known.qos == qos => known.ids = ids,
                    _ => {
                        if self.publishing.remove(&key).is_some()
                            && let Some(port) = ports.get(publisher)
                        {
                            unpublish(net, port, &topic.name);
                        }
                        let made = self.publish(net, ports, publisher, topic, &of, qos, ids);
                        if let Some(made) = made {
                            self.publishing.insert(key, made);
                        }
                    }
                }
            }
        }
        for (node, topic) in gone {
            if let Some(port) = ports.get(&node) {
                unpublish(net, port, &topic);
            }
            self.publishing.remove(&(node, topic));
        }
        self.sync_subscriptions(net, ports, node, topics);
    }

    #[allow(clippy::too_many_arguments)]
    fn publish(
        &self,
        net: &Net,
        ports: &mut Ports,
        node: &str,
        topic: &TopicInfo,
        of: &str,
        qos: Qos,
        ids: BTreeSet<EndpointId>,
    ) -> Option<Publishing> {
        let (definition, codec) = (message_definition(of)?, Codec::to_ros1(&topic.type_name)?);
        let port = port(net, ports, node)?;
        let (due, shared) = (self.is_due.clone(), net.shared.clone());
        let wake = Box::new(move || {
            due.store(true, Ordering::Release);
            shared.wake();
        });
        let is_latching = qos.durability == Durability::TransientLocal;
        let depth = depth(&qos);
        let publication =
            Publication::new(port.name(), &topic.name, definition, is_latching, depth, wake);
        port.publish(publication.clone());
        net.shared.note(&publication);
        let outgoing = Outgoing::new(publication, codec, depth, &net.lane);
        register_publisher(net, port, &topic.name, of);
        self.is_due.store(true, Ordering::Release);
        Some(Publishing { ids, outgoing, qos, of: of.to_owned() })
    }

    fn sync_subscriptions(&self, net: &Net, ports: &mut Ports, node: &Node, topics: &[TopicInfo]) {
        let mut all = lock(&self.subscribing);
        let mut gone: BTreeSet<String> = all.keys().cloned().collect();
        for topic in topics {
            let Some(of) = ros1_type(&topic.type_name) else { continue };
            let nodes: BTreeSet<&str> =
                topic.subscriptions.iter().map(|end| end.node.as_str()).collect();
            if nodes.is_empty() {
                continue;
            }
            gone.remove(&topic.name);
            let asks_latched = topic
                .subscriptions
                .iter()
                .any(|end| end.qos.durability == Durability::TransientLocal);
            let one = match all.entry(topic.name.clone()) {
                Entry::Occupied(place) => place.into_mut(),
                Entry::Vacant(place) => {
                    // A type that this program does not know is taken as its publishers define it.
                    let of = message_definition(&of).unwrap_or(Ros1Type {
                        name: of,
                        md5: "*".into(),
                        definition: String::new(),
                    });
                    let Some(first) = nodes.first().and_then(|name| port(net, ports, name)) else {
                        continue;
                    };
                    let is_latched = Arc::new(AtomicBool::new(asks_latched));
                    let receiver = Arc::new(GraphReceiver {
                        node: node.clone(),
                        topic: topic.name.clone(),
                        of: topic.type_name.clone(),
                        type_hash: topic.type_hash.clone(),
                        is_latched: is_latched.clone(),
                        foreign: self.taps.foreign().clone(),
                        shared: net.shared.clone(),
                    });
                    let subscription =
                        Subscription::new(first.name(), &topic.name, of.clone(), receiver);
                    place.insert(Subscribing {
                        of,
                        nodes: BTreeMap::new(),
                        is_latched,
                        subscription,
                    })
                }
            };
            one.is_latched.store(asks_latched, Ordering::Relaxed);
            one.nodes.retain(|name, _| {
                let stays = nodes.contains(name.as_str());
                if !stays && let Some(port) = ports.get(name) {
                    unsubscribe(net, port, &topic.name);
                }
                stays
            });
            for name in nodes {
                if one.nodes.contains_key(name) {
                    continue;
                }
                let Some(port) = port(net, ports, name) else { continue };
                one.nodes.insert(name.to_owned(), port.name().to_owned());
                register_subscriber(net, port, &topic.name, &one.of.name);
            }
        }
        for topic in gone {
            let Some(one) = all.remove(&topic) else { continue };
            for name in one.nodes.keys() {
                if let Some(port) = ports.get(name) {
                    unsubscribe(net, port, &topic);
                }
            }
        }
    }

    /// Connects to the publishers that the master has announced.
    pub(super) fn feed(&self, net: &Net, ports: &Ports) {
        let changed = net.shared.take_announced();
        if changed.is_empty() {
            return;
        }
        // Nodes of the graph meet in the graph.
        let own: BTreeSet<String> = ports.values().map(NodePort::uri).collect();
        let all = lock(&self.subscribing);
        for (topic, publishers) in changed {
            if let Some(one) = all.get(&topic) {
                let others = publishers.difference(&own).cloned().collect();
                one.subscription.update(&others);
            }
        }
    }

    /// Taps the topics with remote subscribers, if these may have changed.
    pub(super) fn listen(&mut self, graph: &Graph, is_new: bool) {
        if self.is_due.swap(false, Ordering::AcqRel) || is_new {
            let ways = self.publishing.iter().flat_map(|((_, topic), one)| {
                one.ids.iter().map(move |id| (topic.as_str(), *id, &one.outgoing))
            });
            self.taps.listen(graph, ways);
            for one in self.publishing.values() {
                one.outgoing.publication.set_fed(one.outgoing.publication.is_wanted());
            }
        }
    }

    /// Warns about topics that are too fast for their subscribers.
    pub(super) fn look_at_traffic(&mut self, net: &Net) {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK) {
            return;
        }
        self.looked = Some(Since::now());
        for ((node, topic), one) in &self.publishing {
            if one.outgoing.dropped() > 0 && self.slow.insert(topic.clone()) {
                let message = format!(
                    "a ROS 1 subscriber is slower than `{node}` publishes on `{topic}`; older messages are dropped \
                     for newer ones"
                );
                let help = "publish less often or smaller messages, or use a larger depth";
                net.say(Diagnostic::warning("slow-peer", message).help(help));
            }
        }
    }

    /// Registers everything again.
    pub(super) fn register_again(&self, net: &Net, ports: &Ports) {
        for ((node, topic), one) in &self.publishing {
            if let Some(port) = ports.get(node) {
                register_publisher(net, port, topic, &one.of);
            }
        }
        for (topic, one) in &*lock(&self.subscribing) {
            for port in one.nodes.keys().filter_map(|name| ports.get(name)) {
                register_subscriber(net, port, topic, &one.of.name);
            }
        }
    }

    /// Unregisters everything.
    pub(super) fn leave(&mut self, net: &Net, ports: &Ports) {
        for (node, topic) in std::mem::take(&mut self.publishing).into_keys() {
            if let Some(port) = ports.get(&node) {
                unpublish(net, port, &topic);
            }
        }
        for (topic, one) in std::mem::take(&mut *lock(&self.subscribing)) {
            for port in one.nodes.keys().filter_map(|name| ports.get(name)) {
                unsubscribe(net, port, &topic);
            }
        }
    }

    /// Nodes with topics.
    pub(super) fn nodes(&self) -> BTreeSet<String> {
        let all = lock(&self.subscribing);
        let subscribers = all.values().flat_map(|one| one.nodes.keys().cloned());
        self.publishing.keys().map(|(node, _)| node.clone()).chain(subscribers).collect()
    }

    /// Reports the subscribed topics of a node.
    pub(super) fn reporter(&self) -> SubscriptionReporter {
        let all = self.subscribing.clone();
        Arc::new(move |node| {
            let all = lock(&all);
            let its = all.iter().filter(|(_, one)| one.nodes.values().any(|name| name == node));
            let reports = its.map(|(topic, one)| SubscriptionReport {
                topic: topic.clone(),
                of: one.of.name.clone(),
                sources: one.subscription.report(),
            });
            reports.collect()
        })
    }
}

/// Smallest queue depth: a sender in a thread of its connection lags behind by some messages.
const MIN_DEPTH: usize = 10;

/// A history of unlimited depth gets a limit.
fn depth(qos: &Qos) -> usize {
    match qos.history {
        History::KeepLast => qos.depth.clamp(MIN_DEPTH, KEEP_ALL_MAX_MESSAGES),
        History::KeepAll => KEEP_ALL_MAX_MESSAGES,
    }
}

fn register_publisher(net: &Net, port: &NodePort, topic: &str, of: &str) {
    let params = vec![port.name().into(), topic.into(), of.into(), port.uri().into()];
    net.tell_master("registerPublisher", params);
}

fn register_subscriber(net: &Net, port: &NodePort, topic: &str, of: &str) {
    let params = vec![port.name().into(), topic.into(), of.into(), port.uri().into()];
    if let Some(publishers) = net.tell_master("registerSubscriber", params) {
        net.shared.announce(topic, addresses(&publishers));
    }
}

fn unpublish(net: &Net, port: &NodePort, topic: &str) {
    port.unpublish(topic);
    let params = vec![port.name().into(), topic.into(), port.uri().into()];
    net.tell_master("unregisterPublisher", params);
}

fn unsubscribe(net: &Net, port: &NodePort, topic: &str) {
    let params = vec![port.name().into(), topic.into(), port.uri().into()];
    net.tell_master("unregisterSubscriber", params);
}

/// Publishes the messages of other programs in the graph.
struct GraphReceiver {
    node: Node,
    topic: String,
    /// Type in the graph.
    of: String,
    type_hash: Option<String>,
    /// True if a subscription of the graph asks for retained messages.
    is_latched: Arc<AtomicBool>,
    foreign: Foreign,
    shared: Arc<Shared>,
}

/// A publisher of the graph that represents one of another program.
struct Feed {
    publisher: RawPublisher,
    foreign: Foreign,
}

impl Drop for Feed {
    fn drop(&mut self) {
        lock(&self.foreign).remove(&self.publisher.id());
    }
}

impl Receiver for GraphReceiver {
    fn begin(&self, publisher: &str, header: &Header) -> Result<Receive, String> {
        let ours = ros1_type(&self.of).and_then(|of| message_definition(&of));
        let is_known = ours.is_some_and(|ours| ours.md5 == header.get("md5sum"));
        let codec = if is_known {
            Codec::to_ros2(&self.of)
        } else {
            Codec::from_definition(&self.of, header.get("message_definition"))
        };
        let codec = codec.ok_or_else(|| {
            format!("the definition of {} in the publisher's header cannot be read", self.of)
        })?;
        let is_latched = header.get("latching") == "1" || self.is_latched.load(Ordering::Relaxed);
        let qos = if is_latched {
            Qos::reliable(DEPTH).with_durability(Durability::TransientLocal)
        } else {
            Qos::reliable(DEPTH)
        };
        let made = self.node.raw_publisher(&self.topic, &self.of, self.type_hash.as_deref(), qos);
        let made = made.map_err(|error| error.to_string())?;
        lock(&self.foreign).insert(made.id());
        let feed = Feed { publisher: made, foreign: self.foreign.clone() };
        let (topic, publisher, shared) =
            (self.topic.clone(), publisher.to_owned(), self.shared.clone());
        let mut is_told = false;
        Ok(Box::new(move |message| {
            let mut cdr = Vec::with_capacity(message.len() + 16);
            match codec.convert(message, &mut cdr) {
                Ok(()) => feed.publisher.publish(cdr),
                Err(error) if !std::mem::replace(&mut is_told, true) => {
                    let message =
                        format!("a message of {publisher} on `{topic}` is malformed: {error}");
                    shared.report(Diagnostic::warning("ros1-message", message));
                }
                Err(_) => {}
            }
        }))
    }

    fn complain(&self, publisher: &str, why: &str) {
        let message = format!("`{}` is not received from {publisher}: {why}", self.topic);
        self.shared.report(
            Diagnostic::warning("type-mismatch", message).help(
                "compare the types with `rostopic info`; both sides need the same definition",
            ),
        );
    }
}
