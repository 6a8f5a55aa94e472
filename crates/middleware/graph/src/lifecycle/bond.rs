//! Bonds: two programs send heartbeats under a common id on the topic `bond` and detect when the
//! other stops. Nav2's lifecycle manager keeps one with each node.
//!
//! All times are steady: `bondcpp` runs its timers on the steady clock, and a bond between two
//! programs holds while the simulation of one is paused.
//!
//! Source: the documentation of `bond_core` (message `bond/Status`, its constants and states),
//! `bondcpp/src/bond.cpp` (wall timers, stamps of the steady clock), and Nav2's
//! `LifecycleNode::createBond` and `LifecycleManager::createBondConnection`.

use std::sync::{Arc, Mutex};

use periplus_msgs::bond::Status;
use periplus_msgs::builtin_interfaces::Time;
use periplus_msgs::std_msgs::Header;

use crate::common::lock;
use crate::{Actor, Mailbox, Node, Publisher, Qos, SteadyCallback};

/// Topic of all bonds of a namespace.
const TOPIC: &str = "bond";

/// Queue depth of the topic.
const DEPTH: usize = 100;

/// Period at which the end of a bond is published until the other end has acknowledged it \[ns\].
const DEAD_PUBLISH_PERIOD_NS: i64 = 50_000_000;

/// Timeout for that acknowledgement \[ns\].
const DISCONNECT_TIMEOUT_NS: i64 = 2_000_000_000;

/// Heartbeat timeout of the node's end, as in Nav2 \[s\].
const NODE_TIMEOUT_S: f64 = 4.0;

/// Settings of a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BondSettings {
    /// Period of heartbeats \[s\].
    pub period_s: f64,
    /// Time without a heartbeat after which the bond is broken \[s\].
    pub timeout_s: f64,
    /// True for the end that sends heartbeats before it has received one.
    pub begins: bool,
}

/// State machine of one end of a bond.
#[derive(Debug)]
pub struct Bond {
    id: String,
    instance_id: String,
    settings: BondSettings,
    sister: Option<String>,
    state: State,
    published_ns: Option<i64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// No heartbeat received yet.
    Waiting,
    /// Time of the last heartbeat \[ns\].
    Alive(i64),
    /// Time at which this end broke the bond \[ns\]; not acknowledged yet.
    Ending(i64),
    Broken,
}

fn ns(seconds: f64) -> i64 {
    // Saturates; periods are seconds.
    #[allow(clippy::cast_possible_truncation, reason = "saturates")]
    let ns = (seconds * 1e9) as i64;
    ns
}

impl Bond {
    /// Creates one end of the bond `id`; `instance_id` is unique to this end.
    #[must_use]
    pub fn new(id: &str, instance_id: &str, settings: BondSettings) -> Self {
        Self {
            id: id.to_owned(),
            instance_id: instance_id.to_owned(),
            settings,
            sister: None,
            state: State::Waiting,
            published_ns: None,
        }
    }

    /// Processes a message of the topic. Messages of other bonds, of this end, and of a third end
    /// are ignored.
    pub fn receive(&mut self, status: &Status, now_ns: i64) {
        if status.id != self.id || status.instance_id == self.instance_id {
            return;
        }
        match &self.sister {
            Some(sister) if *sister != status.instance_id => return,
            Some(_) => {}
            // The end of an earlier bond.
            None if !status.active => return,
            None => self.sister = Some(status.instance_id.clone()),
        }
        self.state = match (self.state, status.active) {
            (State::Waiting | State::Alive(_), true) => State::Alive(now_ns),
            // The other end broke the bond: acknowledge once.
            (State::Waiting | State::Alive(_), false) => {
                State::Ending(now_ns - DISCONNECT_TIMEOUT_NS)
            }
            (State::Ending(_), false) => State::Broken,
            (state, _) => state,
        };
    }

    /// Breaks the bond.
    pub fn end(&mut self, now_ns: i64) {
        self.state = match self.state {
            State::Alive(_) => State::Ending(now_ns),
            State::Waiting => State::Broken,
            state => state,
        };
        if self.state == State::Ending(now_ns) {
            self.published_ns = None;
        }
    }

    /// Returns the message that is due, if any. Calls more often than the period have no effect.
    pub fn due(&mut self, now_ns: i64) -> Option<Status> {
        match self.state {
            // Time went back: a reset, where no edge drives steady time.
            State::Alive(received_ns) if received_ns > now_ns => self.state = State::Alive(now_ns),
            State::Alive(received_ns) if now_ns - received_ns > ns(self.settings.timeout_s) => {
                self.state = State::Broken;
            }
            _ => {}
        }
        let (is_active, period_ns) = match self.state {
            State::Waiting if !self.settings.begins => return None,
            State::Waiting | State::Alive(_) => (true, ns(self.settings.period_s)),
            State::Ending(_) => (false, DEAD_PUBLISH_PERIOD_NS),
            State::Broken => return None,
        };
        let is_early = |published_ns| (0..period_ns).contains(&(now_ns - published_ns));
        if is_active && self.published_ns.is_some_and(is_early) {
            return None;
        }
        if let State::Ending(since_ns) = self.state
            && now_ns - since_ns >= DISCONNECT_TIMEOUT_NS
        {
            self.state = State::Broken;
        }
        self.published_ns = Some(now_ns);
        #[allow(clippy::cast_possible_truncation, reason = "seconds")]
        let [heartbeat_timeout, heartbeat_period] =
            [self.settings.timeout_s, self.settings.period_s].map(|seconds| seconds as f32);
        Some(Status {
            header: Header { stamp: Time::of_ns(now_ns), ..Header::default() },
            id: self.id.clone(),
            instance_id: self.instance_id.clone(),
            active: is_active,
            heartbeat_timeout,
            heartbeat_period,
        })
    }

    /// True when both ends have received heartbeats and neither has broken the bond.
    #[must_use]
    pub fn is_formed(&self) -> bool {
        matches!(self.state, State::Alive(_))
    }

    /// True when it was broken by either end, or heartbeats stopped.
    #[must_use]
    pub fn is_broken(&self) -> bool {
        matches!(self.state, State::Ending(_) | State::Broken)
    }
}

/// The node's end of the bond to its lifecycle manager. It is silent until the manager starts, so
/// that nothing is published where there is none.
pub(super) struct End {
    node: Node,
    heartbeats: Arc<Mutex<Heartbeats>>,
    /// Heartbeats where an edge drives steady time.
    _steady: SteadyCallback,
    /// Heartbeats where none does.
    _timer: Actor<()>,
}

struct Heartbeats {
    bond: Bond,
    publisher: Publisher<Status>,
    received: Mailbox<Status>,
}

impl Heartbeats {
    fn exchange(&mut self, now_ns: i64) {
        for status in self.received.drain() {
            self.bond.receive(&status, now_ns);
        }
        self.publish(now_ns);
    }

    fn publish(&mut self, now_ns: i64) {
        if let Some(status) = self.bond.due(now_ns) {
            self.publisher.publish(status);
        }
    }
}

impl End {
    /// Starts the bond; none if the node's period is not positive or the topic has another type.
    pub(super) fn start(node: &Node) -> Option<Self> {
        let period_s = lock(&node.0.standard().store).bond_period_s();
        if period_s.is_nan() || period_s <= 0.0 {
            return None;
        }
        // The instance id is never reused.
        let number = node.0.next_ordinal();
        let settings = BondSettings { period_s, timeout_s: NODE_TIMEOUT_S, begins: false };
        let graph = node.graph();
        let instance_id = format!("{}:{}:{number}", node.full_name(), graph.steady_now_ns());
        let bond = Bond::new(node.names().name(), &instance_id, settings);
        let qos = Qos::reliable(DEPTH);
        let publisher = node.publisher(TOPIC, qos).ok()?;
        let received = node.mailbox(TOPIC, qos).ok()?;
        let heartbeats = Arc::new(Mutex::new(Heartbeats { bond, publisher, received }));
        let own = heartbeats.clone();
        let steady = node.on_steady_time(move |now_ns| lock(&own).exchange(now_ns));
        let mut timer = node.actor(());
        let own = heartbeats.clone();
        let beat_ns = ns(period_s).clamp(1, DEAD_PUBLISH_PERIOD_NS);
        let beat = timer.timer(beat_ns, move |(), io| {
            let graph = io.node().graph();
            if !graph.has_steady_driver() {
                lock(&own).exchange(graph.steady_now_ns());
            }
        });
        beat.ok()?;
        Some(Self { node: node.clone(), heartbeats, _steady: steady, _timer: timer })
    }

    /// Breaks the bond and publishes that.
    pub(super) fn end(&self) {
        let now_ns = self.node.graph().steady_now_ns();
        let mut heartbeats = lock(&self.heartbeats);
        heartbeats.bond.end(now_ns);
        heartbeats.publish(now_ns);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: i64 = 1_000_000_000;

    fn settings(begins: bool) -> BondSettings {
        BondSettings { period_s: 0.1, timeout_s: 4.0, begins }
    }

    fn pair() -> (Bond, Bond) {
        let manager = Bond::new("map_server", "manager", settings(true));
        (manager, Bond::new("map_server", "node", settings(false)))
    }

    fn exchange(manager: &mut Bond, node: &mut Bond, now_ns: i64) {
        for _ in 0..2 {
            if let Some(status) = manager.due(now_ns) {
                node.receive(&status, now_ns);
            }
            if let Some(status) = node.due(now_ns) {
                manager.receive(&status, now_ns);
            }
        }
    }

    #[test]
    fn a_node_answers_the_manager_that_begins() {
        let (mut manager, mut node) = pair();
        assert_eq!(node.due(0), None);
        exchange(&mut manager, &mut node, 0);
        assert!(manager.is_formed() && node.is_formed());
        // One message per period, however often it is called.
        assert_eq!(node.due(SECOND / 20), None);
        let status = node.due(SECOND / 10).unwrap();
        assert!(status.active && status.heartbeat_period == 0.1 && status.heartbeat_timeout == 4.0);
    }

    #[test]
    fn silence_breaks_a_bond() {
        let (mut manager, mut node) = pair();
        exchange(&mut manager, &mut node, 0);
        let _ = manager.due(4 * SECOND);
        assert!(!manager.is_broken());
        assert_eq!(manager.due(4 * SECOND + 1), None);
        assert!(manager.is_broken());
    }

    /// Regression test: after a reset of simulated time an end was silent until the time before the
    /// reset.
    #[test]
    fn heartbeats_go_on_when_time_goes_back() {
        let (mut manager, mut node) = pair();
        exchange(&mut manager, &mut node, 100 * SECOND);
        assert!(node.due(0).is_some() && node.is_formed());
        assert_eq!(node.due(SECOND / 20), None);
        assert!(node.due(SECOND / 10).is_some());
        let _ = node.due(4 * SECOND + 1);
        assert!(node.is_broken());
    }

    #[test]
    fn an_end_is_published_until_it_is_acknowledged() {
        let (mut manager, mut node) = pair();
        exchange(&mut manager, &mut node, 0);
        node.end(SECOND);
        let last = node.due(SECOND).unwrap();
        assert!(!last.active && node.is_broken());
        manager.receive(&last, SECOND);
        assert!(manager.is_broken());
        // The manager acknowledges once; then both are silent.
        let known = manager.due(SECOND).unwrap();
        assert!(!known.active);
        assert_eq!(manager.due(2 * SECOND), None);
        node.receive(&known, SECOND);
        assert_eq!(node.due(2 * SECOND), None);
    }

    #[test]
    fn an_end_that_is_not_acknowledged_stops() {
        let (mut manager, mut node) = pair();
        exchange(&mut manager, &mut node, 0);
        node.end(SECOND);
        let ends: Vec<_> = (0..100).filter_map(|i| node.due(SECOND + i * SECOND / 20)).collect();
        assert!((40..=42).contains(&ends.len()), "{}", ends.len());
    }

    #[test]
    fn a_third_end_and_old_news_are_ignored() {
        let (mut manager, mut node) = pair();
        exchange(&mut manager, &mut node, 0);
        let mut other = Bond::new("map_server", "other", settings(true));
        let mut status = other.due(0).unwrap();
        status.active = false;
        manager.receive(&status, 0);
        assert!(manager.is_formed());
        let mut late = Bond::new("map_server", "late", settings(false));
        late.receive(&status, 0);
        assert!(!late.is_formed() && !late.is_broken());
    }
}
