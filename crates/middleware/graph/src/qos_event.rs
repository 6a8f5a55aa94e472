//! What happens to the quality of service of an end, for who asks.
//!
//! Source: the events of `rmw/event.h`. They are worked out when somebody looks, from the clock of
//! the graph, so that they cost nothing otherwise and come the same in every run.

use std::collections::BTreeSet;
use std::fmt;

use periplus_msgs::Message;

use crate::common::lock;
use crate::graph::Core;
use crate::inlet::Inlet;
use crate::outlet::Outlet;
use crate::sample::EndpointId;
use crate::{History, Liveliness, Mailbox, Policy, Publisher, Qos, RawMailbox, RawPublisher};

/// Something that happened since somebody last looked.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum QosEvent {
    /// Times passed without a message: those that a publisher offered to keep, or that a
    /// subscription asked for. Time counts from the first message.
    DeadlineMissed {
        /// How often since the last look.
        new: u64,
        /// How often at all.
        total: u64,
    },
    /// A publisher that has to say that it lives did not.
    LivelinessLost,
    /// For a subscription: how many of its publishers live, and how many do not.
    LivelinessChanged {
        /// Those that live.
        alive: usize,
        /// Those that do not say so any more.
        silent: usize,
    },
    /// An end on the other side does not fit, and nothing goes between the two.
    Incompatible {
        /// Full name of its node.
        node: String,
        /// In which policies the offer is too weak.
        policies: Vec<Unfit>,
    },
    /// For a subscription that keeps all: messages were lost, because more than
    /// [`crate::MOST_KEPT`] waited.
    MessagesLost {
        /// How many since the last look.
        new: u64,
        /// How many at all.
        total: u64,
    },
}

/// A policy in which two ends do not fit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unfit {
    /// Which.
    pub policy: Policy,
    /// What the publisher offers, as ROS spells it.
    pub offered: String,
    /// What the subscription asks for.
    pub asked: String,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "offers {} {}, asked for is {}", self.policy, self.offered, self.asked)
    }
}

impl Unfit {
    /// The policies in which an offer is too weak.
    #[must_use]
    pub fn between(offered: &Qos, asked: &Qos) -> Vec<Self> {
        let spelled = |policy| Self {
            policy,
            offered: offered.spelled(policy),
            asked: asked.spelled(policy),
        };
        offered.lacks(asked).into_iter().map(spelled).collect()
    }
}

/// What was told already.
#[derive(Default)]
pub(crate) struct Told {
    deadlines: u64,
    lost: u64,
    is_silent: bool,
    liveliness: (usize, usize),
    unfit: BTreeSet<EndpointId>,
}

impl Outlet {
    /// Whether it says that it lives, as it has promised.
    fn is_alive(&self, now_ns: i64) -> bool {
        let qos = self.qos();
        match (qos.liveliness, qos.lease_ns) {
            (Liveliness::ManualByTopic, Some(lease_ns)) => {
                now_ns.saturating_sub(self.asserted_ns()) <= lease_ns
            }
            _ => true,
        }
    }

    fn events(&self, core: &Core) -> Vec<QosEvent> {
        let now_ns = core.common.clock.now_ns();
        let total = self.missed_deadlines();
        let qos = self.qos();
        let inlets = ends(core, &self.topic.name, |entry| entry.inlets().to_vec());
        let mut told = lock(&self.told);
        let mut events = Vec::new();
        deadlines(&mut told, total, &mut events);
        let is_silent = !self.is_alive(now_ns);
        if is_silent && !told.is_silent {
            events.push(QosEvent::LivelinessLost);
        }
        told.is_silent = is_silent;
        for inlet in inlets {
            incompatible(
                &mut told,
                inlet.id,
                &inlet.node,
                Unfit::between(&qos, &inlet.qos()),
                &mut events,
            );
        }
        events
    }
}

impl Inlet {
    fn events(&self, core: &Core) -> Vec<QosEvent> {
        let now_ns = core.common.clock.now_ns();
        let counts = self.counts();
        let qos = self.qos();
        let outlets = ends(core, &self.topic, |entry| entry.outlets().to_vec());
        let mut told = lock(&self.told);
        let mut events = Vec::new();
        deadlines(&mut told, counts.missed_deadlines, &mut events);
        let (mut alive, mut silent) = (0, 0);
        for outlet in outlets {
            let unfit = Unfit::between(&outlet.qos(), &qos);
            if !unfit.is_empty() {
                incompatible(&mut told, outlet.id, &outlet.node, unfit, &mut events);
            } else if outlet.is_alive(now_ns) {
                alive += 1;
            } else {
                silent += 1;
            }
        }
        if told.liveliness != (alive, silent) {
            told.liveliness = (alive, silent);
            events.push(QosEvent::LivelinessChanged { alive, silent });
        }
        // Who keeps only the last ones wants it so.
        let keeps_all = qos.history == History::KeepAll;
        let new = if keeps_all { counts.dropped - told.lost } else { 0 };
        if new > 0 {
            told.lost = counts.dropped;
            events.push(QosEvent::MessagesLost { new, total: counts.dropped });
        }
        events
    }
}

/// The ends on the other side of a topic.
fn ends<T>(
    core: &Core,
    topic: &str,
    ends: impl FnOnce(&crate::registry::TopicEntry) -> Vec<T>,
) -> Vec<T> {
    lock(&core.registry).topics.get(topic).map(ends).unwrap_or_default()
}

fn deadlines(told: &mut Told, total: u64, events: &mut Vec<QosEvent>) {
    let new = total - told.deadlines.min(total);
    if new > 0 {
        told.deadlines = total;
        events.push(QosEvent::DeadlineMissed { new, total });
    }
}

fn incompatible(
    told: &mut Told,
    id: EndpointId,
    node: &str,
    policies: Vec<Unfit>,
    events: &mut Vec<QosEvent>,
) {
    if !policies.is_empty() && told.unfit.insert(id) {
        events.push(QosEvent::Incompatible { node: node.to_owned(), policies });
    }
}

impl<T: Message> Publisher<T> {
    /// What happened to its quality of service since the last look.
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.outlet.events(&own.node.core)
    }

    /// Says that it lives, for a publisher with [`Liveliness::ManualByTopic`]; publishing says so,
    /// too.
    pub fn assert_liveliness(&self) {
        self.own().outlet.assert_liveliness();
    }
}

impl RawPublisher {
    /// As [`Publisher::events`].
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.outlet.events(&own.node.core)
    }

    /// As [`Publisher::assert_liveliness`].
    pub fn assert_liveliness(&self) {
        self.own().outlet.assert_liveliness();
    }
}

impl<T: Message> Mailbox<T> {
    /// What happened to its quality of service since the last look.
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.inlet.events(&own.node.core)
    }
}

impl RawMailbox {
    /// As [`Mailbox::events`].
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.inlet.events(&own.node.core)
    }
}
