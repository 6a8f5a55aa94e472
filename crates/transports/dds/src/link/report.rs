//! Reports of incompatible endpoints, once each.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::{EndpointId, Policy, Qos, Reliability};
use periplus_transport::report::{self, Party};
use periplus_transport::{Since, lock};

use super::net::Net;
use super::topics::Topics;
use crate::Guid;
use crate::names;
use crate::peers::{Endpoint, NAMELESS, Peers};

/// Time to wait for the node name of a new endpoint.
const PATIENCE: Duration = Duration::from_secs(1);

/// Period at which outgoing traffic is checked.
const LOOK: Duration = Duration::from_millis(250);

/// Maximum size of best-effort samples \[bytes\]: a whole sample has to fit into the receiver's
/// socket buffer. Measured with the default buffers of stock kernels.
const LARGEST_BEST_EFFORT: usize = 1_200_000;

#[derive(Default)]
pub(super) struct Told {
    /// Incompatible endpoints whose node name is unknown so far.
    waiting: BTreeMap<Guid, Since>,
    done: BTreeSet<(String, Guid)>,
    large: BTreeSet<EndpointId>,
    slow: BTreeSet<EndpointId>,
    /// Time of the last traffic check.
    looked: Option<Since>,
}

/// A local endpoint.
struct Own<'a> {
    topic: &'a str,
    node: &'a str,
    type_name: &'a str,
    type_hash: Option<&'a str>,
    qos: &'a Qos,
    is_writer: bool,
}

impl<'a> Own<'a> {
    fn party(&self) -> Party<'a> {
        Party { node: self.node, type_name: self.type_name, type_hash: self.type_hash }
    }
}

impl Told {
    pub(super) fn is_waiting(&self) -> bool {
        !self.waiting.is_empty()
    }

    /// Compares the local endpoints with the remote ones.
    pub(super) fn look(&mut self, net: &Net, topics: &Topics, peers: &Peers) {
        self.waiting.retain(|_, since| since.elapsed() < 2 * PATIENCE);
        for (_, one) in topics.publishing() {
            let (topic, node, type_name) = (&*one.topic, &*one.node, &*one.type_name);
            let type_hash = one.type_hash.as_deref();
            let own = Own { topic, node, type_name, type_hash, qos: &one.qos, is_writer: true };
            self.compare(net, &own, peers);
        }
        for one in topics.subscribing() {
            let (topic, type_name) = (&*one.topic, &*one.type_name);
            let type_hash = one.type_hash.as_deref();
            for node in &one.nodes {
                let own =
                    Own { topic, node, type_name, type_hash, qos: &one.qos, is_writer: false };
                self.compare(net, &own, peers);
            }
        }
    }

    fn compare(&mut self, net: &Net, own: &Own<'_>, peers: &Peers) {
        for (guid, end) in peers.ends(&names::topic(own.topic), !own.is_writer) {
            if self.done.contains(&(own.node.to_owned(), guid)) {
                continue;
            }
            let Some(describe) = differ(own, end) else { continue };
            let node = match peers.node_of(guid) {
                Some(node) => node,
                None if self.waiting.entry(guid).or_insert_with(Since::now).elapsed()
                    < PATIENCE =>
                {
                    continue;
                }
                None => NAMELESS,
            };
            self.waiting.remove(&guid);
            self.done.insert((own.node.to_owned(), guid));
            net.say(describe(node));
        }
    }

    /// Warns about topics that are too large or too fast for their subscribers.
    pub(super) fn look_at_traffic(&mut self, net: &Net, topics: &Topics) {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK) {
            return;
        }
        self.looked = Some(Since::now());
        for (id, one) in topics.publishing() {
            let largest = one.outgoing.largest();
            if largest > LARGEST_BEST_EFFORT && !self.large.contains(&id) {
                let peers = lock(&net.shared.peers);
                let topic = names::topic(&one.topic);
                let best_effort = peers
                    .ends(&topic, false)
                    .find(|(_, end)| end.qos.reliability == Reliability::BestEffort);
                let Some((guid, _)) = best_effort else { continue };
                let node = peers.node_of(guid).unwrap_or(NAMELESS).to_owned();
                drop(peers);
                self.large.insert(id);
                let message = format!(
                    "`{node}` subscribes to `{}` with best effort, and its messages have up to \
                     {largest} bytes: most will not arrive",
                    one.topic
                );
                net.say(Diagnostic::warning("large-best-effort", message).help(
                    "subscribe with reliable, make the messages smaller, or give the receiver's \
                     sockets more room: `sysctl -w net.core.rmem_max=33554432 \
                     net.core.rmem_default=33554432`",
                ));
            }
            let (dropped, refused) = one.outgoing.losses();
            if dropped + refused > 0 && self.slow.insert(id) {
                let message = format!(
                    "remote subscriptions to `{}` are slower than `{}` publishes; older \
                     messages are dropped in favour of newer ones",
                    one.topic, one.node
                );
                net.say(Diagnostic::warning("slow-peer", message).help(
                    "publish less often or smaller messages; subscribe with best effort to what \
                     may get lost; a program that was killed counts as slow for up to 10 s",
                ));
            }
        }
    }
}

type Describe<'a> = Box<dyn Fn(&str) -> Diagnostic + 'a>;

/// Compares two endpoints; the returned function describes the difference, given the name of the
/// remote node.
fn differ<'a>(own: &'a Own<'a>, end: &'a Endpoint) -> Option<Describe<'a>> {
    if end.type_name != names::type_of(own.type_name) {
        return Some(Box::new(|node| other_type(own, end, node)));
    }
    let (offer, asked) = if own.is_writer { (own.qos, &end.qos) } else { (&end.qos, own.qos) };
    let lacks = offer.incompatible_policies(asked);
    if !lacks.is_empty() {
        return Some(Box::new(move |node| other_qos(own, end, node, &lacks)));
    }
    let hash = end.type_hash.as_deref();
    (hash.is_some() && own.type_hash.is_some() && hash != own.type_hash)
        .then(|| Box::new(move |node: &str| other_hash(own, hash, node)) as Describe<'a>)
}

fn other_type(own: &Own<'_>, end: &Endpoint, node: &str) -> Diagnostic {
    let theirs = names::message(&end.type_name).unwrap_or_else(|| end.type_name.clone());
    let theirs = Party { node, type_name: &theirs, type_hash: None };
    report::other_type(own.topic, own.party(), theirs)
}

fn other_hash(own: &Own<'_>, hash: Option<&str>, node: &str) -> Diagnostic {
    let theirs = Party { node, type_name: own.type_name, type_hash: hash };
    report::other_hash(own.topic, own.party(), theirs)
}

fn other_qos(own: &Own<'_>, end: &Endpoint, node: &str, lacks: &[Policy]) -> Diagnostic {
    let (offers, asks) = if own.is_writer { (own.node, node) } else { (node, own.node) };
    let (offer, asked) = if own.is_writer { (own.qos, &end.qos) } else { (&end.qos, own.qos) };
    let policies: Vec<String> = lacks
        .iter()
        .map(|policy| {
            let (offer, asked) = (offer.policy_value(*policy), asked.policy_value(*policy));
            format!("offers {policy} {offer}, requested is {asked}")
        })
        .collect();
    let message = format!(
        "`{asks}` receives nothing from `{offers}` on the topic `{}`: the publisher {}",
        own.topic,
        policies.join("; it ")
    );
    Diagnostic::warning("qos-mismatch", message)
        .help("request weaker policies, or offer stronger ones")
}
