//! QoS events of an endpoint.
//!
//! Source: the events of `rmw/event.h`. They are computed on request from the clock of the graph,
//! so that they cost nothing otherwise and are the same in every run.

use std::collections::BTreeSet;
use std::fmt;

use periplus_msgs::Message;

use crate::common::lock;
use crate::graph::Core;
use crate::publisher_core::PublisherCore;
use crate::sample::EndpointId;
use crate::subscription_core::SubscriptionCore;
use crate::{History, Liveliness, Mailbox, Policy, Publisher, Qos, RawMailbox, RawPublisher};

/// A QoS event since the last call.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum QosEvent {
    /// Deadlines passed without a message: the deadline that a publisher offered, or that a
    /// subscription requested. They count from the first message.
    DeadlineMissed {
        /// Number since the last call.
        new: u64,
        /// Total number.
        total: u64,
    },
    /// A publisher did not assert its liveliness in time.
    LivelinessLost,
    /// For a subscription: the numbers of live and lost publishers changed.
    LivelinessChanged {
        /// Number of publishers that are alive.
        alive: usize,
        /// Number of publishers that no longer assert their liveliness.
        silent: usize,
    },
    /// A publisher or subscription of the topic is incompatible; no messages are exchanged.
    Incompatible {
        /// Full name of its node.
        node: String,
        /// Policies in which the offer is too weak.
        policies: Vec<IncompatiblePolicy>,
    },
    /// For a `KEEP_ALL` subscription: messages were lost because more than [`crate::KEEP_ALL_MAX_MESSAGES`]
    /// were queued.
    MessagesLost {
        /// Number since the last call.
        new: u64,
        /// Total number.
        total: u64,
    },
}

/// A policy that is incompatible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct IncompatiblePolicy {
    /// The policy.
    pub policy: Policy,
    /// The offered value, in the spelling of ROS.
    pub offered: String,
    /// The requested value.
    pub asked: String,
}

impl fmt::Display for IncompatiblePolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "offers {} {}, requested is {}", self.policy, self.offered, self.asked)
    }
}

impl IncompatiblePolicy {
    /// Returns the policies in which an offer is too weak.
    #[must_use]
    pub fn between(offered: &Qos, asked: &Qos) -> Vec<Self> {
        let spelled = |policy| Self {
            policy,
            offered: offered.policy_value(policy),
            asked: asked.policy_value(policy),
        };
        offered.incompatible_policies(asked).into_iter().map(spelled).collect()
    }
}

/// The events that were already reported.
#[derive(Default)]
pub(crate) struct ReportedEvents {
    deadlines: u64,
    lost: u64,
    is_silent: bool,
    liveliness: (usize, usize),
    unfit: BTreeSet<EndpointId>,
}

impl PublisherCore {
    /// True if the publisher asserts its liveliness as offered.
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
        let subscriptions = ends(core, &self.topic.name, |entry| entry.subscriptions().to_vec());
        let mut reported = lock(&self.reported);
        let mut events = Vec::new();
        deadlines(&mut reported, total, &mut events);
        let is_silent = !self.is_alive(now_ns);
        if is_silent && !reported.is_silent {
            events.push(QosEvent::LivelinessLost);
        }
        reported.is_silent = is_silent;
        for subscription in subscriptions {
            incompatible(
                &mut reported,
                subscription.id,
                &subscription.node,
                IncompatiblePolicy::between(&qos, &subscription.qos()),
                &mut events,
            );
        }
        events
    }
}

impl SubscriptionCore {
    fn events(&self, core: &Core) -> Vec<QosEvent> {
        let now_ns = core.common.clock.now_ns();
        let counts = self.counts();
        let qos = self.qos();
        let publishers = ends(core, &self.topic, |entry| entry.publishers().to_vec());
        let mut reported = lock(&self.reported);
        let mut events = Vec::new();
        deadlines(&mut reported, counts.missed_deadlines, &mut events);
        let (mut alive, mut silent) = (0, 0);
        for publisher in publishers {
            let unfit = IncompatiblePolicy::between(&publisher.qos(), &qos);
            if !unfit.is_empty() {
                incompatible(&mut reported, publisher.id, &publisher.node, unfit, &mut events);
            } else if publisher.is_alive(now_ns) {
                alive += 1;
            } else {
                silent += 1;
            }
        }
        if reported.liveliness != (alive, silent) {
            reported.liveliness = (alive, silent);
            events.push(QosEvent::LivelinessChanged { alive, silent });
        }
        // A `KEEP_LAST` history drops messages by design.
        let keeps_all = qos.history == History::KeepAll;
        let new = if keeps_all { counts.dropped - reported.lost } else { 0 };
        if new > 0 {
            reported.lost = counts.dropped;
            events.push(QosEvent::MessagesLost { new, total: counts.dropped });
        }
        events
    }
}

/// The endpoints on the other side of a topic.
fn ends<T>(
    core: &Core,
    topic: &str,
    ends: impl FnOnce(&crate::registry::TopicEntry) -> Vec<T>,
) -> Vec<T> {
    lock(&core.registry).topics.get(topic).map(ends).unwrap_or_default()
}

fn deadlines(reported: &mut ReportedEvents, total: u64, events: &mut Vec<QosEvent>) {
    let new = total - reported.deadlines.min(total);
    if new > 0 {
        reported.deadlines = total;
        events.push(QosEvent::DeadlineMissed { new, total });
    }
}

fn incompatible(
    reported: &mut ReportedEvents,
    id: EndpointId,
    node: &str,
    policies: Vec<IncompatiblePolicy>,
    events: &mut Vec<QosEvent>,
) {
    if !policies.is_empty() && reported.unfit.insert(id) {
        events.push(QosEvent::Incompatible { node: node.to_owned(), policies });
    }
}

impl<T: Message> Publisher<T> {
    /// Returns the QoS events since the last call.
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.publisher.events(&own.node.core)
    }

    /// Asserts liveliness, for a publisher with [`Liveliness::ManualByTopic`]; publishing asserts
    /// it, too.
    pub fn assert_liveliness(&self) {
        self.own().publisher.assert_liveliness();
    }
}

impl RawPublisher {
    /// Same as [`Publisher::events`].
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.publisher.events(&own.node.core)
    }

    /// Same as [`Publisher::assert_liveliness`].
    pub fn assert_liveliness(&self) {
        self.own().publisher.assert_liveliness();
    }
}

impl<T: Message> Mailbox<T> {
    /// Returns the QoS events since the last call.
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.subscription.events(&own.node.core)
    }
}

impl RawMailbox {
    /// Same as [`Mailbox::events`].
    #[must_use]
    pub fn events(&self) -> Vec<QosEvent> {
        let own = self.own();
        own.subscription.events(&own.node.core)
    }
}
