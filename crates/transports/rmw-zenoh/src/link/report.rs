//! Reports of incompatible endpoints, once each. In Zenoh all QoS are compatible; only types can
//! differ.

use std::collections::BTreeSet;
use std::time::Duration;

use periplus_diagnostics::Diagnostic;
use periplus_graph::EndpointId;
use periplus_transport::Since;
use periplus_transport::report::{Party, other_hash, other_type};

use super::net::Net;
use super::topics::Topics;
use crate::token::{End, EntityKind};

/// Period at which outgoing traffic is checked.
const LOOK: Duration = Duration::from_millis(250);

#[derive(Default)]
pub(super) struct Told {
    slow: BTreeSet<EndpointId>,
    /// Time of the last traffic check.
    looked: Option<Since>,
}

fn party<'a>(node: &'a str, end: &'a End) -> Party<'a> {
    Party { node, type_name: &end.type_name, type_hash: end.type_hash.as_deref() }
}

impl Told {
    /// Compares the local endpoints with the remote ones.
    pub(super) fn look(&self, net: &Net, topics: &Topics) {
        for (_, one) in topics.publishing() {
            compare(net, &one.node, &one.end, EntityKind::Subscription);
        }
        for one in topics.subscribing() {
            for (node, _) in one.ends.values() {
                compare(net, node, &one.end, EntityKind::Publisher);
            }
        }
    }

    /// Warns about topics that are too fast for their subscribers.
    pub(super) fn look_at_traffic(&mut self, net: &Net, topics: &Topics) {
        if self.looked.is_some_and(|looked| looked.elapsed() < LOOK) {
            return;
        }
        self.looked = Some(Since::now());
        for (id, one) in topics.publishing() {
            if one.outgoing.dropped() > 0 && self.slow.insert(id) {
                let message = format!(
                    "the network is slower than `{}` publishes on `{}`; older messages are dropped \
                     for newer ones",
                    one.node, one.end.name
                );
                let help = "publish less often or smaller messages, or use a larger depth";
                net.say(Diagnostic::warning("slow-peer", message).help(help));
            }
        }
    }
}

fn compare(net: &Net, node: &str, end: &End, kind: EntityKind) {
    net.shared.others(|others, _| {
        for other in others.values().filter(|other| other.kind == kind) {
            let Some(theirs) = other.end.as_ref().filter(|theirs| theirs.name == end.name) else {
                continue;
            };
            let (ours, other) = (party(node, end), party(&other.node, theirs));
            if theirs.type_name != end.type_name {
                net.say(other_type(&end.name, ours, other));
            } else if !end.hears(theirs) && !theirs.hears(end) {
                net.say(other_hash(&end.name, ours, other));
            }
        }
    });
}
