//! The bonds of a lifecycle manager with its nodes.
//!
//! Source: `LifecycleManager::createBondConnection` and `checkBondConnections` of Nav2.

use std::collections::BTreeMap;

use periplus_graph::{Bond, BondSettings, GraphError, Mailbox, Node, Publisher, Qos};
use periplus_msgs::bond::Status;

/// Topic of all bonds of a namespace.
const TOPIC: &str = "bond";

/// Messages that wait on it.
const DEPTH: usize = 100;

/// Period of the manager's heartbeats, as Nav2's manager has it \[s\].
const PERIOD_S: f64 = 0.1;

/// Bonds with nodes, by the nodes' names.
pub(super) struct Bonds {
    instance_id: String,
    timeout_s: f64,
    publisher: Publisher<Status>,
    received: Mailbox<Status>,
    bonds: BTreeMap<String, Held>,
}

struct Held {
    bond: Bond,
    since_ns: i64,
    was_formed: bool,
}

/// A bond that broke, or never formed.
pub(super) struct Broken {
    pub(super) name: String,
    pub(super) reason: String,
}

impl Bonds {
    /// None when the timeout is not positive.
    ///
    /// # Errors
    /// When the topic has another type.
    pub(super) fn new(node: &Node, timeout_s: f64) -> Result<Option<Self>, GraphError> {
        if timeout_s.is_nan() || timeout_s <= 0.0 {
            return Ok(None);
        }
        let qos = Qos::reliable(DEPTH);
        Ok(Some(Self {
            instance_id: format!("{}:{}", node.full_name(), node.now_ns()),
            timeout_s,
            publisher: node.publisher(TOPIC, qos)?,
            received: node.mailbox(TOPIC, qos)?,
            bonds: BTreeMap::new(),
        }))
    }

    /// Begins a bond with a node that became active.
    pub(super) fn begin(&mut self, name: &str, now_ns: i64) {
        let settings = BondSettings { period_s: PERIOD_S, timeout_s: self.timeout_s, begins: true };
        let id = name.rsplit('/').next().unwrap_or(name);
        let instance_id = format!("{}:{name}:{now_ns}", self.instance_id);
        let bond = Bond::new(id, &instance_id, settings);
        self.bonds.insert(name.to_owned(), Held { bond, since_ns: now_ns, was_formed: false });
    }

    /// True while a node has not answered yet.
    pub(super) fn is_forming(&self) -> bool {
        self.bonds.values().any(|held| !held.was_formed)
    }

    /// Ends the bond with a node that is deactivated.
    pub(super) fn end(&mut self, name: &str, now_ns: i64) {
        if let Some(mut held) = self.bonds.remove(name) {
            held.bond.end(now_ns);
            if let Some(status) = held.bond.due(now_ns) {
                self.publisher.publish(status);
            }
        }
    }

    /// Sends and receives heartbeats. Gives a bond that broke, and ends all others then.
    pub(super) fn keep(&mut self, now_ns: i64) -> Option<Broken> {
        for status in self.received.drain() {
            for held in self.bonds.values_mut() {
                held.bond.receive(&status, now_ns);
            }
        }
        let mut broken = None;
        #[allow(clippy::cast_possible_truncation, reason = "saturates")]
        let forming_ns = (self.timeout_s / 2.0 * 1e9) as i64;
        for (name, held) in &mut self.bonds {
            held.was_formed |= held.bond.is_formed();
            if let Some(status) = held.bond.due(now_ns) {
                self.publisher.publish(status);
            }
            let timeout_s = self.timeout_s;
            let reason = if held.bond.is_broken() {
                format!(
                    "`{name}` is down: no heartbeat of its bond for {timeout_s:.2} s, or it ended it"
                )
            } else if !held.was_formed && now_ns - held.since_ns > forming_ns {
                format!(
                    "`{name}` was unable to be reached after {timeout_s:.2} s by bond; set `bond_timeout: \
                     0.0` for nodes that keep no bond"
                )
            } else {
                continue;
            };
            broken.get_or_insert(Broken { name: name.clone(), reason });
        }
        if let Some(Broken { name, .. }) = &broken {
            self.bonds.remove(name);
        }
        broken
    }
}
