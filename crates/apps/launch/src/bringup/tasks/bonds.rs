//! Bonds of a lifecycle manager with its nodes.
//!
//! Source: `LifecycleManager::createBondConnection` and `checkBondConnections` of Nav2.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use periplus_graph::{
    Bond, BondSettings, GraphError, Mailbox, Node, Publisher, Qos, SteadyCallback,
};
use periplus_msgs::bond::Status;

/// Topic of all bonds of a namespace.
const TOPIC: &str = "bond";

/// Queue depth.
const DEPTH: usize = 100;

/// Period of heartbeats, the default of Nav2 \[s\].
const PERIOD_S: f64 = 0.1;

/// Bonds by node name. All times are steady: heartbeats continue while the simulation is paused or
/// the manager waits.
pub(super) struct Bonds {
    heartbeats: Arc<Mutex<Heartbeats>>,
    _steady: SteadyCallback,
}

struct Heartbeats {
    instance_id: String,
    timeout_s: f64,
    publisher: Publisher<Status>,
    received: Mailbox<Status>,
    bonds: BTreeMap<String, BondState>,
}

struct BondState {
    bond: Bond,
    since_ns: i64,
    was_formed: bool,
}

/// Bond that broke, or never formed.
pub(super) struct BrokenBond {
    pub(super) name: String,
    pub(super) reason: String,
    /// False if the node never responded: it has no bond, and a restart would not change that.
    pub(super) was_formed: bool,
}

impl Bonds {
    /// Creates the bonds; `None` when the timeout is not positive.
    ///
    /// # Errors
    /// An error when the topic has another type.
    pub(super) fn new(node: &Node, timeout_s: f64) -> Result<Option<Self>, GraphError> {
        if timeout_s.is_nan() || timeout_s <= 0.0 {
            return Ok(None);
        }
        let qos = Qos::reliable(DEPTH);
        let heartbeats = Arc::new(Mutex::new(Heartbeats {
            instance_id: format!("{}:{}", node.full_name(), node.graph().steady_now_ns()),
            timeout_s,
            publisher: node.publisher(TOPIC, qos)?,
            received: node.mailbox(TOPIC, qos)?,
            bonds: BTreeMap::new(),
        }));
        let own = heartbeats.clone();
        let steady = node.on_steady_time(move |now_ns| lock(&own).exchange(now_ns));
        Ok(Some(Self { heartbeats, _steady: steady }))
    }

    /// Starts a bond with a node that became active.
    pub(super) fn begin(&mut self, name: &str, now_ns: i64) {
        lock(&self.heartbeats).begin(name, now_ns);
    }

    /// Returns true while a node has not responded yet.
    pub(super) fn is_forming(&self) -> bool {
        lock(&self.heartbeats).bonds.values().any(|held| !held.was_formed)
    }

    /// Ends the bond with a node that is deactivated.
    pub(super) fn end(&mut self, name: &str, now_ns: i64) {
        lock(&self.heartbeats).end(name, now_ns);
    }

    /// Exchanges heartbeats. Returns a bond that broke or did not form.
    pub(super) fn keep(&mut self, now_ns: i64) -> Option<BrokenBond> {
        let mut heartbeats = lock(&self.heartbeats);
        heartbeats.exchange(now_ns);
        heartbeats.take_broken(now_ns)
    }
}

/// Locks a mutex, also after a panic of another thread.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Heartbeats {
    fn begin(&mut self, name: &str, now_ns: i64) {
        let settings = BondSettings { period_s: PERIOD_S, timeout_s: self.timeout_s, begins: true };
        let id = name.rsplit('/').next().unwrap_or(name);
        let instance_id = format!("{}:{name}:{now_ns}", self.instance_id);
        let bond = Bond::new(id, &instance_id, settings);
        self.bonds.insert(name.to_owned(), BondState { bond, since_ns: now_ns, was_formed: false });
    }

    fn end(&mut self, name: &str, now_ns: i64) {
        if let Some(mut held) = self.bonds.remove(name) {
            held.bond.end(now_ns);
            if let Some(status) = held.bond.due(now_ns) {
                self.publisher.publish(status);
            }
        }
    }

    fn exchange(&mut self, now_ns: i64) {
        for status in self.received.drain() {
            for held in self.bonds.values_mut() {
                held.bond.receive(&status, now_ns);
            }
        }
        for held in self.bonds.values_mut() {
            held.was_formed |= held.bond.is_formed();
            if let Some(status) = held.bond.due(now_ns) {
                self.publisher.publish(status);
            }
        }
    }

    fn take_broken(&mut self, now_ns: i64) -> Option<BrokenBond> {
        let timeout_s = self.timeout_s;
        #[allow(clippy::cast_possible_truncation, reason = "saturates")]
        let forming_ns = (timeout_s / 2.0 * 1e9) as i64;
        let broken = self.bonds.iter().find_map(|(name, held)| {
            let reason = if held.bond.is_broken() {
                format!(
                    "`{name}` is down: no heartbeat of its bond for {timeout_s:.2} s, or it ended the bond"
                )
            } else if !held.was_formed && now_ns - held.since_ns > forming_ns {
                format!(
                    "`{name}` was unable to be reached after {timeout_s:.2} s by bond; set `bond_timeout: \
                     0.0` for nodes that keep no bond"
                )
            } else {
                return None;
            };
            Some(BrokenBond { name: name.clone(), reason, was_formed: held.was_formed })
        })?;
        self.bonds.remove(&broken.name);
        Some(broken)
    }
}
